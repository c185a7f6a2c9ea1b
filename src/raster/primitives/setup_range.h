// SPDX-License-Identifier: Apache-2.0
//
// Input of setup for one draw range, and the functions that append triangles, count culled primitives and record primitive numbers.
#pragma once

#include "halfspace/raster/pipeline/pass_context.h"
#include "halfspace/raster/primitives/primitive_assembly.h"
#include "halfspace/raster/primitives/setup_scalar.h"

namespace halfspace::HS_LANES {

/// Vertex slots of a primitive, in the order of its indices. A point has the same slot three times, and a line has its second slot twice.
using PrimitiveSlots = std::array<uint32_t, 3>;

struct SetupRange {
  const PassContext& context;
  Chunk& chunk;
  uint32_t range;  ///< index in chunk.ranges
  const Draw& draw;
  const ShadedVertices& shaded;
  Assembly assembly;  ///< the remaining primitives
  uint32_t instance;
  uint32_t slot_base;       ///< slot of a vertex = its index − slot_base (modulo 2^32)
  uint32_t first_number;    ///< number of the first primitive of the range in the draw
  bool records_primitives;  ///< see needs_primitive_numbers()

  SetupRange(const PassContext& context_, Chunk& chunk_, uint32_t range_)
      : context(context_),
        chunk(chunk_),
        range(range_),
        draw(context_.draws[chunk_.ranges[range_].draw]),
        shaded(context_.shaded[chunk_.ranges[range_].draw]),
        assembly(draw, chunk_.ranges[range_].first),
        instance(chunk_.ranges[range_].instance),
        slot_base(shaded.first - instance * shaded.count),
        first_number(chunk_.ranges[range_].first),
        records_primitives(needs_primitive_numbers(context_, draw)) {}

  PrimitiveSlots next_slots() {
    PrimitiveSlots slots = assembly.next();
    for (uint32_t& s : slots) s -= slot_base;
    return slots;
  }

  /// Returns the position of the provoking vertex among the three indices of a primitive.
  uint32_t provoking() const { return draw.state.provoking == ProvokingVertex::first ? 0 : 2; }

  const float* distances_of(uint32_t slot) const {
    return shaded.distances.get() + std::size_t{slot} * static_cast<std::size_t>(shaded.distance_count());
  }
  /// Returns a bit mask of the distances that are negative at a vertex. A primitive is culled if one of them is at all its vertices.
  uint32_t beyond_distances(uint32_t slot) const {
    uint32_t beyond = 0;
    for (int k = 0; k < shaded.distance_count(); ++k) {
      if (!(distances_of(slot)[k] >= 0.0f)) beyond |= 1u << k;
    }
    return beyond;
  }
  /// Returns true if a distance for which a vertex is outside is a clip distance.
  bool is_clipped_by(uint32_t beyond) const { return (beyond & ((1u << shaded.clip_distance_count) - 1)) != 0; }

  const ScreenVertex& clip_vertex(uint32_t index) const { return chunk.clip_vertices[index].screen; }

  /// Counts n primitives that were culled for the given reason.
  void count(Cull why, uint64_t n = 1) const {
    PassStatistics& s = chunk.statistics;
    if (why == Cull::degenerate) s.culled_degenerate += n;
    if (why == Cull::face) s.culled_face += n;
    if (why == Cull::no_sample) s.culled_no_sample += n;
  }

  /// Must be called after primitive i of the range is set up. Records its number for the triangles that were appended.
  void record_primitive(uint32_t i) const {
    if (records_primitives) chunk.primitive_numbers.resize(chunk.triangles.size(), first_number + i);
  }

  /// Sets up a triangle with set_up_triangle() and appends it, unless it is culled. Returns the reason if it is.
  Cull append_triangle(const std::array<const ScreenVertex*, 3>& v, const std::array<uint32_t, 3>& index, uint32_t flags,
                       uint32_t provoking, Facing facing) const {
    Triangle t;
    const Cull why = set_up_triangle(draw, context, v, index, provoking, facing, t);
    return append(why, t, flags);
  }
  /// The same for three clip vertices.
  Cull append_clip_triangle(const std::array<uint32_t, 3>& index, Facing facing) const {
    return append_triangle({&clip_vertex(index[0]), &clip_vertex(index[1]), &clip_vertex(index[2])}, index, kClipped, 0, facing);
  }

  /// Appends a primitive with additional flags, unless it is culled. Returns why.
  Cull append(Cull why, Triangle& t, uint32_t flags) const {
    if (why != Cull::none) return why;
    t.flags |= flags | range << kDrawRangeShift;
    chunk.triangles.push_back(t);
    return Cull::none;
  }
};

}  // namespace halfspace::HS_LANES
