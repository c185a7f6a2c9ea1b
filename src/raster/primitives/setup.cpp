// SPDX-License-Identifier: Apache-2.0
#include "halfspace/raster/primitives/setup.h"

#include <algorithm>
#include <bit>

#include "halfspace/raster/primitives/append_lines.h"
#include "halfspace/raster/primitives/clip.h"
#include "halfspace/raster/primitives/setup_clipped.h"
#include "halfspace/raster/primitives/setup_lines.h"
#include "halfspace/raster/primitives/setup_points.h"
#include "halfspace/raster/primitives/setup_range.h"
#include "halfspace/raster/primitives/setup_simd.h"

namespace halfspace::HS_LANES {

namespace {

// Sets up the triangles of one draw range.
class TriangleSetup {
 public:
  explicit TriangleSetup(SetupRange& range)
      : range_(range), draw_(range.draw), shaded_(range.shaded), chunk_(range.chunk), appends_outlines_(can_append_outlines(range)) {}

  // Submits the next `count` triangles, one by one or W at a time.
  void submit(uint32_t count) {
    for (uint32_t i = 0; i < count; ++i) {
      submit_triangle(range_.next_slots());
      range_.record_primitive(i);
    }
  }
  void submit_batches(uint32_t count) {
    for (uint32_t i = 0; i < count; i += kLanes) submit_batch(i, static_cast<int>(std::min<uint32_t>(kLanes, count - i)));
  }

 private:
  // Submits the next `count` triangles, at most W. first_triangle: number of the first one in the range.
  void submit_batch(uint32_t first_triangle, int count) {
    const uint32_t unclipped = put_triangles(count);
    batch_.set_up(range_.context, draw_, shaded_, unclipped, range_.provoking(), range_.range, chunk_.statistics);
    const uint32_t single = (bits(first_lanes<Mask>(count)) & ~unclipped) | batch_.large();  // lanes that are set up individually
    if (single == 0 && batch_.kept() == 0) return;
    if (single == 0 && !range_.records_primitives) {
      const std::size_t first = chunk_.triangles.size();
      chunk_.triangles.resize(first + static_cast<std::size_t>(std::popcount(batch_.kept())));
      return batch_.write(&chunk_.triangles[first]);
    }
    std::array<Triangle, kLanes> triangles;  // triangles kept by the batch
    if (batch_.kept() != 0) batch_.write(triangles.data());
    const Triangle* next = triangles.data();
    for (uint32_t rest = single | batch_.kept(); rest != 0; rest &= rest - 1) {
      const int i = std::countr_zero(rest);
      if ((single >> i & 1) != 0) {
        submit_triangle(batch_.slots(i));
      } else {
        chunk_.triangles.push_back(*next++);
      }
      range_.record_primitive(first_triangle + static_cast<uint32_t>(i));
    }
  }

  // Adds the next triangles to the batch. Returns the lanes that need no clipping.
  uint32_t put_triangles(int count) {
    if (shaded_.any_outcode == 0 && put_without_lookup(count)) return bits(first_lanes<Mask>(count));
    uint32_t unclipped = 0;
    PrimitiveSlots slots{};
    for (int i = 0; i < count; ++i) {
      slots = range_.next_slots();
      const Outcode any = shaded_.outcodes[slots[0]] | shaded_.outcodes[slots[1]] | shaded_.outcodes[slots[2]];
      const Outcode all = shaded_.outcodes[slots[0]] & shaded_.outcodes[slots[1]] & shaded_.outcodes[slots[2]];
      if ((any & (kOutNonFinite | kOutNeedsClip)) == 0 && (all & kOutView) == 0) unclipped |= 1u << i;
      batch_.put(i, slots);
    }
    for (int i = count; i < kLanes; ++i) batch_.put(i, slots);
    return unclipped;
  }

