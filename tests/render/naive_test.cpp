// SPDX-License-Identifier: Apache-2.0
//
// Checks that the naive float pipeline is bit-identical to the tile-based pipeline.
#include <gtest/gtest.h>

#include <cstring>

#include "halfspace/render/frame/frame.h"
#include "halfspace/render/frame/naive_render.h"
#include "halfspace/render/scene_assets.h"
#include "halfspace/scene/scene_file.h"
#include "render/naive_picture.h"

namespace halfspace {
namespace {

struct Comparison {
  int differing = 0;  // pixels
  std::string first;  // place and values of the first one
};

Comparison compare(const Image<glm::vec4>& a, const Image<glm::vec4>& b) {
  Comparison c;
  for (int y = 0; y < a.height(); ++y) {
    for (int x = 0; x < a.width(); ++x) {
      if (std::memcmp(&a.at(x, y), &b.at(x, y), sizeof(glm::vec4)) == 0) continue;
      if (c.differing++ == 0) {
        const glm::vec4 &p = a.at(x, y), &q = b.at(x, y);
        c.first = std::to_string(x) + "," + std::to_string(y) + ": " + std::to_string(p.x) + " " + std::to_string(p.y) + " " +
                  std::to_string(p.z) + " and " + std::to_string(q.x) + " " + std::to_string(q.y) + " " + std::to_string(q.z);
      }
    }
  }
  return c;
}

// Returns the number of pixels that differ, or −1 if the naive pipeline cannot draw the scene.
Comparison compare_pipelines(const SceneDescription& scene, int width, int height) {
  const Workers workers(2);
  SceneAssets assets(workers);
  const PreparedScene prepared = assets.prepare(scene, width, height);
  if (!naive_obstacle(prepared, scene).empty()) return {-1, {}};
  Image<glm::vec4> tiles(width, height), naive(width, height);
  render(prepared, tiles, workers);
  render_naive(prepared, naive);
  return compare(tiles, naive);
}

TEST(Naive, ShippedScenesAreBitIdentical) {
  int drawn = 0;
  for (const ShippedScene& shipped : shipped_scenes()) {
    SceneFile file = SceneFile::open(std::string(shipped.name));
    file.set("samples=1");
    const Comparison c = compare_pipelines(file.at(0.5), 160, 90);
    if (c.differing < 0) continue;
    EXPECT_EQ(c.differing, 0) << shipped.name << " at " << c.first;
    ++drawn;
  }
  EXPECT_GE(drawn, 10) << "most scenes consist of opaque triangles";
}

}  // namespace
}  // namespace halfspace
