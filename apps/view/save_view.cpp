// SPDX-License-Identifier: Apache-2.0
#include "view/save_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <span>

#include "halfspace/core/check.h"
#include "halfspace/image/atomic_output.h"
#include "halfspace/image/image_io.h"
#include "halfspace/render/frame/frame.h"
#include "halfspace/render/scene_assets.h"

namespace halfspace {

namespace {

ViewFiles unused_files(const std::string& name, const std::filesystem::path& folder) {
  for (int i = 1;; ++i) {
    ViewFiles files{folder / fmt::format("{}-view-{}.png", name, i), folder / fmt::format("{}-view-{}.json", name, i)};
    if (!std::filesystem::exists(files.picture) && !std::filesystem::exists(files.scene)) return files;
  }
}

}  // namespace

std::string scene_text_at(const SceneFile& scene, double seconds) {
  const SceneDescription& d = scene.description();
  const double time = d.time.hours / 24.0 * d.time.day + seconds * d.animation.speed;
  if (time < 0.0) throw OutputError("the time of the animation is negative, but a scene file cannot start before 0; expected a later time");
  // `hours` cannot exceed a day, so a later time requires a longer day.
  double day = d.time.day;
  while (time > day) day *= 2.0;
  SceneFile saved = scene;
  saved.set(std::vector<std::string>{"time.day=" + number_text(day), "time.hours=" + number_text(std::min(time / day * 24.0, 24.0))});
  return saved.print();
}

ViewFiles save_view(const SceneFile& scene, double seconds, const std::string& name, int width, int height, int threads,
                    const std::filesystem::path& folder) {
  const ViewFiles files = unused_files(name, folder);
  const std::string text = scene_text_at(scene, seconds);
  const SceneFile saved = SceneFile::parse(text, files.scene.string(), folder);
  const Workers workers(threads);
  SceneAssets assets(workers);  // new assets, because maps that are cached between frames can be finer than this picture needs
  Image<glm::u8vec4> picture(width, height);
  render(assets.prepare(saved.at(0.0), width, height), picture, workers);
  write_file(files.scene, std::as_bytes(std::span(text)));
  write_png(files.picture, picture);
  return files;
}

}  // namespace halfspace
