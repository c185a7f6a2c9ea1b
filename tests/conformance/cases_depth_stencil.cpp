// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "conformance/geometry.h"
#include "conformance/groups.h"

namespace halfspace::conformance {

namespace {

constexpr const char* kCompareNames[] = {"never", "less", "equal", "less_equal", "greater", "not_equal", "greater_equal", "always"};
constexpr const char* kOpNames[] = {"keep",   "zero",           "replace",       "increment_clamp", "decrement_clamp",
                                    "invert", "increment_wrap", "decrement_wrap"};
// The initial stencil value of each strip and the initial depth of each row. The tested draw has the depth of row 2.
constexpr std::array<uint8_t, 8> kStencils{0, 1, 5, 0x7f, 0x80, 0xa5, 0xfe, 0xff};
constexpr std::array<float, 4> kDepths{0.25f, 0.5f, 0.625f, 0.75f};
constexpr float kDrawn = 0.625f;
constexpr int kSize = 16;

float ndc(float window_depth) { return 2.0f * window_depth - 1.0f; }

// Draws vertical strips of stencil values and rows of depths, and then rectangles with the tested state. Every other column of the
// rectangles is back-facing.
Picture cells(DepthFormat format, const DrawState& state) {
  Picture p;
  p.width = p.height = kSize;
  p.depth = format;
  for (int i = 0; i < 4; ++i) {
    Drawing depths;
    depths.state.depth.compare = CompareOp::always;
    add_rectangle(depths, p, {0, 4.0 * i, kSize, 4.0 * i + 4}, color_number(i), ndc(kDepths[static_cast<std::size_t>(i)]));
    p.draws.push_back(std::move(depths));
  }
  for (int i = 0; i < 8 && state.stencil; ++i) {
    Drawing strip;
    strip.state.depth.test = false;
    strip.state.color_mask = {false, false, false, false};
    const StencilFace replace{.pass = StencilOp::replace, .reference = kStencils[static_cast<std::size_t>(i)]};
    strip.state.stencil = StencilState{replace, replace};
    add_rectangle(strip, p, {2.0 * i, 0, 2.0 * i + 2, kSize}, glm::vec4(1.0f));
    p.draws.push_back(std::move(strip));
  }
  Drawing d;
  d.state = state;
  for (const bool back : {true, false}) {  // columns 0, 2, 4, … are back-facing
    for (int x = back ? 0 : 1; x < kSize; x += 2) {
      add_rectangle(d, p, {static_cast<double>(x), 0, x + 1.0, kSize}, color_number(9), ndc(kDrawn));
      if (back) std::swap(d.indices[d.indices.size() - 5], d.indices[d.indices.size() - 4]);
      if (back) std::swap(d.indices[d.indices.size() - 2], d.indices[d.indices.size() - 1]);
    }
  }
  p.draws.push_back(std::move(d));
  return p;
}

bool compares(CompareOp op, double a, double b) {
  const std::array<bool, 8> results{false, a<b, a == b, a <= b, a> b, a != b, a >= b, true};
  return results[static_cast<std::size_t>(op)];
}
int after(StencilOp op, int value, int reference) {
  const std::array<int, 8> results{
      value, 0, reference, std::min(value + 1, 255), std::max(value - 1, 0), 255 - value, (value + 1) % 256, (value + 255) % 256};
  return results[static_cast<std::size_t>(op)];
}
double as_stored(DepthFormat format, float z) {
  const bool code = depth_part(format) == DepthFormat::d24 || format == DepthFormat::d16;
  const double max_code = format == DepthFormat::d16 ? 65535.0 : 16777215.0;
  return code ? std::floor(static_cast<double>(z) * max_code + 0.5) : static_cast<double>(z);
}

// Evaluates OpenGL 4.6, sections 17.3.3 and 17.3.4, for each cell.
std::string tests_by_hand(const Picture& p, const Seen& seen) {
  const DrawState& state = p.draws.back().state;
  return for_each_pixel(seen, [&](int x, int y) -> std::string {
    const float stored = kDepths[static_cast<std::size_t>(y / 4)];
    double depth = as_stored(p.depth, stored);
    glm::vec4 color = color_number(y / 4);
    bool passes = !state.depth.test || compares(state.depth.compare, as_stored(p.depth, kDrawn), depth);
    if (state.stencil) {
      const StencilFace& f = x % 2 == 0 ? state.stencil->back : state.stencil->front;
      const int value = kStencils[static_cast<std::size_t>(x / 2)];
      const bool stencil_passes = compares(f.compare, f.reference & f.read_mask, value & f.read_mask);
      const int result = after(!stencil_passes ? f.fail : passes ? f.pass : f.depth_fail, value, f.reference);
      const int expected = (value & ~f.write_mask) | (result & f.write_mask);
      passes = passes && stencil_passes;
      if (seen.stencil(x, y) != expected) return "stencil " + std::to_string(seen.stencil(x, y)) + ", expected " + std::to_string(expected);
    }
    if (passes) {
      color = color_number(9);
      if (state.depth.test && state.depth.write) depth = as_stored(p.depth, kDrawn);
    }
    if (seen.depth(x, y) != depth) return "depth " + std::to_string(seen.depth(x, y)) + ", expected " + std::to_string(depth);
    return expect_near(glm::dvec4(color), seen.color(x, y), kHalfCode);
  });
}

Case state_case(std::string name, DepthFormat format, const DrawState& state) {
  const bool all_pass = !state.stencil && (!state.depth.test || state.depth.compare == CompareOp::always);
  return {std::move(name), [=] { return cells(format, state); }, tests_by_hand, all_pass};
}

StencilOp op_number(int i) { return static_cast<StencilOp>(i % 8); }
CompareOp compare_number(int i) { return static_cast<CompareOp>(i % 8); }

// Adds every pair of stencil and depth comparisons twice. The operations are rotated so that each occurs in every role.
void add_both(Cases& cases) {
  for (int i = 0; i < 128; ++i) {
    const int stencil = i % 8, depth = i / 8 % 8;
    DrawState s;
    s.depth.compare = compare_number(depth);
    s.stencil.emplace();
    s.stencil->front = {compare_number(stencil), op_number(i), op_number(i / 8 + 3), op_number(i / 16 + i), 5, 0xff, 0xff};
    s.stencil->back = {compare_number(stencil + depth),
                       op_number(i + 5),
                       op_number(i + 2),
                       op_number(i / 8),
                       static_cast<uint8_t>(i % 2 == 0 ? 0x80 : 0xa5),
                       static_cast<uint8_t>(i % 3 == 0 ? 0x0f : 0xff),
                       static_cast<uint8_t>(i % 5 == 0 ? 0x3c : 0xff)};
    cases.push_back(state_case("stencil_" + std::string(kCompareNames[stencil]) + "_depth_" + kCompareNames[depth] + (i < 64 ? "_a" : "_b"),
                               i % 2 == 0 ? DepthFormat::d24s8 : DepthFormat::d32fs8, s));
  }
}

// Adds each operation separately in each of the three roles.
void add_operations(Cases& cases) {
  for (int op = 0; op < 8; ++op) {
    const std::string name = kOpNames[op];
    DrawState fail, depth_fail, pass;
    const StencilFace never{.compare = CompareOp::never, .fail = op_number(op), .reference = 0x42};
    const StencilFace blocked{.depth_fail = op_number(op), .reference = 0x42}, free{.pass = op_number(op), .reference = 0x42};
    fail.stencil = StencilState{never, never};
    depth_fail.stencil = StencilState{blocked, blocked};
    depth_fail.depth.compare = CompareOp::never;
    pass.stencil = StencilState{free, free};
    cases.push_back(state_case("stencil_fail_" + name, DepthFormat::d24s8, fail));
    cases.push_back(state_case("depth_fail_" + name, DepthFormat::d32fs8, depth_fail));
    cases.push_back(state_case("pass_" + name, DepthFormat::d24s8, pass));
  }
}

// Adds cases for the depth test alone: every comparison in every format, with and without depth writes.
void add_depth(Cases& cases) {
  constexpr std::pair<DepthFormat, const char*> kFormats[] = {
      {DepthFormat::d16, "d16"}, {DepthFormat::d24, "d24"}, {DepthFormat::d32f, "d32f"}, {DepthFormat::d24s8, "d24s8"}};
  for (const auto& [format, format_name] : kFormats) {
    for (int i = 0; i < 8; ++i) {
      DrawState s;
      s.depth.compare = compare_number(i);
      s.depth.write = (i + static_cast<int>(format)) % 3 != 0;
      const DepthFormat f = format;
      cases.push_back(
          state_case("depth_" + std::string(kCompareNames[i]) + "_" + format_name + (s.depth.write ? "" : "_not_written"), f, s));
    }
  }
  DrawState off;
  off.depth.test = false;
  cases.push_back(state_case("depth_off_writes_nothing", DepthFormat::d32f, off));
}

}  // namespace

Cases depth_stencil_cases() {
  Cases cases;
  add_both(cases);
  add_operations(cases);
  add_depth(cases);
  return cases;
}

}  // namespace halfspace::conformance
