// SPDX-License-Identifier: Apache-2.0
//
// The scenes' shaders in double precision against the renderer's floats, and the same pixels for any number of threads.
#include <gtest/gtest.h>

#include <cmath>

#include "naive_picture.h"
#include "scene/scene_file.h"

namespace halfspace {
namespace {

// The largest difference of a pixel, and the root mean square of all, in linear light.
struct Difference {
  double most = 0, rmse = 0;
};

Difference difference_from_double(const SceneDescription& description, int width, int height) {
  const Workers workers(2);
  SceneAssets assets(workers);
  const PreparedScene scene = assets.prepare(description, width, height);
  Image<glm::vec4> picture(width, height);
  render(scene, picture, workers);
  const Image<vec4<double>> truth = naive_picture<double>(scene, width, height, Positions::as_rendered);
  Difference d;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      for (int k = 0; k < 3; ++k) {
        const double one = std::abs(static_cast<double>(picture.at(x, y)[k]) - truth.at(x, y)[k]);
        d.most = std::max(d.most, one);
        d.rmse += one * one;
      }
    }
  }
  d.rmse = std::sqrt(d.rmse / (3.0 * width * height));
  return d;
}

// A scene, and what is set in it.
using Case = std::pair<const char*, std::vector<std::string>>;
const std::vector<Case> kCases{{"three-lights", {}},
                               {"three-lights", {"camera=green_light"}},
                               {"three-lights", {"camera=mirror"}},
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

TEST_P(Twin, AgreesInDouble) {
  const Difference d = difference_from_double(scene(), 480, 270);
  RecordProperty("most", std::to_string(d.most));
  RecordProperty("rmse", std::to_string(d.rmse * 1e6) + "e-6");
  EXPECT_LE(d.most, 1.0 / 255) << "no exception: with equal positions, no decision falls differently";
  EXPECT_LE(d.rmse, 1e-5);
}

uint64_t hash_of(const Image<glm::u8vec4>& image) {
  uint64_t hash = 14695981039346656037u;  // FNV-1a
  for (const glm::u8vec4& t : image.texels()) {
    for (int c = 0; c < 4; ++c) hash = (hash ^ t[c]) * 1099511628211u;
  }
  return hash;
}

// One number for all cases: the pixels of every compiler, lane width and processor.
TEST(Twins, SameBitsEverywhere) {
  uint64_t hash = 0;
  for (const Case& c : kCases) hash = hash * 31 + hash_of(picture_of(scene_of(c), 160, 90, 2));
  EXPECT_EQ(hash, 2114842543125201661u);
}

TEST_P(Twin, SamePixelsForAnyThreads) {
  const Image<glm::u8vec4> one = picture_of(scene(), 160, 90, 1);
  EXPECT_EQ(picture_of(scene(), 160, 90, 2), one);
  EXPECT_EQ(picture_of(scene(), 160, 90, 7), one);
}

INSTANTIATE_TEST_SUITE_P(Scenes, Twin, testing::ValuesIn(kCases));

}  // namespace
}  // namespace halfspace
