// SPDX-License-Identifier: Apache-2.0
//
// Cases of conditional rendering, after the group conditional_render_inverted of VK-GL-CTS (KHR-GL45). All rectangles consist of whole
// pixels, so the truth follows from whether samples pass.
#include <array>
#include <optional>
#include <utility>

#include "conformance/geometry.h"
#include "conformance/groups.h"

namespace halfspace::conformance {

namespace {

constexpr glm::dvec4 kWall{0, 0, 16, 14};  // x0, y0, x1, y1
constexpr glm::dvec4 kTested{4, 18, 12, 28}, kBehindTheWall{3, 3, 12, 11};
constexpr glm::dvec4 kConditional{18, 4, 30, 28};

// What happens to the draw with the query.
enum class Fate : uint8_t {
  passes,
  passes_for_one_pixel,
  writes_no_color,
  hidden,
  fails_stencil,
  culled,
  scissored,
  discarded,
  outside,
  masked,
  fails_depth_bounds
};
struct NamedFate {
  const char* name;
  Fate fate;
  bool passes = false;
};
constexpr NamedFate kFates[] = {{"passes", Fate::passes, true},
                                {"passes_for_one_pixel", Fate::passes_for_one_pixel, true},
                                {"writes_no_color", Fate::writes_no_color, true},
                                {"hidden", Fate::hidden},
                                {"fails_stencil", Fate::fails_stencil},
                                {"culled", Fate::culled},
                                {"scissored", Fate::scissored},
                                {"discarded", Fate::discarded},
                                {"outside", Fate::outside},
                                {"masked", Fate::masked},
                                {"fails_depth_bounds", Fate::fails_depth_bounds}};

Drawing rectangle(const Picture& p, const glm::dvec4& r, int color, float z_ndc) {
  Drawing d;
  d.mode = kFlat;
  add_rectangle(d, p, r, color_number(color), z_ndc);
  return d;
}

Drawing tested(const Picture& p, Fate fate, uint32_t query) {
  glm::dvec4 r = kTested;
  if (fate == Fate::hidden) r = kBehindTheWall;
  if (fate == Fate::outside) r = {40, 4, 50, 12};
  if (fate == Fate::passes_for_one_pixel) r = {7, 20, 8, 21};
  Drawing d = rectangle(p, r, 2, 0.25f);
  DrawState& s = d.state;
  s.query = query;
  if (fate == Fate::writes_no_color) s.color_mask = {false, false, false, false};
  if (fate == Fate::fails_stencil) s.stencil.emplace().front.compare = CompareOp::never;
  if (fate == Fate::culled) s.cull = CullMode::front;
  if (fate == Fate::scissored) s.scissor = Rect{0, 0, 3, 32};
  if (fate == Fate::masked) s.sample_mask = 0;
  if (fate == Fate::fails_depth_bounds) s.depth_bounds = StoredDepthRange{0.0f, 0.5f};  // the stored depth is 1
  if (fate == Fate::discarded) {
    d.kind = Kind::cutout;
    d.value = 2.0f;
  }
  return d;
}

// The rectangles that must be visible, from the first to the last, in one color each.
struct Visible {
  glm::dvec4 place;
  int color;
};

std::string shows(const Seen& seen, const std::vector<Visible>& rectangles) {
  return for_each_pixel(seen, [&](int x, int y) {
    glm::dvec4 expected(0.0);
    for (const auto& [r, color] : rectangles) {
      if (x >= r.x && x < r.z && y >= r.y && y < r.w) expected = glm::dvec4(color_number(color));
    }
    return expect_near(expected, seen.color(x, y), 0.0);
  });
}

Picture with_wall(int samples) {
  Picture p;
  p.samples = samples;
  p.colors = {ColorFormat::rgba32f};
  p.draws.push_back(rectangle(p, kWall, 1, -0.5f));
  return p;
}

std::optional<Visible> visible_part(Fate fate) {
  if (fate == Fate::passes) return Visible{kTested, 2};
  if (fate == Fate::passes_for_one_pixel) return Visible{{7, 20, 8, 21}, 2};
  return std::nullopt;
}

// A draw with the query, and one that depends on it.
Case on_one_query(const NamedFate& f, bool inverted, int samples) {
  const auto [name, fate, passes] = f;
  const bool draws = passes != inverted;
  return {std::string(inverted ? "inverted_" : "functional_") + name + (samples == 1 ? "" : "_multisample"),
          [=, fate = fate] {
            Picture p = with_wall(samples);
            p.draws.push_back(tested(p, fate, 1));
            p.draws.push_back(rectangle(p, kConditional, 3, 0.0f));
            p.draws.back().state.condition = DrawCondition{1, inverted};
            return p;
          },
          [=, fate = fate](const Picture&, const Seen& seen) {
            std::vector<Visible> rectangles{{kWall, 1}};
            if (const auto part = visible_part(fate)) rectangles.push_back(*part);
            if (draws) rectangles.push_back({kConditional, 3});
            return shows(seen, rectangles);
          },
          false, fate == Fate::fails_depth_bounds ? "OpenGL has no depth bounds" : nullptr};
}

// A draw that depends on a draw that depends on a query.
Case on_conditional_draw(bool passes, bool first_inverted, bool second_inverted) {
  const bool draws_first = passes != first_inverted, draws_second = draws_first != second_inverted;
  return {std::string("chain_") + (passes ? "passes" : "hidden") + (first_inverted ? "_inverted" : "_plain") +
              (second_inverted ? "_inverted" : "_plain"),
          [=] {
            Picture p = with_wall(1);
            p.draws.push_back(tested(p, passes ? Fate::writes_no_color : Fate::hidden, 0));
            p.draws.push_back(rectangle(p, kTested, 3, 0.0f));
            p.draws.back().state.condition = DrawCondition{0, first_inverted};
            p.draws.back().state.query = 1;
            p.draws.push_back(rectangle(p, kConditional, 4, 0.0f));
            p.draws.back().state.condition = DrawCondition{1, second_inverted};
            return p;
          },
          [=](const Picture&, const Seen& seen) {
            std::vector<Visible> rectangles{{kWall, 1}};
            // With the depth of the tested rectangle behind it.
            if (draws_first) rectangles.push_back({kTested, 3});
            if (draws_second) rectangles.push_back({kConditional, 4});
            return shows(seen, rectangles);
          }};
}

// Several draws share a query; draws that come later and queries without draws have no effect.
Case on_shared_query(const char* name, std::vector<Fate> before, std::vector<Fate> after, bool passes) {
  return {std::string("shared_") + name,
          [=] {
            Picture p = with_wall(1);
            for (const Fate fate : before) p.draws.push_back(tested(p, fate, 2));
            p.draws.push_back(rectangle(p, kConditional, 3, 0.0f));
            p.draws.back().state.condition = DrawCondition{2};
            for (const Fate fate : after) p.draws.push_back(tested(p, fate, 2));
            return p;
          },
          [=](const Picture&, const Seen& seen) {
            std::vector<Visible> rectangles{{kWall, 1}};
            if (passes) rectangles.push_back({kConditional, 3});
            for (const std::vector<Fate>& fates : {before, after}) {
              for (const Fate fate : fates) {
                if (const auto part = visible_part(fate)) rectangles.push_back(*part);
              }
            }
            return shows(seen, rectangles);
          },
          false, "a query of OpenGL counts the draws of one scope"};
}

// A draw that is not drawn leaves the depth and the stencil as they are: a rectangle behind it shows where it is not.
Case leaves_the_buffers(bool draws, bool by_stencil, int samples) {
  return {std::string(by_stencil ? "stencil_" : "depth_") + (draws ? "is_written" : "is_kept") + (samples == 1 ? "" : "_multisample"),
          [=] {
            Picture p = with_wall(samples);
            p.draws.push_back(tested(p, Fate::writes_no_color, 0));
            Drawing mask = rectangle(p, kConditional, 3, -0.25f);
            mask.state.condition = DrawCondition{0, !draws};
            mask.state.color_mask = {false, false, false, false};
            Drawing behind = rectangle(p, {16, 0, 32, 32}, 4, 0.5f);
            if (by_stencil) {
              mask.state.depth.write = false;
              mask.state.stencil.emplace().front = {.pass = StencilOp::replace, .reference = 1};
              behind.state.stencil.emplace().front = {.compare = CompareOp::equal, .reference = 0};
            }
            p.draws.push_back(std::move(mask));
            p.draws.push_back(std::move(behind));
            return p;
          },
          [=](const Picture&, const Seen& seen) {
            const std::string wrong = for_each_pixel(seen, [&](int x, int y) {
              const bool is_wall = x < 16 && y < 14, is_masked = draws && x >= 18 && x < 30 && y >= 4 && y < 28;
              const glm::vec4 expected = is_wall ? color_number(1) : x >= 16 && !is_masked ? color_number(4) : glm::vec4(0.0f);
              return expect_near(glm::dvec4(expected), seen.color(x, y), 0.0);
            });
            return wrong;
          }};
}

// Conditional draws of other primitives and with the stages that emit primitives: the picture is that of the draws that are drawn.
Case of_kind(const char* name, const Drawing& drawing, bool passes) {
  return {std::string(name) + (passes ? "_drawn" : "_dropped"),
          [=] {
            Picture p = with_wall(1);
            p.draws.push_back(tested(p, passes ? Fate::passes : Fate::hidden, 0));
            p.draws.push_back(drawing);
            p.draws.back().state.condition = DrawCondition{0};
            return p;
          },
          [=](const Picture& p, const Seen& seen) {
            Picture plain = p;
            plain.draws.back().state.condition.reset();
            if (!passes) plain.draws.pop_back();
            const Seen expected = draw(plain);
            return for_each_pixel(seen, [&](int x, int y) { return expect_near(glm::dvec4(expected.color(x, y)), seen.color(x, y), 0.0); });
          }};
}

std::vector<std::pair<const char*, Drawing>> drawings() {
  const Picture p;
  Drawing plain;
  plain.mode = kFlat;
  plain.vertices = scattered(p, 12, 17);
  std::vector<std::pair<const char*, Drawing>> out;
  const auto add = [&](const char* name, Topology topology, auto change) {
    Drawing d = plain;
    d.state.topology = topology;
    change(d);
    out.emplace_back(name, std::move(d));
  };
  const auto nothing = [](Drawing&) {};
  add("points", Topology::points, [](Drawing& d) { d.state.point_size = 5.0f; });
  add("line_strip", Topology::line_strip, nothing);
  add("triangle_strip", Topology::triangle_strip, nothing);
  add("outlines", Topology::triangles, [](Drawing& d) { d.state.polygon_mode = PolygonMode::line; });
  add("instanced", Topology::triangles, [](Drawing& d) {
    d.kind = Kind::instance;
    d.value = 0.125f;
    d.state.instances = 3;
    for (Vertex& v : d.vertices) v.extra = glm::vec4(0.0f);
  });
  add("blended", Topology::triangles, [](Drawing& d) { d.state.blend = kAdd; });
  add("geometry", Topology::triangles, [](Drawing& d) {
    d.kind = Kind::geometry;
    d.mode = kWhole;
    d.geometry = {GeometryInputPrimitive::triangles, GeometryOutputPrimitive::line_strip, 18, 1};
  });
  add("tessellation", Topology::patches, [](Drawing& d) {
    d.kind = Kind::tessellation;
    d.mode = kPerEdge;
    d.value = 3.0f;
    d.tessellation = {.patch_vertices = 3, .domain = TessellationDomain::triangles};
  });
  return out;
}

}  // namespace

Cases conditional_rendering_cases() {
  Cases cases;
  for (const NamedFate& f : kFates) {
    for (const bool inverted : {false, true}) {
      for (const int samples : {1, 4}) {
        if (f.fate != Fate::masked || samples > 1) cases.push_back(on_one_query(f, inverted, samples));
      }
    }
  }
  for (const bool passes : {true, false}) {
    for (const bool first : {true, false}) {
      for (const bool second : {true, false}) cases.push_back(on_conditional_draw(passes, first, second));
    }
  }
  cases.push_back(on_shared_query("none_passes", {Fate::hidden, Fate::outside}, {}, false));
  cases.push_back(on_shared_query("first_passes", {Fate::passes, Fate::hidden}, {}, true));
  cases.push_back(on_shared_query("last_passes", {Fate::culled, Fate::passes_for_one_pixel}, {}, true));
  cases.push_back(on_shared_query("later_draw_passes", {Fate::hidden}, {Fate::passes}, false));
  cases.push_back(on_shared_query("no_draw_before", {}, {Fate::passes}, false));
  for (const bool draws : {true, false}) {
    for (const bool by_stencil : {true, false}) {
      for (const int samples : {1, 4}) cases.push_back(leaves_the_buffers(draws, by_stencil, samples));
    }
  }
  for (const auto& [name, drawing] : drawings()) {
    for (const bool passes : {true, false}) cases.push_back(of_kind(name, drawing, passes));
  }
  return cases;
}

}  // namespace halfspace::conformance
