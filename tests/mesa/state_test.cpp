// SPDX-License-Identifier: Apache-2.0
//
// Tests the states of a draw call one by one, on random triangles of either winding and various depths. The sizes of the window and
// viewports are powers of two and vertices are on the 1/256 px grid, so snapping does not move vertices, and depths agree, too.
#include "mesa/mesa_context.h"
#include "mesa/scenes.h"
#include "mesa/twin_pass.h"

namespace halfspace::test {

namespace {

constexpr int kStateWidth = 256, kStateHeight = 256;
constexpr TargetSpec kTarget{.width = kStateWidth, .height = kStateHeight};
constexpr Soup kHeap{.triangles = 150, .size = 70, .w_ratio = 8, .grid = 1.0f / 256.0f, .inside = true, .seed = 3};

struct StateCase {
  std::string name;
  DrawState state;
  TargetSpec target = kTarget;
  Soup soup = kHeap;
  friend void PrintTo(const StateCase& c, std::ostream* os) { *os << c.name; }
};

DrawState with_depth(const DepthState& depth) {
  return state_with([&](DrawState& s) { s.depth = depth; });
}
DrawState with_cull(CullMode cull, Winding front = Winding::counter_clockwise, ClipOrigin origin = ClipOrigin::lower_left) {
  return state_with([&](DrawState& s) {
    s.cull = cull;
    s.front = front;
    s.clip_origin = origin;
  });
}
DrawState with_window(std::optional<ViewportRect> viewport, std::optional<Rect> scissor) {
  return state_with([&](DrawState& s) {
    s.viewport = viewport;
    s.scissor = scissor;
  });
}

std::vector<StateCase> cull_cases() {
  return {{"cull_none_ccw", with_cull(CullMode::none)},
          {"cull_none_cw", with_cull(CullMode::none, Winding::clockwise)},
          {"cull_front_ccw", with_cull(CullMode::front)},
          {"cull_front_cw", with_cull(CullMode::front, Winding::clockwise)},
          {"cull_back_ccw", with_cull(CullMode::back)},
          {"cull_back_cw", with_cull(CullMode::back, Winding::clockwise)},
          {"upper_left_cull_none", with_cull(CullMode::none, Winding::counter_clockwise, ClipOrigin::upper_left)},
          {"upper_left_cull_back_ccw", with_cull(CullMode::back, Winding::counter_clockwise, ClipOrigin::upper_left)},
          {"upper_left_cull_back_cw", with_cull(CullMode::back, Winding::clockwise, ClipOrigin::upper_left)}};
}

// `never` and `equal` have separate tests. With a clear depth of 0.5, every other operator passes some fragments and rejects some.
std::vector<StateCase> compare_cases() {
  TargetSpec half = kTarget;
  half.clear_depth = 0.5f;
  const auto compare = [&](const char* name, CompareOp op) { return StateCase{name, with_depth({.compare = op}), half}; };
  return {compare("depth_less", CompareOp::less),           compare("depth_less_equal", CompareOp::less_equal),
          compare("depth_greater", CompareOp::greater),     compare("depth_greater_equal", CompareOp::greater_equal),
          compare("depth_not_equal", CompareOp::not_equal), compare("depth_always", CompareOp::always)};
}

std::vector<StateCase> window_cases() {
  TargetSpec far_is_zero = kTarget;
  far_is_zero.clear_depth = 0.0f;
  Soup deep = kHeap;
  deep.crosses_near = true;
  Soup wide = kHeap;
  wide.size = 300;
  wide.inside = false;
  return {{"scissor", with_window({}, Rect{37, 51, 103, 119})},
          {"scissor_beyond_the_target", with_window({}, Rect{-10, 200, 200, 400})},
          {"viewport_offset", with_window(Rect{61, 43, 128, 64}, {})},
          {"viewport_beyond_the_target", with_window(Rect{-100, -50, 512, 1024}, {})},
          {"viewport_of_odd_size", with_window(Rect{13, 7, 211, 173}, {})},
          {"viewport_with_fractions", with_window(ViewportRect{13.375f, 7.8125f, 128.0f, 64.0f}, {})},
          {"viewport_of_a_fractional_size", with_window(ViewportRect{20.0f, 30.0f, 100.25f, 150.75f}, {})},
          {"viewport_and_scissor", with_window(Rect{61, 43, 128, 128}, Rect{100, 20, 60, 300})},
          {"depth_range", with_depth({.range_near = 0.25f, .range_far = 0.75f})},
          {"depth_range_reversed", with_depth({.range_near = 0.9f, .range_far = 0.1f})},
          {"depth_not_written", with_depth({.write = false})},
          {"depth_clamp", with_depth({.clamp = true}), kTarget, deep},
          {"depth_clamp_to_a_range", with_depth({.clamp = true, .range_near = 0.2f, .range_far = 0.4f}), kTarget, deep},
          {"clipped_at_near_and_far", {}, kTarget, deep},
          {"triangles_beyond_the_window", {}, kTarget, wide},
          {"clip_zero_to_one", with_depth({.clip = ClipDepth::zero_to_one})},
          {"reversed_z", with_depth({.compare = CompareOp::greater, .clip = ClipDepth::zero_to_one}), far_is_zero}};
}

std::vector<StateCase> all_cases() {
  std::vector<StateCase> all;
  for (const auto& some : {cull_cases(), compare_cases(), window_cases()}) all.insert(all.end(), some.begin(), some.end());
  return all;
}

}  // namespace

class StateOf : public MesaFixture<testing::TestWithParam<StateCase>> {};

TEST_P(StateOf, DrawsTheSameImage) {
  const StateCase& c = GetParam();
  const ColoredMesh mesh = make_soup(c.soup, kStateWidth, kStateHeight);
  TwinPass pass(c.target);
  pass.draw(SmoothColor{}, mesh.positions_and_colors(), mesh.indices, c.state);
  pass.run();
  const Figures figures = pass.figures(200);
  report(figures);
  expect_agreement(figures);
}

INSTANTIATE_TEST_SUITE_P(Heap, StateOf, testing::ValuesIn(all_cases()), case_name);

using State = MesaTest;

TEST_F(State, NeverAndCullingBothFacesDrawNothing) {
  const ColoredMesh mesh = make_soup(kHeap, kStateWidth, kStateHeight);
  TwinPass pass(kTarget);
  pass.draw(SmoothColor{}, mesh.positions_and_colors(), mesh.indices, with_depth({.compare = CompareOp::never}));
  pass.draw(SmoothColor{}, mesh.positions_and_colors(), mesh.indices, with_cull(CullMode::front_and_back));
  pass.run();
  EXPECT_EQ(pass.figures().covered, 0);
}

// Draws the same triangles twice, the second time with EQUAL and in different colors, which must replace all pixels of the first draw.
TEST_F(State, EqualReplacesPixelsOfTheSameTriangles) {
  const ColoredMesh mesh = make_soup(kHeap, kStateWidth, kStateHeight);
  TwinPass pass(kTarget);
  pass.draw(OneColor{glm::vec4(1.0f)}, mesh.positions(), mesh.indices);
  pass.draw(SmoothColor{}, mesh.positions_and_colors(), mesh.indices, with_depth({.compare = CompareOp::equal}));
  pass.run();
  const Figures figures = pass.figures(200);
  report(figures);
  expect_agreement(figures);
}

// Values between two multiples of 1/255 may be rounded either way; multiples of 1/255 must be exact.
TEST_F(State, ClearValuesAgree) {
  for (const ColorFormat format : {ColorFormat::rgba8, ColorFormat::srgb8a8}) {
    for (int i = 0; i <= 1020; ++i) {
      const float v = static_cast<float>(i) / 1020.0f;
      TwinPass pass({.width = 8, .height = 8, .format = format, .clear_color = glm::vec4(v, 1.0f - v, v * v, v), .clear_depth = v});
      pass.run();
      for (int k = 0; k < 4; ++k) {
        const bool whole_code = i % 4 == 0 && (k == 3 || (k < 2 && format == ColorFormat::rgba8));
        const int difference = int{pass.halfspace().color.at(3, 5)[k]} - int{pass.mesa().color.at(3, 5)[k]};
        EXPECT_LE(std::abs(difference), whole_code ? 0 : 1) << "clear value " << v << ", channel " << k;
      }
      EXPECT_EQ(pass.halfspace().depth.at(3, 5), pass.mesa().depth.at(3, 5));
    }
  }
}

// ---- polygon offset ----------------------------------------------------------------------------------------------

struct OffsetCase {
  const char* name;
  DepthOffset offset;
  friend void PrintTo(const OffsetCase& c, std::ostream* os) { *os << c.name; }
};
class OffsetOf : public MesaFixture<testing::TestWithParam<OffsetCase>> {};

// Draws the triangles, and then again in different colors with the offset. Compares where the second draw is visible, and the resulting
// depth.
TEST_P(OffsetOf, DrawsTheSameImageAndDepth) {
  const ColoredMesh mesh = make_soup(kHeap, kStateWidth, kStateHeight);
  TwinPass pass(kTarget);
  pass.draw(OneColor{glm::vec4(1.0f)}, mesh.positions(), mesh.indices);
  pass.draw(SmoothColor{}, mesh.positions_and_colors(), mesh.indices, state_with([](DrawState& s) { s.offset = GetParam().offset; }));
  pass.run();
  const Figures figures = pass.figures(0);
  report(figures);
  expect_agreement(figures);
  EXPECT_LE(figures.depth_differs, figures.covered / 100);  // Mesa has an error of a few 1e-6 on steep triangles
}

INSTANTIATE_TEST_SUITE_P(Heap, OffsetOf,
                         testing::Values(OffsetCase{"towards_the_eye", {.slope = -1.0f, .constant = -16.0f}},
                                         OffsetCase{"away_from_the_eye", {.slope = 1.0f, .constant = 16.0f}},
                                         OffsetCase{"constant_alone", {.constant = -1000.0f}}, OffsetCase{"slope_alone", {.slope = -2.0f}},
                                         OffsetCase{"clamped_from_below", {.slope = -3.0f, .constant = -100.0f, .clamp = -0.005f}},
                                         OffsetCase{"clamped_from_above", {.slope = 3.0f, .clamp = 0.005f}}),
                         case_name);

// ---- blending ----------------------------------------------------------------------------------------------------

struct BlendCase {
  const char* name;
  BlendState blend;
  friend void PrintTo(const BlendCase& c, std::ostream* os) { *os << c.name; }
};
class BlendOf : public MesaFixture<testing::TestWithParam<BlendCase>> {
 protected:
  static DrawState state() {
    return state_with([](DrawState& s) {
      s.depth.test = false;
      s.depth.write = false;
      s.blend = GetParam().blend;
    });
  }
};

TEST_P(BlendOf, OneLayerOverAnImage) {
  const ColoredMesh picture = make_sheet(7, 5, 0.3f, 1), layer = make_sheet(9, 8, 0.3f, 2, 0.6f);
  TwinPass pass(kTarget);
  pass.draw(SmoothColor{}, picture.positions_and_colors(), picture.indices);
  pass.draw(SmoothColor{}, layer.positions_and_colors(), layer.indices, state());
  pass.run();
  const Figures figures = pass.figures(200);
  report(figures);
  expect_agreement(figures);
}

// About twenty layers, each rounded to 8 bits. Halfspace blends a layer in float. Mesa uses 8-bit colors and factors.
TEST_P(BlendOf, ManyLayers) {
  ColoredMesh mesh = make_soup(kHeap, kStateWidth, kStateHeight);
  for (std::size_t i = 0; i < mesh.colors.size(); ++i) mesh.colors[i].w = 0.2f + 0.1f * static_cast<float>(i % 6);
  TargetSpec target = kTarget;
  target.clear_color = {0.6f, 0.7f, 0.8f, 0.0f};
  TwinPass pass(target);
  pass.draw(SmoothColor{}, mesh.positions_and_colors(), mesh.indices, state());
  pass.run();
  const Figures figures = pass.figures(200);
  report(figures);
  expect_halfspace_right(figures, "blends 8-bit colors in integers, so rounding errors accumulate from layer to layer");
}

namespace {

std::vector<BlendCase> blend_cases() {
  using F = BlendFactor;
  using E = BlendEquation;
  const auto same = [](E e, F s, F d) { return BlendState{e, s, d, e, s, d}; };
  return {{"alpha_over", {}},
          {"additive", same(E::add, F::one, F::one)},
          {"additive_by_alpha", {E::add, F::src_alpha, F::one, E::add, F::one, F::one}},
          {"premultiplied", same(E::add, F::one, F::one_minus_src_alpha)},
          {"multiply", {E::add, F::dst_color, F::zero, E::add, F::one, F::one}},
          {"screen", {E::add, F::one_minus_dst_color, F::one, E::add, F::one, F::one}},
          {"source_color", {E::add, F::src_color, F::one_minus_src_color, E::add, F::one, F::one}},
          {"subtract", {E::subtract, F::one, F::src_alpha, E::max, F::one, F::one}},
          {"reverse_subtract", {E::reverse_subtract, F::src_alpha, F::one, E::max, F::one, F::one}},
          {"min", {E::min, F::one, F::one, E::max, F::one, F::one}},
          {"max", {E::max, F::one, F::one, E::max, F::one, F::one}},
          {"constant_color", {E::add, F::constant_color, F::one_minus_constant_color, E::add, F::one, F::one, {0.25f, 0.5f, 0.75f, 0.5f}}},
          {"constant_alpha", {E::add, F::constant_alpha, F::one_minus_constant_alpha, E::add, F::one, F::one, {0.0f, 0.0f, 0.0f, 0.375f}}},
          {"saturate", {E::add, F::src_alpha_saturate, F::one, E::add, F::src_alpha_saturate, F::one}},
          {"destination_alpha", {E::add, F::one_minus_dst_alpha, F::dst_alpha, E::add, F::one, F::one}}};
}

}  // namespace

INSTANTIATE_TEST_SUITE_P(By, BlendOf, testing::ValuesIn(blend_cases()), case_name);

}  // namespace halfspace::test
