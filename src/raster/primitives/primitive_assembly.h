// SPDX-License-Identifier: Apache-2.0
//
// Primitive assembly. Input: the index list of a draw. Output: the three indices of each triangle in the order of OpenGL 4.6, table 13.2.
// The provoking vertex is the first or the last of them, depending on the state. A point has the same index three times, and a line has its
// second index twice.
#pragma once

#include <array>
#include <optional>
#include <utility>

#include "halfspace/raster/pipeline/pass_context.h"
#include "halfspace/shading/tessellation_stage.h"

namespace halfspace::HS_LANES {

/// Sets d.primitive_count and d.runs.
void count_primitives(Draw& d);

/// Returns the places of the vertices of triangle i in a strip (OpenGL 4.6, table 13.2).
constexpr std::array<uint32_t, 3> strip_triangle(uint32_t i, bool first_provokes) {
  if (i % 2 == 0) return {i, i + 1, i + 2};
  if (first_provokes) return {i, i + 2, i + 1};
  return {i + 1, i, i + 2};
}

/// Iterates over the primitives of a draw.
class Assembly {
 public:
  /// Starts at the given primitive, which must be less than d.primitive_count.
  Assembly(const Draw& d, uint32_t primitive)
      : draw_(d), topology_(d.state.topology), fast_path_(topology_ == Topology::triangles && d.runs.empty()) {
    begin_run(primitive);
  }

  /// Returns the indices of the next primitive.
  HS_INLINE std::array<uint32_t, 3> next() {
    const Indices& list = *draw_.indices;
    if (fast_path_) {
      const std::size_t at = std::size_t{primitive_++} * 3;
      return {list[at], list[at + 1], list[at + 2]};
    }
    return next_of_run();
  }

  /// Returns the indices of the next primitive, with those of adjacent vertices if the topology has them: four for a line, six for a
  /// triangle, in the order of OpenGL 4.6, section 10.1. Otherwise the same as next(), in the first elements.
  std::array<uint32_t, 6> next_with_adjacency();

  /// Returns the indices of the next patch, in the first elements.
  std::array<uint32_t, kMaxPatchVertices> next_patch();

  /// Returns the 3·count indices of the next `count` triangles if they are contiguous in a list of 32-bit indices, and skips the triangles.
  /// Otherwise returns null and skips nothing.
  const uint32_t* next_list(uint32_t count) {
    const uint32_t* indices = fast_path_ ? draw_.indices->words(std::size_t{primitive_} * 3) : nullptr;
    if (indices != nullptr) primitive_ += count;
    return indices;
  }

  /// Returns the first index of the next `count` triangles if the draw has no index list, and skips the triangles. Otherwise returns
  /// nullopt and skips nothing.
  std::optional<uint32_t> next_sequence(uint32_t count) {
    if (!fast_path_ || !draw_.indices->is_sequential()) return std::nullopt;
    return draw_.indices->first_vertex() + 3 * std::exchange(primitive_, primitive_ + count);
  }

 private:
  void begin_run(uint32_t primitive);
  std::array<uint32_t, 3> next_of_run();
  /// Returns the indices of primitive i of the run and of its neighbors. The topology must have adjacency.
  std::array<uint32_t, 6> adjacent(uint32_t i) const;
  uint32_t index_at(uint32_t place) const { return (*draw_.indices)[std::size_t{first_index_} + place]; }

  const Draw& draw_;
  Topology topology_;
  bool fast_path_;            ///< a triangle list without restarts
  uint32_t primitive_ = 0;    ///< next primitive, relative to the start of the run
  uint32_t first_index_ = 0;  ///< start of the run in the index list
  uint32_t run_ = 0;
  uint32_t run_end_ = 0;  ///< number of primitives in the run
};

}  // namespace halfspace::HS_LANES
