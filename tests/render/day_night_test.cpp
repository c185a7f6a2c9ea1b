// SPDX-License-Identifier: Apache-2.0
//
// Tests the shipped scene "day-night", and checks that the thread count does not change the image of any shipped scene.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "halfspace/render/scene_assets.h"
#include "halfspace/scene/scene_file.h"
#include "render/naive_picture.h"

namespace halfspace {
namespace {

SceneDescription at_hour(double hours, double seconds = 0.0) {
  SceneFile file = SceneFile::open("day-night");
  file.set("time.hours=" + std::to_string(hours));
  return file.at(seconds);
}

// Returns the mean luminance (Rec. 709) of the linear image before exposure.
double mean_luminance(const SceneDescription& description) {
  const Image<glm::vec4> light = light_of(description, 160, 90);
  double sum = 0.0;
  for (const glm::vec4& t : light.texels()) sum += glm::dot(glm::dvec3(t), glm::dvec3(0.2126, 0.7152, 0.0722));
  return sum / static_cast<double>(light.texels().size());
}

TEST(DayNight, LightDecreasesFromNoonToMidnight) {
  const double noon = mean_luminance(at_hour(12)), dusk = mean_luminance(at_hour(17.5)), midnight = mean_luminance(at_hour(0));
  EXPECT_GT(noon, 2.0 * dusk);
  EXPECT_GT(dusk, 5.0 * midnight);
  EXPECT_GT(midnight, 0.0);
}

TEST(DayNight, SunFollowsAnEllipseOncePerDay) {
  for (double hours = 0.0; hours <= 24.0; hours += 1.0) {
    const glm::dvec3 sun = at_hour(hours).lights.front().second.direction;
    const double phi = 2.0 * std::numbers::pi * hours / 24.0;
    EXPECT_NEAR(sun.x, 0.1 * std::cos(phi) + 1.5 * std::sin(phi), 1e-12);
    EXPECT_NEAR(sun.y, -std::cos(phi), 1e-12);
  }
  // A day lasts 24 seconds, so one hour is one second.
  EXPECT_NEAR(at_hour(6).lights.front().second.direction.y, at_hour(0, 6.0).lights.front().second.direction.y, 1e-12);
}

TEST(DayNight, ExposureRisesAtNightAndSkiesBlend) {
  const SceneDescription noon = at_hour(12), dusk = at_hour(18), midnight = at_hour(0);
  EXPECT_LT(noon.post.exposure, dusk.post.exposure);
  EXPECT_LT(dusk.post.exposure, midnight.post.exposure);
  EXPECT_EQ(noon.background.weight, 0.0);
  EXPECT_EQ(midnight.background.weight, 1.0);
  EXPECT_GT(dusk.background.weight, 0.2);
  EXPECT_LT(dusk.background.weight, 0.8);
}

TEST(DayNight, OmitsLightsWithoutIntensity) {
  const Workers workers(1);
  SceneAssets assets(workers);
  const auto lights = [&](double hours) {
    std::vector<std::string> names;
    for (const PreparedLight& l : assets.prepare(at_hour(hours), 64, 36).lights) names.push_back(l.name);
    return names;
  };
  EXPECT_EQ(lights(12), std::vector<std::string>{"sun"});
  EXPECT_EQ(lights(0), std::vector<std::string>{"moon"});
}

class EveryPicture : public testing::TestWithParam<std::string> {};

TEST_P(EveryPicture, IsBitIdenticalForAnyThreadCount) {
  const SceneDescription scene = SceneFile::open(GetParam()).at(0.5);
  const Image<glm::u8vec4> one = picture_of(scene, 96, 54, 1);
  EXPECT_EQ(picture_of(scene, 96, 54, 2), one);
  EXPECT_EQ(picture_of(scene, 96, 54, 7), one);
}

std::vector<std::string> names() {
  std::vector<std::string> list;
  for (const ShippedScene& s : shipped_scenes()) list.emplace_back(s.name);
  return list;
}

std::string test_name(const testing::TestParamInfo<std::string>& info) {
  std::string name = info.param;
  std::ranges::replace(name, '-', '_');
  return name;
}

INSTANTIATE_TEST_SUITE_P(Shipped, EveryPicture, testing::ValuesIn(names()), test_name);

}  // namespace
}  // namespace halfspace
