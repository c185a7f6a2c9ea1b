// SPDX-License-Identifier: Apache-2.0
//
// Renders normal and bump maps and compares the shading normals of pixels with the analytic normals of the bumps.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "halfspace/core/parallel.h"
#include "halfspace/geometry/camera.h"
#include "halfspace/geometry/height_slopes.h"
#include "halfspace/geometry/shapes.h"
#include "halfspace/raster/pass.h"
#include "halfspace/shading/surface/surface_shader.h"
#include "support/constants.h"

namespace halfspace {
namespace {

constexpr int kSize = 256;
constexpr double kHalf = 1.05;  // half the height of the view, in units

using Plain = SurfaceShader<ShadingRate::phong, true>;
using Mapped = SurfaceShader<ShadingRate::phong, true, NormalDetail::map>;
using Bumped = SurfaceShader<ShadingRate::phong, true, NormalDetail::bump>;

// Directions of three lights, one per column. A white Lambertian surface that all three reach has the color kSunsᵀ·n, from which the normal
// can be recovered.
const glm::dmat3 kSuns(glm::normalize(glm::dvec3(0.4, 0, 1)), glm::normalize(glm::dvec3(-0.2, 0.35, 1)),
                       glm::normalize(glm::dvec3(-0.2, -0.35, 1)));

std::vector<Light> suns() {
  std::vector<Light> lights;
  for (int k = 0; k < 3; ++k) {
    Light light;
    light.position_rws = glm::vec3(kSuns[k]);
    light.diffuse = glm::vec3(0.0f);
    light.diffuse[k] = 1.0f;
    lights.push_back(light);
  }
  return lights;
}

// Renders a mesh, transformed by `world`, from +z with an orthographic camera and returns the normals of the pixels. Background pixels are
// (0, 0, 0).
template <class S>
Image<glm::dvec3> normals_seen(const Mesh& mesh, const DetailMap& detail, const glm::dmat4& world = glm::dmat4(1.0)) {
  const std::vector<Light> lights = suns();
  S shader;
  const glm::dvec3 eye(0, 0, 10);
  shader.clip_from_object = glm::mat4(orthographic_reversed(2 * kHalf, 1, 1, 30) * look_at(eye, glm::dvec3(0.0), {0, 1, 0}) * world);
  glm::dmat4 world_rws = world;
  world_rws[3] -= glm::dvec4(eye, 0.0);
  shader.world_from_object = glm::mat4(world_rws);
  shader.normal_from_object = normal_matrix(world);
  shader.handedness = glm::determinant(glm::dmat3(world)) < 0 ? -1.0f : 1.0f;
  shader.to_eye_ws = {0, 0, 1};
  shader.lights = lights;
  shader.model = LightModel::lambert;
  shader.factors[kAmbient].constant = glm::vec3(0.0f);
  shader.factors[kSpecular].constant = glm::vec3(0.0f);
  shader.factors[kEmissive].constant = glm::vec3(0.0f);
  shader.detail = detail;
  DrawState state;
  state.cull = CullMode::back;
  if (shader.handedness < 0) state.front = Winding::clockwise;
  state.depth.clip = ClipDepth::zero_to_one;
  state.depth.compare = CompareOp::greater;
  Image<glm::vec4> picture(kSize, kSize);
  ColorTarget color = rgba32f_target(picture);
  color.clear_value = glm::vec4(0.0f);
  Pass pass(kSize, kSize, color, {.format = DepthFormat::d32f, .clear_value = 0.0f});
  const Indices indices(mesh.indices, mesh.positions.size());
  const auto view = [&] {
    if constexpr (S::kTangents)
      return make_vertex_view(stream(mesh.positions), stream(mesh.normals), stream(mesh.tangents), stream(mesh.uvs));
    if constexpr (!S::kTangents) return make_vertex_view(stream(mesh.positions), stream(mesh.normals), stream(mesh.uvs));
  }();
  pass.draw(shader, view, indices, state);
  pass.run(Workers(1));
  Image<glm::dvec3> normals(kSize, kSize);
  const glm::dmat3 inverse = glm::inverse(glm::transpose(kSuns));
  for (int y = 0; y < kSize; ++y) {
    for (int x = 0; x < kSize; ++x) normals.at(x, y) = inverse * glm::dvec3(glm::vec3(picture.at(x, y)));
  }
  return normals;
}

glm::dvec2 spot_of(int x, int row) { return {((x + 0.5) / kSize * 2 - 1) * kHalf, (1 - (row + 0.5) / kSize * 2) * kHalf}; }

// Bumps on the unit sphere: A · sin 2πku · sin²πv · cos πlv. They vanish at the poles.
struct Bumps {
  double amplitude = 0.02;
  int k = 16, l = 12;

