// SPDX-License-Identifier: Apache-2.0
//
// Compares the renderer, which uses float, with the same shaders in double precision, and checks that images do not depend on the thread
// count.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "halfspace/render/frame/frame.h"
#include "halfspace/render/scene_assets.h"
#include "halfspace/scene/scene_file.h"
#include "render/naive_picture.h"
#include "support/expected_hash.h"

namespace halfspace {
namespace {

// Difference of two images in linear light: the maximum over all pixels and channels, and the RMS.
struct Difference {
  double max = 0, rmse = 0;
  double beyond = 0;       ///< fraction of pixels that differ by more than 1/255
  double rmse_within = 0;  ///< RMS over the remaining pixels
};

Difference difference_from_double(const SceneDescription& description, int width, int height) {
  const Workers workers(2);
  SceneAssets assets(workers);
  const PreparedScene scene = assets.prepare(description, width, height);
  Image<glm::vec4> picture(width, height);
  render(scene, picture, workers);
  const Image<vec4<double>> truth = naive_picture<double>(scene, width, height, Positions::as_rendered);
  Difference d;
  double squares_within = 0;
  int pixels_beyond = 0;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      double max = 0, squares = 0;
      for (int k = 0; k < 3; ++k) {
        const double one = std::abs(static_cast<double>(picture.at(x, y)[k]) - truth.at(x, y)[k]);
        max = std::max(max, one);
        squares += one * one;
      }
      d.max = std::max(d.max, max);
      d.rmse += squares;
      if (max > 1.0 / 255) {
        ++pixels_beyond;
      } else {
        squares_within += squares;
      }
    }
  }
  const double pixels = static_cast<double>(width) * height;
  d.rmse = std::sqrt(d.rmse / (3.0 * pixels));
  d.rmse_within = std::sqrt(squares_within / (3.0 * pixels));
  d.beyond = pixels_beyond / pixels;
  return d;
}

// A scene name and its settings.
using Case = std::pair<const char*, std::vector<std::string>>;
const std::vector<Case> kCases{{"three-lights", {"shadow.method=none"}},
                               {"three-lights", {"shadow.method=none", "camera=green_light"}},
                               {"three-lights", {"shadow.method=none", "camera=mirror"}},
                               {"earth", {}},
                               {"earth", {"earth.normal=bump"}},
                               {"earth", {"earth.normal=bump", "earth.bump_method=difference"}},
                               {"earth", {"earth.normal=none"}},
                               {"earth", {"earth.shading=none"}},
                               {"earth", {"earth.shading=flat"}},
                               {"earth", {"earth.shading=provoking"}},
                               {"earth", {"earth.shading=gouraud"}}};

SceneDescription scene_of(const Case& c) {
  SceneFile file = SceneFile::open(c.first);
  file.set(c.second);
  return file.description();
}

class Twin : public testing::TestWithParam<Case> {
 protected:
  SceneDescription scene() const { return scene_of(GetParam()); }
};

TEST_P(Twin, MatchesDoublePrecision) {
  const Difference d = difference_from_double(scene(), 480, 270);
  RecordProperty("max", std::to_string(d.max));
  RecordProperty("rmse", std::to_string(d.rmse * 1e6) + "e-6");
  EXPECT_LE(d.max, 1.0 / 255) << "positions are equal, so every pixel must match";
  EXPECT_LE(d.rmse, 1e-5);
}

// "three-lights,shadow.method=none,camera=mirror"
std::string name_of(const Case& c) {
  std::string name = c.first;
  for (const std::string& setting : c.second) name += "," + setting;
  return name;
}

// Checks that the pixels are the same for every compiler, SIMD width and processor. If they differ, the failure report shows the
// differences from the naive pipeline.
void expect_pixels(const Case& c) {
  const SceneDescription scene = scene_of(c);
  expect_picture(name_of(c), picture_of(scene, 160, 90, 2), [&] {
    const Image<vec4<float>> naive = naive_picture<float>(scene, 160, 90);
    Image<glm::u8vec4> codes(160, 90);
    std::ranges::transform(naive.texels(), codes.data(), encode<float>);
    return codes;
  });
}

TEST(Twins, MatchTheStoredHashes) {
  for (const Case& c : kCases) expect_pixels(c);
}

TEST(Twins, ShippedScenesMatchTheStoredHashes) {
  for (const ShippedScene& shipped : shipped_scenes()) {
    const std::string name(shipped.name);
    expect_picture("shipped-" + name, picture_of(SceneFile::open(name).at(0.5), 160, 90, 2));
  }
}

TEST_P(Twin, IsBitIdenticalForAnyThreadCount) {
  const Image<glm::u8vec4> one = picture_of(scene(), 160, 90, 1);
  EXPECT_EQ(picture_of(scene(), 160, 90, 2), one);
  EXPECT_EQ(picture_of(scene(), 160, 90, 7), one);
}

INSTANTIATE_TEST_SUITE_P(Scenes, Twin, testing::ValuesIn(kCases));

// Shadows involve discrete decisions: a depth comparison can have a different result in float if the two depths differ by less than the
// rounding error. Both twins read the same shadow maps. One texel of a 3x3 filter changes the light by a ninth.
class ShadowedTwin : public testing::TestWithParam<Case> {
 protected:
  SceneDescription scene() const { return scene_of(GetParam()); }
};
const std::vector<Case> kShadowed{{"three-lights", {}},
                                  {"moon", {}},
                                  {"moon", {"camera=terminator"}},
                                  {"shadow-plane", {}},
                                  {"shadow-contact", {"shadow.method=pcss"}},
                                  {"shadow-knot", {"shadow.method=hard"}},
                                  {"shadow-knot", {"shadow.method=moments"}},
                                  {"day-night", {"time.hours=16"}}};

TEST_P(ShadowedTwin, DiffersOnlyAtDepthComparisons) {
  const Difference d = difference_from_double(scene(), 480, 270);
  RecordProperty("beyond", std::to_string(d.beyond * 1e6) + "e-6");
  RecordProperty("rmse", std::to_string(d.rmse_within * 1e6) + "e-6");
  EXPECT_LE(d.beyond, 1e-4);
  SceneDescription without = scene();
  without.shadow.method = ShadowMethod::none;
  const Difference unshaded = difference_from_double(without, 480, 270);
  EXPECT_LE(unshaded.max, 1.0 / 255) << "without shadows, every pixel must match";
  EXPECT_LE(unshaded.rmse, 1e-5);
}

TEST_P(ShadowedTwin, IsBitIdenticalForAnyThreadCount) {
  const Image<glm::u8vec4> one = picture_of(scene(), 160, 90, 1);
  EXPECT_EQ(picture_of(scene(), 160, 90, 2), one);
  EXPECT_EQ(picture_of(scene(), 160, 90, 7), one);
}

TEST(Twins, ShadowsMatchTheStoredHashes) {
  for (const Case& c : kShadowed) expect_pixels(c);
}

INSTANTIATE_TEST_SUITE_P(Scenes, ShadowedTwin, testing::ValuesIn(kShadowed));

}  // namespace
}  // namespace halfspace
