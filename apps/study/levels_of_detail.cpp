// SPDX-License-Identifier: Apache-2.0
//
// Levels of detail of model files (model_error): compares pictures of simplified meshes with those of the exact mesh. Colors are compared
// inside of the outline, and the outlines apart from them.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "halfspace/core/trig_double.h"
#include "halfspace/geometry/shapes.h"
#include "halfspace/image/image_difference.h"
#include "halfspace/reference/inside_error.h"
#include "halfspace/reference/silhouettes.h"
#include "halfspace/render/assets/model_asset.h"
#include "halfspace/render/frame/frame.h"
#include "halfspace/render/scene_assets.h"
#include "halfspace/scene/scene_file.h"
#include "study/pictures.h"

namespace halfspace {

namespace {

constexpr const char* kRingFile = "/made/in/memory.obj";
constexpr const char* kRingScene = R"({
  "version": 1, "ambient": 0.1,
  "cameras": { "near": { "position": [0, 8.4, 6.8], "fov": 20, "near": 0.1, "far": 100 },
               "far": { "position": [0, 33.6, 27.2], "fov": 20, "near": 0.1, "far": 100 } },
  "lights": { "sun": { "direction": [1, 1.5, 0.5] } },
  "objects": { "ring": { "shape": "file", "file": "/made/in/memory.obj" } }
})";
constexpr int kFinerOutline = 8;  // outlines are measured to an eighth of a pixel

double wave(double turns) { return sincos_turns(turns).cos; }

// A ring with bumps of two sizes.
Mesh bumpy_ring(int bands, int sectors, const Workers& workers) {
  Image<float> heights(192, 96);
  for (int y = 0; y < heights.height(); ++y) {
    for (int x = 0; x < heights.width(); ++x) {
      const double u = (x + 0.5) / heights.width(), v = (y + 0.5) / heights.height();
      heights.at(x, y) = static_cast<float>(wave(5 * u) * wave(2 * v) + 0.3 * wave(19 * u) * wave(9 * v));
    }
  }
  const HeightField field(heights, 0.0, workers, MapEdges::torus);
  const Displacement bumps{&field, 0.07, 0.0};
  return torus(1.0f, 0.42f, bands, sectors, &bumps);
}

// Smooth colors, so that an error of the texture coordinates gives an error of the color in proportion.
std::shared_ptr<const ColorPicture> smooth_pattern() {
  Image<glm::u8vec4> picture(512, 256);
  for (int y = 0; y < picture.height(); ++y) {
    for (int x = 0; x < picture.width(); ++x) {
      const double u = (x + 0.5) / picture.width(), v = (y + 0.5) / picture.height();
      const auto code = [](double share) { return static_cast<uint8_t>(std::lround(170.0 + 60.0 * share)); };
      picture.at(x, y) = {code(wave(12 * u)), code(wave(12 * u + 4 * v)), code(wave(6 * v)), 255};
    }
  }
  return std::make_shared<const ColorPicture>(std::move(picture));
}

std::shared_ptr<const ModelAsset> ring_model(int bands, int sectors, const Workers& workers) {
  Mesh ring = bumpy_ring(bands, sectors, workers);
  Model model;
  ModelImage& image = model.images.emplace_back();
  image.name = "pattern";
  image.pixels = smooth_pattern();
  model.textures.emplace_back().image = 0;
  ModelMaterial& paint = model.materials.emplace_back();
  paint.name = "paint";
  paint.roughness = 0.6f;
  paint.base_color_map.texture = 0;
  ModelMesh& mesh = model.meshes.emplace_back();
  mesh.positions = std::move(ring.positions);
  mesh.normals = std::move(ring.normals);
  mesh.uvs[0] = std::move(ring.uvs);
  mesh.indices = std::move(ring.indices);
  mesh.material = 0;
  model.nodes.emplace_back().meshes = {0};
  model.scenes.emplace_back().roots = {0};
  return std::make_shared<const ModelAsset>(std::move(model));
}

// A frame of the ring, and what its errors are computed from; drawn in the run that measures its times.
struct RingFrame {
  Image<glm::u8vec4> picture;
  Image<glm::u8vec4> base_colors{};      // without lighting
  Image<int> objects{}, fine_objects{};  // seen_objects, also at kFinerOutline times the resolution
  double triangles = 0.0;
  double bound_px = 0.0;  // computed by the program; 0 for the exact mesh
  double first_ms = 0.0;  // the first frame, which makes the simplified mesh
  Timing time{};          // of later frames
};

Image<glm::u8vec4> base_colors_of(const PreparedScene& scene, const Workers& workers) {
  Image<glm::vec3> albedo(scene.view.width_px, scene.view.height_px);
  FrameImages images;
  images.albedo = &albedo;
  render_frame(scene, images, workers);
  Image<glm::vec4> light(albedo.width(), albedo.height());
  std::ranges::transform(albedo.texels(), light.data(), [](const glm::vec3& c) { return glm::vec4(c, 1.0f); });
  return codes_of(light);
}

