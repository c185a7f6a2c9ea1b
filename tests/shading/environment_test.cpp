// SPDX-License-Identifier: Apache-2.0
//
// Tests the mapping from directions to texels, continuity, and mip level selection.
#include "halfspace/shading/environment/environment.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cfenv>
#include <cmath>
#include <random>

#include "support/constants.h"
#include "support/random.h"

namespace halfspace {
namespace {

using Faces = std::array<Image<glm::vec4>, 6>;

Image<glm::vec4> random_image(int width, int height, uint32_t seed) {
  std::mt19937 random(seed);
  Image<glm::vec4> image(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const auto next = [&] { return static_cast<float>(random() >> 8) * 0x1p-24f; };
      const float r = next(), g = next(), b = next();
      image.at(x, y) = {r, g, b, 1};
    }
  }
  return image;
}
Faces random_faces(int size, uint32_t seed) {
  Faces faces;
  for (uint32_t f = 0; f < 6; ++f) faces[f] = random_image(size, size, seed + f);
  return faces;
}
EnvironmentMap random_panorama(int width, int height) { return {random_image(width, height, 1), TexelFormat::rgba32f}; }
EnvironmentMap random_cube(int size) { return {random_faces(size, 5), TexelFormat::rgba32f}; }

// Returns the direction in map space for panorama coordinates (u, v), from the formula that defines the convention.
glm::dvec3 panorama_direction(double u, double v) {
  const double phi = (u - 0.5) * 2 * kPi, theta = v * kPi;
  return {std::sin(theta) * std::sin(phi), std::cos(theta), std::sin(theta) * std::cos(phi)};
}

// Samples level 0, since the derivatives are zero.
glm::dvec3 at(const EnvironmentMap& map, const glm::dvec3& d) { return map.sample<double>(d, glm::dvec3(0.0), glm::dvec3(0.0)); }

double distance(const glm::dvec3& a, const glm::dvec3& b) {
  return std::max({std::abs(a.x - b.x), std::abs(a.y - b.y), std::abs(a.z - b.z)});
}

// ---- mapping from directions to texels ---------------------------------------------------------------------------------

TEST(EnvironmentMap, PanoramaAxesPointAtTheDocumentedTexels) {
  Image<glm::vec4> image(8, 4);
  for (int y = 0; y < 4; ++y) {
    for (int x = 0; x < 8; ++x) image.at(x, y) = glm::vec4(static_cast<float>(x), static_cast<float>(y), 0, 1);
  }
  const EnvironmentMap map(image, TexelFormat::rgba32f);
  // The directions are halfway between texels: u = 1/2 is between columns 3 and 4, v = 1/2 between rows 1 and 2.
  EXPECT_LT(distance(at(map, {0, 0, 1}), {3.5, 1.5, 0}), 1e-9) << "forward is the center";
  EXPECT_LT(distance(at(map, {1, 0, 0}), {5.5, 1.5, 0}), 1e-9) << "right";
  EXPECT_LT(distance(at(map, {-1, 0, 0}), {1.5, 1.5, 0}), 1e-9) << "left";
  EXPECT_LT(distance(at(map, {0, 0, -1}), {3.5, 1.5, 0}), 1e-9) << "backward is between columns 7 and 0";
  EXPECT_LT(distance(at(map, {0, 1, 0}), {3.5, 0, 0}), 4) << "up is row 0";
  EXPECT_NEAR(at(map, {0, 1, 0}).y, 0, 1e-9);
  EXPECT_NEAR(at(map, {0, -1, 0}).y, 3, 1e-9);
}

TEST(EnvironmentMap, PanoramaTexelsMatchTheirDirections) {
  const Image<glm::vec4> image = random_image(32, 16, 3);
  const EnvironmentMap map(image, TexelFormat::rgba32f);
  for (int y = 0; y < 16; ++y) {
    for (int x = 0; x < 32; ++x) {
      const glm::dvec3 d = panorama_direction((x + 0.5) / 32, (y + 0.5) / 16) * (1.0 + x);
      EXPECT_LT(distance(at(map, d), glm::dvec3(image.at(x, y))), 1e-12);
    }
  }
}

// OpenGL 4.6, table 8.19, with s = sc/|ma| and t = tc/|ma|.
glm::dvec3 table_direction(int face, double sc, double tc) {
  switch (face) {
    case 0: return {1, -tc, -sc};    // sc = -rz, tc = -ry, ma = rx
    case 1: return {-1, -tc, sc};    // sc = rz, tc = -ry
    case 2: return {sc, 1, tc};      // sc = rx, tc = rz, ma = ry
    case 3: return {sc, -1, -tc};    // sc = rx, tc = -rz
    case 4: return {sc, -tc, 1};     // sc = rx, tc = -ry, ma = rz
    default: return {-sc, -tc, -1};  // sc = -rx, tc = -ry
  }
}

TEST(EnvironmentMap, CubeTexelsMatchOpenGl) {
  const Faces faces = random_faces(8, 9);
  const EnvironmentMap map(faces, TexelFormat::rgba32f);
  for (int f = 0; f < 6; ++f) {
    for (int y = 0; y < 8; ++y) {
      for (int x = 0; x < 8; ++x) {
        const glm::dvec3 d = table_direction(f, (2 * x + 1) / 8.0 - 1, (2 * y + 1) / 8.0 - 1) * 3.0;
        EXPECT_LT(distance(at(map, d), glm::dvec3(faces[static_cast<std::size_t>(f)].at(x, y))), 1e-12) << f;
      }
    }
  }
}

TEST(EnvironmentMap, WorldIsNotMirrored) {
  // Right, left, top, bottom, front and back, as seen by an observer who looks along -z with y up.
  Faces faces;
  for (std::size_t f = 0; f < 6; ++f) {
    faces[f] = Image<glm::vec4>(1, 1);
    faces[f].at(0, 0) = glm::vec4(static_cast<float>(f));
  }
  const EnvironmentMap map(faces, TexelFormat::rgba32f);
  const Environment environment{.map = &map};
  const std::array<glm::vec3, 6> world{{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, -1}, {0, 0, 1}}};
  for (std::size_t f = 0; f < 6; ++f) {
    EXPECT_EQ(environment.light<float>(world[f], glm::vec3(0), glm::vec3(0)).x, static_cast<float>(f));
  }
}

