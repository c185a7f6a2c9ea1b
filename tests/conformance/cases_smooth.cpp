// SPDX-License-Identifier: Apache-2.0
//
// Cases of smooth lines and polygons (OpenGL 4.6, sections 14.5.4 and 14.6.6). The truth is the sum of the colors of the primitives, each
// multiplied by the exact area of the pixel that it covers.
#include <cmath>
#include <string>
#include <utility>

#include "conformance/geometry.h"
#include "conformance/groups.h"
#include "conformance/topologies.h"
#include "support/pixel_area.h"

namespace halfspace::conformance {

namespace {

// Adds colors that are multiplied by their alpha, and alphas.
constexpr BlendState kAddWeighted{BlendEquation::add, BlendFactor::src_alpha, BlendFactor::one,
                                  BlendEquation::add, BlendFactor::one,       BlendFactor::one};

Picture smooth(Topology topology, PolygonMode mode, float width, std::vector<Vertex> vertices, ProvokingVertex provoking, int samples = 1) {
  Picture p;
  p.samples = samples;
  p.colors = {ColorFormat::rgba32f};
  Drawing d;
  d.mode = kFlat;
  d.vertices = std::move(vertices);
  d.state.topology = topology;
  d.state.polygon_mode = mode;
  d.state.line_width = width;
  d.state.line_smooth = d.state.polygon_smooth = true;
  d.state.provoking = provoking;
  d.state.blend = kAddWeighted;
  d.state.depth.test = false;
  p.draws.push_back(std::move(d));
  return p;
}

struct Covered {
  std::vector<glm::dvec2> polygon;
  glm::dvec4 color;
};

std::vector<glm::dvec2> line_polygon(const glm::dvec2& a, const glm::dvec2& b, double width) {
  const glm::dvec2 along = (b - a) / std::hypot(b.x - a.x, b.y - a.y), side = 0.5 * width * glm::dvec2(-along.y, along.x);
  return {a - side, b - side, b + side, a + side};
}

// The polygons that a drawing covers, in pixels.
std::vector<Covered> covered_by(const Picture& p, const Drawing& d) {
  std::vector<Covered> out;
  for (const Assembled& a : assembled(d)) {
    std::array<glm::dvec2, 3> c;
    for (std::size_t k = 0; k < 3; ++k) c[k] = window_of(p, d.vertices[a.vertex[k]].pos_clip);
    const glm::dvec4 color(d.vertices[a.provoking].color);
    const auto width = static_cast<double>(d.state.line_width);
    if (is_lines(d.state.topology)) {
      out.push_back({line_polygon(c[0], c[1], width), color});
    } else if (d.state.polygon_mode == PolygonMode::line) {
      for (std::size_t k = 0; k < 3; ++k) out.push_back({line_polygon(c[k], c[(k + 1) % 3], width), color});
    } else {
      out.push_back({{c.begin(), c.end()}, color});
    }
  }
  return out;
}

std::string areas(const Picture& p, const Seen& seen) {
  const std::vector<Covered> all = covered_by(p, p.draws[0]);
  return for_each_pixel(seen, [&](int x, int y) {
    glm::dvec4 sum(0.0);
    for (const auto& [polygon, color] : all) {
      const double alpha = color.w * area_in_pixel(polygon, x, y);
      sum += glm::dvec4(glm::dvec3(color) * alpha, alpha);
    }
    // Up to 12 products and sums below 8, each rounded by at most 2^-22; the closed form has an error of 1e-9.
    return expect_near(sum, seen.color(x, y), 12 * 0x1p-22 + 1e-8);
  });
}

// One triangle or line: which pixels have a depth, between those of the vertices, and that the query counts them.
std::string depths_and_query(const Picture& p, const Seen& seen) {
  const Covered c = covered_by(p, p.draws[0]).at(0);
  const Region region = polygon(c.polygon);
  uint64_t with_depth = 0;
  std::string wrong = for_each_pixel(seen, [&](int x, int y) -> std::string {
    const double depth = seen.depth(x, y);
    const bool is_drawn = depth != 1.0;
    with_depth += is_drawn ? 1 : 0;
    if (!is_drawn && area_in_pixel(c.polygon, x, y) > 1e-8) return "no depth";                    // 1e-8: the error of the closed form
    if (is_drawn && where(region, {x + 0.5, y + 0.5}, 0.71) == Where::outside) return "a depth";  // half a diagonal is 0.7071
    return is_drawn && (depth < 0.25 || depth > 0.75) ? "a depth beyond those of the vertices" : "";
  });
  const uint64_t passed = seen.queries.at(0);
  if (wrong.empty() && passed != with_depth) wrong = std::to_string(passed) + " samples passed, " + std::to_string(with_depth) + " drawn";
  return wrong;
}

// The state has no effect.
std::string is_not_smooth(const Picture& p, const Seen& seen) {
  Picture plain = p;
  plain.draws[0].state.line_smooth = plain.draws[0].state.polygon_smooth = false;
  const Seen expected = draw(plain);
  return for_each_pixel(seen, [&](int x, int y) { return expect_near(glm::dvec4(expected.color(x, y)), seen.color(x, y), 0.0); });
}

}  // namespace

Cases smooth_primitives_cases() {
  Cases cases;
  const Picture size;
  const auto fill = PolygonMode::fill, outline = PolygonMode::line;
  for (const auto& [name, topology, width] : kTriangles) {
    for (const ProvokingVertex provoking : {ProvokingVertex::first, ProvokingVertex::last}) {
      const std::string prefix = std::string(name) + "_", suffix = provoking == ProvokingVertex::first ? "_first" : "_last";
      const auto add = [&, t = topology](const std::string& what, PolygonMode mode, float w, const std::vector<Vertex>& vertices) {
        cases.push_back({prefix + what + suffix, [=] { return smooth(t, mode, w, vertices, provoking); }, areas});
      };
      add("scattered", fill, 1.0f, scattered(size, 12, 71));
      add("projected", fill, 1.0f, scattered(size, 12, 72, true));
      add("zigzag", fill, 1.0f, zigzag(size, 12));
      add("outlines", outline, 1.0f, scattered(size, 9, 73));
      add("outlines_wide", outline, 3.75f, scattered(size, 9, 74));
    }
  }
  for (const auto& [name, topology, unused] : kLines) {
    for (const float width : {0.25f, 1.0f, 1.5f, 6.75f}) {
      const std::string prefix = std::string(name) + "_", suffix = "_width_" + std::to_string(static_cast<int>(width * 100.0f));
      const auto add = [&, t = topology](const std::string& what, const std::vector<Vertex>& vertices) {
        cases.push_back({prefix + what + suffix, [=] { return smooth(t, fill, width, vertices, ProvokingVertex::last); }, areas});
      };
      add("scattered", scattered(size, 10, 75));
      add("projected", scattered(size, 10, 76, true));
    }
  }
  for (const auto& [name, topology] : {std::pair("triangle", Topology::triangles), {"line", Topology::lines}}) {
    for (const uint64_t seed : {77u, 78u, 79u}) {
      cases.push_back({"depth_of_" + std::string(name) + "_" + std::to_string(seed),
                       [=, t = topology] {
                         Picture p = smooth(t, fill, 2.5f, scattered(size, t == Topology::lines ? 2 : 3, seed), ProvokingVertex::last);
                         DrawState& s = p.draws[0].state;
                         s.depth.test = true;
                         s.query = 0;
                         for (std::size_t i = 0; i < p.draws[0].vertices.size(); ++i)
                           p.draws[0].vertices[i].pos_clip.z = 0.5f * static_cast<float>(i) - 0.5f;  // depths from 0.25
                         return p;
                       },
                       depths_and_query});
    }
  }
  for (const auto& [name, topology, unused] : kTriangles) {
    cases.push_back({name + std::string("_multisample"),
                     [=, t = topology] { return smooth(t, fill, 1.0f, scattered(size, 12, 71), ProvokingVertex::last, 4); },
                     is_not_smooth});
    cases.push_back({name + std::string("_with_smooth_lines"),
                     [=, t = topology] {
                       Picture p = smooth(t, fill, 1.0f, scattered(size, 12, 71), ProvokingVertex::last);
                       p.draws[0].state.polygon_smooth = false;
                       return p;
                     },
                     is_not_smooth});
  }
  for (const auto& [name, topology, width] : kWideLines) {
    cases.push_back({name + std::string("_multisample"),
                     [=, t = topology, w = width] { return smooth(t, fill, w, scattered(size, 12, 71), ProvokingVertex::last, 4); },
                     is_not_smooth});
  }
  return cases;
}

}  // namespace halfspace::conformance
