// SPDX-License-Identifier: Apache-2.0
#include <bit>
#include <cmath>
#include <set>

#include "conformance/geometry.h"
#include "conformance/groups.h"
#include "halfspace/core/trig_double.h"

namespace halfspace::conformance {

namespace {

Picture counting_picture(int samples) {
  Picture p;
  p.samples = samples;
  p.colors = {ColorFormat::rgba32f};
  Drawing d;
  d.state.blend = kAdd;
  d.state.depth.test = false;
  p.draws.push_back(std::move(d));
  return p;
}

// ---- edges ---------------------------------------------------------------------------------------------------------

// 25 thin triangles around the center.
Picture fan_picture(int samples) {
  Picture p = counting_picture(samples);
  for (int i = 0; i < 25; ++i) {
    const auto at = [&](double turn) {
      const SinCosDouble s = sincos_turns(turn);
      return Vertex{clip_at(p, std::round((16 + 15 * s.cos) * 256) / 256, std::round((16 + 15 * s.sin) * 256) / 256)};
    };
    p.draws[0].vertices.insert(p.draws[0].vertices.end(), {Vertex{clip_at(p, 16, 16)}, at(i / 25.0), at((i + 0.5) / 25.0)});
  }
  return p;
}

std::vector<Region> regions_of(const Picture& p) {
  std::vector<Region> regions;
  const Drawing& d = p.draws.back();
  for (const Assembled& a : assembled(d)) {
    std::array<glm::dvec2, 3> c;
    for (std::size_t k = 0; k < 3; ++k) c[k] = window_of(p, d.vertices[a.vertex[k]].pos_clip);
    regions.push_back(polygon(c));
  }
  return regions;
}

// All possible numbers of covered samples must occur in edge pixels, and each pixel must be within its bounds.
std::string all_shares(const Picture& p, const Seen& seen) {
  std::set<float> values;
  for_each_pixel(seen, [&](int x, int y) {
    values.insert(seen.color(x, y).x);
    return std::string();
  });
  if (values.size() < static_cast<std::size_t>(p.samples) + 1)
    return "only " + std::to_string(values.size()) + " different coverage values occur";
  return expect_red(p, seen, regions_of(p));
}

// Quads that are split by a diagonal. Each sample must be drawn once.
Picture common_edge_picture(int samples, int n) {
  Picture p = counting_picture(samples);
  for (int i = 0; i < n * n; ++i) {
    const double size = 32.0 / n, x = size * (i % n) + 0.37, y = size * (i / n) + 0.21, side = size * 0.85;
    const auto at = [&](double u, double v) {
      return Vertex{
          clip_at(p, std::round((x + u * side + v * 0.1 * side) * 256) / 256, std::round((y + v * side - u * 0.07 * side) * 256) / 256)};
    };
    add_quad(p.draws[0], {at(0, 0), at(1, 0), at(1, 1), at(0, 1)});
  }
  return p;
}

// ---- masks and alpha -----------------------------------------------------------------------------------------------

// Whole pixels, with an alpha that increases from column to column.
Picture columns(int samples, bool alpha_to_coverage, uint32_t mask) {
  Picture p = counting_picture(samples);
  DrawState& s = p.draws[0].state;
  s.alpha_to_coverage = alpha_to_coverage;
  s.sample_mask = mask;
  for (int x = 0; x < 32; ++x) add_rectangle(p.draws[0], p, {1.0 * x, 0, x + 1.0, 32}, glm::vec4(1, 1, 1, static_cast<float>(x) / 31.0f));
  return p;
}
std::string masked_share(const Picture& p, const Seen& seen) {
  const auto mask = p.draws[0].state.sample_mask & ((1u << p.samples) - 1u);
  const float share = static_cast<float>(std::popcount(mask)) / static_cast<float>(p.samples);
  return for_each_pixel(
      seen, [&](int x, int y) { return expect_near(glm::dvec4(glm::vec3(share), seen.color(x, y).w), seen.color(x, y), 1e-6); });
}
// Coverage is 0 for alpha 0 and full for alpha 1, never decreases from column to column, and differs from alpha by at most half a sample.
std::string alpha_share(const Picture& p, const Seen& seen) {
  return for_each_pixel(seen, [&](int x, int y) -> std::string {
    const float share = seen.color(x, y).x, alpha = static_cast<float>(x) / 31.0f;
    if (x > 0 && share < seen.color(x - 1, y).x) return "fewer samples for a higher alpha";
    return std::fabs(share - alpha) <= 0.5f / static_cast<float>(p.samples) + 1e-6f ? "" : "share " + std::to_string(share);
  });
}

// ---- per-sample shading, centroid, per-sample depth and stencil ----------------------------------------------------------

enum class By { pixel, sample, supersample, centroid, depth, stencil };
constexpr const char* kByNames[] = {"by_pixel", "sample_shading", "supersample", "centroid", "depth", "stencil"};

Picture sampled(By by, int samples) {
  Picture p;
  p.samples = samples;
  p.supersample = by == By::supersample;
  Drawing d;
  d.vertices = zigzag(p, 9, true);
  d.mode = by == By::centroid ? kCentroid : kSmooth;
  d.state.sample_shading = by == By::sample;
  if (by == By::depth || by == By::stencil) {  // a second set of triangles, partly hidden per sample by the first
    p.draws.push_back(d);
    d.vertices = scattered(p, 30, 4);
    if (by == By::stencil) {
      const StencilFace mark{.pass = StencilOp::replace, .reference = 1}, unmarked{.compare = CompareOp::not_equal, .reference = 1};
      p.draws[0].state.stencil = StencilState{mark, mark};
      d.state.stencil = StencilState{unmarked, unmarked};
      d.state.depth.test = false;
    }
  }
  p.draws.push_back(std::move(d));
  return p;
}

// With centroid interpolation, a color never leaves the range of the vertices, unlike one interpolated at the pixel center.
std::string within_vertices(const Picture& p, const Seen& seen) {
  glm::vec4 low(1.0f), high(0.0f);
  for (const Vertex& v : p.draws[0].vertices) low = glm::min(low, v.color), high = glm::max(high, v.color);
  return for_each_pixel(seen, [&](int x, int y) -> std::string {
    const Share share = share_of(regions_of(p), x, y, p.samples);
    if (share.low < 1.0 || share.high > 1.0) return {};
    const glm::vec4 c = seen.color(x, y), half(static_cast<float>(kHalfCode));
    return glm::all(glm::lessThanEqual(low - half, c)) && glm::all(glm::lessThanEqual(c, high + half)) ? ""
                                                                                                       : "color outside of vertex range";
  });
}

// ---- occlusion queries -----------------------------------------------------------------------------------------------

struct Query {
  const char* name;
  Topology topology;
  void (*hide)(Picture&, DrawState&);  ///< changes the picture before the draw with the query
  int visible;                         ///< samples of the 20 x 12 px rectangle that pass; −1: the number of visible pixels
};

void nothing(Picture&, DrawState&) {}
void by_scissor(Picture&, DrawState& s) { s.scissor = Rect{10, 0, 5, 32}; }
void by_all_scissor(Picture&, DrawState& s) { s.scissor = Rect{0, 0, 3, 3}; }
void occluder(Picture& p, double x1) {
  Drawing d;
  add_rectangle(d, p, {0, 0, x1, 32}, glm::vec4(0.25f), -0.5f);
  p.draws.push_back(std::move(d));
}
void half_behind(Picture& p, DrawState&) { occluder(p, 14); }
void all_behind(Picture& p, DrawState&) { occluder(p, 32); }
void by_stencil(Picture& p, DrawState& s) {
  occluder(p, 9);
  const StencilFace mark{.pass = StencilOp::replace, .reference = 3}, other{.compare = CompareOp::not_equal, .reference = 3};
  p.draws.back().state.stencil = StencilState{mark, mark};
  s.stencil = StencilState{other, other};
  s.depth.test = false;
}
void by_culling(Picture&, DrawState& s) { s.cull = CullMode::back, s.front = Winding::clockwise; }
void by_never(Picture&, DrawState& s) { s.depth.compare = CompareOp::never; }
void by_mask(Picture&, DrawState& s) { s.color_mask = {false, false, false, false}; }
void by_blend(Picture&, DrawState& s) { s.blend = BlendState{BlendEquation::add, BlendFactor::zero, BlendFactor::one}; }
void four_samples(Picture& p, DrawState&) { p.samples = 4; }
void masked_samples(Picture& p, DrawState& s) { p.samples = 8, s.sample_mask = 0x7; }

constexpr Query kQueries[] = {{"all", Topology::triangles, nothing, 240},
                              {"scissor", Topology::triangles, by_scissor, 60},
                              {"scissor_hides_all", Topology::triangles, by_all_scissor, 0},
                              {"depth", Topology::triangles, half_behind, 144},
                              {"depth_hides_all", Topology::triangles, all_behind, 0},
                              {"stencil", Topology::triangles, by_stencil, 204},
                              {"culled", Topology::triangles, by_culling, 0},
                              {"never", Topology::triangles, by_never, 0},
                              {"color_masked", Topology::triangles, by_mask, 240},
                              {"blended_away", Topology::triangles, by_blend, 240},
                              {"four_samples", Topology::triangles, four_samples, 960},
                              {"masked_samples", Topology::triangles, masked_samples, 720},
                              {"lines", Topology::lines, nothing, -1},
                              {"lines_behind", Topology::lines, half_behind, -1},
                              {"points", Topology::points, nothing, -1},
                              {"points_scissored", Topology::points, by_scissor, -1}};

Picture query_picture(const Query& q, bool in_two_draws) {
  Picture p;
  Drawing d;
  q.hide(p, d.state);
  d.state.query = 2;
  if (q.topology == Topology::triangles) {
    add_rectangle(d, p, {6, 5, 26, 17}, glm::vec4(1.0f));
  } else {
    d.state.topology = q.topology;
    d.state.point_size = 3.0f;
    d.vertices = zigzag(p, 8);
    for (Vertex& v : d.vertices) v.color = glm::vec4(1.0f);
  }
  if (in_two_draws) {  // the second draw is tested against the depth of the first
    p.draws.push_back(d);
  }
  p.draws.push_back(std::move(d));
  return p;
}

// The query must return the number of samples from the closed form or, if there is none, the number of pixels that have the color of the
// draw. The expected number is doubled if nothing rejects the second draw.
std::string counted(const Query& q, const Picture& p, const Seen& seen) {
  uint64_t expected = static_cast<uint64_t>(std::max(q.visible, 0));
  if (q.visible < 0) {
    for_each_pixel(seen, [&](int x, int y) {
      expected += seen.color(x, y) == glm::vec4(1.0f);
      return std::string();
    });
  }
  const bool twice = p.draws.size() > 1 && p.draws[p.draws.size() - 2].state.query && !p.draws.back().state.depth.test;
  if (twice) expected *= 2;
  const uint64_t got = seen.queries.size() > 2 ? seen.queries[2] : 0;
  return got == expected ? "" : std::to_string(got) + " samples counted, expected " + std::to_string(expected);
}

}  // namespace

Cases multisample_cases() {
  Cases cases;
  for (const int samples : {1, 2, 4, 8}) {
    const std::string suffix = "_samples_" + std::to_string(samples);
    cases.push_back({"num_samples_polygon" + suffix, [=] { return fan_picture(samples); }, all_shares});
    for (const int n : {2, 9}) {
      const std::string name = "common_edge_" + std::to_string(n * n) + "_quads" + suffix;
      cases.push_back({name, [=] { return common_edge_picture(samples, n); }, quads_once});
    }
    for (const By by : {By::pixel, By::sample, By::supersample, By::centroid, By::depth, By::stencil}) {
      Case c{kByNames[static_cast<int>(by)] + suffix, [=] { return sampled(by, samples); }};
      if (by == By::centroid) c.truth = within_vertices;
      cases.push_back(std::move(c));
    }
    if (samples == 1) continue;
    cases.push_back({"alpha_to_coverage" + suffix, [=] { return columns(samples, true, ~0u); }, alpha_share});
    for (const uint32_t mask : {1u, 2u, 0xa5u}) {
      if ((mask & ((1u << samples) - 1u)) == 0) continue;
      cases.push_back({"sample_mask_" + std::to_string(mask) + suffix, [=] { return columns(samples, false, mask); }, masked_share});
    }
  }
  return cases;
}

Cases occlusion_query_cases() {
  Cases cases;
  for (const Query& q : kQueries) {
    for (const bool in_two_draws : {false, true}) {
      cases.push_back({std::string(q.name) + (in_two_draws ? "_two_draws" : ""),
                       [&q, in_two_draws] { return query_picture(q, in_two_draws); },
                       [&q](const Picture& p, const Seen& seen) { return counted(q, p, seen); },
                       q.visible == 0 || q.hide == by_mask || q.hide == by_blend});
    }
  }
  return cases;
}

}  // namespace halfspace::conformance