TEST(EnvironmentMap, GlobeMatchesTheUvSphere) {
  const Image<glm::vec4> image = random_image(16, 8, 4);
  const EnvironmentMap map(image, TexelFormat::rgba32f);
  const Environment globe{.map = &map, .map_from_world = kMapFromGlobe};
  for (int y = 0; y < 8; ++y) {
    for (int x = 0; x < 16; ++x) {
      const double u = (x + 0.5) / 16, v = (y + 0.5) / 8;
      const glm::dvec3 p(std::sin(kPi * v) * std::cos(2 * kPi * u), std::cos(kPi * v), -std::sin(kPi * v) * std::sin(2 * kPi * u));
      EXPECT_LT(distance(globe.light<double>(p, glm::dvec3(0.0), glm::dvec3(0.0)), glm::dvec3(image.at(x, y))), 1e-12);
    }
  }
}

// ---- constants ---------------------------------------------------------------------------------------------------------

template <class Texel>
void expect_constant(const Texel& texel, TexelFormat format, const glm::vec3& want) {
  Image<Texel> panorama(20, 10), odd(7, 5), face(6, 6);
  for (Image<Texel>* image : {&panorama, &odd, &face}) std::fill_n(image->data(), image->width() * image->height(), texel);
  std::array<Image<Texel>, 6> faces;
  faces.fill(face);
  std::mt19937 random(3);
  for (const EnvironmentMap& map : {EnvironmentMap(panorama, format), EnvironmentMap(odd, format), EnvironmentMap(faces, format)}) {
    for (int i = 0; i < 2000; ++i) {
      const glm::vec3 d(random_vector(random)), step(0.5f * glm::vec3(random_vector(random)) * std::exp2(-static_cast<float>(i % 8)));
      const glm::vec3 got = map.sample<float>(d, step, glm::vec3(0));
      ASSERT_EQ(got, want) << i;
    }
  }
}

