// SPDX-License-Identifier: Apache-2.0
//
// Tests complete scenes and studies where common methods fail.
#include <cmath>
#include <numbers>
#include <set>

#include "halfspace/render/frame/frame.h"
#include "halfspace/render/prepared_scene.h"
#include "halfspace/render/scene_assets.h"
#include "halfspace/scene/scene_file.h"
#include "stability/regime.h"
#include "study/study.h"

namespace halfspace::stability {
namespace {

Image<glm::vec4> light_of(const SceneDescription& scene, int width, int height, const Workers& team = Workers(2)) {
  SceneAssets assets(team);
  Image<glm::vec4> picture(width, height);
  render(assets.prepare(scene, width, height), picture, team);
  return picture;
}

SceneDescription parsed(const std::string& text) { return SceneFile::parse(text, "test", ".").description(); }

const Variant& variant(const Study& study, const std::string& name) {
  for (const Variant& v : study.variants)
    if (v.name == name) return v;
  ADD_FAILURE() << study.name << " has no variant " << name;
  return study.variants.front();
}

// ---- far from the origin ------------------------------------------------------------------------------------------------

// Largest distance in px between the vertices of a sphere transformed by float matrices and in double. The sphere is `away` from the origin
// and the camera 4 units from the sphere.
struct Distances {
  double common, ours;
};
Distances far_from_the_origin(double away) {
  char text[1000];
  std::snprintf(text, sizeof text,
                R"({ "version": 1, "cameras": { "main": { "position": [%.17g, %.17g, %.17g], "target": [%.17g, %.17g, %.17g] } },
    "lights": { "sun": { "direction": [1, 1, 1] } },
    "objects": { "ball": { "latitudes": 16, "longitudes": 32, "position": [%.17g, %.17g, %.17g] } } })",
                away + 1.3, away + 0.7, away + 3.6, away, away, away, away, away, away);
  const Workers workers(1);
  SceneAssets assets(workers);
  const int size = 1024;
  const PreparedScene scene = assets.prepare(parsed(text), size, size);
  const PlacedMesh& placed = scene.meshes.front();
  const glm::mat4 clip_from_world(scene.view.clip_from_world), world_from_object(placed.world_from_object);
  const glm::mat4 clip_from_object = std::visit(
      [](const auto& shader) {
        if constexpr (requires { shader.clip_from_object; }) {
          return shader.clip_from_object;
        } else {
          return glm::mat4(0.0f);
        }
      },
      scene.draws.front().shader);
  Distances out{};
  for (const glm::vec3& p : placed.positions) {
    const auto window = [&](const glm::dvec4& clip) { return glm::dvec2(clip) / clip.w * (0.5 * size); };
    const glm::dvec2 exact = window(scene.view.clip_from_world * placed.world_from_object * glm::dvec4(glm::dvec3(p), 1.0));
    const glm::vec4 world = world_from_object * glm::vec4(p, 1.0f);
    out.common = std::max(out.common, glm::length(window(glm::dvec4(clip_from_world * world)) - exact));
    out.ours = std::max(out.ours, glm::length(window(glm::dvec4(clip_from_object * glm::vec4(p, 1.0f))) - exact));
  }
  return out;
}

TEST(Stability, PositionsAreAccurateFarFromTheOrigin) {
  const Distances d = far_from_the_origin(1e6);
  // The product of the matrices is computed in double and rounded once: 2^-24 of 1,024 px for each of a few products.
  record_and_check(
      {6, "huge coordinates and the guard band",
       "a sphere 1,000,000 units from the origin and 4 units from the camera; world positions in float vs. one matrix computed in double",
       "largest vertex error in pixels, in an image of 1024x1024"},
      d.common, 5.0, d.ours, 1e-3);
}

// ---- depth --------------------------------------------------------------------------------------------------------------

