// SPDX-License-Identifier: Apache-2.0
//
// Meshes of a displaced sphere that adapt to the view (mesh_error), compared with regular meshes: the Moon from far away and from close to
// the ground. The camera moves, so that each frame needs another adaptive mesh.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <set>
#include <utility>

#include "halfspace/core/trig_double.h"
#include "halfspace/image/image_difference.h"
#include "halfspace/reference/inside_error.h"
#include "halfspace/reference/silhouettes.h"
#include "halfspace/render/frame/frame.h"
#include "halfspace/render/scene_assets.h"
#include "halfspace/scene/scene_file.h"
#include "study/pictures.h"

namespace halfspace {

namespace {

// On the near side, the ground is 0.9978 to 1.0020 radii from the center.
constexpr const char* kMoonScene = R"({
  "version": 1, "ambient": 0.02,
  "cameras": { "flight": { "fov": 40 } },
  "lights": { "sun": { "direction": [-0.59, 0.3, 0.75] } },
  "textures": { "relief": { "source": "moon_height", "width": 2048, "wrap_t": "clamp" } },
  "objects": { "moon": { "shape": "uv_sphere", "height": "relief", "height_scale": 0.01 } }
})";
constexpr int kFinerMoon = 8;  // outlines are measured to an eighth of a pixel
constexpr double kRuleError = 0.5;
constexpr double kTruthError = 0.005;  // px; finer meshes change the pictures by the rounding of vertices to pixel fractions

// The floor of a crater (9.5° N, 19.5° W), 0.9979 radii from the center.
const glm::dvec3 kAboveCrater(-0.9295, 0.1654, -0.3297);

// The camera is `distance` radii from the center of the Moon and looks to the north. The horizon of a smooth sphere is 10° above the middle
// of the picture.
CameraDescription flight_camera(CameraDescription camera, double distance, double sideways) {
  const glm::dvec3 upwards = glm::normalize(kAboveCrater), east = glm::normalize(glm::cross(glm::dvec3(0.0, 1.0, 0.0), upwards));
  const glm::dvec3 north = glm::cross(upwards, east);
  const double cosine = 1.0 / distance, sine = std::sqrt(1.0 - cosine * cosine);  // of the angle to the horizon
  const SinCosDouble lower = sincos_turns(10.0 / 360.0);
  const double ahead = cosine * lower.cos - sine * lower.sin, down = sine * lower.cos + cosine * lower.sin;
  camera.position = distance * upwards + sideways * east;
  camera.target = camera.position + ahead * north - down * upwards;
  camera.up = down * north + ahead * upwards;
  return camera;
}

// A frame of the Moon, and what its errors are computed from.
struct MoonFrame {
  Image<glm::u8vec4> picture;
  Image<int> objects{}, fine_objects{};  // seen_objects, also at kFinerMoon times the resolution
  double triangles = 0.0;
  double bound_px = 0.0;    // computed by the program; 0 for regular meshes
  double first_ms = 0.0;    // the first frame, which measures the surface or makes the regular mesh
  double prepare_ms = 0.0;  // the median time of later frames before anything is drawn
  Timing time{};            // of later frames
};

class MoonView {
 public:
  MoonView(double distance, const StudyOptions& options, SceneAssets& assets, const Workers& workers)
      : distance_(distance), options_(options), assets_(assets), workers_(workers), width_(options.quick ? 160 : 640) {}

  int width() const { return width_; }
  int height() const { return width_ * 9 / 16; }
  double distance() const { return distance_; }

  // Returns the number of bands that --max-error chooses for a sphere that cannot adapt to the view.
  int bands_of_rule(double error_px) const {
    SceneDescription scene = scene_with(0.0, 2);
    scene.objects.front().second.normals = NormalSource::vertex;
    return assets_.choose_within_error(scene, width(), height(), {error_px, {}}).scene.objects.front().second.latitudes;
  }

  // bands: of the regular mesh, if mesh_error is 0.
  MoonFrame frame(double mesh_error, int bands) const {
    SceneDescription scene = scene_with(mesh_error, bands);
    prepare(scene_with(0.0, 2));  // makes the maps and forgets the last mesh
    MoonFrame out{.picture = Image<glm::u8vec4>(width(), height())};
    const auto start = std::chrono::steady_clock::now();
    const PreparedScene first = prepare(scene);
    render(first, out.picture, workers_);
    out.first_ms = ms_since(start);
    out.objects = seen_objects(first, 1, workers_);
    out.fine_objects = seen_objects(first, kFinerMoon, workers_);
    out.triangles = static_cast<double>(first.meshes.front().indices->size() / 3);
    if (!first.simplified.empty()) out.bound_px = first.simplified.front().error_px;
    return out;
  }

