// SPDX-License-Identifier: Apache-2.0
//
// Compares strips, fans, points, lines and outlines, drawn by both renderers.
#include "mesa/mesa_context.h"
#include "mesa/scenes.h"
#include "mesa/twin_pass.h"
#include "mesa/twin_shaders.h"

namespace halfspace::test {

namespace {

constexpr int kWidth = 256, kHeight = 128;  // powers of two, so positions on the 1/256 px grid are exact for both renderers

struct Case {
  const char* name;
  DrawState state;
};

// Returns vertices on the 1/256 px grid inside the window.
ColoredMesh scattered(int n, uint32_t seed) {
  std::mt19937 random(seed);
  const auto place = [&](int size) { return static_cast<float>(random() % static_cast<uint32_t>(size * 256)) / 256.0f; };
  ColoredMesh mesh;
  for (int i = 0; i < n; ++i) {
    const float x = place(kWidth);
    const float y = place(kHeight);
    mesh.pos_clip.push_back({x / (kWidth / 2) - 1.0f, y / (kHeight / 2) - 1.0f, 0.0f, 1.0f});
    mesh.indices.push_back(static_cast<uint32_t>(i));
  }
  return mesh;
}

class MesaPrimitives : public MesaTest, public testing::WithParamInterface<Case> {};

// Additive draws of 1/255 count fragments, so pixels that are drawn twice are detected.
TEST_P(MesaPrimitives, CoverTheSamePixels) {
  const ColoredMesh mesh = scattered(GetParam().state.topology == Topology::triangle_strip ? 12 : 60, 7);
  DrawState state = GetParam().state;
  state.depth.test = false;
  state.blend = BlendState{BlendEquation::add, BlendFactor::one, BlendFactor::one, BlendEquation::add, BlendFactor::one, BlendFactor::one};
  TwinPass pass({.width = kWidth, .height = kHeight});
  pass.draw(OneColor{glm::vec4(1.0f / 255.0f)}, mesh.positions(), mesh.indices, state);
  pass.run();
  int64_t covered = 0, differing = 0;
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const int ours = pass.halfspace().color.at(x, y).x, theirs = pass.mesa().color.at(x, y).x;
      covered += std::max(ours, theirs);
      differing += std::abs(ours - theirs);
    }
  }
  std::printf("%s: %lld fragments, %lld differ\n", GetParam().name, static_cast<long long>(covered), static_cast<long long>(differing));
  EXPECT_GT(covered, 0);
  EXPECT_LE(static_cast<double>(differing), 1e-3 * static_cast<double>(covered));
}

INSTANTIATE_TEST_SUITE_P(
    Kinds, MesaPrimitives,
    testing::Values(Case{"Strip", {.topology = Topology::triangle_strip}}, Case{"Fan", {.topology = Topology::triangle_fan}},
                    Case{"Points1", {.topology = Topology::points}}, Case{"Points2", {.topology = Topology::points, .point_size = 2.0f}},
                    Case{"Points7", {.topology = Topology::points, .point_size = 7.0f}},
                    Case{"Points30", {.topology = Topology::points, .point_size = 30.0f}}, Case{"Lines", {.topology = Topology::lines}},
                    Case{"LineStrip", {.topology = Topology::line_strip}}, Case{"LineLoop", {.topology = Topology::line_loop}},
                    Case{"Lines3", {.topology = Topology::lines, .line_width = 3.0f}},
                    Case{"Outlines", {.polygon_mode = PolygonMode::line}}, Case{"Corners", {.polygon_mode = PolygonMode::point}}),
    case_name);

}  // namespace

}  // namespace halfspace::test