TEST(Stability, ReversedDepthKeepsTheOrder) {
  const Study study = study_depth({.quick = true}, Workers(2));
  double common = 0.0, ours = 0.0;
  for (const Variant& v : study.variants) {
    if (v.group == "d32f") common = std::max(common, v.error);
    if (v.group == "d32f reversed") ours = std::max(ours, v.error);
  }
  record_and_check(
      {10, "z-fighting",
       "pairs of surfaces separated by 1/10,000 of their distance, far/near from 1e2 to 1e9; OpenGL's depth in float32 vs. reversed Z",
       "worst fraction of pairs in the wrong order"},
      common, 0.3, ours, 0.0);
}

TEST(Stability, ReversedDepthKeepsTheOrderWhere24BitsFail) {
  const Study study = study_depth({.quick = true}, Workers(2));
  // The step of float32 with reversed Z is 2^-24 of the distance everywhere, 1,600 times finer than the gap.
  record_and_check(
      {10, "z-fighting", "the same pairs at far/near = 1e6; 24-bit depth vs. reversed Z", "fraction of pairs in the wrong order"},
      variant(study, "d24 1e6").error, 0.15, variant(study, "d32f reversed 1e6").error, 0.0);
}

// ---- highlights ---------------------------------------------------------------------------------------------------------

TEST(Stability, PhongShadingKeepsHighlightsInsideFacets) {
  // Facets span 10 degrees; light and eye face the center of a facet.
  const auto missing = [](const char* shading) {
    const SceneDescription scene = parsed(std::string(R"({ "version": 1,
      "cameras": { "main": { "position": [0, 0, 400], "fov": 0.35, "near": 1, "far": 1000 } },
      "lights": { "sun": { "direction": [0, 0, 1] } },
      "objects": { "ball": { "latitudes": 18, "longitudes": 36, "rotation": [5, 5, 0], "diffuse": 0, "specular": 1, "shininess": 200,
                             "shading": ")") +
                                          shading + "\" } } }");
    const Image<glm::vec4> light = light_of(scene, 300, 300);
    float peak = 0.0f;
    for (const glm::vec4& p : light.texels()) peak = std::max(peak, p.x);
    return 1.0 - static_cast<double>(peak);
  };
  // Pixels are 0.5 degrees apart, so one is within about 0.25 degrees of the peak: cos(0.25 degrees)^200 is 1 − 0.002. Interpolated normals
  // have an error of similar size.
  record_and_check(
      {11, "Gouraud shading misses highlights", "exponent 200 at the center of a facet of 10 degrees; lighting per vertex vs. per pixel",
       "difference between the brightest pixel and 1"},
      missing("gouraud"), 0.4, missing("phong"), 0.01);
}

// ---- textures -----------------------------------------------------------------------------------------------------------

TEST(Stability, AnisotropicFilteringReducesAliasing) {
  const Study study = study_texture_filter({.quick = true}, Workers(2));
  // A probe is a trilinear lookup, which is wider than the box that it represents. At each edge of a square, its error is about a tenth of
  // the contrast, over a width of one pixel. (docs/results/accuracy.md lists every filter, at 960x540.)
  record_and_check(
      {16, "minification aliasing",
       "a checkered plane that reaches the horizon; nearest texel vs. 16x anisotropic filtering; reference: 1,024 lookups per pixel",
       "RMS error of light"},
      variant(study, "nearest").error, 0.15, variant(study, "16x").error, 0.02);
}

// ---- spheres as points --------------------------------------------------------------------------------------------------

// A sphere of radius 1 at the origin, drawn as a sprite, with a camera that looks past it. All light is ambient.
constexpr int kWidth = 320, kHeight = 180;
SceneDescription one_sphere(const char* sprite, double distance, double degrees) {
  const double a = degrees * std::numbers::pi / 180.0;
  char text[1000];
  std::snprintf(text, sizeof text, R"({ "version": 1, "ambient": 1,
    "cameras": { "main": { "position": [0, 0, %.9g], "target": [%.9g, 0, %.9g], "fov": 60, "near": 0.00001, "far": 1000 } },
    "particles": { "sprite": "%s", "count": 1, "arrangement": "grid", "radius": 1 } })",
                distance, std::sin(a), distance - std::cos(a), sprite);
  return parsed(text);
}

