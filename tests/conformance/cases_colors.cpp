// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "conformance/geometry.h"
#include "conformance/groups.h"
#include "conformance/topologies.h"
#include "halfspace/core/trig_double.h"

namespace halfspace::conformance {

namespace {

// Adjacent triangles or lines with different colors.
Picture colored(const Named& kind, bool projected, ColorMode mode, int samples = 1) {
  Picture p;
  p.samples = samples;
  Drawing d;
  d.mode = mode;
  d.state.topology = kind.topology;
  d.state.line_width = kind.width;
  d.vertices = kind.topology == Topology::triangles ? zigzag(p, 9, projected) : zigzag(p, 7, projected);
  if (kind.topology == Topology::triangle_fan) {  // around a first vertex at the bottom
    d.vertices.assign(1, {clip_at(p, 16, 1, 0.0f, projected ? 2.0f : 1.0f), color_number(20)});
    for (int i = 0; i < 6; ++i) {
      const double angle = 0.3 + 0.5 * i;
      const double x = std::round((16 + 14 * sincos_radians(angle).cos) * 256) / 256,
                   y = std::round((2 + 27 * sincos_radians(angle).sin) * 256) / 256;
      d.vertices.push_back({clip_at(p, x, y, 0.0f, projected && i % 2 == 0 ? 0.5f : 1.0f), color_number(i)});
    }
  }
  if (is_lines(kind.topology) && kind.topology != Topology::line_strip) d.vertices.pop_back();
  p.draws.push_back(std::move(d));
  return p;
}

// Inside exactly one triangle, a pixel must have its interpolated color. Culled triangles must not be drawn.
std::string triangle_colors(const Picture& p, const Seen& seen) {
  const Drawing& d = p.draws[0];
  struct Shown {
    Weighed triangle;
    std::array<glm::vec4, 3> colors;
  };
  std::vector<Shown> shown;
  for (const Assembled& a : assembled(d)) {
    std::array<glm::vec4, 3> at, colors;
    std::array<glm::dvec2, 3> w;
    for (std::size_t k = 0; k < 3; ++k) {
      at[k] = d.vertices[a.vertex[k]].pos_clip;
      w[k] = window_of(p, at[k]);
      colors[k] = d.vertices[d.mode == kFlat ? a.provoking : a.vertex[k]].color;
    }
    const double area = (w[1].x - w[0].x) * (w[2].y - w[0].y) - (w[1].y - w[0].y) * (w[2].x - w[0].x);
    if (is_culled(d.state.cull, (area > 0) == (d.state.front == Winding::counter_clockwise))) continue;
    if (d.mode == kLinear) {  // the same window position with w = 1
      for (glm::vec4& c : at) c = glm::vec4(glm::vec3(c) / c.w, 1.0f);
    }
    shown.push_back({weigh(p, d.state.depth, at).value(), colors});
  }
  const bool clipped = std::any_of(d.vertices.begin(), d.vertices.end(), [](const Vertex& v) { return v.pos_clip.z > v.pos_clip.w; });
  const double tolerance = clipped ? 2.0 * kHalfCode : kHalfCode;  // new vertices are snapped by 1/512 px times the slope of the colors
  return for_each_pixel(seen, [&](int x, int y) -> std::string {
    const glm::dvec2 at(x + 0.5, y + 0.5);
    const double around = p.samples == 1 ? kMargin : 0.75;  // with several samples, the whole pixel must be inside or outside
    glm::dvec4 expected(p.clear_color);
    for (const Shown& s : shown) {
      const Where w = where(s.triangle.region, at, around);
      if (w == Where::unsure) return {};
      if (w == Where::inside) expected = s.triangle.color(s.colors, at);  // there is no overlap, or the last one is in front
    }
    return expect_near(expected, seen.color(x, y), tolerance);
  });
}

// Every pixel of a line has the color of a provoking vertex, or is not drawn.
std::string provoking_colors(const Picture& p, const Seen& seen) {
  const Drawing& d = p.draws[0];
  const std::vector<Assembled> lines = assembled(d);
  return for_each_pixel(seen, [&](int x, int y) -> std::string {
    const glm::vec4 got = seen.color(x, y);
    if (got == p.clear_color) return {};
    for (const Assembled& a : lines) {
      if (expect_near(glm::dvec4(d.vertices[a.provoking].color), got, kHalfCode).empty()) return {};
    }
    return "the color is not that of a provoking vertex";
  });
}

// Every channel of a line is between the minimum and maximum of its vertices. For a wide line, the color can exceed this range, because the
// corners of the line extend beyond its ends (by w/2 px and half a pixel).
std::string colors_in_range(const Picture& p, const Seen& seen) {
  const Drawing& d = p.draws[0];
  glm::vec4 low(1.0f), high(0.0f);
  for (const Vertex& v : d.vertices) low = glm::min(low, v.color), high = glm::max(high, v.color);
  if (d.state.line_width > 1.0f) {
    constexpr float kShortest = 20.0f;  // length in px of the shortest line in a zigzag
    const glm::vec4 beyond = (high - low) * (0.5f * d.state.line_width + 0.5f) / kShortest;
    low -= beyond;
    high += beyond;
  }
  return for_each_pixel(seen, [&](int x, int y) -> std::string {
    const glm::vec4 got = seen.color(x, y), half(static_cast<float>(kHalfCode));
    const bool in_range = glm::all(glm::lessThanEqual(low - half, got)) && glm::all(glm::lessThanEqual(got, high + half));
    return got == p.clear_color || in_range ? "" : "the color is outside of the range of the vertices";
  });
}

}  // namespace

Cases interpolation_cases() {
  Cases cases;
  for (const bool projected : {false, true}) {
    const std::string suffix = projected ? "_projected" : "_basic";
    for (const Named& kind : kTriangles) {
      cases.push_back({kind.name + suffix, [=] { return colored(kind, projected, kSmooth); }, triangle_colors});
      cases.push_back({std::string("linear_") + kind.name + suffix, [=] { return colored(kind, projected, kLinear); }, triangle_colors});
      for (const ColorMode mode : {kSmooth, kLinear}) {
        const std::string name = std::string(mode == kLinear ? "linear_" : "") + kind.name + suffix + "_clipped";
        cases.push_back({name,
                         [=] {
                           Picture p = colored(kind, projected, mode);
                           for (std::size_t i = 1; i < p.draws[0].vertices.size(); i += 3) {  // beyond the far plane
                             glm::vec4& at = p.draws[0].vertices[i].pos_clip;
                             at.z = 2.0f * at.w;
                           }
                           return p;
                         },
                         triangle_colors});
      }
      cases.push_back({kind.name + suffix + "_samples_4", [=] { return colored(kind, projected, kSmooth, 4); }, triangle_colors});
    }
    for (const Named& kind : kLines) {
      cases.push_back({kind.name + suffix, [=] { return colored(kind, projected, kSmooth); }, colors_in_range});
      cases.push_back({std::string("linear_") + kind.name + suffix, [=] { return colored(kind, projected, kLinear); }, colors_in_range});
    }
    for (const Named& kind : kWideLines)
      cases.push_back({kind.name + suffix, [=] { return colored(kind, projected, kSmooth); }, colors_in_range});
  }
  return cases;
}

Cases culling_cases() {
  Cases cases;
  constexpr CullMode kModes[] = {CullMode::front, CullMode::back, CullMode::front_and_back};
  constexpr const char* kNames[] = {"front", "back", "both"};
  for (int mode = 0; mode < 3; ++mode) {
    for (const Named& kind : kTriangles) {
      for (const Winding front : {Winding::counter_clockwise, Winding::clockwise}) {
        const bool reverse = front == Winding::clockwise;
        cases.push_back({std::string(kNames[mode]) + "_" + kind.name + (reverse ? "_reverse" : ""),
                         [=] {
                           Picture p = colored(kind, false, kSmooth);
                           p.draws[0].state.cull = kModes[mode];
                           p.draws[0].state.front = front;
                           return p;
                         },
                         triangle_colors, mode == 2 || kind.topology != Topology::triangles});
      }
    }
  }
  return cases;
}

Cases flatshading_cases() {
  Cases cases;
  for (const ProvokingVertex provoking : {ProvokingVertex::last, ProvokingVertex::first}) {
    const auto add = [&](const Named& kind, auto truth) {
      cases.push_back({std::string(kind.name) + (provoking == ProvokingVertex::first ? "_first" : "_last"),
                       [=] {
                         Picture p = colored(kind, false, kFlat);
                         p.draws[0].state.provoking = provoking;
                         return p;
                       },
                       truth});
    };
    for (const Named& kind : kTriangles) add(kind, triangle_colors);
    for (const Named& kind : kLines) add(kind, provoking_colors);
    for (const Named& kind : kWideLines) add(kind, provoking_colors);
  }
  return cases;
}

}  // namespace halfspace::conformance
