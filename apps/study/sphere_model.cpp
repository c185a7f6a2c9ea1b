// SPDX-License-Identifier: Apache-2.0
//
// Compares models of a sphere away from the image center: two kinds of mesh, the classic point sprite and the exact point sprite.
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "halfspace/geometry/shapes.h"
#include "halfspace/scene/scene_file.h"
#include "study/pictures.h"

namespace halfspace {

namespace {

// The sphere is 22 degrees off the view axis, where its projection is not a circle.
constexpr const char* kModelScene = R"({{
  "version": 1,
  "cameras": {{ "main": {{ "position": [0, 0, 5], "target": [2, 0, 0], "fov": 50, "near": 0.1, "far": 100 }} }},
  "lights": {{ "sun": {{ "direction": [1, 1, 1.5] }} }},
  "ambient": 0.05,
  {}
}})";
constexpr const char* kMesh = R"("objects": {{ "ball": {{ {}, "model": "phong", "diffuse": 0.7, "specular": 0.5, "shininess": 40 }} }})";
// The only particle of a one-particle grid is at the origin, where the grid's color factor is 0.55: 0.55 · 1.8181818 = 1.
constexpr const char* kPointSprite =
    R"("particles": {{ "sprite": "{}", "count": 1, "arrangement": "grid", "radius": 1, "color": 1.8181818,
                    "diffuse": 0.7, "specular": 0.5, "shininess": 40 }})";

struct SphereModel {
  std::string name, group, keys;
  double triangles, chord;
};

SphereModel of_mesh(const std::string& name, const std::string& group, const std::string& keys, const Mesh& mesh) {
  return {name, group, fmt::format(kMesh, keys), static_cast<double>(mesh.indices.size() / 3), deepest_chord(mesh, 1.0)};
}

std::vector<SphereModel> models(bool quick) {
  std::vector<SphereModel> list;
  for (const int n : quick ? std::vector{8, 32} : std::vector{8, 16, 32, 64, 128, 256, 512})
    list.push_back(of_mesh(fmt::format("UV {}", n), "UV sphere",
                           fmt::format(R"("shape": "uv_sphere", "latitudes": {}, "longitudes": {})", n, 2 * n), uv_sphere(n, 2 * n, 1.0f)));
  for (int level = 1; level <= (quick ? 3 : 7); ++level)
    list.push_back(of_mesh(fmt::format("ico {}", level), "icosphere", fmt::format(R"("shape": "icosphere", "level": {})", level),
                           icosphere(level, 1.0f)));
  for (const char* sprite : {"original", "exact"})
    list.push_back({fmt::format("{} sprite", sprite), "sprite", fmt::format(kPointSprite, sprite), 0, 0});
  return list;
}

}  // namespace

Study study_sphere_model(const StudyOptions& options, const Workers& workers) {
  const int size = options.quick ? 160 : 720;
  Study study{
      .name = "sphere_model",
      .title = "Models of a sphere: meshes and sprites",
      .setting =
          fmt::format("A shiny sphere 22 degrees off the axis, {}x{}; labels: latitude bands (UV) or subdivision level (ico)", size, size),
      .error_name = "RMS error of linear light over the image",
      .time_name = "frame",
      .truth = {"the sphere with one ray per pixel, in double", 0.0, "largest difference from long double"},
  };
  SphereTruth truth{};
  for (const SphereModel& model : models(options.quick)) {
    const SceneDescription scene = SceneFile::parse(fmt::format(kModelScene, model.keys), "study", ".").description();
    const View view = make_view(scene.cameras.front().second, size, size);
    if (truth.light.empty()) {
      truth = sphere_truth({.model = LightModel::phong}, view);
      study.truth.error = truth.error;
      study.truth.picture = codes_of(truth.light);
    }
    const TimedPicture picture = timed_picture(scene, size, size, options, workers);
    const double px_per_unit = size / (2.0 * view.tan_y * 5.0);
    Variant v{.name = model.name,
              .group = model.group,
              .parameters = {{"triangles", model.triangles},
                             {"pixels", static_cast<double>(picture.statistics.fragments_shaded)},
                             {"chord_px", px_per_unit * model.chord}},
              .time = picture.time};
    set_picture_error(v, picture.light, truth.light, PictureError::rms);
    v.error = rms_error(picture.light, truth.exact);
    study.variants.push_back(std::move(v));
  }
  return study;
}

}  // namespace halfspace
