// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "conformance/geometry.h"
#include "conformance/groups.h"

namespace halfspace::conformance {

namespace {

// ---- scissor -------------------------------------------------------------------------------------------------------

constexpr std::pair<const char*, Topology> kPrimitives[] = {
    {"triangles", Topology::triangles}, {"lines", Topology::lines}, {"points", Topology::points}};
constexpr std::pair<const char*, Rect> kScissors[] = {{"inside", {5, 7, 12, 9}},
                                                      {"across_the_left", {-8, 4, 20, 20}},
                                                      {"across_the_top", {3, 20, 25, 40}},
                                                      {"one_pixel", {15, 16, 1, 1}},
                                                      {"empty", {9, 9, 0, 5}},
                                                      {"outside", {40, 3, 10, 10}},
                                                      {"whole", {0, 0, 32, 32}}};

Picture scissored(Topology topology, const Rect& scissor) {
  Picture p;
  Drawing d;
  d.state.topology = topology;
  d.state.point_size = 6.0f;
  d.state.scissor = scissor;
  d.state.depth.test = false;
  d.mode = kFlat;
  d.vertices = scattered(p, 60, 3);
  p.draws.push_back(std::move(d));
  return p;
}

// Inside the scissor rectangle, the picture must equal the one without it. Nothing may be drawn outside.
std::string scissor_cuts(const Picture& p, const Seen& seen) {
  Picture whole = p;
  whole.draws[0].state.scissor.reset();
  const Seen all = draw(whole);
  const Rect r = *p.draws[0].state.scissor;
  return for_each_pixel(seen, [&](int x, int y) {
    const bool in = x >= r.x && x < r.x + r.width && y >= r.y && y < r.y + r.height;
    return expect_near(glm::dvec4(in ? all.color(x, y) : p.clear_color), seen.color(x, y), 0.0);
  });
}

// ---- interaction ---------------------------------------------------------------------------------------------------

constexpr std::pair<const char*, Kind> kKinds[] = {{"color", Kind::color},      {"clip", Kind::clip},   {"cutout", Kind::cutout},
                                                   {"depth", Kind::depth},      {"point", Kind::point}, {"derivative", Kind::derivative},
                                                   {"instance", Kind::instance}};

// Draws random triangles of all colors, and then the shader with a state that combines several operations.
void several_operations(int number, DrawState& s, Picture& p) {
  const StencilFace counting{.pass = StencilOp::increment_wrap};
  const StencilFace if_even{.compare = CompareOp::equal, .reference = 0, .read_mask = 1};
  switch (number) {
    case 0:
      s.blend.emplace();
      s.stencil = StencilState{if_even, if_even};
      p.draws[0].state.stencil = StencilState{counting, counting};
      break;
    case 1:
      s.depth.compare = CompareOp::greater;
      s.offset = {.slope = -1.0f, .constant = -2.0f};
      s.color_mask = {true, false, true, true};
      s.scissor = Rect{3, 2, 25, 21};
      break;
    case 2:
      p.samples = 4;
      s.blend = kAdd;
      s.blend->source_color = BlendFactor::dst_alpha;
      break;
    case 3:
      p.samples = 4;
      s.alpha_to_coverage = true;
      s.sample_mask = 0xb;
      s.stencil = StencilState{if_even, counting};
      break;
    default:
      p.depth = DepthFormat::d24s8;
      p.colors = {ColorFormat::srgb8a8};
      s.depth.range_near = 0.9f;
      s.depth.range_far = 0.2f;
      s.depth.compare = CompareOp::greater_equal;
      s.cull = CullMode::back;
      s.viewport = Rect{4, 6, 32, 16};
      s.blend.emplace();
      break;
  }
}

Picture interaction(Kind kind, int number) {
  Picture p;
  Drawing heap, d;
  heap.vertices = scattered(p, 30, 8);
  d.kind = kind;
  d.value = kind == Kind::instance ? 0.25f : kind == Kind::derivative ? 8.0f : 0.4f;
  d.vertices = scattered(p, 36, 21, true);
  for (std::size_t i = 0; i < d.vertices.size(); ++i) {
    d.vertices[i].extra = color_number(static_cast<int>(i) + 50) - (kind == Kind::clip ? glm::vec4(0.3f) : glm::vec4(0.0f));
    if (kind == Kind::point) d.vertices[i].extra.x *= 12.0f;
  }
  if (kind == Kind::point) d.state.topology = Topology::points;
  if (kind == Kind::instance) d.state.instances = 3;
  p.draws = {std::move(heap), std::move(d)};
  several_operations(number, p.draws[1].state, p);
  return p;
}

// ---- polygon offset ------------------------------------------------------------------------------------------------

struct Format {
  const char* name;
  DepthFormat format;
};
constexpr Format kFormats[] = {
    {"fixed16", DepthFormat::d16}, {"fixed24", DepthFormat::d24}, {"float32", DepthFormat::d32f}, {"fixed24_stencil8", DepthFormat::d24s8}};

// Draws a rectangle over the window with a window depth from `left` to `right`.
Picture offset_picture(DepthFormat format, float left, float right, const DepthOffset& offset) {
  Picture p;
  p.depth = format;
  Drawing d;
  d.state.offset = offset;
  add_quad(d, {Vertex{clip_at(p, 0, 0, 2 * left - 1), color_number(1)},
               {clip_at(p, 32, 0, 2 * right - 1), color_number(2)},
               {clip_at(p, 32, 32, 2 * right - 1), color_number(3)},
               {clip_at(p, 0, 32, 2 * left - 1), color_number(4)}});
  p.draws.push_back(std::move(d));
  return p;
}

// o = slope·m + constant·r (OpenGL 4.6, section 14.6.5), clamped. All depths have the same exponent, so r is constant.
std::string offset_formula(const Picture& p, const Seen& seen) {
  const Drawing& d = p.draws[0];
  const double left = 0.5 * static_cast<double>(d.vertices[0].pos_clip.z) + 0.5,
               right = 0.5 * static_cast<double>(d.vertices[1].pos_clip.z) + 0.5;
  const bool is_float = p.depth == DepthFormat::d32f;
  const double codes = p.depth == DepthFormat::d16 ? 65535.0 : 16777215.0;
  const double r = is_float ? std::ldexp(1.0, std::ilogb(std::fmax(left, right)) - 23) : 1.0 / codes;
  const DepthOffset& o = d.state.offset;
  double by = static_cast<double>(o.slope) * std::fabs(right - left) / 32.0 + static_cast<double>(o.constant) * r;
  if (o.clamp > 0.0f) by = std::fmin(by, static_cast<double>(o.clamp));
  if (o.clamp < 0.0f) by = std::fmax(by, static_cast<double>(o.clamp));
  return for_each_pixel(seen, [&](int x, int y) -> std::string {
    const double z = std::fmin(std::fmax(left + (right - left) * (x + 0.5) / 32.0 + by, 0.0), 1.0);
    const double expected = is_float ? z : z * codes, got = seen.depth(x, y);
    // Fixed point: rounding by half an LSB (for 24 bits, the float adds another half). Float: two roundings of 2^-24.
    const double tolerance = is_float ? 0x1p-23 : codes > 65535.0 ? 1.5 : 0.51;
    return std::fabs(got - expected) <= tolerance ? "" : "depth " + std::to_string(got) + ", expected " + std::to_string(expected);
  });
}

// Draws the rectangle again with an offset and another color. It must be visible if the offset is toward the eye.
Case rendered(const std::string& name, DepthFormat format, float slope, float constant) {
  const bool shown = slope + constant < 0.0f;
  return {name,
          [=] {
            Picture p = offset_picture(format, 0.55f, 0.7f, {});
            p.draws.push_back(p.draws[0]);
            for (Vertex& v : p.draws[1].vertices) v.color = glm::vec4(0.0f, 0.0f, 1.0f, 1.0f);
            p.draws[1].state.offset = {.slope = slope, .constant = constant};
            return p;
          },
          [=](const Picture&, const Seen& seen) {
            return for_each_pixel(seen, [&](int x, int y) -> std::string {
              const bool blue = seen.color(x, y) == glm::vec4(0.0f, 0.0f, 1.0f, 1.0f);
              return blue == shown ? "" : shown ? "the offset rectangle is not visible" : "the offset rectangle is visible";
            });
          },
          true};
}

}  // namespace

Cases scissor_cases() {
  Cases cases;
  for (const auto& [name, topology] : kPrimitives) {
    for (const auto& [where, rect] : kScissors) {
      const Topology t = topology;
      const Rect r = rect;
      cases.push_back({std::string(name) + "_" + where, [=] { return scissored(t, r); }, scissor_cuts,
                       intersect(r, {0, 0, 32, 32}).width <= 1 || r.height == 0});
    }
  }
  return cases;
}

Cases interaction_cases() {
  Cases cases;
  for (const auto& [name, kind] : kKinds) {
    for (int number = 0; number < 5; ++number) {
      const Kind k = kind;
      cases.push_back({std::string(name) + "_" + std::to_string(number), [=] { return interaction(k, number); }});
    }
  }
  return cases;
}

Cases polygon_offset_cases() {
  Cases cases;
  for (const auto& [name, format] : kFormats) {
    const std::string prefix = std::string(name) + "_";
    const DepthFormat f = format;
    const auto add = [&](const char* what, float left, float right, const DepthOffset& offset) {
      cases.push_back({prefix + what, [=] { return offset_picture(f, left, right, offset); }, offset_formula});
    };
    add("displacement_with_units", 0.625f, 0.625f, {.constant = 7.0f});
    add("displacement_with_units_back", 0.625f, 0.625f, {.constant = -7.0f});
    add("displacement_with_factor", 0.5625f, 0.875f, {.slope = 2.0f});
    add("displacement_with_both", 0.875f, 0.5625f, {.slope = -1.5f, .constant = 30.0f});
    add("clamped_from_above", 0.5625f, 0.875f, {.slope = 8.0f, .clamp = 0.01f});
    add("clamped_from_below", 0.5625f, 0.875f, {.slope = -8.0f, .clamp = -0.01f});
    add("factor_0_slope", 0.625f, 0.625f, {.slope = 1000.0f});
    cases.push_back(rendered(prefix + "render_with_units", f, 0.0f, -4.0f));
    cases.push_back(rendered(prefix + "render_with_units_behind", f, 0.0f, 4.0f));
    cases.push_back(rendered(prefix + "render_with_factor", f, -1.0f, 0.0f));
    cases.push_back(rendered(prefix + "render_with_factor_behind", f, 1.0f, 0.0f));
  }
  return cases;
}

}  // namespace halfspace::conformance