  // Adds the next triangles to the batch without looking up each index. Returns false if the index list does not allow this.
  bool put_without_lookup(int count) {
    if (const uint32_t* list = range_.assembly.next_list(static_cast<uint32_t>(count))) {
      batch_.put_list(list, count, range_.slot_base);
      return true;
    }
    const std::optional<uint32_t> first = range_.assembly.next_sequence(static_cast<uint32_t>(count));
    if (first) batch_.put_sequence(*first, count, range_.slot_base);
    return first.has_value();
  }

  void submit_triangle(const PrimitiveSlots& id) {
    Outcode any = 0;
    Outcode all = kOutView;
    for (const uint32_t i : id) {
      any |= shaded_.outcodes[i];
      all &= shaded_.outcodes[i];
    }
    if (any & kOutNonFinite) {
      ++chunk_.statistics.culled_non_finite;
    } else if (all) {
      ++chunk_.statistics.culled_outside;
    } else if ((any & kOutNeedsClip) != 0 || shaded_.distance_count() != 0 || draw_.state.polygon_mode != PolygonMode::fill) {
      submit_triangle_slowly(id, any);
    } else {
      append_whole(id);
    }
  }

  void submit_triangle_slowly(const PrimitiveSlots& id, Outcode any) {
    const uint32_t a = range_.beyond_distances(id[0]), b = range_.beyond_distances(id[1]), c = range_.beyond_distances(id[2]);
    const bool is_cut = (any & kOutNeedsClip) != 0 || range_.is_clipped_by(a | b | c);
    if ((a & b & c) != 0) {
      ++chunk_.statistics.culled_outside;
    } else if (!is_cut && appends_outlines_) {
      append_outline(range_, id);
    } else if (is_cut || draw_.state.polygon_mode != PolygonMode::fill) {
      set_up_clipped(range_, id, clip_triangle, is_cut);
    } else {
      append_whole(id);
    }
  }

  void append_whole(const PrimitiveSlots& id) {
    const std::array<const ScreenVertex*, 3> v{&shaded_.screen[id[0]], &shaded_.screen[id[1]], &shaded_.screen[id[2]]};
    range_.count(range_.append_triangle(v, id, 0, range_.provoking(), Facing::by_winding));
  }

  SetupRange& range_;
  const Draw& draw_;
  const ShadedVertices& shaded_;
  Chunk& chunk_;
  TriangleBatch batch_;
  bool appends_outlines_;  ///< see can_append_outlines()
};

void set_up_triangles(SetupRange& range, uint32_t count) {
  TriangleSetup setup(range);
  if (TriangleBatch::serves(range.draw) && can_gather(range.shaded, range.draw)) {
    setup.submit_batches(count);
  } else {
    setup.submit(count);
  }
}

}  // namespace

void set_up_chunk(const PassContext& context, Chunk& chunk) {
  std::size_t primitives = 0;
  for (const DrawRange& range : chunk.ranges) primitives += range.count;
  chunk.triangles.reserve(primitives);
  chunk.statistics.primitives_in = primitives;
  for (uint32_t i = 0; i < chunk.ranges.size(); ++i) {
    DrawRange& range = chunk.ranges[i];
    range.first_triangle = static_cast<uint32_t>(chunk.triangles.size());
    SetupRange setup(context, chunk, i);
    if (const Topology topology = setup.draw.state.topology; topology == Topology::points) {
      set_up_points(setup, range.count);
    } else if (is_lines(topology)) {
      set_up_lines(setup, range.count);
    } else {
      set_up_triangles(setup, range.count);
    }
  }
  chunk.statistics.triangles_binned = chunk.triangles.size();
}

uint32_t max_triangles_per_primitive(const Draw& draw, int samples) {
  const uint32_t by_line = samples > 1 ? 2 : 1;
  if (draw.state.topology == Topology::points) return 1;
  if (is_lines(draw.state.topology)) return by_line;
  const auto corners = static_cast<uint32_t>(max_corners(draw.kernels.clip_distance_count));
  switch (draw.state.polygon_mode) {
    case PolygonMode::fill: return corners - 2;
    case PolygonMode::line: return corners * by_line;
    case PolygonMode::point: return 3;
  }
  return corners;
}

}  // namespace halfspace::HS_LANES
