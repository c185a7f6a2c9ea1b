// SPDX-License-Identifier: Apache-2.0
#include "halfspace/render/model_file/opened_scene.h"
#include "halfspace/render/scene_assets.h"

#include <algorithm>
#include <cstdint>
#include <string_view>
#include <utility>

namespace halfspace::HS_LANES {

OpenedScene open_scene_or_model(const std::string& name_or_file, const ModelView& view) {
  if (!is_model_file(name_or_file)) return {SceneFile::open(name_or_file), {}, nullptr, {}};
  GeneratedScene generated = model_scene(name_or_file, view);
  const std::filesystem::path file = std::filesystem::absolute(name_or_file).lexically_normal();
  return {SceneFile::parse(generated.text, name_or_file, std::filesystem::current_path()), file, std::move(generated.model),
          std::move(generated.camera_names), generated.radius};
}

std::string message_in_scene(const SceneFile& scene, const std::string& message) {
  constexpr std::string_view kPanorama = "environments.around.map: ";
  if (is_model_file(scene.source()) && message.starts_with(kPanorama)) return "--environment: " + message.substr(kPanorama.size());
  const std::string place = scene.source() + ": ";
  return message.starts_with(place) ? message : place + message;
}

void expect_frames(SceneAssets& assets, const SceneFile& scene, int frames, const std::function<double(int)>& time_of, int width,
                   int height) {
  constexpr int kMaxLooks = 1000;
  const int looks = scene.description().animations.empty() ? 1 : std::min(frames, kMaxLooks);
  for (int i = 0; i < looks; ++i) {
    const int frame = static_cast<int>(static_cast<int64_t>(frames - 1) * i / std::max(looks - 1, 1));
    assets.expect(scene.at(time_of(frame)), width, height);
  }
}

}  // namespace halfspace::HS_LANES
