// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "conformance/geometry.h"
#include "conformance/groups.h"
#include "support/random.h"

namespace halfspace::conformance {

namespace {

// The 26 regions of space around the view volume: −1, 0 or 1 on each axis.
glm::ivec3 part(int number) {
  const int i = number < 13 ? number : number + 1;  // 13 is the view volume
  return {i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1};
}
std::string part_name(int number) {
  const glm::ivec3 d = part(number);
  std::string name;
  const auto say = [&](int side, const char* low, const char* high) {
    if (side != 0) name += std::string(name.empty() ? "" : "_") + (side < 0 ? low : high);
  };
  say(d.x, "left", "right");
  say(d.y, "below", "above");
  say(d.z, "near", "far");
  return name;
}
// Returns a point in that region, between 1.2 and `reach` times as far from the center as the sides of the view volume.
glm::vec4 outside(int number, float reach, Random& random) {
  const glm::ivec3 d = part(number);
  const float w = random.pick({0.5f, 1.0f, 3.0f});
  glm::vec4 p(0.0f, 0.0f, 0.0f, w);
  for (int k = 0; k < 3; ++k) {
    const float distance = random.real(1.2f, reach);
    p[k] = (d[k] == 0 ? random.real(-0.8f, 0.8f) : distance * static_cast<float>(d[k])) * w;
  }
  return p;
}
glm::vec4 inside(Random& random) {
  const float w = random.pick({0.5f, 1.0f, 3.0f});
  const float x = random.real(-0.9f, 0.9f);
  const float y = random.real(-0.9f, 0.9f);
  return {x * w, y * w, random.real(-0.8f, 0.8f) * w, w};
}

Picture triangle_picture(const std::array<int, 3>& parts, float reach, uint64_t seed) {
  Random random(seed);
  Picture p;
  Drawing d;
  for (int i = 0; i < 3; ++i) {
    const int number = parts[static_cast<std::size_t>(i)];
    const glm::vec4 at = number < 0 ? inside(random) : outside(number, reach, random);
    d.vertices.push_back({at, color_number(i + 3)});
  }
  p.draws.push_back(std::move(d));
  return p;
}

// Inside exactly one triangle, the color of a pixel follows from its homogeneous weights; outside, it is the clear color.
std::string as_if_unclipped(const Picture& p, const Seen& seen) {
  const std::vector<Vertex>& v = p.draws[0].vertices;
  std::vector<std::pair<Weighed, std::array<glm::vec4, 3>>> triangles;
  for (const Assembled& a : assembled(p.draws[0])) {
    const auto w = weigh(p, p.draws[0].state.depth, {v[a.vertex[0]].pos_clip, v[a.vertex[1]].pos_clip, v[a.vertex[2]].pos_clip});
    if (w) triangles.emplace_back(*w, std::array{v[a.vertex[0]].color, v[a.vertex[1]].color, v[a.vertex[2]].color});
  }
  return for_each_pixel(seen, [&](int x, int y) -> std::string {
    const glm::dvec2 at(x + 0.5, y + 0.5);
    glm::dvec4 expected(p.clear_color);
    for (const auto& [triangle, colors] : triangles) {
      const Where w = where(triangle.region, at);
      if (w == Where::unsure) return {};
      if (w == Where::inside) expected = triangle.color(colors, at);
    }
    // Snapping moves a vertex by up to 1/512 px and changes the colors by their slope times that distance. For triangles that are almost
    // edge-on, this is up to 2/255.
    return expect_near(expected, seen.color(x, y), 2.0 / 255.0);
  });
}

void add_triangles(Cases& cases) {
  const auto add = [&](const std::string& name, std::array<int, 3> parts, float reach) {
    const uint64_t seed = cases.size() + 17;
    cases.push_back({"triangle_" + name, [=] { return triangle_picture(parts, reach, seed); }, as_if_unclipped, true});
  };
  for (int i = 0; i < 26; ++i) {
    const int next = (i + 7) % 26, third = (i + 16) % 26;
    add("one_" + part_name(i), {i, -1, -1}, 3.0f);
    add("one_far_out_" + part_name(i), {-1, i, -1}, 300.0f);
    add("two_" + part_name(i) + "_and_" + part_name(next), {i, next, -1}, 3.0f);
    add("two_far_out_" + part_name(i) + "_and_" + part_name(third), {third, -1, i}, 300.0f);
    add("three_" + part_name(i) + "_and_" + part_name(next) + "_and_" + part_name(third), {i, next, third}, 4.0f);
  }
}

// ---- polygons and their edges --------------------------------------------------------------------------------------

// A fan of n vertices at about `radius` from the center of the window, in NDC, with depths from −z to z and different values of w.
Picture polygon_picture(int corners, float radius, float z, bool behind) {
  Picture p;
  p.colors = {ColorFormat::rgba32f};
  Drawing d;
  d.state.topology = Topology::triangle_fan;
  d.state.blend = kAdd;
  d.state.depth.test = false;
  for (int i = 0; i < corners; ++i) {
    const glm::dvec2 turn(std::array{1.0, 0.6, -0.5, -0.9, -0.7, 0.1, 0.8}[static_cast<std::size_t>(i)],
                          std::array{0.1, 0.9, 1.0, 0.3, -0.7, -1.0, -0.8}[static_cast<std::size_t>(i)]);
    const float w = behind && i == 1 ? -0.4f : i % 2 == 0 ? 1.0f : 2.5f;
    const glm::vec2 at = glm::vec2(turn) * radius * std::fabs(w);
    d.vertices.push_back({{at, (i % 3 == 0 ? -z : z) * std::fabs(w), w}, glm::vec4(1.0f)});
  }
  p.draws.push_back(std::move(d));
  return p;
}
std::vector<Region> triangle_regions(const Picture& p) {
  std::vector<Region> regions;
  const std::vector<Vertex>& v = p.draws[0].vertices;
  for (const Assembled& a : assembled(p.draws[0])) {
    const auto w = weigh(p, p.draws[0].state.depth, {v[a.vertex[0]].pos_clip, v[a.vertex[1]].pos_clip, v[a.vertex[2]].pos_clip});
    if (w) regions.push_back(w->region);
  }
  return regions;
}
std::string covered(const Picture& p, const Seen& seen) { return expect_red(p, seen, triangle_regions(p)); }

// Two triangles with a shared edge that extends beyond the window. No sample on the edge may be drawn twice or omitted.
Picture edge_picture(int i) {
  Random random(static_cast<uint64_t>(i) + 400);
  Picture p;
  p.colors = {ColorFormat::rgba32f};
  Drawing d;
  d.state.blend = kAdd;
  d.state.depth.test = false;
  d.state.depth.clamp = i % 2 == 1;
  const float far_out = std::array{2.0f, 40.0f, 1000.0f, 40000.0f}[static_cast<std::size_t>(i % 4)];
  const glm::vec4 a(-far_out, random.real(-0.9f, 0.9f), -0.5f, 1.0f), b(far_out, random.real(-0.9f, 0.9f), 0.5f, 1.0f);
  const glm::vec4 up(random.real(-1.0f, 1.0f), far_out, 0.0f, 1.0f), down(random.real(-1.0f, 1.0f), -far_out, 0.0f, 1.0f);
  for (const glm::vec4& v : {a, b, up, b, a, down}) d.vertices.push_back({v, glm::vec4(1.0f)});
  p.draws.push_back(std::move(d));
  return p;
}
// The two triangles must also cover their union exactly once. The quad is convex enough that a pixel of the window near the edge belongs to
// only one of them.
std::string edge_once(const Picture& p, const Seen& seen) {
  std::string wrong = covered(p, seen);
  if (!wrong.empty()) return wrong;
  const std::vector<Vertex>& v = p.draws[0].vertices;
  std::array<glm::dvec2, 4> quad;
  for (std::size_t k = 0; k < 4; ++k) quad[k] = window_of(p, v[std::array<std::size_t, 4>{0, 5, 1, 2}[k]].pos_clip);
  return expect_red(p, seen, {polygon(quad)});
}

void add_polygons(Cases& cases) {
  for (const int corners : {3, 4, 5, 6, 7}) {
    for (const float radius : {1.3f, 6.0f, 150.0f}) {
      const std::string name = "polygon_" + std::to_string(corners) + "_corners_" + std::to_string(static_cast<int>(radius * 10.0f));
      cases.push_back({name, [=] { return polygon_picture(corners, radius, radius < 2.0f ? 1.6f : 0.5f, false); }, covered, true});
    }
    cases.push_back({"polygon_" + std::to_string(corners) + "_corners_behind", [=] { return polygon_picture(corners, 1.2f, 0.2f, true); },
                     covered, true});
  }
  for (int i = 0; i < 12; ++i) cases.push_back({"polygon_edge_" + std::to_string(i), [=] { return edge_picture(i); }, edge_once, true});
}

// ---- lines and points ----------------------------------------------------------------------------------------------

Picture line_picture(int from, int to, float width, uint64_t seed) {
  Random random(seed);
  Picture p;
  Drawing d;
  d.mode = kFlat;
  d.state.topology = Topology::lines;
  d.state.line_width = width;
  const glm::vec4 a = from < 0 ? inside(random) : outside(from, 3.0f, random);
  d.vertices = {{a, color_number(1)}, {to < 0 ? inside(random) : outside(to, 3.0f, random), color_number(4)}};
  p.draws.push_back(std::move(d));
  return p;
}

// Pixels near the part of the line between near and far must be drawn, and all others must not.
std::string on_the_line(const Picture& p, const Seen& seen) {
  const glm::dvec4 a(p.draws[0].vertices[0].pos_clip), b(p.draws[0].vertices[1].pos_clip);
  const double width = static_cast<double>(p.draws[0].state.line_width);
  glm::dvec2 ends[2];
  double low = 0.0, high = 1.0;  // parameters of the line between near and far
  const auto keep = [&](double da, double db) {
    if (da < 0.0 && db < 0.0) high = -1.0;
    if (da < 0.0 && db >= 0.0) low = std::max(low, da / (da - db));
    if (da >= 0.0 && db < 0.0) high = std::min(high, da / (da - db));
  };
  keep(a.z + a.w, b.z + b.w);
  keep(a.w - a.z, b.w - b.z);
  if (low < high) {
    for (int i = 0; i < 2; ++i) {
      const glm::dvec4 c = a + (b - a) * (i == 0 ? low : high);
      ends[i] = {(c.x / c.w + 1.0) * 0.5 * p.width, (c.y / c.w + 1.0) * 0.5 * p.height};
    }
  }
  return for_each_pixel(seen, [&](int x, int y) -> std::string {
    const bool drawn = seen.color(x, y) != p.clear_color;
    if (low >= high) return drawn ? "drawn; expected an empty picture" : "";
    const glm::dvec2 at(x + 0.5, y + 0.5), e = ends[1] - ends[0];
    const int major = std::fabs(e.y) > std::fabs(e.x) ? 1 : 0;
    const double t = (at[major] - ends[0][major]) / e[major], end = 1.0 / std::fabs(e[major]);
    const double off = std::fabs(ends[0][1 - major] + t * e[1 - major] - at[1 - major]);
    const bool must = t > end && t < 1.0 - end && off < 0.5 * width - kMargin;
    const bool may = t > -end && t < 1.0 + end && off < 0.5 * width + kMargin + std::fabs(e[1 - major] / e[major]) + 0.5;
    return must && !drawn ? "not drawn" : drawn && !may ? "drawn" : "";
  });
}

Picture point_picture(const glm::vec4& center, float size) {
  Picture p;
  p.colors = {ColorFormat::rgba32f};
  Drawing d;
  d.state.topology = Topology::points;
  d.state.point_size = size;
  d.vertices = {{center, glm::vec4(1.0f)}};
  p.draws.push_back(std::move(d));
  return p;
}

// The window clips the square of a point; the position of its center does not matter. A point beyond near or far is discarded completely.
std::string point_rectangle(const Picture& p, const Seen& seen) {
  const glm::vec4 c = p.draws[0].vertices[0].pos_clip;
  if (c.z < -c.w || c.z > c.w) return expect_red(p, seen, {});
  const glm::dvec2 at = window_of(p, c);
  const double r = 0.5 * static_cast<double>(p.draws[0].state.point_size);
  const std::array<glm::dvec2, 4> square{at + glm::dvec2(-r, -r), at + glm::dvec2(r, -r), at + glm::dvec2(r, r), at + glm::dvec2(-r, r)};
  return expect_red(p, seen, {polygon(square)});
}

void add_lines_and_points(Cases& cases) {
  for (int i = 0; i < 8; ++i) {
    const int number = (i * 7 + 2) % 26;
    const float width = i % 2 == 0 ? 1.0f : 4.0f;
    const auto seed = static_cast<uint64_t>(i);
    cases.push_back({"line_from_" + part_name(number), [=] { return line_picture(number, -1, width, seed + 70); }, on_the_line, true});
    cases.push_back(
        {"line_across_" + part_name(number), [=] { return line_picture(number, 25 - number, width, seed + 90); }, on_the_line, true});
  }
  for (int i = 0; i < 26; ++i) {
    const glm::ivec3 d = part(i);
    const glm::vec4 center(glm::vec3(d) * 1.125f, 1.0f);
    const bool center_is_out = d.x != 0 || d.y != 0;
    cases.push_back({"point_" + part_name(i), [=] { return point_picture(center, 11.0f); }, point_rectangle, true,
                     center_is_out ? "Mesa clips points by their center" : nullptr});
  }
}

}  // namespace

Cases clipping_cases() {
  Cases cases;
  add_triangles(cases);
  add_polygons(cases);
  add_lines_and_points(cases);
  return cases;
}

}  // namespace halfspace::conformance
