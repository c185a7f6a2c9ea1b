// SPDX-License-Identifier: Apache-2.0
//
// Primitive assembly. In: a draw's index list. Out: the three indices of each triangle, in the order in which they count as
// submitted: the provoking vertex is the first or the last of them, as the state says (OpenGL 4.6, table 13.2). A point has
// its one index thrice, a line its second twice.
#pragma once

#include <array>
#include <optional>
#include <utility>

#include "halfspace/raster/pipeline/pass_context.h"

namespace halfspace {

/// Sets d.primitive_count and d.runs from its indices and topology.
void count_primitives(Draw& d);

/// Walks over a draw's primitives.
class Assembly {
 public:
  /// Begins at a primitive below d.primitive_count.
  Assembly(const Draw& d, uint32_t primitive)
      : draw_(d), topology_(d.state.topology), plain_list_(topology_ == Topology::triangles && d.runs.empty()) {
    begin_run(primitive);
  }

  /// The indices of the next primitive.
  HS_INLINE std::array<uint32_t, 3> next() {
    const Indices& list = *draw_.indices;
    if (plain_list_) {
      const std::size_t at = std::size_t{primitive_++} * 3;
      return {list[at], list[at + 1], list[at + 2]};
    }
    return next_of_run();
  }

  /// The 3·count indices of the next `count` triangles where they lie side by side, and past these; else null, and nothing is passed.
  const uint32_t* next_list(uint32_t count) {
    const uint32_t* indices = plain_list_ ? draw_.indices->words(std::size_t{primitive_} * 3) : nullptr;
    if (indices != nullptr) primitive_ += count;
    return indices;
  }

  /// The first index of the next `count` triangles where index i of the draw is i, and past these; else none, and nothing is passed.
  std::optional<uint32_t> next_sequence(uint32_t count) {
    if (!plain_list_ || !draw_.indices->is_sequential()) return std::nullopt;
    return 3 * std::exchange(primitive_, primitive_ + count);
  }

 private:
  void begin_run(uint32_t primitive);
  std::array<uint32_t, 3> next_of_run();

  const Draw& draw_;
  Topology topology_;
  bool plain_list_;           ///< of triangles, without a restart
  uint32_t primitive_ = 0;    ///< the next one, counted from the run's first
  uint32_t first_index_ = 0;  ///< of the run
  uint32_t run_ = 0;
  uint32_t run_end_ = 0;  ///< primitives of the run
};

}  // namespace halfspace
