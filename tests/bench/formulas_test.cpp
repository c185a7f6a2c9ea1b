// SPDX-License-Identifier: Apache-2.0
//
// Checks the workloads against ray tracing and closed forms in double. The formulas are written independently of the workloads' shaders;
// workloads_test.cpp, in contrast, runs the same shaders in the naive pipeline.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <string_view>

#include "halfspace/raster/depth_on_demand.h"
#include "workloads/workload.h"
#include "workloads/workload_assets.h"
#include "workloads/workload_shadow.h"

namespace halfspace {

namespace {

using glm::dvec3;

constexpr WorkloadSize kSize{640, 480};
const double kTan = std::tan(std::numbers::pi / 8);

Image<glm::u8vec4> drawn(std::string_view name, WorkloadSize size) {
  WorkloadAssets assets;
  const auto kind = std::ranges::find(workloads(), name, &WorkloadKind::name);
  const std::unique_ptr<Workload> workload = kind->prepare(size, assets);
  workload->frame(Workers(1));
  return *workload->picture().color;
}

// Returns the ray of a pixel for a camera at `eye` that looks at `center`. The ray is not normalized.
dvec3 ray_of(int x, int row, const dvec3& eye, const dvec3& center) {
  const dvec3 ahead = glm::normalize(center - eye), right = glm::normalize(glm::cross(ahead, dvec3(0, 1, 0))),
              up = glm::cross(right, ahead);
  const double s = (2 * (x + 0.5) / kSize.width - 1) * kSize.width / kSize.height, t = 1 - 2 * (row + 0.5) / kSize.height;
  return ahead + kTan * (s * right + t * up);
}

// Returns the first intersection of a ray with the unit sphere.
std::optional<dvec3> on_sphere(const dvec3& from, const dvec3& along) {
  const double a = glm::dot(along, along), b = glm::dot(from, along), c = glm::dot(from, from) - 1, d = b * b - a * c;
  if (d < 0 || -b - std::sqrt(d) < 0) return std::nullopt;
  return from + along * ((-b - std::sqrt(d)) / a);
}

double positive(double x) { return std::max(x, 0.0); }

dvec3 blinn(const dvec3& base, const dvec3& n, const dvec3& l, const dvec3& v, double visible) {
  const double specular = 0.4 * std::pow(positive(glm::dot(n, glm::normalize(l + v))), 48);
  return base * (0.08 + visible * 0.8 * positive(glm::dot(n, l))) + visible * specular;
}

void expect_color(const Image<glm::u8vec4>& image, int x, int row, const dvec3& expected) {
  for (int k = 0; k < 3; ++k)
    ASSERT_NEAR(image.at(x, row)[k] / 255.0, std::clamp(expected[k], 0.0, 1.0), 1.0 / 255) << x << ' ' << row << " channel " << k;
}

// The nearest of the ten layers hides the others, in either order.
TEST(WorkloadFormulas, LayersShowTheNearestOne) {
  for (const std::string_view name : {"layers_b2f", "layers_f2b"}) {
    const Image<glm::u8vec4> image = drawn(name, kSize);
    for (int row = 0; row < kSize.height && !HasFatalFailure(); ++row) {
      for (int x = 0; x < kSize.width; ++x) {
        const dvec3 p = 2.0 * ray_of(x, row, dvec3(0), {0, 0, -1}), n{0, 0, 1};
        const dvec3 l = glm::normalize(dvec3(0.5, 0.5, 0) - p), r = glm::reflect(-l, n);
        const double shine = 0.3 * std::pow(positive(glm::dot(r, glm::normalize(-p))), 32);
        expect_color(image, x, row, dvec3(0.1, 0.5, 1.0) * (0.1 + 0.7 * positive(glm::dot(n, l))) + shine);
      }
    }
  }
}

// Returns the color of the checkerboard at a point of the sphere, or nothing within 16 texels of an adjacent square, where the filter mixes
// both colors. (A pixel spans up to 7 texels where the sphere faces the camera.)
std::optional<dvec3> checker(const dvec3& p) {
  const double turn = std::atan2(p.z, p.x) / (2 * std::numbers::pi);
  const double x = 2048 * (turn - std::floor(turn)), y = 1024 * std::acos(p.y) / std::numbers::pi;
  const auto inside = [](double at) { return std::abs(std::fmod(at, 64) - 32) < 16; };
  if (!inside(x) || !inside(y)) return std::nullopt;
  const bool light = ((static_cast<int>(x / 64) + static_cast<int>(y / 64)) & 1) != 0;
  return light ? dvec3(230.0 / 255) : dvec3(40.0 / 255, 90.0 / 255, 160.0 / 255);
}

// The mesh of two million triangles is within 5e-6 of the sphere, and the mesh of 200,000 is within 4e-5. Both are far less than 1/255.
TEST(WorkloadFormulas, SpherePhongAndHdrMatch) {
  const Image<glm::u8vec4> phong = drawn("sphere_phong_2m", kSize), hdr = drawn("hdr_200k", kSize);
  const auto tone = [](const dvec3& c) { return glm::pow(0.8 * c / (1.0 + 0.8 * c), dvec3(1 / 2.2)); };
  const dvec3 eye(0, 0.8, 2.7);
  int judged = 0;
  for (int row = 0; row < kSize.height && !HasFatalFailure(); ++row) {
    for (int x = 0; x < kSize.width; ++x) {
      const std::optional<dvec3> p = on_sphere(eye, ray_of(x, row, eye, dvec3(0)));
      if (!p) continue;
      const dvec3 v = glm::normalize(eye - *p);
      const std::optional<dvec3> base = checker(*p);
      if (!base || glm::dot(v, *p) < 0.5) continue;  // the footprint grows towards the rim
      const dvec3 color = blinn(*base, *p, glm::normalize(dvec3(2, 3, 4) - *p), v, 1.0);
      expect_color(phong, x, row, color);
      expect_color(hdr, x, row, tone(8.0 * color));
      ++judged;
    }
  }
  EXPECT_GT(judged, 10'000);
  expect_color(phong, 0, 0, {0.10, 0.20, 0.30});
  expect_color(hdr, 0, 0, tone({0.4, 0.6, 1.5}));
}

TEST(WorkloadFormulas, ShadowMatches) {
  const Image<glm::u8vec4> image = drawn("shadow_200k", kSize);
  const dvec3 eye(0, 1.5, 4.5), l = glm::normalize(dvec3(0.5, 1.0, 0.3));
  int in_shadow = 0, lit = 0, dark_side = 0;
  for (int row = 0; row < kSize.height && !HasFatalFailure(); ++row) {
    for (int x = 0; x < kSize.width; ++x) {
      const dvec3 ray = ray_of(x, row, eye, {0, -0.3, 0});
      if (const std::optional<dvec3> p = on_sphere(eye, ray)) {
        const dvec3 v = glm::normalize(eye - *p);
        const double n_l = glm::dot(*p, l);
        if (glm::dot(*p, v) < 0.1 || std::abs(n_l) < 0.15) continue;  // skips the rim, and angles where bias and filter matter
        expect_color(image, x, row, blinn({0.8, 0.3, 0.2}, *p, l, v, n_l > 0 ? 1 : 0));
        dark_side += n_l < 0 ? 1 : 0;
        continue;
      }
      const dvec3 p = eye + ray * (-2.5 / ray.y);
      const double reach = std::max(std::abs(p.x), std::abs(p.z));
      if (ray.y >= 0 || reach > 4.05) {
        expect_color(image, x, row, {0.10, 0.20, 0.30});
      } else if (reach < 3.95) {
        const double off = glm::length(p - l * glm::dot(p, l)) - 1;  // distance of the shadow ray from the sphere
        if (std::abs(off) < 0.02) continue;                          // skips the edge of the shadow: 12 texels of the map
        expect_color(image, x, row, blinn(dvec3(0.6), {0, 1, 0}, l, glm::normalize(eye - p), off > 0 ? 1 : 0));
        ++(off > 0 ? lit : in_shadow);
      }
    }
  }
  EXPECT_GT(in_shadow, 3000);
  EXPECT_GT(lit, 30'000);
  EXPECT_GT(dark_side, 3000);
}

// A million non-overlapping triangles of 1 px² cover about a million pixels. On the 1/256 px grid, a triangle has legs of n = 362 steps and
// an area of n²/2. The fill rule includes two of its edges and excludes one, so a triangle contains about n(n + 1)/2 grid points,
// 0.3% more than its area. In addition, the positions of the 1357 columns relative to the pixel grid are not perfectly uniform.
TEST(WorkloadFormulas, TinyCoversTheExpectedArea) {
  const Image<glm::u8vec4> image = drawn("tiny_1m", {1920, 1080});
  const auto covered = std::ranges::count(image.texels(), glm::u8vec4(229, 153, 26, 255));  // the float 0.9 is less than 229.5/255
  const auto background = std::ranges::count(image.texels(), glm::u8vec4(26, 51, 77, 255));
  EXPECT_EQ(covered + background, 1920 * 1080);
  EXPECT_NEAR(static_cast<double>(covered), 1e6, 1e4);
}

TEST(ShadowFormulas, TheShadowFilterRequiresTheTexelsThatItReads) {
  constexpr float kUndrawn = -7.0f;
  const Workers workers(1);
  Image<float> map(kShadowMapSize, kShadowMapSize);
  for (const float x : {-1e30f, -3.0f, -1.0f, 0.0f, 0.36f, 1.0f, 3.0f, 1e30f}) {  // ±1e30 becomes the lowest integer, as NaN does
    for (const float y : {0.5f, x}) {
      std::fill_n(map.data(), map.texels().size(), kUndrawn);
      // Without draws, all depths are 1, so that nothing is in shadow.
      const DepthOnDemand demand(Pass(kShadowMapSize, kShadowMapSize, ColorTarget{}, d32f_target(map)), workers);
      const WorkloadShadowMap read{map.data(), &demand.tiles()};
      EXPECT_FLOAT_EQ(unoccluded_fraction(read, glm::mat4(1.0f), 0.0f, vec3<float>(x, y, 0.0f)), 1.0f) << x << ", " << y;
    }
  }
}

}  // namespace

}  // namespace halfspace
