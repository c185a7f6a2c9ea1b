// SPDX-License-Identifier: Apache-2.0
#include "halfspace/raster/primitives/primitive_assembly.h"

#include <algorithm>

namespace halfspace::HS_LANES {

namespace {

// Returns the number of primitives that n indices form.
std::size_t primitives_of(Topology topology, std::size_t n, std::size_t patch_vertices) {
  switch (topology) {
    case Topology::points: return n;
    case Topology::lines: return n / 2;
    case Topology::line_strip: return n < 2 ? 0 : n - 1;
    case Topology::line_loop: return n < 2 ? 0 : n;
    case Topology::triangles: return n / 3;
    case Topology::triangle_strip:
    case Topology::triangle_fan: return n < 3 ? 0 : n - 2;
    case Topology::lines_adjacency: return n / 4;
    case Topology::line_strip_adjacency: return n < 4 ? 0 : n - 3;
    case Topology::triangles_adjacency: return n / 6;
    case Topology::triangle_strip_adjacency: return n < 6 ? 0 : n / 2 - 2;
    case Topology::patches: return n / patch_vertices;
  }
  return 0;
}

}  // namespace

void count_primitives(Draw& d) {
  std::size_t primitives = 0, begin = 0;
  const auto add = [&](std::size_t end) {
    const std::size_t n = primitives_of(d.state.topology, end - begin, static_cast<std::size_t>(d.kernels.patch_vertices));
    if (n != 0 && !d.indices->restarts().empty()) d.runs.push_back({static_cast<uint32_t>(primitives), static_cast<uint32_t>(begin)});
    primitives += n;
    begin = end + 1;
  };
  for (const uint32_t restart : d.indices->restarts()) add(restart);
  add(d.indices->size());
  HS_CHECK_OP(primitives, <, std::size_t{1} << 32, "Pass::draw: too many primitives; expected fewer than 2^32");
  d.primitive_count = static_cast<uint32_t>(primitives);
}

void Assembly::begin_run(uint32_t primitive) {
  primitive_ = primitive;
  run_end_ = draw_.primitive_count;
  if (draw_.runs.empty()) return;
  const auto after = std::upper_bound(draw_.runs.begin(), draw_.runs.end(), primitive,
                                      [](uint32_t p, const IndexRun& run) { return p < run.first_primitive; });
  run_ = static_cast<uint32_t>(after - draw_.runs.begin()) - 1;
  const uint32_t end = after == draw_.runs.end() ? draw_.primitive_count : after->first_primitive;
  first_index_ = draw_.runs[run_].first_index;
  primitive_ = primitive - draw_.runs[run_].first_primitive;
  run_end_ = end - draw_.runs[run_].first_primitive;
}

std::array<uint32_t, 3> Assembly::next_of_run() {
  if (primitive_ == run_end_) begin_run(draw_.runs[run_ + 1].first_primitive);
  const uint32_t i = primitive_++;
  const auto at = [&](uint32_t place) { return index_at(place); };
  const bool first_provokes = draw_.state.provoking == ProvokingVertex::first;
  switch (topology_) {
    case Topology::points: return {at(i), at(i), at(i)};
    case Topology::lines: return {at(2 * i), at(2 * i + 1), at(2 * i + 1)};
    case Topology::line_strip: return {at(i), at(i + 1), at(i + 1)};
    case Topology::line_loop: {
      const uint32_t next = i + 1 == run_end_ ? 0 : i + 1;
      return {at(i), at(next), at(next)};
    }
    case Topology::triangles: return {at(3 * i), at(3 * i + 1), at(3 * i + 2)};
    case Topology::triangle_strip: {
      const std::array<uint32_t, 3> places = strip_triangle(i, first_provokes);
      return {at(places[0]), at(places[1]), at(places[2])};
    }
    case Topology::triangle_fan:
      if (first_provokes) return {at(i + 1), at(i + 2), at(0)};
      return {at(0), at(i + 1), at(i + 2)};
    case Topology::lines_adjacency:
    case Topology::line_strip_adjacency: {
      const std::array<uint32_t, 6> v = adjacent(i);
      return {v[1], v[2], v[2]};
    }
    case Topology::triangles_adjacency:
    case Topology::triangle_strip_adjacency: {
      const std::array<uint32_t, 6> v = adjacent(i);
      return {v[0], v[2], v[4]};
    }
    case Topology::patches: break;  // see next_patch()
  }
  return {};
}

std::array<uint32_t, 6> Assembly::next_with_adjacency() {
  if (has_adjacency(topology_)) {
    if (primitive_ == run_end_) begin_run(draw_.runs[run_ + 1].first_primitive);
    return adjacent(primitive_++);
  }
  const std::array<uint32_t, 3> v = next();
  return {v[0], v[1], v[2]};
}

std::array<uint32_t, kMaxPatchVertices> Assembly::next_patch() {
  if (primitive_ == run_end_) begin_run(draw_.runs[run_ + 1].first_primitive);
  const auto n = static_cast<uint32_t>(draw_.kernels.patch_vertices);
  const uint32_t first = primitive_++ * n;
  std::array<uint32_t, kMaxPatchVertices> out{};
  for (uint32_t v = 0; v < n; ++v) out[v] = index_at(first + v);
  return out;
}

std::array<uint32_t, 6> Assembly::adjacent(uint32_t i) const {
  const auto at = [&](uint32_t place) { return index_at(place); };
  switch (topology_) {
    case Topology::lines_adjacency: return {at(4 * i), at(4 * i + 1), at(4 * i + 2), at(4 * i + 3)};
    case Topology::line_strip_adjacency: return {at(i), at(i + 1), at(i + 2), at(i + 3)};
    case Topology::triangles_adjacency: return {at(6 * i), at(6 * i + 1), at(6 * i + 2), at(6 * i + 3), at(6 * i + 4), at(6 * i + 5)};
    default: break;
  }
  // A strip of triangles (OpenGL 4.6, table 10.1; places count from 0 here, from 1 there). The corners of triangle i are the even places
  // 2i, 2i + 2 and 2i + 4, of which odd triangles swap two, as in a strip without adjacency. The neighbor at the edge to the preceding
  // triangle is its first corner, and the one at the edge to the next triangle is its last corner.
  const uint32_t p = 2 * i;
  const bool is_last = i + 1 == run_end_;
  const uint32_t preceding = i == 0 ? at(1) : at(p - 2), next = at(is_last ? p + 5 : p + 6), outer = at(p + 3);
  if (i % 2 == 0) return {at(p), preceding, at(p + 2), next, at(p + 4), outer};
  if (draw_.state.provoking == ProvokingVertex::first) return {at(p), outer, at(p + 4), next, at(p + 2), preceding};
  return {at(p + 2), preceding, at(p), outer, at(p + 4), next};
}

}  // namespace halfspace::HS_LANES
