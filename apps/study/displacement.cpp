// SPDX-License-Identifier: Apache-2.0
//
// Displacement mapping: the mesh resolution that the Moon's relief needs, depending on the source of the normals.
#include <fmt/format.h>

#include "halfspace/render/frame/frame.h"
#include "halfspace/render/scene_assets.h"
#include "halfspace/scene/scene_file.h"
#include "study/pictures.h"

namespace halfspace {

namespace {

SceneDescription moon(int latitudes, const char* normals, bool quick) {
  SceneFile file = SceneFile::open("moon");
  // All variants use the same maps. The relief is so coarse that the reference mesh has six times its resolution.
  const int width = quick ? 512 : 2048, relief = quick ? 128 : 512;
  file.set(std::vector<std::string>{fmt::format("moon.latitudes={}", latitudes), fmt::format("moon.longitudes={}", 2 * latitudes),
                                    fmt::format("moon.normals={}", normals), "shadow.method=none", "background.type=color",
                                    fmt::format("surface.width={}", width), fmt::format("relief.width={}", relief)});
  return file.description();
}

}  // namespace

Study study_displacement(const StudyOptions& options, const Workers& workers) {
  const int width = options.quick ? 160 : 960, height = options.quick ? 90 : 540, finest = options.quick ? 256 : 1536;
  Study study{
      .name = "displacement",
      .title = "Displacement: mesh resolution of the Moon",
      .setting = fmt::format("The Moon without shadows, {}x{}; labels give the number of latitude bands", width, height),
      .error_name = "mean error of linear light over the image",
      .time_name = "frame",
      .truth = {fmt::format("the same with {} bands, normals per pixel", finest), 0.0, "a third of the change from half as many bands"},
  };
  SceneAssets assets(workers);
  Image<glm::vec4> truth(width, height), half(width, height);
  render(assets.prepare(moon(finest, "pixel", options.quick), width, height), truth, workers);
  render(assets.prepare(moon(finest / 2, "pixel", options.quick), width, height), half, workers);
  set_truth(study.truth, truth, half, PictureError::mean);
  for (const auto& [normals, group] : {std::pair("pixel", "normals per pixel"), std::pair("vertex", "normals per vertex"),
                                       std::pair("undisplaced", "normals of the sphere")}) {
    for (const int latitudes : options.quick ? std::vector{16, 64} : std::vector{16, 32, 64, 128, 256}) {
      const PreparedScene prepared = assets.prepare(moon(latitudes, normals, options.quick), width, height);
      Image<glm::vec4> picture(width, height);
      PassStatistics statistics;
      Variant v{.name = fmt::format("{} {}", normals, latitudes), .group = group};
      v.time = time_of([&] { statistics = render(prepared, picture, workers); }, options);
      v.parameters = {{"latitudes", static_cast<double>(latitudes)},
                      {"triangles", static_cast<double>(statistics.primitives_in)},
                      {"pixels", static_cast<double>(statistics.fragments_shaded)}};
      set_picture_error(v, picture, truth, PictureError::mean);
      study.variants.push_back(std::move(v));
    }
  }
  return study;
}

}  // namespace halfspace
