// SPDX-License-Identifier: Apache-2.0
#include "halfspace/procedural/sky.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>

#include "halfspace/core/cube_map.h"
#include "halfspace/scene/scene_file.h"
#include "halfspace/shading/environment.h"
#include "halfspace/shading/tone.h"
#include "render/naive_picture.h"

namespace halfspace {
namespace {

uint64_t hash_of(const SkyFaces& faces) {
  uint64_t hash = 14695981039346656037u;
  for (const Image<glm::vec4>& face : faces) {
    for (const glm::vec4& t : face.texels()) {
      for (int c = 0; c < 4; ++c) hash = (hash ^ std::bit_cast<uint32_t>(t[c])) * 1099511628211u;
    }
  }
  return hash;
}

const DaySky kDay{.sun_ms = {0.6f, 0.64f, 0.48f}, .clouds = 0.4f};

TEST(ProceduralSky, SameBitsEverywhere) {
  EXPECT_EQ(hash_of(procedural_day_sky(48, kDay, Workers(1))), 15637977251397464453u);
  EXPECT_EQ(hash_of(procedural_night_sky(48, {}, Workers(1))), 8917191049804205683u);
}

TEST(ProceduralSky, ThreadsChangeNothing) {
  EXPECT_EQ(procedural_day_sky(37, kDay, Workers(1)), procedural_day_sky(37, kDay, Workers(7)));
  EXPECT_EQ(procedural_night_sky(37, {}, Workers(1)), procedural_night_sky(37, {}, Workers(7)));
}

struct Range {
  float low = 1e9f, high = 0.0f;
  double mean = 0.0;  // over the sphere
};

// Over the sky's upper half; `away` keeps so far from the sun (its cosine).
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

TEST(ProceduralSky, LuminancesAreThoseOfTheHeader) {
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

TEST(ProceduralSky, IsBrightestAtTheSunAndDarkensWithIt) {
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

TEST(ProceduralSky, MoreCloudsCoverMore) {
  double last = 2;
  for (const float clouds : {0.0f, 0.3f, 0.6f, 1.0f}) {  // clouds are white: their share is what is less blue
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

// ---- in scenes ---------------------------------------------------------------------------------------------------------

SceneDescription sky_with(const std::vector<std::string>& settings) {
  SceneFile scene = SceneFile::parse(R"({"version": 1, "cameras": {"c": {"position": [0, 0, 0], "target": [0, 0.4, -1], "fov": 60}},
    "environments": {"day": {"type": "day_sky", "sun": [0, 0.4, -1], "size": 128}, "night": {"type": "night_sky", "size": 64}},
    "background": {"type": "environment", "environment": "day", "second": "night"}})",
                                     "test.json", ".");
  scene.set(settings);
  return scene.description();
}

TEST(ProceduralSky, TheSunStandsWhereItsKeySays) {
  for (const char* rotation : {"day.rotation=0,0,0", "day.rotation=0,70,0"}) {
    const Image<glm::vec4> image = light_of(sky_with({rotation}), 65, 65);
    EXPECT_GT(luminance(vec3<float>(glm::vec3(image.at(32, 32)))), 10.0f) << "in the middle, however the clouds are turned";
    EXPECT_LT(luminance(vec3<float>(glm::vec3(image.at(8, 8)))), 3.0f);
  }
}

TEST(ProceduralSky, StarsAreTheNightsAndFadeWithIt) {
  const auto brightest = [](const std::vector<std::string>& settings) {
    const Image<glm::vec4> image = light_of(sky_with(settings), 320, 200);
    float most = 0;
    for (const glm::vec4& c : image.texels()) most = std::max(most, luminance(vec3<float>(glm::vec3(c))));
    return most;
  };
  EXPECT_GT(brightest({"background.weight=1", "night.star_brightness=50"}), 5.0f);
  EXPECT_LT(brightest({"background.weight=1", "night.stars=0"}), 0.02f);
  const float half = brightest({"background.weight=0.5", "day.brightness=0", "night.star_brightness=50"});
  EXPECT_NEAR(half, 0.5f * brightest({"background.weight=1", "night.star_brightness=50"}), 0.01f * half);
  EXPECT_GT(brightest({"background.environment=night", "background.weight=0", "night.star_brightness=50"}), 5.0f) << "as the first too";
}

TEST(ProceduralSky, IsWithinOneCodeOfDoublePrecision) {
  for (const char* weight : {"background.weight=0", "background.weight=0.6", "background.weight=1"}) {
    // On stars' rims and where a code ties; no more than the Moon's stars have.
    EXPECT_LE(share_beyond_one_code<double>(sky_with({weight}), 160, 90), 1e-3) << weight;
  }
}

TEST(ProceduralSky, IsNoFinerThanTheViewNeeds) {
  const auto size_of = [](int height) {
    const Workers workers(2);
    SceneAssets assets(workers);
    const PreparedScene scene = assets.prepare(sky_with({"day.size=0", "day.clouds=0"}), height, height);
    return std::get<EnvironmentSky>(scene.draws.back().shader).environment.first.map->width();
  };
  // A pixel of the middle spans 2 tan 30° / height; a face's texel there 2 / size, at most two pixels.
  EXPECT_EQ(size_of(50), 64);
  EXPECT_EQ(size_of(100), 128);
  EXPECT_EQ(size_of(200), 256);
}

TEST(ProceduralSky, ExpectedFramesShareItsSize) {
  const Workers workers(2);
  SceneAssets assets(workers);
  const auto size_of = [&](const char* fov) {
    const PreparedScene scene = assets.prepare(sky_with({"day.size=0", "day.clouds=0", fov}), 100, 100);
    return std::get<EnvironmentSky>(scene.draws.back().shader).environment.first.map->width();
  };
  EXPECT_EQ(size_of("c.fov=60"), 128);
  assets.expect(sky_with({"c.fov=30"}), 100, 100);  // a pixel spans half as much
  EXPECT_EQ(size_of("c.fov=60"), 256);
  EXPECT_EQ(size_of("c.fov=30"), 256);
}

}  // namespace
}  // namespace halfspace