  double height(double u, double v) const { return amplitude * std::sin(2 * kPi * k * u) * wave(v); }
  double wave(double v) const { return std::sin(kPi * v) * std::sin(kPi * v) * std::cos(kPi * l * v); }
  double du(double u, double v) const { return amplitude * 2 * kPi * k * std::cos(2 * kPi * k * u) * wave(v); }
  double dv(double u, double v) const {
    const double s = std::sin(kPi * v), c = std::cos(kPi * v);
    return amplitude * std::sin(2 * kPi * k * u) * (2 * kPi * s * c * std::cos(kPi * l * v) - kPi * l * s * s * std::sin(kPi * l * v));
  }
};

struct PassContext {
  double u, v;
  SphereFrame axes;
};
PassContext frame_at(const glm::dvec3& p) {
  const double u = std::atan2(-p.z, p.x) / (2 * kPi), v = std::acos(std::clamp(p.y, -1.0, 1.0)) / kPi;
  const double u01 = u < 0 ? u + 1 : u;
  return {u01, v, sphere_frame(sincos_turns(u01), sincos_turns(0.5 * v))};
}

// Returns the normalized n − ∇h at a position on the sphere, which must not be a pole.
glm::dvec3 bumped(const Bumps& b, const PassContext& f) {
  const double east = b.du(f.u, f.v) / (2 * kPi * std::sin(kPi * f.v)), north = -b.dv(f.u, f.v) / kPi;
  return glm::normalize(f.axes.normal - f.axes.east * east - f.axes.north * north);
}

Image<float> heights(const Bumps& b, int width, int height) {
  Image<float> map(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) map.at(x, y) = static_cast<float>(0.5 + b.height((x + 0.5) / width, (y + 0.5) / height));
  }
  return map;
}

constexpr Sampler kSampler{.min = Filter::bilinear, .wrap_t = Wrap::clamp};

DetailMap detail_of(const Texture2D& map, bool difference = false) {
  return {.map = &map, .sampler = kSampler, .strength = 1, .flip_green = false, .difference = difference};
}

// Returns the RMS angle to the analytic normals, in radians, over the part of the sphere that is tilted by less than 45° from the view
// direction. All lights reach every bump there: they are 22° off the axis, and bumps tilt by up to 18°.
double angle_error(const Image<glm::dvec3>& seen, const Bumps& b) {
  double sum = 0;
  int count = 0;
  for (int row = 0; row < kSize; ++row) {
    for (int x = 0; x < kSize; ++x) {
      const glm::dvec2 s = spot_of(x, row);
      const double z2 = 1 - s.x * s.x - s.y * s.y;
      if (z2 < 0.5) continue;
      const glm::dvec3 want = bumped(b, frame_at({s.x, s.y, std::sqrt(z2)}));
      sum += std::pow(glm::length(glm::cross(want, glm::normalize(seen.at(x, row)))), 2);
      ++count;
    }
  }
  EXPECT_GT(count, 20000);
  return std::sqrt(sum / count);
}

// Returns the difference between horizontal neighbors in the same 2x2 quad, divided by that between neighbors in different quads.
double blockiness(const Image<glm::dvec3>& seen) {
  double within = 0, across = 0;
  for (int row = kSize / 4; row < kSize * 3 / 4; ++row) {
    for (int x = kSize / 4; x < kSize * 3 / 4; ++x) (x % 2 == 0 ? within : across) += glm::length(seen.at(x, row) - seen.at(x + 1, row));
  }
  return within / across;
}

class SphereBumps : public testing::Test {
 protected:
  const Bumps bumps{};
  const Mesh sphere = uv_sphere(256, 512, 1.0f);
  const Image<float> map = heights(bumps, 1024, 512);
};

TEST_F(SphereBumps, GradientIsAccurateAndDifferenceIsBlocky) {
  const Texture2D slopes(height_slopes(map, Wrap::repeat, Wrap::clamp), TexelFormat::rgba16f);
  const Texture2D codes(codes16(map));
  const Image<glm::dvec3> gradient = normals_seen<Bumped>(sphere, detail_of(slopes));
  const Image<glm::dvec3> difference = normals_seen<Bumped>(sphere, detail_of(codes, true));
  const double good = angle_error(gradient, bumps), poor = angle_error(difference, bumps);
  RecordProperty("gradient_error", std::to_string(good));
  RecordProperty("difference_error", std::to_string(poor));
  RecordProperty("gradient_blockiness", std::to_string(blockiness(gradient)));
  RecordProperty("difference_blockiness", std::to_string(blockiness(difference)));
  // Slopes reach 0.32. The parabola has a relative error of (2πk/1024)²/6 = 0.16%, linear filtering adds half of that, and half floats add
  // 0.05%. Facets tilt the derivatives of the position by up to π/512 against the normal, a relative error of the same size.
  EXPECT_LT(good, 2e-3);
  // The finite difference equals the slope half a pixel away. Half a pixel is 0.07 to 0.09 rad of phase, so the error is about a tenth of
  // the mean slope of 0.15.
  EXPECT_GT(poor, 10 * good);
  EXPECT_NEAR(blockiness(gradient), 1.0, 0.05);
  EXPECT_LT(blockiness(difference), 0.3);
}

Image<glm::vec4> coded_normals(const Bumps& b, int width, int height) {
  Image<glm::vec4> image(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const double u = (x + 0.5) / width, v = (y + 0.5) / height;
      const glm::dvec3 n = glm::normalize(glm::dvec3(-b.du(u, v) / (2 * kPi * std::sin(kPi * v)), b.dv(u, v) / kPi, 1));
      image.at(x, y) = glm::vec4(glm::vec3(n * 0.5 + 0.5), 1);
    }
  }
  return image;
}

