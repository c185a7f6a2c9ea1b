// SPDX-License-Identifier: Apache-2.0
//
// Cases of viewport arrays, after the group viewport_array of VK-GL-CTS (KHR-GL45). The truth draws each primitive on its own, in order,
// with the viewport, scissor and depth range of its provoking vertex.
#include <memory>
#include <utility>

#include "conformance/geometry.h"
#include "conformance/groups.h"

namespace halfspace::conformance {

namespace {

constexpr int kCount = static_cast<int>(kMaxViewports);
constexpr int kVertices = 48;

enum class Place : uint8_t { grid, overlapping, fractional, upside_down, upper_left, scissor, depth_range, out_of_range };
constexpr std::pair<const char*, Place> kPlaces[] = {{"grid", Place::grid},
                                                     {"overlapping", Place::overlapping},
                                                     {"fractional", Place::fractional},
                                                     {"upside_down", Place::upside_down},
                                                     {"upper_left", Place::upper_left},
                                                     {"scissor", Place::scissor},
                                                     {"depth_range", Place::depth_range},
                                                     {"out_of_range", Place::out_of_range}};

// Returns viewport i of 16, in a picture of 32 x 32 pixels.
IndexedViewport viewport_of(Place place, int i) {
  const auto n = static_cast<float>(i);
  const Rect cell{i % 4 * 8, i / 4 * 8, 8, 8};
  switch (place) {
    case Place::overlapping: return {.viewport = Rect{i, i * 3 % 13, 18, 18}};
    // Multiples of 1/256 px, so that the viewports are not rounded.
    case Place::fractional: return {.viewport = ViewportRect{n * 1.1875f, 20.5f - n * 1.25f, 9.25f + n * 0.28125f, 11.00390625f}};
    case Place::upside_down: return {.viewport = ViewportRect(static_cast<float>(cell.x), static_cast<float>(cell.y + 8), 8.0f, -8.0f)};
    case Place::scissor: return {.scissor = Rect{i, 15 - i, 16, 16}};
    case Place::depth_range:
      return {.viewport = Rect{i % 4, i / 4, 24, 24}, .range_near = n / 16.0f, .range_far = i % 3 == 0 ? 0.0f : 1.0f};
    case Place::grid:
    case Place::upper_left:
    case Place::out_of_range: break;
  }
  return {.viewport = cell};
}

Picture in_viewports(Topology topology, Place place, ProvokingVertex provoking, int samples) {
  Picture p;
  p.samples = samples;
  auto viewports = std::make_shared<ViewportArray>();
  for (int i = 0; i < kCount; ++i) viewports->push_back(viewport_of(place, i));
  Drawing d;
  d.kind = Kind::viewport;
  d.viewports = std::move(viewports);
  d.state.viewports = d.viewports.get();
  d.state.topology = topology;
  d.state.provoking = provoking;
  if (place == Place::upper_left) d.state.clip_origin = ClipOrigin::upper_left;
  d.vertices = scattered(p, kVertices, 71, topology != Topology::points);
  for (int i = 0; i < kVertices; ++i) {
    // Neighbors are in different viewports, and the provoking vertices of each topology are in all of them.
    const int number = i * 2 + i / 3, viewport = place == Place::out_of_range ? number % (kCount + 2) - 1 : number % kCount;
    d.vertices[static_cast<std::size_t>(i)].extra.x = static_cast<float>(viewport);
  }
  p.draws.push_back(std::move(d));
  return p;
}

std::string one_by_one(const Picture& p, const Seen& seen) {
  const Drawing& all = p.draws[0];
  const Topology topology = all.state.topology;
  Picture alone = p;
  alone.draws.clear();
  const auto add = [&](const std::array<uint32_t, 3>& vertex, std::size_t count, uint32_t provoking) {
    const int index = static_cast<int>(all.vertices[provoking].extra.x);
    if (index < 0 || index >= kCount) return;
    const IndexedViewport& viewport = (*all.viewports)[static_cast<std::size_t>(index)];
    Drawing one;
    one.kind = Kind::color;
    one.state = all.state;
    one.state.topology = topology == Topology::points ? Topology::points : is_lines(topology) ? Topology::lines : Topology::triangles;
    one.state.viewports = nullptr;
    one.state.viewport = viewport.viewport;
    one.state.scissor = viewport.scissor;
    one.state.depth.range_near = viewport.range_near;
    one.state.depth.range_far = viewport.range_far;
    one.state.point_size = 3.0f;
    for (std::size_t i = 0; i < count; ++i) one.vertices.push_back(all.vertices[vertex[i]]);
    alone.draws.push_back(std::move(one));
  };
  if (topology == Topology::points) {
    for (uint32_t i = 0; i < all.vertices.size(); ++i) add({i, i, i}, 1, i);
  } else {
    for (const Assembled& a : assembled(all)) add(a.vertex, is_lines(topology) ? 2 : 3, a.provoking);
  }
  const Seen expected = draw(alone);
  return for_each_pixel(seen, [&](int x, int y) {
    if (expected.depth(x, y) != seen.depth(x, y)) return std::string("another depth than that of the primitives on their own");
    return expect_near(glm::dvec4(expected.color(x, y)), seen.color(x, y), 0.0);
  });
}

// Returns the reason why Mesa does not draw a case, or null.
const char* not_by_mesa(Topology topology, Place place, ProvokingVertex provoking) {
  if (place == Place::out_of_range) return "OpenGL does not define viewports that do not exist";
  if (place == Place::upside_down) return "OpenGL has no viewports with a negative height";
  if (topology == Topology::points) return "OpenGL does not cut the squares of points at the sides of the viewport";
  // GL_VIEWPORT_INDEX_PROVOKING_VERTEX is for the implementation to choose.
  return provoking == ProvokingVertex::last ? "llvmpipe always takes the viewport of the first vertex" : nullptr;
}

struct Shape {
  const char* name;
  Topology topology;
  ProvokingVertex provoking = ProvokingVertex::last;
};
constexpr Shape kShapes[] = {{"points", Topology::points},
                             {"lines", Topology::lines},
                             {"line_strip", Topology::line_strip},
                             {"line_strip_first", Topology::line_strip, ProvokingVertex::first},
                             {"triangles", Topology::triangles},
                             {"triangles_first", Topology::triangles, ProvokingVertex::first},
                             {"triangle_strip", Topology::triangle_strip},
                             {"triangle_strip_first", Topology::triangle_strip, ProvokingVertex::first},
                             {"triangle_fan", Topology::triangle_fan}};

}  // namespace

Cases viewport_array_cases() {
  Cases cases;
  for (const Shape& shape : kShapes) {
    for (const auto& [name, place] : kPlaces) {
      for (const int samples : {1, 4}) {
        cases.push_back({std::string(shape.name) + "_" + name + (samples == 1 ? "" : "_multisample"),
                         [=, to = place] { return in_viewports(shape.topology, to, shape.provoking, samples); }, one_by_one, false,
                         not_by_mesa(shape.topology, place, shape.provoking)});
      }
    }
  }
  return cases;
}

}  // namespace halfspace::conformance