  // The same with times. The camera swings to both sides by a hundredth of its height, which is about a pixel per frame.
  MoonFrame timed_frame(double mesh_error, int bands) const {
    MoonFrame out = frame(mesh_error, bands);
    SceneDescription scene = scene_with(mesh_error, bands);
    Image<glm::u8vec4> picture(width(), height());
    std::vector<double> prepare_ms;
    out.time = time_of(
        [&] {
          const double share = sincos_turns(static_cast<double>(prepare_ms.size() + 1) / 32.0).sin;
          CameraDescription& camera = scene.cameras.front().second;
          camera = flight_camera(camera, distance_, 0.01 * (distance_ - 1.0) * share);
          const auto start = std::chrono::steady_clock::now();
          const PreparedScene prepared = prepare(scene);
          prepare_ms.push_back(ms_since(start));
          render(prepared, picture, workers_);
        },
        options_);
    std::ranges::nth_element(prepare_ms, prepare_ms.begin() + static_cast<std::ptrdiff_t>(prepare_ms.size() / 2));
    out.prepare_ms = prepare_ms[prepare_ms.size() / 2];
    return out;
  }

 private:
  static double ms_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
  }

  SceneDescription scene_with(double mesh_error, int bands) const {
    SceneFile file = SceneFile::parse(kMoonScene, "adaptive_tessellation", {});
    file.set(std::vector<std::string>{fmt::format("moon.mesh_error={}", mesh_error), fmt::format("moon.latitudes={}", bands),
                                      fmt::format("moon.longitudes={}", 2 * bands)});
    if (options_.quick) file.set("relief.width=256");
    SceneDescription scene = file.description();
    CameraDescription& camera = scene.cameras.front().second;
    camera = flight_camera(camera, distance_, 0.0);
    return scene;
  }

  PreparedScene prepare(const SceneDescription& scene) const { return assets_.prepare(scene, width(), height()); }

  double distance_;
  const StudyOptions& options_;
  SceneAssets& assets_;
  const Workers& workers_;
  int width_;
};

InsideError moon_error(const MoonFrame& frame, const MoonFrame& truth) {
  return inside_error({frame.picture, frame.objects}, {truth.picture, truth.objects});
}

// What the frames of a view are compared with.
struct MoonTruth {
  MoonFrame frame;
  double error;  // the mean error of the colors
};

MoonTruth moon_truth(const MoonView& view) {
  MoonFrame finest = view.frame(kTruthError, 2);
  const double change = moon_error(view.frame(2.0 * kTruthError, 2), finest).mean;
  return {std::move(finest), change};
}

Variant moon_variant(const MoonView& view, double mesh_error, int bands, const MoonTruth& truth) {
  MoonFrame frame = view.timed_frame(mesh_error, bands);
  const InsideError inside = moon_error(frame, truth.frame);
  const std::string mesh = mesh_error == 0.0 ? fmt::format("{} bands", bands) : fmt::format("{} px", mesh_error);
  Variant v{.name = fmt::format("{}: {}", view.distance(), mesh), .group = fmt::format("{} radii", view.distance())};
  v.parameters = {{"mesh_error", mesh_error}, {"bands", mesh_error == 0.0 ? bands : 0.0}};
  v.error = inside.mean;
  v.measures = {{"p99", inside.p99},
                {"outline_px", silhouette_distance(frame.fine_objects, truth.frame.fine_objects, kFinerMoon).max},
                {"bound_px", frame.bound_px},
                {"differing_pixels", static_cast<double>(inside.differing)},
                {"triangles", frame.triangles},
                {"first_frame_ms", frame.first_ms},
                {"prepare_ms", frame.prepare_ms},
                {"reference_error", truth.error}};
  v.time = frame.time;
  v.difference = difference_colors(difference_map(frame.picture, truth.frame.picture));
  v.picture = std::move(frame.picture);
  return v;
}

}  // namespace

Study study_adaptive_tessellation(const StudyOptions& options, const Workers& workers) {
  Study study{.name = "adaptive_tessellation",
              .title = "Adaptive tessellation of the Moon: mesh_error and regular meshes",
              .setting = {},
              .error_name = "mean error of colors inside of the outline, in 8-bit steps",
              .time_name = "frame with its adaptive mesh; the camera moves",
              .truth = {fmt::format("mesh_error {}", kTruthError), 0.0, "largest change from twice the mesh_error"}};
  SceneAssets assets(workers);
  for (const double distance : options.quick ? std::vector{1.5, 2.0} : std::vector{1.001, 1.02, 1.2, 2.0, 10.0}) {
    const MoonView view(distance, options, assets, workers);
    MoonTruth truth = moon_truth(view);
    study.truth.error = std::max(study.truth.error, truth.error);
    for (const double mesh_error : options.quick ? std::vector{2.0, 0.5} : std::vector{2.0, 1.0, 0.5, 0.25})
      study.variants.push_back(moon_variant(view, mesh_error, 2, truth));
    std::set<int> bands = options.quick ? std::set{32} : std::set{256, 512};
    bands.insert(view.bands_of_rule(kRuleError));
    for (const int n : bands) study.variants.push_back(moon_variant(view, 0.0, n, truth));
    study.setting = fmt::format("The Moon, {}x{}; labels: distance from its center in radii, mesh_error or latitude bands", view.width(),
                                view.height());
    if (study.truth.picture.empty()) study.truth.picture = std::move(truth.frame.picture);
  }
  return study;
}

}  // namespace halfspace
