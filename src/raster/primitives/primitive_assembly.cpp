// SPDX-License-Identifier: Apache-2.0
#include "halfspace/raster/primitives/primitive_assembly.h"

#include <algorithm>

namespace halfspace::HS_LANES {

namespace {

// Returns the number of primitives that n indices form.
std::size_t primitives_of(Topology topology, std::size_t n) {
  switch (topology) {
    case Topology::points: return n;
    case Topology::lines: return n / 2;
    case Topology::line_strip: return n < 2 ? 0 : n - 1;
    case Topology::line_loop: return n < 2 ? 0 : n;
    case Topology::triangles: return n / 3;
    case Topology::triangle_strip:
    case Topology::triangle_fan: return n < 3 ? 0 : n - 2;
  }
  return 0;
}

}  // namespace

void count_primitives(Draw& d) {
  std::size_t primitives = 0, begin = 0;
  const auto add = [&](std::size_t end) {
    const std::size_t n = primitives_of(d.state.topology, end - begin);
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
  const Indices& list = *draw_.indices;
  const auto at = [&](uint32_t place) { return list[std::size_t{first_index_} + place]; };
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
    case Topology::triangle_strip:
      if (i % 2 == 0) return {at(i), at(i + 1), at(i + 2)};
      if (first_provokes) return {at(i), at(i + 2), at(i + 1)};
      return {at(i + 1), at(i), at(i + 2)};
    case Topology::triangle_fan:
      if (first_provokes) return {at(i + 1), at(i + 2), at(0)};
      return {at(0), at(i + 1), at(i + 2)};
  }
  return {};
}

}  // namespace halfspace::HS_LANES
