// SPDX-License-Identifier: Apache-2.0
//
// Compares lighting per triangle, per vertex and per pixel on a sphere with few or many triangles.
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "halfspace/geometry/shapes.h"
#include "halfspace/scene/scene_file.h"
#include "study/pictures.h"

namespace halfspace {

namespace {

constexpr const char* kLitScene = R"({{
  "version": 1,
  "cameras": {{ "main": {{ "position": [0, 0, 4], "fov": 32, "near": 0.1, "far": 100 }} }},
  "lights": {{ "sun": {{ "direction": [1, 1, 1.5] }} }},
  "ambient": 0.05,
  "objects": {{ "ball": {{ "shape": "uv_sphere", "latitudes": {}, "longitudes": {}, "shading": "{}",
                         "diffuse": 0.7, "specular": 0.5, "shininess": 40 }} }}
}})";

// Excludes the silhouette from the comparison: where only one of the two images shows the sphere, replaces the pixel with the reference.
// Returns the number of these pixels as a fraction of the sphere's pixels.
double exclude_silhouette(Image<glm::vec4>& light, const Image<double>& truth) {
  int moved = 0, sphere = 0;
  for (std::size_t i = 0; i < truth.texels().size(); ++i) {
    const bool is_sphere = truth.data()[i] > 0.0;
    sphere += is_sphere;
    if ((light.data()[i].x > 0.0f) == is_sphere) continue;
    ++moved;
    light.data()[i] = glm::vec4(glm::vec3(static_cast<float>(truth.data()[i])), 1.0f);
  }
  return static_cast<double>(moved) / sphere;
}

}  // namespace

Study study_shading_rate(const StudyOptions& options, const Workers& workers) {
  const int size = options.quick ? 160 : 720;
  Study study{
      .name = "shading_rate",
      .title = "Shading rate: flat, Gouraud or Phong",
      .setting = fmt::format("A shiny sphere (Blinn-Phong, exponent 40), {}x{}; labels give the number of latitude bands", size, size),
      .error_name = "RMS error of linear light over the image, without the silhouette",
      .time_name = "frame",
      .truth = {"the sphere with one ray per pixel, in double", 0.0, "largest difference from long double"},
  };
  SphereTruth truth{};
  for (const auto& [rate, group] : {std::pair("flat", "flat"), std::pair("gouraud", "Gouraud"), std::pair("phong", "Phong")}) {
    for (const int latitudes : options.quick ? std::vector{8, 32} : std::vector{8, 16, 32, 64, 128, 256, 512}) {
      const SceneDescription scene = SceneFile::parse(fmt::format(kLitScene, latitudes, 2 * latitudes, rate), "study", ".").description();
      if (truth.light.empty()) {
        truth = sphere_truth({.ambient = 0.05, .diffuse = 0.7, .specular = 0.5, .shininess = 40.0},
                             make_view(scene.cameras.front().second, size, size));
        study.truth.error = truth.error;
        study.truth.picture = codes_of(truth.light);
      }
      const TimedPicture picture = timed_picture(scene, size, size, options, workers);
      const double px_per_unit = size / (2.0 * 4.0 * std::tan(16.0 * std::numbers::pi / 180.0));
      Variant v{.name = fmt::format("{} {}", group, latitudes),
                .group = group,
                .parameters = {{"latitudes", static_cast<double>(latitudes)},
                               {"triangles", static_cast<double>(picture.statistics.primitives_in)},
                               {"pixels", static_cast<double>(picture.statistics.fragments_shaded)},
                               {"chord_px", px_per_unit * deepest_chord(uv_sphere(latitudes, 2 * latitudes, 1.0f), 1.0)}},
                .time = picture.time};
      Image<glm::vec4> inside = picture.light;
      const double moved = exclude_silhouette(inside, truth.exact);
      set_picture_error(v, inside, truth.light, PictureError::rms);
      v.error = rms_error(inside, truth.exact);
      v.measures.push_back({"silhouette_share", moved});
      v.picture = codes_of(picture.light);
      study.variants.push_back(std::move(v));
    }
  }
  return study;
}

}  // namespace halfspace