TEST(EnvironmentMap, ConstantsAreExactOnEveryLevel) {
  expect_constant(glm::u8vec4(137, 1, 254, 255), TexelFormat::srgb8a8, {kSrgbToLinear[137], kSrgbToLinear[1], kSrgbToLinear[254]});
  expect_constant(glm::vec4(0.1f, 3e-5f, 70000.0f, 1), TexelFormat::rgba32f, {0.1f, 3e-5f, 70000.0f});
  expect_constant(glm::vec4(0.125f, 1000.0f, 0.5f, 1), TexelFormat::rgba16f, {0.125f, 1000.0f, 0.5f});
}

// ---- seams -------------------------------------------------------------------------------------------------------------

// Bounds the change across an edge by the contrast of the texels (1) and their density (n/2 per unit of the face, in each direction).
TEST(EnvironmentMap, CubeIsContinuousAcrossEdgesAndCorners) {
  const int n = 16;
  const EnvironmentMap map = random_cube(n);
  std::mt19937 random(7);
  const double tiny = 1e-7;
  double worst = 0;
  for (int i = 0; i < 20000; ++i) {
    glm::dvec3 d = random_vector(random);
    const int a = i % 3, b = (i + 1 + i / 3 % 2) % 3, c = 3 - a - b;
    d[b] = std::copysign(std::abs(d[a]), d[b]);                   // on an edge or its extension
    if (i % 10 == 0) d[c] = std::copysign(std::abs(d[a]), d[c]);  // at a corner
    d /= std::max({std::abs(d.x), std::abs(d.y), std::abs(d.z)});
    const glm::dvec3 off = random_vector(random) * tiny;
    worst = std::max(worst, distance(at(map, d + off), at(map, d - off)));
  }
  RecordProperty("worst", std::to_string(worst));
  EXPECT_LT(worst, 10 * tiny * n * 2);  // |off| reaches 4.5·tiny
}

TEST(EnvironmentMap, CubeIsContinuousBetweenFacesOnEveryLevel) {
  const EnvironmentMap map = random_cube(16);
  std::mt19937 random(8);
  for (const float lod : {1.0f, 2.0f, 3.0f, 4.0f}) {
    for (int i = 0; i < 500; ++i) {
      glm::dvec3 d = random_vector(random);
      d.z = d.x > 0 ? d.x : -d.x;
      d /= std::max(std::abs(d.x), std::abs(d.y));
      if (std::abs(d.y) > 0.99) continue;
      // Both faces have the same texel density along y: lod = log2(n/2 · step).
      const glm::dvec3 step(0, std::exp2(static_cast<double>(lod)) / 8.0, 0), tiny(1e-9, 0, 0);
      EXPECT_LT(distance(map.sample<double>(d + tiny, step, {}), map.sample<double>(d - tiny, step, {})), 1e-6);
    }
  }
}

TEST(EnvironmentMap, PanoramaIsContinuousWhereLongitudeWraps) {
  const EnvironmentMap map = random_panorama(64, 32);
  for (int i = 1; i < 300; ++i) {
    const double v = i / 300.0;
    const glm::dvec3 step = panorama_direction(0.25, 0.5) * (std::exp2(i % 5) * kPi / 32);  // levels 0 to 4
    const glm::dvec3 before = map.sample<double>(panorama_direction(1 - 1e-10, v), step, {}),
                     after = map.sample<double>(panorama_direction(1e-10, v), step, {});
    EXPECT_LT(distance(before, after), 1e-6) << v;
  }
}