TEST_F(SphereBumps, NormalMapMatchesTheBumps) {
  const Texture2D normals(coded_normals(bumps, 1024, 512), TexelFormat::rgba16f);
  // The ulp of a half float near 1/2 is 1/2048, which is 0.05% of a slope of 1; linear filtering adds 0.1% of a slope of 0.3.
  EXPECT_LT(angle_error(normals_seen<Mapped>(sphere, detail_of(normals)), bumps), 1e-3);
}

TEST_F(SphereBumps, MirroringTheObjectMirrorsTheBumps) {
  // Mirroring in x moves the point at (−x, y) to (x, y) and flips the sign of the x component of its normal.
  const Texture2D slopes(height_slopes(map, Wrap::repeat, Wrap::clamp), TexelFormat::rgba16f);
  const Texture2D normals(coded_normals(bumps, 1024, 512), TexelFormat::rgba16f);
  glm::dmat4 mirror(1.0);
  mirror[0][0] = -1;
  const auto check = [&](const Image<glm::dvec3>& plain, const Image<glm::dvec3>& mirrored) {
    double sum = 0;
    for (int row = kSize / 4; row < kSize * 3 / 4; ++row) {
      for (int x = kSize / 4; x < kSize * 3 / 4; ++x)
        sum += glm::length(mirrored.at(x, row) * glm::dvec3(-1, 1, 1) - plain.at(kSize - 1 - x, row));
    }
    return sum * 4 / (kSize * kSize);
  };
  // Takes the mean over pixels, because a pixel on the edge between two facets may show the other facet, where the slope of a bump differs
  // by up to π/256 of its value.
  EXPECT_LT(check(normals_seen<Bumped>(sphere, detail_of(slopes)), normals_seen<Bumped>(sphere, detail_of(slopes), mirror)), 2e-5);
  EXPECT_LT(check(normals_seen<Mapped>(sphere, detail_of(normals)), normals_seen<Mapped>(sphere, detail_of(normals), mirror)), 2e-5);
}