// Returns 1 − IoU of the coverage given by seen(x, y) and the coverage of the sphere. Pixels within 1e-4 of the rim (in terms of the
// squared half chord) are ignored.
template <class Seen>
double coverage_error(const SceneDescription& scene, const Seen& seen) {
  const View view = make_view(scene.cameras.front().second, kWidth, kHeight);
  int either = 0, differ = 0;
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const glm::dvec3 d = glm::normalize(view.forward_ws + view.right_ws * (view.tan_x * (2 * (x + 0.5) / kWidth - 1)) +
                                          view.up_ws * (view.tan_y * (1 - 2 * (y + 0.5) / kHeight)));
      const double b = glm::dot(view.eye_ws, d), chord = b * b - glm::dot(view.eye_ws, view.eye_ws) + 1.0;
      const bool truth = chord > 0.0 && b < 0.0;
      either += truth || seen(x, y);
      differ += truth != seen(x, y) && std::abs(chord) > 1e-4;
    }
  }
  EXPECT_GT(either, 100);
  return static_cast<double>(differ) / either;
}

double coverage_error(const SceneDescription& scene) {
  const Image<glm::vec4> picture = light_of(scene, kWidth, kHeight);
  return coverage_error(scene, [&](int x, int y) { return picture.at(x, y).x > 0.0f; });
}

TEST(Stability, SpritesWithTheirCenterOutsideAreDrawn) {
  // The image is 91.5 degrees wide. The center is at 50 or 60 degrees, and the sphere extends 19 degrees to either side.
  double common = 1.0, ours = 0.0;
  for (const double degrees : {50.0, 60.0, -50.0, -60.0}) {
    const SceneDescription scene = one_sphere("exact", 3.0, degrees);
    // OpenGL 4.6 clips points by their center, so it draws nothing.
    common = std::min(common, coverage_error(scene, [](int, int) { return false; }));
    ours = std::max(ours, coverage_error(scene));
  }
  record_and_check({18, "sphere sprites vanish when their center leaves the image",
                    "center 5 and 15 degrees outside of the image; culling by the center vs. by the footprint", "1 − IoU with the sphere"},
                   common, 0.99, ours, 0.0);
}

TEST(Stability, SpritesOffTheAxisAreAccurate) {
  record_and_check(
      {19, "point size limits, perspective distortion",
       "30 degrees off the axis; a circle sized by the distance of its center vs. the exact sprite", "1 − IoU with the sphere"},
      coverage_error(one_sphere("original", 3.0, 30.0)), 0.1, coverage_error(one_sphere("exact", 3.0, 30.0)), 0.0);
}

TEST(Stability, SpritesHaveNoSizeLimit) {
  // Seen from 1.02 radii, the sphere spans 157 degrees, and its sprite is 1,553 px high in a 180-pixel-high image; from 1.0005 radii, it is
  // 10,000 px high.
  double ours = 0.0;
  for (const double distance : {1.02, 1.005, 1.0005}) ours = std::max(ours, coverage_error(one_sphere("exact", distance, 75.0)));
  // A point size limited to 255 px, as on hardware: the sprite is a square around the projected center, which is far off the left edge of
  // the image.
  const SceneDescription near = one_sphere("exact", 1.0005, 75.0);
  const double px_per_tan = kHeight / (2.0 * make_view(near.cameras.front().second, kWidth, kHeight).tan_y);
  const double centre = 0.5 * kWidth - px_per_tan * std::tan(75.0 * std::numbers::pi / 180.0);
  const double limited =
      coverage_error(near, [&](int x, int y) { return std::abs(x + 0.5 - centre) < 127.5 && std::abs(y + 0.5 - 0.5 * kHeight) < 127.5; });
  record_and_check({19, "point size limits, perspective distortion",
                    "a sphere 10,000 px high, seen from 1.0005 radii; a size limit of 255 px vs. no limit", "1 − IoU with the sphere"},
                   limited, 0.9, ours, 0.0);
}

