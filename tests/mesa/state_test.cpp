// SPDX-License-Identifier: Apache-2.0
//
// The states of a draw, one by one, on a heap of triangles of every winding and depth.
#include "mesa_context.h"
#include "scenes.h"
#include "twin_pass.h"
#include "twin_shaders.h"

namespace halfspace::test {

namespace {

constexpr int kWidth = 400, kHeight = 300;
constexpr Soup kHeap{.triangles = 150, .size = 90, .w_ratio = 4, .seed = 3};

struct StateCase {
  std::string name;
  DrawState state;
  TargetSpec target{.width = kWidth, .height = kHeight};
  Soup soup = kHeap;
  bool blends = false;
  friend void PrintTo(const StateCase& c, std::ostream* os) { *os << c.name; }
};

DrawState with_depth(const DepthState& depth) {
  return state_with([&](DrawState& s) { s.depth = depth; });
}
DrawState with_cull(CullMode cull, Winding front = Winding::counter_clockwise) {
  return state_with([&](DrawState& s) {
    s.cull = cull;
    s.front = front;
  });
}
DrawState with_window(std::optional<Rect> viewport, std::optional<Rect> scissor) {
  return state_with([&](DrawState& s) {
    s.viewport = viewport;
    s.scissor = scissor;
  });
}
DrawState with_blend(const BlendState& blend) {
  DrawState s;
  s.depth.test = false;
  s.depth.write = false;
  s.blend = blend;
  return s;
}

std::vector<StateCase> cull_cases() {
  std::vector<StateCase> cases;
  const std::array<const char*, 4> names{"none", "front", "back", "front_and_back"};
  for (const CullMode cull : {CullMode::none, CullMode::front, CullMode::back})
    for (const Winding front : {Winding::counter_clockwise, Winding::clockwise})
      cases.push_back({std::string("cull_") + names[static_cast<std::size_t>(cull)] + (front == Winding::clockwise ? "_cw" : "_ccw"),
                       with_cull(cull, front)});
  return cases;
}

std::vector<StateCase> compare_cases() {
  const std::array<const char*, 8> names{"never", "less", "equal", "less_equal", "greater", "not_equal", "greater_equal", "always"};
  std::vector<StateCase> cases;
  for (std::size_t i = 1; i < names.size(); ++i) {  // `never` draws nothing: a test of its own
    if (static_cast<CompareOp>(i) == CompareOp::equal) continue;  // has a test of its own too
    StateCase c{std::string("depth_") + names[i], with_depth({.compare = static_cast<CompareOp>(i)})};
    c.target.clear_depth = 0.5f;  // every operator passes some and fails some
    cases.push_back(c);
  }
  return cases;
}

std::vector<StateCase> window_cases() {
  DepthState clamp{.clamp = true};
  Soup deep = kHeap;
  deep.crosses_near = true;
  return {{"scissor", with_window({}, Rect{37, 51, 203, 119})},
          {"scissor_beyond_the_target", with_window({}, Rect{-10, 200, 300, 400})},
          {"viewport_offset", with_window(Rect{61, 43, 211, 173}, {})},
          {"viewport_beyond_the_target", with_window(Rect{-100, -50, 700, 500}, {})},
          {"viewport_and_scissor", with_window(Rect{61, 43, 211, 173}, Rect{100, 20, 90, 300})},
          {"depth_range", with_depth({.range_near = 0.25f, .range_far = 0.75f})},
          {"depth_range_reversed", with_depth({.range_near = 0.9f, .range_far = 0.1f})},
          {"depth_clamp", with_depth(clamp), {.width = kWidth, .height = kHeight}, deep},
          {"no_depth_clamp", {}, {.width = kWidth, .height = kHeight}, deep},
          {"depth_not_written", with_depth({.write = false})},
          {"clip_zero_to_one", with_depth({.clip = ClipDepth::zero_to_one})},
          {"reversed_z", with_depth({.compare = CompareOp::greater, .clip = ClipDepth::zero_to_one}),
           {.width = kWidth, .height = kHeight, .clear_depth = 0.0f}}};
}

std::vector<StateCase> blend_cases() {
  using F = BlendFactor;
  using E = BlendEquation;
  const auto same = [](E e, F s, F d) { return BlendState{e, s, d, e, s, d}; };
  std::vector<StateCase> cases{{"blend_alpha_over", with_blend({})},
                               {"blend_additive", with_blend(same(E::add, F::one, F::one))},
                               {"blend_additive_by_alpha", with_blend({E::add, F::src_alpha, F::one, E::add, F::one, F::one})},
                               {"blend_premultiplied", with_blend(same(E::add, F::one, F::one_minus_src_alpha))},
                               {"blend_multiply", with_blend({E::add, F::dst_color, F::zero, E::add, F::one, F::one})},
                               {"blend_screen", with_blend({E::add, F::one_minus_dst_color, F::one, E::add, F::one, F::one})},
                               {"blend_reverse_subtract", with_blend({E::reverse_subtract, F::src_alpha, F::one, E::max, F::one, F::one})},
                               {"blend_min", with_blend({E::min, F::one, F::one, E::max, F::one, F::one})},
                               {"blend_max", with_blend({E::max, F::one, F::one, E::max, F::one, F::one})},
                               {"blend_destination_alpha", with_blend({E::add, F::one_minus_dst_alpha, F::dst_alpha, E::add, F::one, F::one})}};
  for (StateCase& c : cases) {
    c.target.clear_color = glm::vec4(0.6f, 0.7f, 0.8f, 0.0f);
    c.blends = true;
  }
  return cases;
}

std::vector<StateCase> all_cases() {
  std::vector<StateCase> all;
  for (const auto& some : {cull_cases(), compare_cases(), window_cases(), blend_cases()}) all.insert(all.end(), some.begin(), some.end());
  return all;
}

}  // namespace

class StateOf : public MesaFixture<testing::TestWithParam<StateCase>> {};

TEST_P(StateOf, DrawsTheSamePicture) {
  const StateCase& c = GetParam();
  ColoredMesh mesh = make_soup(c.soup, kWidth, kHeight);
  if (c.blends) {  // a see-through heap
    for (std::size_t i = 0; i < mesh.colors.size(); ++i) mesh.colors[i].w = 0.2f + 0.1f * static_cast<float>(i % 6);
  }
  TwinPass pass(c.target);
  pass.draw(SmoothColor{}, mesh.positions_and_colors(), mesh.indices, c.state);
  pass.run();
  const Figures figures = pass.figures(200);
  report(figures);
  expect_agreement(figures);
}

INSTANTIATE_TEST_SUITE_P(Heap, StateOf, testing::ValuesIn(all_cases()), case_name);

using State = MesaTest;

TEST_F(State, NothingIsDrawnByNeverAndByCullingBothFaces) {
  const ColoredMesh mesh = make_soup(kHeap, kWidth, kHeight);
  TwinPass pass;
  pass.draw(SmoothColor{}, mesh.positions_and_colors(), mesh.indices, with_depth({.compare = CompareOp::never}));
  pass.draw(SmoothColor{}, mesh.positions_and_colors(), mesh.indices, with_cull(CullMode::front_and_back));
  pass.run();
  const Figures figures = pass.figures();
  EXPECT_EQ(figures.covered, 0);
}

// The same triangles twice, the second time with EQUAL and in other colours: all of the first are replaced.
TEST_F(State, EqualReplacesWhatTheSameTrianglesDrew) {
  ColoredMesh mesh = make_soup(kHeap, kWidth, kHeight);
  TwinPass pass({.width = kWidth, .height = kHeight});
  pass.draw(OneColor{glm::vec4(1.0f)}, mesh.positions(), mesh.indices);
  pass.draw(SmoothColor{}, mesh.positions_and_colors(), mesh.indices, with_depth({.compare = CompareOp::equal}));
  pass.run();
  const Figures figures = pass.figures(200);
  report(figures);
  expect_agreement(figures);
}

TEST_F(State, ClearValues) {
  for (const ColorFormat format : {ColorFormat::rgba8, ColorFormat::srgb8a8}) {
    for (int i = 0; i <= 1020; ++i) {
      const float v = static_cast<float>(i) / 1020.0f;
      const ColoredMesh none;
      TwinPass pass({.width = 8, .height = 8, .format = format, .clear_color = glm::vec4(v, 1.0f - v, v * v, v), .clear_depth = v});
      pass.run();
      for (int k = 0; k < 4; ++k) {
        const int ours = pass.halfspace().color.at(3, 5)[k], mesa = pass.mesa().color.at(3, 5)[k];
        EXPECT_LE(std::abs(ours - mesa), i % 4 == 0 && k != 2 && format == ColorFormat::rgba8 ? 0 : 1) << "clear value " << v << ", channel " << k;
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

// The heap, and the same heap pushed by the offset: where the second shows, and which depth it leaves.
TEST_P(OffsetOf, DrawsTheSamePictureAndDepth) {
  Soup soup = kHeap;
  soup.w_ratio = 1;
  const ColoredMesh mesh = make_soup(soup, kWidth, kHeight);
  TwinPass pass({.width = kWidth, .height = kHeight});
  pass.draw(OneColor{glm::vec4(1.0f)}, mesh.positions(), mesh.indices);
  DrawState state;
  state.offset = GetParam().offset;
  pass.draw(SmoothColor{}, mesh.positions_and_colors(), mesh.indices, state);
  pass.run();
  const Figures figures = pass.figures();
  report(figures);
  expect_agreement(figures);
}

INSTANTIATE_TEST_SUITE_P(Heap, OffsetOf,
                         testing::Values(OffsetCase{"towards_the_eye", {.slope = -1.0f, .constant = -16.0f}},
                                         OffsetCase{"away_from_the_eye", {.slope = 1.0f, .constant = 16.0f}},
                                         OffsetCase{"constant_alone", {.constant = -1000.0f}}, OffsetCase{"slope_alone", {.slope = -2.0f}},
                                         OffsetCase{"clamped_from_below", {.slope = -3.0f, .constant = -100.0f, .clamp = -0.005f}},
                                         OffsetCase{"clamped_from_above", {.slope = 3.0f, .clamp = 0.005f}}),
                         case_name);

}  // namespace halfspace::test
