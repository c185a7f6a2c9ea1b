// SPDX-License-Identifier: Apache-2.0
//
// Compares shadow lookups with brute force and closed forms, using small synthetic shadow maps.
#include "halfspace/shading/shadow/shadow.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>
#include <vector>

#include "halfspace/shading/shadow/shadow_lookup.h"

namespace halfspace {
namespace {

// A map over [-1, 1]², looking along −z from z = 1 to z = −1, so window depth is (z + 1)/2.
struct Map {
  explicit Map(int size) : depth(static_cast<std::size_t>(size) * static_cast<std::size_t>(size)) {
    view.size = size;
    view.texel_per_w = 2.0f / static_cast<float>(size);
    view.depth_per_unit = 0.5f;
    view.near = 0.0f;
    view.far = 2.0f;
    view.clip_from_rws[2][2] = 0.5f;
    view.clip_from_rws[3][2] = 0.5f;
    view.clip_plane_from_rws = glm::transpose(glm::inverse(view.clip_from_rws));
    view.depth = depth.data();
  }
  float& at(int i, int j) {  // origin at the lower left
    return depth[static_cast<std::size_t>(view.size - 1 - j) * static_cast<std::size_t>(view.size) + static_cast<std::size_t>(i)];
  }
  double center(int i) const { return (i + 0.5) * 2.0 / view.size - 1.0; }
  void fill(const std::function<double(double, double)>& z) {
    for (int j = 0; j < view.size; ++j)
      for (int i = 0; i < view.size; ++i) at(i, j) = static_cast<float>((z(center(i), center(j)) + 1.0) / 2.0);
  }
  // Stores the powers of the linear depth, unfiltered.
  void make_moments() {
    moments.clear();
    for (const float z : depth) {
      const float d = 1.0f - z;
      moments.emplace_back(d, d * d, d * d * d, d * d * d * d);
    }
    view.moments = moments.data();
  }
  ShadowView view;
  std::vector<float> depth;
  std::vector<glm::vec4> moments;
};

Map random_map(int size, unsigned seed) {
  Map map(size);
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> any(0.0f, 1.0f);
  for (float& z : map.depth) z = any(random);
  return map;
}

template <class R = float>
ShadowReceiver<R> receiver(const glm::vec3& p, const glm::vec3& normal = {0, 0, 1}, const glm::vec3& to_light = {0, 0, 1}) {
  return {vec3<R>(p), vec3<R>(normal), vec3<R>(normal), vec3<R>(to_light), R(3.5f), R(7.5f)};
}

Shadow shadow_of(const ShadowView& view, ShadowFilter filter, ShadowBias bias) {
  Shadow s{std::span(&view, 1), {}};
  s.settings.filter = filter;
  s.settings.bias = bias;
  return s;
}

// Returns the length of the overlap of texel [i, i+1] with [a, b].
double overlap(int i, double a, double b) { return std::max(0.0, std::min(i + 1.0, b) - std::max<double>(i, a)); }

TEST(ShadowFilter, PcfIsTheLitAreaOfTheBoxFilter) {
  Map map = random_map(32, 1);
  std::mt19937 random(2);
  std::uniform_real_distribution<float> place(-0.6f, 0.6f);
  const std::pair<ShadowFilter, int> filters[] = {
      {ShadowFilter::bilinear, 1}, {ShadowFilter::pcf3, 3}, {ShadowFilter::pcf5, 5}, {ShadowFilter::pcf7, 7}};
  for (int k = 0; k < 500; ++k) {
    const glm::vec3 p(place(random), place(random), place(random));
    for (const auto& [filter, width] : filters) {
      const double x = (static_cast<double>(p.x) + 1.0) * 16.0, y = (static_cast<double>(p.y) + 1.0) * 16.0, r = 0.5 * width;
      double expected = 0.0;
      for (int j = 0; j < 32; ++j)
        for (int i = 0; i < 32; ++i)
          if ((p.z + 1.0f) / 2.0f >= map.at(i, j)) expected += overlap(i, x - r, x + r) * overlap(j, y - r, y + r);
      expected /= width * width;
      // The fractional parts of float texel coordinates up to 32 have an error of 2e-6, and so does each of the up to 64 terms.
      EXPECT_NEAR(shadow_factor(shadow_of(map.view, filter, ShadowBias::none), receiver(p)), expected, 2e-5);
    }
  }
}

TEST(ShadowFilter, HardReadsOneTexelAndOriginalPcfReadsNine) {
  Map map = random_map(16, 3);
  std::mt19937 random(4);
  std::uniform_real_distribution<float> place(-0.7f, 0.7f);
  for (int k = 0; k < 500; ++k) {
    const glm::vec3 p(place(random), place(random), place(random));
    const int i = static_cast<int>((p.x + 1.0f) * 8.0f), j = static_cast<int>((p.y + 1.0f) * 8.0f);
    const float z = (p.z + 1.0f) / 2.0f;
    EXPECT_EQ(shadow_factor(shadow_of(map.view, ShadowFilter::hard, ShadowBias::none), receiver(p)), z >= map.at(i, j) ? 1.0f : 0.0f);
    int lit = 0;
    for (int dj = -1; dj <= 1; ++dj)
      for (int di = -1; di <= 1; ++di) lit += z + 0.0005f >= map.at(i + di, j + dj);
    EXPECT_NEAR(shadow_factor(shadow_of(map.view, ShadowFilter::pcf3, ShadowBias::original), receiver(p)), static_cast<float>(lit) / 9.0f,
                1e-6f);
  }
}

TEST(ShadowFilter, DiskIsUnbiasedForAnyRotation) {
  // Half of the plane is in shadow. The mean is the fraction of the disk's points on the lit side, for any rotation.
  Map map(64);
  map.fill([](double x, double) { return x < 0 ? 0.9 : -0.9; });
  Shadow s = shadow_of(map.view, ShadowFilter::vogel, ShadowBias::none);
  s.settings.radius = 8.0f;
  double mean = 0.0;
  ShadowReceiver<float> at = receiver({0, 0, 0});
  for (int k = 0; k < 64; ++k) {
    at.x_px = static_cast<float>(k) + 0.5f;
    const float light = shadow_factor(s, at);
    EXPECT_GE(light, 5.0f / 16.0f);  // 16 points on a spiral: half of them, plus or minus three
    EXPECT_LE(light, 11.0f / 16.0f);
    mean += light / 64.0;
  }
  EXPECT_NEAR(mean, 0.5, 0.02);
  at = receiver({0.5f, 0, 0});
  EXPECT_EQ(shadow_factor(s, at), 1.0f);
  at = receiver({-0.5f, 0, 0});
  EXPECT_EQ(shadow_factor(s, at), 0.0f);
}

TEST(ShadowFilter, PenumbraWidthMatchesTheLightSize) {
  // An occluder edge is h above the floor, and t is the tangent of the light's angular radius. Light rises from 0 to 1 over a width of
  // 2·h·t, like the area of a disk cut by a line.
  Map map(512);
  constexpr double kFloor = -0.8, kEdge = 0.2, kTangent = 0.1;
  map.fill([](double x, double) { return x < 0 ? kEdge : kFloor; });
  Shadow s = shadow_of(map.view, ShadowFilter::pcss, ShadowBias::constant);
  s.settings.light_radius = static_cast<float>(kTangent);
  const double reach = (kEdge - kFloor) * kTangent;
  for (double x = -1.5; x <= 1.5; x += 0.25) {
    double mean = 0.0;
    for (int k = 0; k < 32; ++k) {
      ShadowReceiver<float> at = receiver({static_cast<float>(x * reach), 0, static_cast<float>(kFloor)});
      at.x_px = static_cast<float>(k) + 0.5f;
      mean += shadow_factor(s, at) / 32.0;
    }
    const double c = std::clamp(x, -1.0, 1.0);
    const double expected = 0.5 + (c * std::sqrt(1.0 - c * c) + std::asin(c)) / std::numbers::pi;
    EXPECT_NEAR(mean, expected, 0.03) << x;  // 32 points resolve an area to about 1/32
  }
}

TEST(ShadowFilter, FourMomentsSeparateTwoDepthsAndTwoMomentsLeak) {
  // Half of the texels have depth 0.2, and the other half 0.6. A receiver at 0.9 is behind both. A receiver at 0.4 is only behind the
  // nearer half.
  Map map(8);
  map.make_moments();
  const auto power = [](double d, int n) { return std::pow(d, n); };
  for (glm::vec4& m : map.moments)
    for (int n = 1; n <= 4; ++n) m[n - 1] = static_cast<float>(0.5 * power(0.2, n) + 0.5 * power(0.6, n));
  const auto light = [&](ShadowFilter filter, double depth) {
    return shadow_factor(shadow_of(map.view, filter, ShadowBias::none), receiver({0, 0, static_cast<float>(1.0 - 2.0 * depth)}));
  };
  EXPECT_NEAR(light(ShadowFilter::moments, 0.1), 1.0f, 1e-3f);
  EXPECT_NEAR(light(ShadowFilter::moments, 0.4), 0.5f, 0.01f);  // tolerance for the bias that guards against rounding
  EXPECT_NEAR(light(ShadowFilter::moments, 0.9), 0.0f, 0.01f);
  // With two moments, the mean is 0.4 and the variance 0.04, so Chebyshev's bound is 0.04/(0.04 + 0.25) = 0.138 although the receiver is
  // fully occluded.
  EXPECT_NEAR(light(ShadowFilter::vsm, 0.9), 0.04f / 0.29f, 1e-4f);
  EXPECT_EQ(light(ShadowFilter::vsm, 0.1), 1.0f);
}

TEST(ShadowFilter, MomentsOfASingleDepthGiveAStep) {
  Map map(8);
  map.fill([](double, double) { return 0.0; });
  map.make_moments();
  for (const ShadowFilter filter : {ShadowFilter::vsm, ShadowFilter::moments}) {
    EXPECT_EQ(shadow_factor(shadow_of(map.view, filter, ShadowBias::none), receiver({0, 0, 0.1f})), 1.0f);
    EXPECT_LT(shadow_factor(shadow_of(map.view, filter, ShadowBias::none), receiver({0, 0, -0.2f})), 0.01f);
  }
}

TEST(Shadow, PointsOutsideOfTheMapAreLit) {
  Map map(16);
  map.fill([](double, double) { return 0.9; });
  const Shadow s = shadow_of(map.view, ShadowFilter::hard, ShadowBias::none);
  EXPECT_EQ(shadow_factor(s, receiver({0, 0, 0})), 0.0f);
  EXPECT_EQ(shadow_factor(s, receiver({1.01f, 0, 0})), 1.0f);
  EXPECT_EQ(shadow_factor(s, receiver({0, -1.01f, 0})), 1.0f);
  EXPECT_EQ(shadow_factor(s, receiver({0, 0, 1.01f})), 1.0f);     // in front of the near plane of the view
  EXPECT_EQ(shadow_factor(s, receiver({0, 0, -1.01f})), 1.0f);    // beyond the far plane, where another cascade takes over
  EXPECT_EQ(shadow_factor(Shadow{}, receiver({0, 0, 0})), 1.0f);  // light without a shadow map
}

TEST(Shadow, PointsBehindASpotAreLit) {
  Map map(16);
  map.fill([](double, double) { return 1.0; });
  map.view.perspective = true;
  map.view.clip_from_rws = glm::mat4(glm::vec4(1, 0, 0, 0), glm::vec4(0, 1, 0, 0), glm::vec4(0, 0, 0.01f, -1), glm::vec4(0, 0, 0.1f, 0));
  const Shadow s = shadow_of(map.view, ShadowFilter::hard, ShadowBias::none);
  EXPECT_EQ(shadow_factor(s, receiver({0, 0, -5})), 0.0f);
  EXPECT_EQ(shadow_factor(s, receiver({0, 0, 5})), 1.0f);
  EXPECT_EQ(shadow_factor(s, receiver({0, 0, 0})), 1.0f);  // at the light position, where w is 0
}

TEST(Shadow, UsesTheFirstViewThatContainsThePoint) {
  Map dark(16), bright(16);
  dark.fill([](double, double) { return 0.9; });
  bright.fill([](double, double) { return -0.9; });
  dark.view.clip_from_rws[0][0] = dark.view.clip_from_rws[1][1] = 2.0f;  // the finer view spans [-1/2, 1/2]²
  const ShadowView views[] = {dark.view, bright.view};
  Shadow s{views, {}};
  s.settings.filter = ShadowFilter::hard;
  s.settings.bias = ShadowBias::none;
  EXPECT_EQ(shadow_factor(s, receiver({0.4f, 0, 0})), 0.0f);
  EXPECT_EQ(shadow_factor(s, receiver({0.6f, 0, 0})), 1.0f);
}

TEST(ShadowBias, EachTypeOffsetsTheDepthByItsFormula) {
  Map map(64);
  const glm::vec3 p(0.1f, 0.2f, -0.3f), l = glm::normalize(glm::vec3(0, 0, 1)), n = glm::normalize(glm::vec3(0.8f, 0, 0.6f));
  ShadowSettings s;
  s.filter = ShadowFilter::hard;
  s.constant = 1.5f;
  s.slope = 2.0f;
  const double texel = 2.0 / 64 * 0.5;  // in window depth
  const double cosine = 0.6, tangent = 0.8 / 0.6;
  const auto lift = [&](ShadowBias bias) {
    s.bias = bias;
    return static_cast<double>(biased_coordinates(map.view, s, receiver(p, n, l)).depth) - 0.35;
  };
  constexpr double kRounding = 2e-7;  // rounding of a depth near 0.35 and of the product in the bias
  EXPECT_NEAR(lift(ShadowBias::none), 0.0, kRounding);
  EXPECT_NEAR(lift(ShadowBias::constant), 1.5 * texel, kRounding);
  EXPECT_NEAR(lift(ShadowBias::slope), texel * (1.5 + 2.0 * 0.5 * tangent), kRounding);  // the hard filter extends by half a texel
  EXPECT_NEAR(lift(ShadowBias::angle), texel * std::max(2.0 * (1.0 - cosine), 1.5), kRounding);
  EXPECT_NEAR(lift(ShadowBias::original), 0.0005, kRounding);
  EXPECT_NEAR(lift(ShadowBias::receiver_plane), 1.5 * texel, kRounding);
  EXPECT_NEAR(lift(ShadowBias::automatic), texel * 0.5 * (1.0 + (1.0 + 0.5) * tangent), kRounding);
  EXPECT_NEAR(lift(ShadowBias::normal_offset), 1.5 * 0.5 * (2.0 / 64) * 0.8 * 0.6 * 0.5, kRounding);  // step·n.z, in depth
  EXPECT_NEAR(lift(ShadowBias::adaptive), 2.0 * 1e-4 * 0.5, kRounding);
}

TEST(ShadowBias, FacesThatFaceAwayStayInShadow) {
  // The point is 1.8 units (57 texels) below an occluder. Its shading normal, turned by a normal map, faces the light. At 96 degrees, the
  // tangent is 9.5, so the offset is 0.5 · (1 + 3 · 9.5) = 15 texels with pcf3, and the plane of the face rises by up to 2 · 9.5 texels
  // within the filter. Both together are less than 57.
  Map map(64);
  map.fill([](double, double) { return 0.9; });
  for (const double degrees : {96.0, 110.0, 135.0, 170.0, 180.0}) {
    const double angle = degrees * std::numbers::pi / 180.0;
    ShadowReceiver<float> point =
        receiver({0.1f, 0.2f, -0.9f}, {static_cast<float>(std::sin(angle)), 0, static_cast<float>(std::cos(angle))});
    point.shading_normal_ws = vec3<float>(glm::vec3(0, 0, 1));
    EXPECT_EQ(shadow_factor(shadow_of(map.view, ShadowFilter::pcf3, ShadowBias::automatic), point), 0.0f) << degrees;
  }
}

TEST(ShadowBias, GrazingFacesOfBumpySurfacesStayInShadow) {
  // The same occluder, 57 texels away. The triangle is within half a degree of the light's direction, on either side, and a normal map
  // turns the shading normal to 60 degrees. The smooth normal is at 80 degrees, so the light does not fade (cos 80 is 0.35 cos 60). A bias
  // of the triangle's own angle is over 100 texels. The tangent of 60 degrees, 1.7, gives 0.5 · (1 + 3 · 3.5) + 2 · 6.9 = 20 texels at
  // most.
  Map map(64);
  map.fill([](double, double) { return 0.9; });
  const auto at_angle = [](double degrees) {
    const double angle = degrees * std::numbers::pi / 180.0;
    return vec3<float>(glm::vec3(glm::dvec3(std::sin(angle), 0.0, std::cos(angle))));
  };
  for (const double degrees : {89.5, 89.7, 89.9, 90.1, 90.3, 90.5}) {
    ShadowReceiver<float> point = receiver({0.1f, 0.2f, -0.9f});
    point.face_normal_ws = at_angle(degrees);
    point.shading_normal_ws = at_angle(60.0);
    point.smooth_normal_ws = at_angle(80.0);
    EXPECT_EQ(shadow_factor(shadow_of(map.view, ShadowFilter::pcf3, ShadowBias::automatic), point), 0.0f) << degrees;
  }
}

TEST(ShadowBias, TrianglesThatFaceAwayAreLitAtTheHeightOfTheSmoothSurface) {
  // Without a normal map, the smooth surface faces the light at 60 degrees, 20 texels above the triangle. The occluder is 10 texels above
  // the triangle. The bias, 0.5 · (1 + 3 · 1.7) texels, is less than that.
  Map map(64);
  const double texel = 2.0 / 64.0;
  map.fill([&](double, double) { return -0.5 + 10.0 * texel; });
  ShadowReceiver<float> point = receiver({0.0f, 0.0f, -0.5f}, {0.8f, 0.0f, -0.6f});
  point.shading_normal_ws = vec3<float>(glm::vec3(0.8660254f, 0.0f, 0.5f));
  const Shadow shadow = shadow_of(map.view, ShadowFilter::hard, ShadowBias::automatic);
  EXPECT_EQ(shadow_factor(shadow, point), 0.0f);
  point.smooth_height = static_cast<float>(20.0 * texel);
  EXPECT_EQ(shadow_factor(shadow, point), 1.0f);
  point.face_normal_ws = vec3<float>(glm::vec3(0.8f, 0.0f, 0.6f));  // a triangle that faces the light keeps its own position
  EXPECT_EQ(shadow_factor(shadow, point), 0.0f);
}

TEST(ShadowFactor, FadesWhereOnlyTheMappedNormalFacesTheLight) {
  Map map(64);
  map.fill([](double, double) { return -1.0; });  // nothing in front of the point
  const Shadow shadow = shadow_of(map.view, ShadowFilter::pcf3, ShadowBias::automatic);
  ShadowReceiver<float> point = receiver({0, 0, 0});
  point.shading_normal_ws = vec3<float>(glm::vec3(0.6f, 0.0f, 0.8f));
  EXPECT_EQ(shadow_factor(shadow, point), 1.0f);
  for (const auto& [cosine, expected] : {std::pair{0.3f, 1.0f}, {0.1f, 0.5f}, {0.0f, 0.0f}, {-0.3f, 0.0f}}) {
    point.smooth_normal_ws = vec3<float>(glm::vec3(std::sqrt(1.0f - cosine * cosine), 0.0f, cosine));
    EXPECT_FLOAT_EQ(shadow_factor(shadow, point), expected) << cosine;
  }
}

// Returns the fraction of a tilted floor that shadows itself. The floor is drawn into the map at texel centers.
double false_shadow(ShadowFilter filter, ShadowBias bias, double degrees) {
  const double slope = std::tan(degrees * std::numbers::pi / 180.0);
  Map map(256);
  const double stretch = std::min(1.0, 0.9 / slope);  // keeps the floor within the depth range of the map
  map.fill([&](double x, double) { return std::clamp(slope * x, -1.0, 1.0); });
  Shadow s = shadow_of(map.view, filter, bias);
  s.settings.max_slope = 1e3f;
  const glm::vec3 normal = glm::normalize(glm::vec3(-slope, 0, 1));
  std::mt19937 random(5);
  std::uniform_real_distribution<double> any(-0.9 * stretch, 0.9 * stretch);
  double shaded = 0.0;
  constexpr int kPoints = 4000;
  for (int k = 0; k < kPoints; ++k) {
    const double x = any(random), y = any(random);
    shaded += 1.0 - static_cast<double>(
                        shadow_factor(s, receiver({static_cast<float>(x), static_cast<float>(y), static_cast<float>(slope * x)}, normal)));
  }
  return shaded / kPoints;
}

TEST(ShadowBias, AcneOccursWithoutABiasButNotWithPlaneBiases) {
  for (const double degrees : {10.0, 45.0, 70.0, 80.0}) {
    EXPECT_GT(false_shadow(ShadowFilter::hard, ShadowBias::none, degrees), 0.4) << degrees;  // half of each texel is below its center
    for (const ShadowFilter filter : {ShadowFilter::hard, ShadowFilter::bilinear, ShadowFilter::pcf5}) {
      EXPECT_EQ(false_shadow(filter, ShadowBias::receiver_plane, degrees), 0.0) << degrees;
      EXPECT_EQ(false_shadow(filter, ShadowBias::automatic, degrees), 0.0) << degrees;
      EXPECT_EQ(false_shadow(filter, ShadowBias::slope, degrees), 0.0) << degrees;
    }
    EXPECT_EQ(false_shadow(ShadowFilter::hard, ShadowBias::adaptive, degrees), 0.0) << degrees;
  }
  EXPECT_GT(false_shadow(ShadowFilter::hard, ShadowBias::constant, 80.0), 0.3);  // too small for a slope of 5.7 texel widths per texel
}

TEST(ShadowBias, SteepPlanesAreLitWhereTheMapIsEmpty) {
  const Map map(64);  // empty
  const glm::vec3 steep = glm::normalize(glm::vec3(-5, 0, 1)), at_far_end(0.1f, 0.1f, -0.999f);
  for (const ShadowFilter filter : {ShadowFilter::hard, ShadowFilter::bilinear, ShadowFilter::pcf7})
    for (const ShadowBias bias : {ShadowBias::receiver_plane, ShadowBias::adaptive, ShadowBias::automatic})
      EXPECT_EQ(shadow_factor(shadow_of(map.view, filter, bias), receiver(at_far_end, steep)), 1.0f);
}

TEST(ShadowBias, ReceiverPlanesAreLinearInSpotLightWindows) {
  // A tilted wall in front of a spot light. The depth that the plane predicts at a texel center must equal the depth at which the ray
  // through the center hits the wall.
  const float near = 0.5f, far = 20.0f, a = near * far / (far - near), b = -near / (far - near);
  ShadowView view;
  view.size = 128;
  view.perspective = true;
  view.depth_per_unit = a;
  view.texel_per_w = 2.0f / 128;
  view.clip_from_rws = glm::mat4(glm::vec4(1, 0, 0, 0), glm::vec4(0, 1, 0, 0), glm::vec4(0, 0, -b, -1), glm::vec4(0, 0, a, 0));
  view.clip_plane_from_rws = glm::mat4(glm::transpose(glm::inverse(glm::dmat4(view.clip_from_rws))));
  const glm::dvec3 n = glm::normalize(glm::dvec3(0.5, 0.3, 0.6)), q(0, 0, -6);
  const auto on_wall = [&](double x, double y) { return glm::dvec3(x, y, -1) * (glm::dot(n, q) / glm::dot(n, glm::dvec3(x, y, -1))); };
  const auto depth_of = [&](const glm::dvec3& p) { return static_cast<double>(a) / -p.z + static_cast<double>(b); };
  const glm::vec3 p(on_wall(0.1, -0.2));
  ShadowCoordinates<float> place = shadow_coordinates(view, vec3<float>(p));
  set_plane(view, vec3<float>(p), vec3<float>(glm::vec3(n)), 1e3f, place);
  for (int step = -8; step <= 8; step += 2) {
    const double x = 0.1 + step / 64.0, y = -0.2 - step / 128.0;
    const double by_plane =
        static_cast<double>(place.depth) + step * static_cast<double>(place.depth_dx) - 0.5 * step * static_cast<double>(place.depth_dy);
    EXPECT_NEAR(by_plane, depth_of(on_wall(x, y)), 3e-7);  // float depths below 0.1, sums of three terms
  }
}

TEST(Shadow, LanesMatchScalarBits) {
  Map map = random_map(64, 6);
  map.make_moments();
  std::mt19937 random(7);
  std::uniform_real_distribution<float> any(-1.1f, 1.1f);
  using L = RealN<8>;  // not instantiated by the library
  for (int f = 0; f <= static_cast<int>(ShadowFilter::moments); ++f) {
    for (int b = 0; b <= static_cast<int>(ShadowBias::original); ++b) {
      Shadow s = shadow_of(map.view, static_cast<ShadowFilter>(f), static_cast<ShadowBias>(b));
      s.settings.light_radius = 0.05f;
      ShadowReceiver<L> wide = receiver<L>({0, 0, 0});
      std::array<ShadowReceiver<float>, 8> single;
      for (int i = 0; i < 8; ++i) {
        const glm::vec3 n = glm::normalize(glm::vec3(any(random), any(random), 1.0f));
        ShadowReceiver<float>& one = single[static_cast<std::size_t>(i)];
        one = receiver({any(random), any(random), any(random)}, n);
        one.x_px = static_cast<float>(i) + 0.5f;
        for (int k = 0; k < 3; ++k) {
          set_lane(wide.position_rws[k], i, one.position_rws[k]);
          set_lane(wide.face_normal_ws[k], i, n[k]);
          set_lane(wide.shading_normal_ws[k], i, n[k]);
        }
        set_lane(wide.x_px, i, one.x_px);
      }
      const L light = shadow_factor(s, wide);
      for (int i = 0; i < 8; ++i)
        EXPECT_EQ(as_int(lane(light, i)), as_int(shadow_factor(s, single[static_cast<std::size_t>(i)]))) << f << " " << b;
    }
  }
}

}  // namespace
}  // namespace halfspace
