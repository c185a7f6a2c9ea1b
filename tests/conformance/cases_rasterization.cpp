// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "conformance/geometry.h"
#include "conformance/groups.h"
#include "conformance/topologies.h"
#include "halfspace/core/trig_double.h"

namespace halfspace::conformance {

namespace {

std::string samples_suffix(int samples) { return samples == 1 ? "" : "_samples_" + std::to_string(samples); }

// Adds up fragments in a float target, so that samples that are drawn twice can be detected.
Drawing counting(const glm::vec4& color) {
  Drawing d;
  d.state.blend = kAdd;
  d.state.depth.test = false;
  for (Vertex& v : d.vertices) v.color = color;
  return d;
}

// ---- fill rules ----------------------------------------------------------------------------------------------------

enum class Quads { basic_quad, basic_quad_reverse, clipped_full, clipped_partly, projected };
constexpr const char* kQuadNames[] = {"basic_quad", "basic_quad_reverse", "clipped_full", "clipped_partly", "projected"};

// Adjacent rotated squares, or one square that extends beyond the window.
Picture quads_picture(Quads quads, int samples) {
  Picture p;
  p.width = p.height = 64;
  p.samples = samples;
  p.colors = {ColorFormat::rgba32f};
  Drawing d = counting(glm::vec4(1.0f));
  const bool beyond = quads == Quads::clipped_full || quads == Quads::clipped_partly;
  const int cells = beyond ? 1 : 4;
  for (int cell = 0; cell < cells * cells; ++cell) {
    const double size = 64.0 / cells, turn = 0.1 + 0.37 * cell;
    const double radius = quads == Quads::clipped_full ? 200.0 : quads == Quads::clipped_partly ? 45.0 : 7.7;
    std::array<Vertex, 4> corners;
    for (int i = 0; i < 4; ++i) {
      const double angle = turn + 1.5707963267948966 * (quads == Quads::basic_quad_reverse ? 3 - i : i);
      const double x = size * (cell % cells + 0.5) + radius * sincos_radians(angle).cos,
                   y = size * (cell / cells + 0.5) + radius * sincos_radians(angle).sin;
      const float w = quads == Quads::projected ? (i % 2 == 0 ? 0.5f : 4.0f) : 1.0f;
      corners[static_cast<std::size_t>(i)] = {clip_at(p, std::round(x * 256.0) / 256.0, std::round(y * 256.0) / 256.0, 0.0f, w)};
    }
    add_quad(d, corners);
  }
  p.draws.push_back(std::move(d));
  return p;
}

// ---- primitives ----------------------------------------------------------------------------------------------------

Picture primitives_picture(const Named& kind, PolygonMode mode, float point_size, int samples) {
  Picture p;
  p.samples = samples;
  p.colors = {ColorFormat::rgba32f};
  Drawing d = counting(glm::vec4(1.0f));
  d.mode = kFlat;
  d.state.topology = kind.topology;
  d.state.line_width = kind.width;
  d.state.polygon_mode = mode;
  d.state.point_size = point_size;
  d.vertices = kind.topology == Topology::triangle_fan ? scattered(p, 6, 11) : scattered(p, 12, 5);
  for (Vertex& v : d.vertices) v.color = glm::vec4(1.0f);
  p.draws.push_back(std::move(d));
  return p;
}

// Checks filled primitives: triangles and points (squares around the vertex).
std::string filled(const Picture& p, const Seen& seen) {
  const Drawing& d = p.draws[0];
  std::vector<Region> regions;
  for (const Assembled& a : assembled(d)) {
    std::array<glm::dvec2, 3> c;
    for (std::size_t k = 0; k < 3; ++k) c[k] = window_of(p, d.vertices[a.vertex[k]].pos_clip);
    if (d.state.topology == Topology::points) {
      const double r = 0.5 * static_cast<double>(d.state.point_size);
      const std::array<glm::dvec2, 4> square{c[0] + glm::dvec2(-r, -r), c[0] + glm::dvec2(r, -r), c[0] + glm::dvec2(r, r),
                                             c[0] + glm::dvec2(-r, r)};
      regions.push_back(polygon(square));
    } else {
      regions.push_back(polygon(c));
    }
  }
  return expect_red(p, seen, regions);
}

// A point that outputs its point coordinate: the offset of the pixel center from the corner of the square.
Picture coordinate_picture(PointOrigin origin, int samples) {
  Picture p;
  p.samples = samples;
  p.colors = {ColorFormat::rgba32f};
  Drawing d;
  d.kind = Kind::point;
  d.state.topology = Topology::points;
  d.state.point_origin = origin;
  d.vertices = {{clip_at(p, 14.25, 17.75), glm::vec4(1.0f), {21.5f, 0, 0, 0}}};
  p.draws.push_back(std::move(d));
  return p;
}
std::string coordinate_formula(const Picture& p, const Seen& seen) {
  const Vertex& v = p.draws[0].vertices[0];
  const double size = static_cast<double>(v.extra.x);
  const glm::dvec2 low = window_of(p, v.pos_clip) - glm::dvec2(0.5 * size);
  return for_each_pixel(seen, [&](int x, int y) -> std::string {
    glm::dvec2 c = (glm::dvec2(x + 0.5, y + 0.5) - low) / size;
    if (p.draws[0].state.point_origin == PointOrigin::upper_left) c.y = 1.0 - c.y;
    const double margin = 1.0 / size;  // the pixel is inside the square
    const bool inside = c.x > margin && c.x < 1.0 - margin && c.y > margin && c.y < 1.0 - margin;
    return inside ? expect_near({c.x, c.y, 1.0, 1.0}, seen.color(x, y), 1e-6) : "";
  });
}

// For a line of width w with one sample per pixel, each column (or row) between its ends has w pixels, and none is more than (w + 1)/2
// away.
std::string thin_lines(const Picture& p, const Seen& seen) {
  const Drawing& d = p.draws[0];
  const double width = static_cast<double>(d.state.line_width);
  struct Line {
    glm::dvec2 from, to;
    bool y_major;
  };
  std::vector<Line> lines;
  for (const Assembled& a : assembled(d)) {
    const glm::dvec2 from = window_of(p, d.vertices[a.vertex[0]].pos_clip), to = window_of(p, d.vertices[a.vertex[1]].pos_clip);
    lines.push_back({from, to, std::fabs(to.y - from.y) > std::fabs(to.x - from.x)});
  }
  return for_each_pixel(seen, [&](int x, int y) -> std::string {
    double low = 0, high = 0;
    for (const Line& l : lines) {
      const int major = l.y_major ? 1 : 0;
      const glm::dvec2 at(x + 0.5, y + 0.5), e = l.to - l.from;
      const double t = (at[major] - l.from[major]) / e[major];
      const double off = std::fabs(l.from[1 - major] + t * e[1 - major] - at[1 - major]), end = 1.0 / std::fabs(e[major]);
      if (t > end && t < 1.0 - end && off < 0.5 * width - kMargin) low += 1;
      if (t > -end && t < 1.0 + end && off < 0.5 * width + kMargin + 1.0 * end) high += 1;
    }
    const double red = static_cast<double>(seen.color(x, y).x);
    if (red >= low && red <= high) return {};
    return "drawn " + std::to_string(red) + " times, expected " + std::to_string(low) + " to " + std::to_string(high);
  });
}

}  // namespace

Cases fill_rules_cases() {
  Cases cases;
  for (const Quads quads : {Quads::basic_quad, Quads::basic_quad_reverse, Quads::clipped_full, Quads::clipped_partly, Quads::projected}) {
    for (const int samples : {1, 2, 4, 8}) {
      cases.push_back({kQuadNames[static_cast<int>(quads)] + samples_suffix(samples), [=] { return quads_picture(quads, samples); },
                       quads_once, quads == Quads::clipped_full});
    }
  }
  return cases;
}

Cases primitives_cases() {
  Cases cases;
  const auto add = [&](const std::string& name, const Named& kind, PolygonMode mode, float size, int samples, auto truth) {
    Case c{name + samples_suffix(samples), [=] { return primitives_picture(kind, mode, size, samples); }};
    if (truth) c.truth = truth;
    cases.push_back(std::move(c));
  };
  constexpr std::string (*no_truth)(const Picture&, const Seen&) = nullptr;
  for (const int samples : {1, 4}) {
    for (const float size : {1.0f, 2.0f, 7.5f, 40.0f}) {
      add("points_" + std::to_string(static_cast<int>(size)), {"points", Topology::points}, PolygonMode::fill, size, samples, filled);
    }
    for (const PointOrigin origin : {PointOrigin::upper_left, PointOrigin::lower_left}) {
      const std::string name = origin == PointOrigin::upper_left ? "point_coordinate_upper_left" : "point_coordinate_lower_left";
      cases.push_back({name + samples_suffix(samples), [=] { return coordinate_picture(origin, samples); }, coordinate_formula});
    }
    for (const Named& kind : kTriangles) add(kind.name, kind, PolygonMode::fill, 1.0f, samples, filled);
    for (const Named& kind : kLines) add(kind.name, kind, PolygonMode::fill, 1.0f, samples, samples == 1 ? thin_lines : no_truth);
    for (const Named& kind : kWideLines) add(kind.name, kind, PolygonMode::fill, 1.0f, samples, samples == 1 ? thin_lines : no_truth);
    for (const Named& kind : kTriangles) {
      add(std::string("outline_of_") + kind.name, kind, PolygonMode::line, 1.0f, samples, no_truth);
      add(std::string("corners_of_") + kind.name, kind, PolygonMode::point, 3.0f, samples, no_truth);
    }
  }
  return cases;
}

}  // namespace halfspace::conformance