// Uses a sky that is linear in the direction, which bilinear filtering must reproduce across the pole.
TEST(EnvironmentMap, PanoramaIsContinuousAcrossThePoles) {
  const glm::dvec3 a(0.3, 0.2, -0.35);
  Image<glm::vec4> image(64, 32);
  for (int y = 0; y < 32; ++y) {
    for (int x = 0; x < 64; ++x) {
      image.at(x, y) = glm::vec4(static_cast<float>(0.5 + glm::dot(a, panorama_direction((x + 0.5) / 64, (y + 0.5) / 32))));
    }
  }
  const EnvironmentMap map(image, TexelFormat::rgba32f);
  double worst = 0, at_pole = 0;
  for (const double pole : {0.0, 1.0}) {
    for (int i = 0; i < 64 * 7; ++i) {
      for (const double away : {1e-9, 0.25 / 32, 0.5 / 32, 0.8 / 32, 2.0 / 32}) {
        const glm::dvec3 d = panorama_direction(i / (64.0 * 7), std::abs(pole - away));
        const double error = std::abs(at(map, d).x - (0.5 + glm::dot(a, d)));
        worst = std::max(worst, error);
        if (away == 1e-9) at_pole = std::max(at_pole, error);
      }
    }
  }
  RecordProperty("worst", std::to_string(worst));
  RecordProperty("at_pole", std::to_string(at_pole));
  // The bilinear error of a function with second derivative |a| = 0.5 is h²/8 per axis. With h = π/32, that is 2 · 0.5 · 0.0096/8 = 1.2e-3.
  // Clamping at the pole would have an error of the slope over half a texel, 0.46 · π/64 = 0.02.
  EXPECT_LT(worst, 1.3e-3);
  EXPECT_LT(at_pole, 1.3e-3);
}

// ---- levels ------------------------------------------------------------------------------------------------------------

TEST(EnvironmentMap, PanoramaLevelFollowsTheAngle) {
  const EnvironmentMap map = random_panorama(256, 128);
  std::mt19937 random(11);
  for (int i = 0; i < 4000; ++i) {
    // Pixels of a randomly oriented camera. A third of them are at the seam, and a third at a pole.
    glm::dvec3 d = random_vector(random);
    if (i % 3 == 1) d.x = 1e-7 * d.x;
    if (i % 3 == 2) d.x *= 1e-4, d.z *= 1e-4;
    const glm::dvec3 dx = random_vector(random) * 0.01, dy = random_vector(random) * 0.01;
    const auto angle = [&](const glm::dvec3& step) {  // uses a small fraction of the step, since a step is a chord and not an arc
      const double h = 1e-5;
      const glm::dvec3 p = glm::normalize(d - step * h), q = glm::normalize(d + step * h);
      return std::asin(glm::length(glm::cross(p, q))) / (2 * h);
    };
    const double want = std::log2(std::max(angle(dx), angle(dy)) * 128 / kPi);
    const float got = map.level_of_detail<float>(glm::vec3(d), glm::vec3(dx), glm::vec3(dy));
    // cross() suffers from cancellation where d and the step are almost parallel, which is very unlikely for the longer of two random
    // steps.
    EXPECT_NEAR(static_cast<double>(got), want, 1e-3) << i;
  }
}

// A power of two changes only exponents, so the results have the same bits.
TEST(EnvironmentMap, LevelsDoNotDependOnTheLengthOfTheDirection) {
  std::mt19937 random(13);
  for (const EnvironmentMap& map : {random_panorama(256, 128), random_cube(64)}) {
    for (int i = 0; i < 100; ++i) {
      const glm::vec3 d(random_vector(random)), dx(random_vector(random) * 0.01), dy(random_vector(random) * 0.01);
      const float want = map.level_of_detail<float>(d, dx, dy);
      for (const float scale : {0x1p-50f, 0x1p-12f, 0x1p50f})
        EXPECT_EQ(map.level_of_detail<float>(d * scale, dx * scale, dy * scale), want);
    }
  }
}

