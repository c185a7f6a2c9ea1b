// SPDX-License-Identifier: Apache-2.0
//
// The named states of draw_state.h: each is compared with the state that it stands for, and drawn.
#include "raster/raster_test.h"

namespace halfspace {
namespace {

using namespace raster_test;

const glm::vec4 kBackground(0.25f, 0.5f, 0.75f, 0.5f);  // exact in sums and products with kSource
const glm::vec4 kSource(1.0f, 0.5f, 0.25f, 0.25f);

struct Preset {
  const char* name;
  DrawState state;
  DrawState written_out;
  bool reversed;
  // For a draw of kSource over kBackground and over depth 0.5.
  glm::vec4 color;
  float depth;  // of a draw that passes the depth test, at depth 0.25 (reversed: 0.75)
  bool fills;   // whether a pixel inside the triangle is drawn, or only its outline
};

std::vector<Preset> presets() {
  const float a = kSource.w;
  const BlendState alpha{.color_equation = BlendEquation::add,
                         .source_color = BlendFactor::src_alpha,
                         .destination_color = BlendFactor::one_minus_src_alpha,
                         .alpha_equation = BlendEquation::add,
                         .source_alpha = BlendFactor::one,
                         .destination_alpha = BlendFactor::one_minus_src_alpha};
  const BlendState additive{.color_equation = BlendEquation::add,
                            .source_color = BlendFactor::src_alpha,
                            .destination_color = BlendFactor::one,
                            .alpha_equation = BlendEquation::add,
                            .source_alpha = BlendFactor::one,
                            .destination_alpha = BlendFactor::one};
  const DepthState less{.test = true, .write = true, .compare = CompareOp::less, .clip = ClipDepth::negative_one_to_one};
  const DepthState less_without_write{.test = true, .write = false, .compare = CompareOp::less, .clip = ClipDepth::negative_one_to_one};
  const DepthState greater{.test = true, .write = true, .compare = CompareOp::greater, .clip = ClipDepth::zero_to_one};
  const glm::vec4 blended(glm::vec3(kSource) * a + glm::vec3(kBackground) * (1 - a), a + kBackground.w * (1 - a));
  const glm::vec4 added(glm::vec3(kSource) * a + glm::vec3(kBackground), a + kBackground.w);
  return {
      {"kOpaqueState", kOpaqueState, {.depth = less}, false, kSource, 0.25f, true},
      {"kAlphaBlendState", kAlphaBlendState, {.depth = less_without_write, .blend = alpha}, false, blended, 0.5f, true},
      {"kAdditiveState", kAdditiveState, {.depth = less_without_write, .blend = additive}, false, added, 0.5f, true},
      {"kDepthOnlyState", kDepthOnlyState, {.depth = less, .color_mask = {false, false, false, false}}, false, kBackground, 0.25f, true},
      {"kReversedZState", kReversedZState, {.depth = greater}, true, kSource, 0.75f, true},
      {"kWireframeState", kWireframeState, {.polygon_mode = PolygonMode::line, .depth = less}, false, kSource, 0.25f, false}};
}

struct Drawn {
  Image<glm::vec4> color{16, 16};
  Image<float> depth{16, 16};
};

// Draws a triangle with its right angle at the lower left pixel center, over kBackground and depth 0.5. It is at the given window depth.
Drawn draw(const DrawState& state, float depth) {
  Drawn out;
  const float z = state.depth.clip == ClipDepth::zero_to_one ? depth : 2.0f * depth - 1.0f;
  std::vector<glm::vec4> positions;
  for (const Point& p : {Point{128, 128}, Point{14 * 256 + 128, 128}, Point{128, 14 * 256 + 128}})
    positions.push_back(clip_position(p, 16, 16, z));
  ColorTarget color = rgba32f_target(out.color);
  color.clear_value = kBackground;
  DepthTarget target = d32f_target(out.depth);
  target.clear_value = 0.5f;
  Pass pass(16, 16, color, target);
  pass.draw(ConstantShader(kSource), make_vertex_view(stream(positions)), state);
  pass.run(one_worker());
  return out;
}

void expect_equal(const Drawn& one, const Drawn& other) {
  for (int y = 0; y < 16; ++y) {
    for (int x = 0; x < 16; ++x) {
      EXPECT_EQ(one.color.at(x, y), other.color.at(x, y)) << x << ' ' << y;
      EXPECT_EQ(one.depth.at(x, y), other.depth.at(x, y)) << x << ' ' << y;
    }
  }
}

TEST(Presets, DrawLikeTheStatesTheyStandFor) {
  for (const Preset& p : presets()) {
    SCOPED_TRACE(p.name);
    for (const float depth : {0.25f, 0.75f}) expect_equal(draw(p.state, depth), draw(p.written_out, depth));
  }
}

TEST(Presets, DrawTheExpectedColorsAndDepths) {
  for (const Preset& p : presets()) {
    SCOPED_TRACE(p.name);
    const Drawn passed = draw(p.state, p.reversed ? 0.75f : 0.25f), failed = draw(p.state, p.reversed ? 0.25f : 0.75f);
    const auto expect_pixel = [](const Drawn& drawn, int x, int y, const glm::vec4& color, float depth) {
      EXPECT_EQ(pixel(drawn.color, x, y), color) << x << ' ' << y;
      EXPECT_EQ(pixel(drawn.depth, x, y), depth) << x << ' ' << y;
    };
    expect_pixel(passed, 5, 0, p.color, p.depth);  // on the lower edge
    if (p.fills) {
      expect_pixel(passed, 3, 3, p.color, p.depth);
    } else {
      expect_pixel(passed, 3, 3, kBackground, 0.5f);
    }
    expect_pixel(passed, 12, 12, kBackground, 0.5f);  // outside
    for (const auto& [x, y] : {std::pair{5, 0}, {3, 3}, {12, 12}}) expect_pixel(failed, x, y, kBackground, 0.5f);
  }
}

}  // namespace
}  // namespace halfspace
