// SPDX-License-Identifier: Apache-2.0
//
// Tests samples exactly on an edge with simple cases, drawn by both renderers.
#include "mesa/mesa_context.h"
#include "mesa/scenes.h"
#include "mesa/twin_pass.h"
#include "mesa/twin_shaders.h"

namespace halfspace::test {

namespace {

constexpr int kSize = 16;

// Formats coverage as text, top row first, for readable failure messages.
std::string coverage(const Picture& p) {
  std::string s;
  for (int row = 0; row < kSize; ++row) {
    for (int x = 0; x < kSize; ++x) s += p.color.at(x, row).w != 0 ? '#' : '.';
    s += '\n';
  }
  return s;
}

TwinPass draw_polygon(const std::vector<glm::vec2>& corners_px) {
  ColoredMesh mesh;
  for (std::size_t i = 2; i < corners_px.size(); ++i)
    add_triangle(mesh, kSize, kSize, {glm::vec3(corners_px[0], 0), glm::vec3(corners_px[i - 1], 0), glm::vec3(corners_px[i], 0)},
                 glm::vec4(1.0f));
  TwinPass pass({.width = kSize, .height = kSize});
  pass.draw(OneColor{}, mesh.positions(), mesh.indices);
  pass.run();
  return pass;
}

}  // namespace

using FillRule = MesaTest;

// The corners of the square are the centers of pixels (4, 4) and (8, 8), y up. Its left and lower edges own their samples, so columns 4 to
// 7 and rows 4 to 7 from below are drawn. Images store the top row first, so the lower edge is also the lower one in the displayed image.
TEST_F(FillRule, SquareOwnsSamplesOnItsLeftAndLowerEdges) {
  const TwinPass pass = draw_polygon({{4.5f, 4.5f}, {8.5f, 4.5f}, {8.5f, 8.5f}, {4.5f, 8.5f}});
  for (int y = 0; y < kSize; ++y) {
    for (int x = 0; x < kSize; ++x) {
      const bool inside = x >= 4 && x < 8 && y >= 4 && y < 8;
      EXPECT_EQ(pass.halfspace().color.at(x, kSize - 1 - y).w != 0, inside) << "Halfspace at " << x << ", " << y;
      EXPECT_EQ(pass.mesa().color.at(x, kSize - 1 - y).w != 0, inside) << "Mesa at " << x << ", " << y;
    }
  }
}

TEST_F(FillRule, WindingDoesNotMatter) {
  const TwinPass pass = draw_polygon({{4.5f, 4.5f}, {4.5f, 8.5f}, {8.5f, 8.5f}, {8.5f, 4.5f}});
  EXPECT_EQ(coverage(pass.halfspace()), coverage(pass.mesa()));
}

TEST_F(FillRule, DiagonalsThroughSamplesAgree) {
  const TwinPass pass = draw_polygon({{8.5f, 2.5f}, {13.5f, 7.5f}, {8.5f, 12.5f}, {3.5f, 7.5f}});
  EXPECT_EQ(coverage(pass.halfspace()), coverage(pass.mesa()));
}

}  // namespace halfspace::test