class RingView {
 public:
  RingView(const std::string& camera, std::shared_ptr<const ModelAsset> model, const StudyOptions& options, const Workers& workers)
      : camera_(camera), model_(std::move(model)), options_(options), workers_(workers), width_(options.quick ? 160 : 320) {}

  int width() const { return width_; }
  int height() const { return width_ * 9 / 16; }

  RingFrame frame(double model_error) const {
    SceneFile file = SceneFile::parse(kRingScene, "levels_of_detail", {});
    file.set(std::vector<std::string>{"camera=" + camera_, fmt::format("ring.model_error={}", model_error)});
    const SceneDescription scene = file.at(0.0);
    SceneAssets assets(workers_);  // new ones, so that the first frame has no simplified mesh
    assets.add_model(kRingFile, model_);
    RingFrame out{.picture = Image<glm::u8vec4>(width(), height())};
    PreparedScene prepared;
    const auto draw = [&] {
      prepared = assets.prepare(scene, width(), height());
      render(prepared, out.picture, workers_);
    };
    const auto start = std::chrono::steady_clock::now();
    draw();
    out.first_ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    out.time = time_of(draw, options_);
    out.base_colors = base_colors_of(prepared, workers_);
    out.objects = seen_objects(prepared, 1, workers_);
    out.fine_objects = seen_objects(prepared, kFinerOutline, workers_);
    out.triangles = static_cast<double>(prepared.meshes.front().indices->size() / 3);
    if (!prepared.simplified.empty()) out.bound_px = prepared.simplified.front().error_px;
    return out;
  }

 private:
  std::string camera_;
  std::shared_ptr<const ModelAsset> model_;
  const StudyOptions& options_;
  const Workers& workers_;
  int width_;
};

Variant variant_of(const std::string& camera, double model_error, RingFrame frame, const RingFrame& exact) {
  const InsideError inside = inside_error({frame.picture, frame.objects}, {exact.picture, exact.objects});
  Variant v{.name = model_error == 0.0 ? camera + " exact" : fmt::format("{} {} px", camera, model_error), .group = camera};
  v.parameters = {{"model_error", model_error}, {"triangles", frame.triangles}};
  v.error = inside.mean;
  v.measures = {{"p99", inside.p99},
                {"base_color", inside_error({frame.base_colors, frame.objects}, {exact.base_colors, exact.objects}).mean},
                {"outline_px", silhouette_distance(frame.fine_objects, exact.fine_objects, kFinerOutline).max},
                {"bound_px", frame.bound_px},
                {"differing_pixels", static_cast<double>(inside.differing)},
                {"first_frame_ms", frame.first_ms}};
  v.time = frame.time;
  v.difference = difference_colors(difference_map(frame.picture, exact.picture));
  v.picture = std::move(frame.picture);
  return v;
}

}  // namespace

Study study_levels_of_detail(const StudyOptions& options, const Workers& workers) {
  const auto model = options.quick ? ring_model(64, 256, workers) : ring_model(240, 720, workers);
  Study study{.name = "levels_of_detail",
              .title = "Levels of detail of a model file: model_error",
              .setting = {},
              .error_name = {},
              .time_name = "frame, without the first one, which simplifies the mesh",
              .truth = {"the exact mesh, drawn apart", 0.0, "rounding: half a step over the root of the number of values"}};
  for (const std::string camera : {"near", "far"}) {
    const RingView view(camera, model, options, workers);
    RingFrame exact = view.frame(0.0);
    const auto values = 3.0 * static_cast<double>(std::ranges::count_if(exact.objects.texels(), [](int object) { return object != 0; }));
    // Two 8-bit values whose unrounded difference is d differ by one of the two integers next to d, with a standard deviation of at most ½.
    study.truth.error = std::max(study.truth.error, 0.5 / std::sqrt(values));
    for (const double model_error : options.quick ? std::vector{0.0, 0.5, 2.0} : std::vector{0.0, 0.25, 0.5, 1.0, 2.0, 4.0})
      study.variants.push_back(variant_of(camera, model_error, view.frame(model_error), exact));
    study.setting = fmt::format("A bumpy ring of {} triangles, {}x{}, seen from near and from 4 times as far; labels: view, model_error",
                                exact.triangles, view.width(), view.height());
    if (study.truth.picture.empty()) study.truth.picture = std::move(exact.picture);
  }
  study.error_name =
      fmt::format("mean error of colors inside of the outline, in 8-bit steps (zero is plotted at {:.0e})", study.truth.error);
  return study;
}

}  // namespace halfspace
