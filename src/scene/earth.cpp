// SPDX-License-Identifier: Apache-2.0
#include "scene/earth.h"

#include <numbers>

#include "core/trig_double.h"
#include "raster/pass.h"
#include "scene/camera.h"
#include "scene/image_io.h"
#include "scene/procedural_earth.h"
#include "scene/shapes.h"

namespace halfspace {

namespace {

constexpr double kFovY = 45.0 * std::numbers::pi / 180.0;
constexpr double kNear = 0.1, kFar = 100.0;
constexpr glm::vec3 kSun{6.0f, 3.0f, 5.0f};
constexpr glm::vec4 kSpace{0.002f, 0.0025f, 0.004f, 1.0f};  // linear
// Chords of 1/256 turn leave the silhouette 0.04 px off at 1080p.
constexpr int kLatitudes = 128, kLongitudes = 256;

// A turn about +y; uv_sphere has 90° E at +z.
glm::mat4 facing_meridian(double degrees_east) {
  const auto [sine, cosine] = sincos_turns((90.0 - degrees_east) / 360.0);
  const auto s = static_cast<float>(sine), c = static_cast<float>(cosine);
  return {glm::vec4(c, 0, -s, 0), glm::vec4(0, 1, 0, 0), glm::vec4(s, 0, c, 0), glm::vec4(0, 0, 0, 1)};
}

BlinnPhong earth_shader(const EarthOptions& o, const Texture2D& map) {
  BlinnPhong s{};
  const double aspect = static_cast<double>(o.width) / o.height;
  const glm::dvec3 up = o.eye.x == 0 && o.eye.z == 0 ? glm::dvec3(0, 0, -1) : glm::dvec3(0, 1, 0);
  s.clip_from_world = glm::mat4(perspective_reversed(kFovY, aspect, kNear, kFar) * look_at(o.eye, glm::dvec3(0.0), up));
  s.world_from_object = facing_meridian(o.meridian);
  s.normal_from_object = glm::mat3(s.world_from_object);  // a rotation is its own inverse transpose
  s.light_ws = kSun;
  s.eye_ws = glm::vec3(o.eye);
  s.albedo = &map;
  s.sampler.wrap_t = Wrap::clamp;
  s.ambient = 0.03f;
  s.diffuse = 1.0f;
  s.specular = 0.12f;
  s.shininess = 24.0f;
  return s;
}

// The built-in map, no finer than the view needs: a texel at the globe's middle is at most two pixels wide.
int map_width(const EarthOptions& o) {
  const double half_angle = sincos_radians(0.5 * kFovY).sin / sincos_radians(0.5 * kFovY).cos;
  const double diameter_px = o.height / (glm::length(o.eye) * half_angle);
  int width = 256;
  while (width < 4096 && 2 * width < std::numbers::pi * diameter_px) width *= 2;
  return width;
}

Image<glm::u8vec4> color_map(const EarthOptions& o, const Workers& workers) {
  return o.color_map.empty() ? procedural_earth(map_width(o), map_width(o) / 2, workers) : read_image(o.color_map);
}

}  // namespace

std::unique_ptr<EarthScene> make_earth(const EarthOptions& options, const Workers& workers) {
  auto scene = std::make_unique<EarthScene>(
      EarthScene{Texture2D(color_map(options, workers), TexelFormat::srgb8a8), uv_sphere(kLatitudes, kLongitudes, 1.0f), {}, {}, kSpace});
  scene->shader = earth_shader(options, scene->map);
  scene->state.cull = CullMode::back;
  scene->state.depth.clip = ClipDepth::zero_to_one;
  scene->state.depth.compare = CompareOp::greater;
  return scene;
}

RenderResult render_earth(const EarthOptions& options, const Workers& workers) {
  const std::unique_ptr<EarthScene> scene = make_earth(options, workers);
  const Mesh& globe = scene->globe;
  const Indices indices(globe.indices, globe.positions.size());
  RenderResult result{Image<glm::u8vec4>(options.width, options.height), {}};
  ColorTarget color = srgb8a8_target(result.image);
  color.clear_value = scene->clear_color;
  Pass pass(options.width, options.height, color, {.format = DepthFormat::d32f, .clear_value = 0.0f});
  pass.draw(scene->shader, vertices(stream(globe.positions), stream(globe.normals), stream(globe.uvs)), indices, scene->state);
  result.statistics = pass.run(workers);
  return result;
}

}  // namespace halfspace