TEST(EnvironmentMap, CubeLevelFollowsTheFaceDensity) {
  const EnvironmentMap map = random_cube(64);
  std::mt19937 random(12);
  for (int i = 0; i < 4000; ++i) {
    const glm::dvec3 d = random_vector(random), dx = random_vector(random) * 0.01, dy = random_vector(random) * 0.01;
    int axis = 0;
    for (int k = 1; k < 3; ++k) axis = std::abs(d[k]) > std::abs(d[axis]) ? k : axis;
    const auto density = [&](const glm::dvec3& step) {  // distance on the face, where 64 texels span 2 units
      const double h = 1e-6;
      const glm::dvec3 p = (d - step * h) / std::abs((d - step * h)[axis]), q = (d + step * h) / std::abs((d + step * h)[axis]);
      return glm::length(q - p) / (2 * h) * 32;
    };
    const double want = std::log2(std::max(density(dx), density(dy)));
    EXPECT_NEAR(static_cast<double>(map.level_of_detail<float>(glm::vec3(d), glm::vec3(dx), glm::vec3(dy))), want, 1e-3) << i;
  }
}

// Uses stripes along the meridians, 4 texels wide at the equator. Near the poles they are narrower than a texel at the equator, so the mip
// levels must average them. At the equator, level 1 still shows stripes 2 texels wide.
TEST(EnvironmentMap, LevelsAreLowPassFilteredTowardThePoles) {
  const int width = 512, height = 256;
  Image<glm::vec4> image(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) image.at(x, y) = glm::vec4(x / 4 % 2 == 0 ? 0.0f : 1.0f);
  }
  const EnvironmentMap map(image, TexelFormat::rgba32f);
  const auto spread = [&](double v) {
    double low = 1, high = 0;
    for (int i = 0; i < 2000; ++i) {
      const glm::dvec3 d = panorama_direction(i / 2000.0, v), up(0, 1, 0);
      const glm::dvec3 step = glm::normalize(glm::cross(d, up)) * (2 * kPi / height);  // two texels: level 1
      const double x = map.sample<double>(d, step, {}).x;
      low = std::min(low, x);
      high = std::max(high, x);
    }
    return high - low;
  };
  EXPECT_GT(spread(0.5), 0.9);
  EXPECT_LT(spread(0.02), 0.15) << "3.6 degrees from the pole, each row averages 16 texels of level 1, which is 4 periods";
}

// ---- arbitrary bit patterns and lanes ----------------------------------------------------------------------------------

TEST(EnvironmentMap, ExtremeDirectionsReturnValuesInRange) {
  const EnvironmentMap maps[]{random_panorama(8, 4), random_cube(4)};
  const float wild[]{0.0f, -0.0f, 1.0f, -1.0f, 1e-38f, 3e38f, detail::kInfinity, -detail::kInfinity, detail::kNaN};
  for (const EnvironmentMap& map : maps) {
    for (const float x : wild) {
      for (const float y : wild) {
        for (const float z : wild) {
          for (const float step : wild) {
            const glm::vec3 light = map.sample<float>({x, y, z}, {step, x, 1}, {0, step, y});
            for (int k = 0; k < 3; ++k) ASSERT_TRUE(light[k] >= 0.0f && light[k] <= 1.0f) << x << " " << y << " " << z << " " << step;
          }
        }
      }
    }
  }
}

template <int W>
void expect_lanes_are_float(const EnvironmentMap& map) {
  using R = RealN<W>;
  std::mt19937 random(21);
  for (int i = 0; i < 2000; ++i) {
    vec3<R> d, dx, dy;
    std::array<glm::vec3, 3 * W> scalar;
    const glm::vec3 middle(random_vector(random));
    for (int k = 0; k < W; ++k) {
      const auto l = static_cast<std::size_t>(3 * k);
      scalar[l] = i % 2 == 0 ? glm::vec3(random_vector(random)) : middle + 0.02f * glm::vec3(random_vector(random));
      scalar[l + 1] = 0.1f * glm::vec3(random_vector(random));
      scalar[l + 2] = 0.1f * glm::vec3(random_vector(random));
      for (int c = 0; c < 3; ++c) {
        set_lane(d[c], k, scalar[l][c]);
        set_lane(dx[c], k, scalar[l + 1][c]);
        set_lane(dy[c], k, scalar[l + 2][c]);
      }
    }
    const vec3<R> light = map.sample<R>(d, dx, dy);
    for (int k = 0; k < W; ++k) {
      const auto l = static_cast<std::size_t>(3 * k);
      const glm::vec3 want = map.sample<float>(scalar[l], scalar[l + 1], scalar[l + 2]);
      for (int c = 0; c < 3; ++c) ASSERT_EQ(lane(light[c], k), want[c]) << W << " lanes, " << i;
    }
  }
}

