// SPDX-License-Identifier: Apache-2.0
//
// Vertices and primitives that the emitting stages of a draw have created, in the order of its primitives.
#pragma once

#include <algorithm>
#include <vector>

#include "halfspace/core/cache_line_allocator.h"
#include "halfspace/core/parallel.h"
#include "halfspace/raster/draw_state.h"

namespace halfspace::HS_LANES {

struct EmittedPrimitives {
  CacheLineVector<float> rows;                  ///< one row per vertex, as in EmittedStrips
  std::size_t row = 0;                          ///< values per row
  Topology topology = Topology::points;         ///< points, lines or triangles
  CacheLineVector<uint32_t> indices;            ///< one, two or three per primitive
  CacheLineVector<int32_t> numbers, instances;  ///< of the submitted primitive or patch that each primitive comes from

  std::size_t vertex_count() const { return rows.size() / row; }
  std::size_t vertices_per_primitive() const { return topology == Topology::points ? 1 : topology == Topology::lines ? 2 : 3; }
  std::size_t primitive_count() const { return indices.size() / vertices_per_primitive(); }
};

/// Joins parts whose rows have the same size, in order.
EmittedPrimitives joined(std::vector<EmittedPrimitives> parts, std::size_t row, Topology topology, const Workers& workers);

/// Calls f(begin, end) -> EmittedPrimitives for parts of [0, count) of the given size in parallel, and returns all of them in order.
template <class F>
EmittedPrimitives emit_in_parts(const Workers& workers, std::size_t count, std::size_t size, std::size_t row, Topology topology,
                                const F& f) {
  std::vector<EmittedPrimitives> parts((count + size - 1) / size);
  workers.for_each(static_cast<int>(parts.size()), [&](int i) {
    const std::size_t begin = static_cast<std::size_t>(i) * size;
    parts[static_cast<std::size_t>(i)] = f(begin, std::min(begin + size, count));
  });
  return joined(std::move(parts), row, topology, workers);
}

}  // namespace halfspace::HS_LANES
