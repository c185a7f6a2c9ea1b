// SPDX-License-Identifier: Apache-2.0
#include "halfspace/procedural/sky.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>

#include "halfspace/core/cube_map.h"
#include "halfspace/core/srgb.h"
#include "halfspace/shading/environment/environment.h"
#include "halfspace/shading/values/tone.h"
#include "support/expected_hash.h"
#include "support/hash.h"
#include "support/test_output.h"

namespace halfspace {
namespace {

uint64_t hash_of(const SkyFaces& faces) {
  Hash hash;
  for (const Image<glm::vec4>& face : faces) {
    for (const glm::vec4& t : face.texels()) {
      for (int c = 0; c < 4; ++c) hash.add(std::bit_cast<uint32_t>(t[c]));
    }
  }
  return hash.value();
}

// Returns the six faces side by side.
Image<glm::u8vec4> codes_of(const SkyFaces& faces) {
  const int size = faces[0].width();
  Image<glm::u8vec4> codes(6 * size, size);
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < 6 * size; ++x) {
      const glm::vec4& light = faces[static_cast<std::size_t>(x / size)].at(x % size, y);
      codes.at(x, y) = glm::u8vec4(linear_to_srgb(light.x), linear_to_srgb(light.y), linear_to_srgb(light.z), 255);
    }
  }
  return codes;
}

void expect_sky(const std::string& name, const SkyFaces& faces) {
  EXPECT_TRUE(expect_hash(name, hash_of(faces))) << write_failed_picture(name, codes_of(faces), {});
}

const DaySky kDay{.sun_ms = {0.6f, 0.64f, 0.48f}, .clouds = 0.4f};

TEST(ProceduralSky, MatchesTheStoredHash) {
  expect_sky("day-sky", procedural_day_sky(48, kDay, Workers(1)));
  expect_sky("night-sky", procedural_night_sky(48, {}, Workers(1)));
}

TEST(ProceduralSky, IsBitIdenticalForAnyThreadCount) {
  EXPECT_EQ(procedural_day_sky(37, kDay, Workers(1)), procedural_day_sky(37, kDay, Workers(7)));
  EXPECT_EQ(procedural_night_sky(37, {}, Workers(1)), procedural_night_sky(37, {}, Workers(7)));
}

struct Range {
  float low = 1e9f, high = 0.0f;
  double mean = 0.0;  // averaged over solid angle
};

// Returns the luminances of the upper hemisphere, excluding directions whose cosine with the sun exceeds `away`.
Range luminances(const SkyFaces& faces, const glm::vec3& sun, float away) {
  Range r;
  double weights = 0;
  const int n = faces[0].width();
  for (int f = 0; f < 6; ++f) {
    for (int y = 0; y < n; ++y) {
      for (int x = 0; x < n; ++x) {
        const glm::dvec3 d = cube_direction(f, (2 * x + 1.0) / n - 1, (2 * y + 1.0) / n - 1);
        const double length = glm::length(d), weight = 1 / (length * length * length);
        const glm::vec3 unit(d / length);
        if (unit.y < 0 || glm::dot(unit, sun) > away) continue;
        const float l = luminance(vec3<float>(glm::vec3(faces[static_cast<std::size_t>(f)].at(x, y))));
        r.low = std::min(r.low, l);
        r.high = std::max(r.high, l);
        r.mean += weight * static_cast<double>(l);
        weights += weight;
      }
    }
  }
  r.mean /= weights;
  return r;
}

TEST(ProceduralSky, LuminancesMatchTheDocumentedRanges) {
  for (const float clouds : {0.0f, 0.4f, 1.0f}) {
    const SkyFaces day = procedural_day_sky(64, {.sun_ms = kDay.sun_ms, .clouds = clouds}, Workers(2));
    const Range r = luminances(day, kDay.sun_ms, 0.97f);
    EXPECT_GT(r.low, 0.2f) << clouds;
    EXPECT_LT(r.high, 2.0f) << clouds;
  }
  const Range night = luminances(procedural_night_sky(64, {}, Workers(2)), {}, 1.0f);
  EXPECT_GT(night.low, 1e-3f);
  EXPECT_LT(night.high, 1.2e-2f);
}

TEST(ProceduralSky, IsBrightestAtTheSunAndDarkensAsItSets) {
  const SkyFaces day = procedural_day_sky(256, kDay, Workers(2));
  const EnvironmentMap map(day, TexelFormat::rgba16f);
  EXPECT_GT(luminance(map.sample<float>(kDay.sun_ms, {}, {})), 15.0f);
  EXPECT_EQ(luminances(day, kDay.sun_ms, 1.0f).high > 15.0f, true);
  double last = 0;
  for (const float height : {-0.4f, -0.1f, 0.1f, 0.5f, 0.9f}) {
    const glm::vec3 sun = glm::normalize(glm::vec3(1, height / std::sqrt(1 - height * height), 0));
    const double mean = luminances(procedural_day_sky(64, {.sun_ms = sun}, Workers(2)), sun, 1.0f).mean;
    EXPECT_GT(mean, last) << height;
    last = mean;
  }
}

TEST(ProceduralSky, MoreCloudsReduceBlue) {
  double last = 2;
  for (const float clouds : {0.0f, 0.3f, 0.6f, 1.0f}) {  // clouds are white, so more clouds mean less blue
    const SkyFaces day = procedural_day_sky(64, {.clouds = clouds}, Workers(2));
    double blue = 0, all = 0;
    for (const glm::vec4& t : day[2].texels()) {
      blue += static_cast<double>(t.z - t.x);
      all += static_cast<double>(t.z);
    }
    EXPECT_LT(blue / all, last) << clouds;
    last = blue / all;
  }
}

}  // namespace
}  // namespace halfspace