TEST(EnvironmentMap, LanesMatchScalarBits) {
  for (const EnvironmentMap& map : {random_panorama(64, 32), random_cube(32)}) {
    expect_lanes_are_float<4>(map);
    expect_lanes_are_float<8>(map);
    if constexpr (kLanes == 16) expect_lanes_are_float<16>(map);
  }
}

// The texels must depend neither on the number of threads nor on the rounding mode of the caller.
TEST(EnvironmentMap, WorkersAndRoundingModeDoNotChangeIt) {
  const Workers workers(3);
  const Faces faces = random_faces(32, 5);
  const EnvironmentMap shared(faces, TexelFormat::rgba32f, &workers);
  ASSERT_EQ(std::fesetround(FE_UPWARD), 0);
  const EnvironmentMap alone(faces, TexelFormat::rgba32f);
  ASSERT_EQ(std::fesetround(FE_TONEAREST), 0);
  ASSERT_EQ(shared.levels(), alone.levels());
  std::mt19937 random(23);
  for (int i = 0; i < 2000; ++i) {
    const glm::vec3 d(random_vector(random));
    const float level = static_cast<float>(i % shared.levels());
    ASSERT_EQ(shared.sample_level<float>(d, level), alone.sample_level<float>(d, level)) << "level " << level;
  }
}

TEST(EnvironmentMap, FloatMatchesDouble) {
  std::mt19937 random(22);
  double worst = 0;
  for (const EnvironmentMap& map : {random_panorama(256, 128), random_cube(128)}) {
    for (int i = 0; i < 50000; ++i) {
      const glm::vec3 d(random_vector(random)), dx = 0.03f * glm::vec3(random_vector(random)),
                                                dy = 0.03f * glm::vec3(random_vector(random));
      worst = std::max(
          worst, distance(glm::dvec3(map.sample<float>(d, dx, dy)), map.sample<double>(glm::dvec3(d), glm::dvec3(dx), glm::dvec3(dy))));
    }
  }
  RecordProperty("worst", std::to_string(worst));
  // u is accurate to 2 ulp near 1 (2^-23), times 256 texels, and the fraction of the coordinate is rounded to 2^-16. With a contrast of 1
  // per texel, the error is about 5e-5 per axis and occurs on two axes. u is just as accurate near a pole, because the error of atan2 is
  // relative.
  EXPECT_LT(worst, 2e-4);
}

// ---- blending ----------------------------------------------------------------------------------------------------------

TEST(EnvironmentBlend, InterpolatesAndReadsOnlyVisibleMaps) {
  const EnvironmentMap a = random_panorama(8, 4), b = random_cube(4);
  const Environment first{.map = &a, .brightness = 2.0f}, second{.map = &b, .brightness = 0.5f}, none{};
  const glm::vec3 d(0.3f, -0.2f, 0.7f), still(0.0f);
  const glm::vec3 x = a.sample<float>(kMapFromWorld * d, still, still) * 2.0f, y = b.sample<float>(kMapFromWorld * d, still, still) * 0.5f;
  // Reading the null map would crash.
  EXPECT_EQ((EnvironmentBlend{first, none, 0.0f}.light<float>(d, still, still)), x);
  EXPECT_EQ((EnvironmentBlend{none, second, 1.0f}.light<float>(d, still, still)), y);
  const glm::vec3 between = EnvironmentBlend{first, second, 0.25f}.light<float>(d, still, still);
  for (int k = 0; k < 3; ++k) EXPECT_FLOAT_EQ(between[k], 0.75f * x[k] + 0.25f * y[k]);
}

}  // namespace
}  // namespace halfspace
