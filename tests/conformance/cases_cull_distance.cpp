// SPDX-License-Identifier: Apache-2.0
//
// Cases of cull distances, after the group cull_distance of VK-GL-CTS (KHR-GL45). The truth is the same draw without the primitives of
// which one distance is negative at all vertices.
#include <array>
#include <utility>

#include "conformance/geometry.h"
#include "conformance/groups.h"

namespace halfspace::conformance {

namespace {

// Which distances are negative. Lines and triangles are culled only in the first, second and last case.
enum class Negative : uint8_t { all_of_first, all_of_second, one_vertex, different_ones, never, all_and_clipped };
constexpr std::pair<const char*, Negative> kNegatives[] = {{"all_of_first", Negative::all_of_first},
                                                           {"all_of_second", Negative::all_of_second},
                                                           {"one_vertex", Negative::one_vertex},
                                                           {"different_ones", Negative::different_ones},
                                                           {"never", Negative::never},
                                                           {"all_and_clipped", Negative::all_and_clipped}};

constexpr std::pair<const char*, Topology> kCulledTopologies[] = {{"points", Topology::points},
                                                                  {"lines", Topology::lines},
                                                                  {"line_strip", Topology::line_strip},
                                                                  {"triangles", Topology::triangles},
                                                                  {"triangle_strip", Topology::triangle_strip},
                                                                  {"triangle_fan", Topology::triangle_fan}};

// The vertices in the lower half of the list, which form whole primitives of a list, have negative distances.
Picture culled(Topology topology, Negative negative, int samples) {
  Picture p;
  p.samples = samples;
  Drawing d;
  d.kind = Kind::cull;
  d.state.topology = topology;
  d.state.depth.test = false;
  d.vertices = scattered(p, 24, 61, true);
  for (std::size_t i = 0; i < d.vertices.size(); ++i) {
    const float outside = i < 12 ? -0.5f : 0.25f;
    glm::vec4& e = d.vertices[i].extra;  // two clip distances, two cull distances
    e = glm::vec4(1.0f);
    if (negative == Negative::all_of_first || negative == Negative::all_and_clipped) e.z = outside;
    if (negative == Negative::all_of_second) e.w = outside;
    if (negative == Negative::one_vertex && i % 3 == 0) e.z = outside;
    if (negative == Negative::different_ones) (i % 2 == 0 ? e.z : e.w) = outside;
    if (negative == Negative::all_and_clipped) e.x = i % 2 == 0 ? 1.0f : -1.0f;
  }
  p.draws.push_back(std::move(d));
  return p;
}

std::string without_culled(const Picture& p, const Seen& seen) {
  const Drawing& d = p.draws[0];
  Picture plain = p;
  Drawing& list = plain.draws[0];
  list.vertices.clear();
  const bool points = d.state.topology == Topology::points;
  list.state.topology = points ? Topology::points : is_lines(d.state.topology) ? Topology::lines : Topology::triangles;
  const auto add = [&](const std::array<uint32_t, 3>& vertex, std::size_t count) {
    for (int k = 2; k < 4; ++k) {
      bool is_culled = true;
      for (std::size_t i = 0; i < count; ++i) is_culled &= d.vertices[vertex[i]].extra[k] < 0.0f;
      if (is_culled) return;
    }
    for (std::size_t i = 0; i < count; ++i) {
      list.vertices.push_back(d.vertices[vertex[i]]);
      list.vertices.back().extra.z = list.vertices.back().extra.w = 1.0f;
    }
  };
  if (points) {
    for (uint32_t i = 0; i < d.vertices.size(); ++i) add({i, i, i}, 1);
  } else {
    for (const Assembled& a : assembled(d)) add(a.vertex, is_lines(d.state.topology) ? 2 : 3);
  }
  const Seen expected = draw(plain);
  return for_each_pixel(seen, [&](int x, int y) { return expect_near(glm::dvec4(expected.color(x, y)), seen.color(x, y), 0.0); });
}

}  // namespace

Cases cull_distance_cases() {
  Cases cases;
  for (const auto& [name, topology] : kCulledTopologies) {
    for (const auto& [which, negative] : kNegatives) {
      for (const int samples : {1, 4}) {
        cases.push_back({std::string("functional_") + name + "_" + which + (samples == 1 ? "" : "_multisample"),
                         [=, t = topology, n = negative] { return culled(t, n, samples); }, without_culled});
      }
    }
  }
  return cases;
}

}  // namespace halfspace::conformance
