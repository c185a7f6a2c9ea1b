// SPDX-License-Identifier: Apache-2.0
//
// Vertices and primitives that the emitting stages of a draw have created, in the order of its primitives.
#pragma once

#include <vector>

#include "halfspace/core/parallel.h"
#include "halfspace/raster/draw_state.h"

namespace halfspace::HS_LANES {

struct EmittedPrimitives {
  std::vector<float> rows;                  ///< one row per vertex, as in EmittedStrips
  std::size_t row = 0;                      ///< values per row
  Topology topology = Topology::points;     ///< points, lines or triangles
  std::vector<uint32_t> indices;            ///< one, two or three per primitive
  std::vector<int32_t> numbers, instances;  ///< of the submitted primitive or patch that each primitive comes from

  std::size_t vertex_count() const { return rows.size() / row; }
  std::size_t vertices_per_primitive() const { return topology == Topology::points ? 1 : topology == Topology::lines ? 2 : 3; }
  std::size_t primitive_count() const { return indices.size() / vertices_per_primitive(); }

  /// Appends the primitives of another object with rows of the same size, and releases its memory.
  void append(EmittedPrimitives&& o);
};

/// Calls f(begin, end) -> EmittedPrimitives for parts of [0, count) of the given size in parallel, and returns all of them in order.
template <class F>
EmittedPrimitives emit_in_parts(const Workers& workers, std::size_t count, std::size_t size, std::size_t row, Topology topology,
                                const F& f) {
  std::vector<EmittedPrimitives> parts((count + size - 1) / size);
  workers.for_each(static_cast<int>(parts.size()), [&](int i) {
    const std::size_t begin = static_cast<std::size_t>(i) * size;
    parts[static_cast<std::size_t>(i)] = f(begin, std::min(begin + size, count));
  });
  EmittedPrimitives all{.rows = {}, .row = row, .topology = topology, .indices = {}, .numbers = {}, .instances = {}};
  std::size_t values = 0, indices = 0;
  for (const EmittedPrimitives& part : parts) values += part.rows.size(), indices += part.indices.size();
  all.rows.reserve(values);
  all.indices.reserve(indices);
  for (EmittedPrimitives& part : parts) all.append(std::move(part));
  return all;
}

}  // namespace halfspace::HS_LANES
