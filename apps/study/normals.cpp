// SPDX-License-Identifier: Apache-2.0
//
// Compares normal maps, bump maps and displacement on the mountains of the Earth.
#include <fmt/format.h>

#include "halfspace/render/frame/frame.h"
#include "halfspace/render/scene_assets.h"
#include "halfspace/scene/scene_file.h"
#include "study/pictures.h"

namespace halfspace {

namespace {

constexpr double kScale = 0.02;  // units per height of 1; the normal map of the Earth is made for this scale

SceneDescription earth(bool quick, const std::vector<std::string>& settings) {
  SceneFile file = SceneFile::open("earth");
  const int width = quick ? 128 : 512;  // so coarse that the reference mesh has four times the resolution of the relief
  file.set(std::vector<std::string>{fmt::format("heights.width={}", width), fmt::format("normals.width={}", width), "earth.color=#808080",
                                    "sun.position=6,1,1", "background.color=0,0,0"});
  file.set(settings);
  return file.description();
}

std::vector<std::string> displaced(int latitudes) {
  return {"earth.normal=none",
          "earth.height=heights",
          fmt::format("earth.height_scale={}", kScale),
          "earth.height_zero=0",
          fmt::format("earth.latitudes={}", latitudes),
          fmt::format("earth.longitudes={}", 2 * latitudes)};
}

struct Kind {
  std::string name, group;
  std::vector<std::string> settings;
};

std::vector<Kind> kinds(bool quick) {
  std::vector<Kind> list{{"sphere normals", "one mesh, 256 bands", {"earth.normal=none"}},
                         {"normal map", "one mesh, 256 bands", {"earth.normal=map"}},
                         {"bump by difference", "one mesh, 256 bands", {"earth.normal=bump", "earth.bump_method=difference"}},
                         {"bump by gradient", "one mesh, 256 bands", {"earth.normal=bump", "earth.bump_method=gradient"}}};
  for (Kind& k : list) k.settings.insert(k.settings.end(), {"earth.latitudes=256", "earth.longitudes=512"});
  for (const int n : quick ? std::vector{64} : std::vector{64, 128, 256}) {
    list.push_back({fmt::format("displaced {}, per vertex", n), "displaced", displaced(n)});
    list.back().settings.push_back("earth.normals=vertex");
    list.push_back({fmt::format("displaced {}, per pixel", n), "displaced", displaced(n)});
  }
  return list;
}

}  // namespace

Study study_normals(const StudyOptions& options, const Workers& workers) {
  const int width = options.quick ? 160 : 960, height = options.quick ? 90 : 540, finest = options.quick ? 256 : 1024;
  Study study{
      .name = "normals",
      .title = "Normals: per vertex, from maps, by displacement",
      .setting =
          fmt::format("The Earth's relief in gray, lit at a grazing angle, {}x{}; labels give the number of latitude bands", width, height),
      .error_name = "mean error of linear light over the image",
      .time_name = "frame",
      .truth = {fmt::format("displaced with {} bands, normals per pixel", finest), 0.0, "a third of the change from half as many bands"},
  };
  SceneAssets assets(workers);
  Image<glm::vec4> truth(width, height), half(width, height);
  render(assets.prepare(earth(options.quick, displaced(finest)), width, height), truth, workers);
  render(assets.prepare(earth(options.quick, displaced(finest / 2)), width, height), half, workers);
  set_truth(study.truth, truth, half, PictureError::mean);
  for (const Kind& kind : kinds(options.quick)) {
    const PreparedScene prepared = assets.prepare(earth(options.quick, kind.settings), width, height);
    Image<glm::vec4> picture(width, height);
    PassStatistics statistics;
    Variant v{.name = kind.name, .group = kind.group};
    v.time = time_of([&] { statistics = render(prepared, picture, workers); }, options);
    v.parameters = {{"triangles", static_cast<double>(statistics.primitives_in)},
                    {"pixels", static_cast<double>(statistics.fragments_shaded)}};
    set_picture_error(v, picture, truth, PictureError::mean);
    study.variants.push_back(std::move(v));
  }
  return study;
}

}  // namespace halfspace