TEST_F(SphereBumps, PolesAndZeroTangentsGiveFiniteNormals) {
  const Texture2D slopes(height_slopes(map, Wrap::repeat, Wrap::clamp), TexelFormat::rgba16f);
  const Texture2D codes(codes16(map));
  const Texture2D normals(coded_normals(bumps, 1024, 512), TexelFormat::rgba16f);
  glm::dmat4 north_up(1.0);  // turns the north pole towards the eye
  north_up[1] = {0, 0, 1, 0};
  north_up[2] = {0, -1, 0, 0};
  Mesh no_tangents = sphere;
  for (glm::vec4& t : no_tangents.tangents) t = glm::vec4(0.0f);
  const auto check = [&](const Image<glm::dvec3>& seen, const char* what) {
    for (int row = 0; row < kSize; ++row) {
      for (int x = 0; x < kSize; ++x) {
        const glm::dvec2 s = spot_of(x, row);
        if (s.x * s.x + s.y * s.y > 0.98) continue;
        const double length = glm::length(seen.at(x, row));
        ASSERT_TRUE(std::isfinite(length)) << what << " " << x << " " << row;
        if (s.x * s.x + s.y * s.y < 0.25) {
          ASSERT_NEAR(length, 1.0, 1e-4) << what << " " << x << " " << row;
        }
      }
    }
    // At the pole, where the bumps vanish, the result is the normal of the sphere.
    const glm::dvec3 middle = glm::normalize(seen.at(kSize / 2, kSize / 2));
    EXPECT_LT(glm::length(middle - glm::dvec3(0, 0, 1)), 0.02) << what;
  };
  check(normals_seen<Bumped>(sphere, detail_of(slopes), north_up), "gradient");
  check(normals_seen<Bumped>(sphere, detail_of(codes, true), north_up), "difference");
  check(normals_seen<Mapped>(sphere, detail_of(normals), north_up), "normal map");
  const Image<glm::dvec3> without = normals_seen<Mapped>(no_tangents, detail_of(normals)), plain = normals_seen<Plain>(no_tangents, {});
  for (int row = 0; row < kSize; ++row) {
    for (int x = 0; x < kSize; ++x)
      ASSERT_LT(glm::length(without.at(x, row) - plain.at(x, row)), 1e-5) << "without tangents, the normals of the mesh are used";
  }
}

TEST(PlaneBumps, NormalMapIsIndependentOfScale) {
  // A plane that faces the eye, stretched to twice its width. Stretching must not change the tilt of the mapped normals.
  Image<glm::vec4> code(1, 1);
  code.at(0, 0) = {0.6f, 0.7f, 1.0f, 1.0f};  // (0.2, 0.4, 1) before normalization
  const Texture2D map(code, TexelFormat::rgba32f);
  glm::dmat4 world(0.0);
  world[0] = {2, 0, 0, 0};
  world[1] = {0, 0, 3, 0};
  world[2] = {0, -1, 0, 0};
  world[3] = {0, 0, 0, 1};
  for (const double side : {1.0, -1.0}) {
    world[0].x = 2 * side;
    const Image<glm::dvec3> seen = normals_seen<Mapped>(plane(2.0f), detail_of(map), world);
    const glm::dvec3 want = glm::normalize(glm::dvec3(0.2 * side, 0.4, 1));
    EXPECT_LT(glm::length(seen.at(kSize / 3, kSize / 3) - want), 1e-6) << side;
    EXPECT_LT(glm::length(seen.at(kSize / 2, kSize / 2) - want), 1e-6) << side;
  }
}

TEST(PlaneBumps, HeightsAreInWorldUnits) {
  // The same plane with a wave along x. The slope is relative to the world-space width, which is 4 units for the whole map.
  constexpr int kTexels = 512;
  Image<float> wave(kTexels, 1);
  for (int x = 0; x < kTexels; ++x) wave.at(x, 0) = static_cast<float>(0.5 + 0.5 * std::sin(2 * kPi * 3 * (x + 0.5) / kTexels));
  const Texture2D slopes(height_slopes(wave, Wrap::repeat, Wrap::clamp), TexelFormat::rgba32f);
  glm::dmat4 world(0.0);
  world[0] = {2, 0, 0, 0};
  world[1] = {0, 0, 1, 0};
  world[2] = {0, -2, 0, 0};
  world[3] = {0, 0, 0, 1};
  DetailMap detail = detail_of(slopes);
  detail.strength = 0.1f;
  const Image<glm::dvec3> seen = normals_seen<Bumped>(plane(2.0f), detail, world);
  for (int x = 4; x < kSize - 4; ++x) {
    const double u = (spot_of(x, 0).x + 2) / 4;
    const double slope = 0.1 * 0.5 * 2 * kPi * 3 * std::cos(2 * kPi * 3 * u) / 4;
    const glm::dvec3 want = glm::normalize(glm::dvec3(-slope, 0, 1));
    // The slope is at most 0.24. The differences in the map have a relative error of (2π·3/512)²/6 = 0.02%, and linear filtering adds as
    // much.
    EXPECT_LT(glm::length(seen.at(x, kSize / 2) - want), 1.2e-4) << x;
  }
}

}  // namespace
}  // namespace halfspace