// ---- transforms ---------------------------------------------------------------------------------------------------------

TEST(Stability, NormalsAreCorrectUnderNonUniformScale) {
  const SceneDescription scene = parsed(R"({ "version": 1, "cameras": { "main": {} }, "lights": { "sun": {} },
      "objects": { "ball": { "latitudes": 32, "longitudes": 64, "scale": [1, 4, -0.25], "rotation": [20, 30, 40] } } })");
  const Workers workers(1);
  SceneAssets assets(workers);
  const PreparedScene prepared = assets.prepare(scene, 64, 64);
  const PlacedMesh& placed = prepared.meshes.front();
  const glm::mat3 by_shader = std::visit(
      [](const auto& shader) {
        if constexpr (requires { shader.normal_from_object; }) {
          return shader.normal_from_object;
        } else {
          return glm::mat3(0.0f);
        }
      },
      prepared.draws.front().shader);
  // The normal of the stretched sphere is the gradient of |M⁻¹ p|². M also rotates and mirrors.
  const glm::dmat3 m(placed.world_from_object), inverse = glm::inverse(m);
  double common = 0.0, ours = 0.0;
  for (std::size_t i = 0; i < placed.positions.size(); ++i) {
    const glm::dvec3 p = m * glm::dvec3(placed.positions[i]), exact = glm::normalize(glm::transpose(inverse) * (inverse * p));
    const auto angle = [&](const glm::dvec3& n) { return std::atan2(glm::length(glm::cross(n, exact)), glm::dot(n, exact)); };
    common = std::max(common, angle(m * glm::dvec3(placed.normals[i])));
    ours = std::max(ours, angle(glm::dvec3(by_shader * placed.normals[i])));
  }
  // The matrix is in float and has a scale ratio of 16:1; normals have an error of 2^-24.
  record_and_check({24, "normals under non-uniform scale",
                    "a rotated sphere scaled by 1, 4 and −1/4; normals transformed by the matrix vs. by its inverse transpose",
                    "largest angle to the ellipsoid's normal, in radians"},
                   common, 1.0, ours, 1e-5);
}

// ---- bit-identical results ---------------------------------------------------------------------------------------------

TEST(Stability, IsBitIdenticalForAnyThreadCount) {
  SceneFile file = SceneFile::open("shadow-contact");
  int ours = 0;
  std::vector<Image<glm::vec4>> pictures;
  for (const int threads : {1, 2, 3, 5, 7, 16}) {
    pictures.push_back(light_of(file.description(), 160, 90, Workers(threads)));
    ours += !(pictures.back() == pictures.front());
  }
  // The common method sums floats per thread and then adds the partial sums.
  std::set<float> sums;
  for (const std::size_t threads : {1u, 2u, 3u, 5u, 7u, 16u}) {
    std::vector<float> parts(threads, 0.0f);
    std::size_t i = 0;
    const std::size_t count = pictures[0].texels().size();
    for (const glm::vec4& p : pictures[0].texels()) parts[i++ * threads / count] += p.x;
    float sum = 0.0f;
    for (const float part : parts) sum += part;
    sums.insert(sum);
  }
  record_and_check(
      {26, "results that depend on threads, SIMD width or processor",
       "shadow-contact with 1 to 16 threads; a float sum per thread vs. a pass", "results that differ from the single-threaded one"},
      static_cast<double>(sums.size() - 1), 1, ours, 0);
}

}  // namespace
}  // namespace halfspace::stability
