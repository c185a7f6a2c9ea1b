// SPDX-License-Identifier: Apache-2.0
#include "halfspace/raster/primitives/setup.h"

#include <algorithm>
#include <bit>

#include "halfspace/raster/pipeline/pixel_box.h"
#include "halfspace/raster/pipeline/window.h"
#include "halfspace/raster/primitives/clip.h"
#include "halfspace/raster/primitives/primitive_assembly.h"
#include "halfspace/raster/primitives/setup_scalar.h"
#include "halfspace/raster/primitives/setup_simd.h"
#include "halfspace/raster/primitives/vertex_stage.h"

namespace halfspace {

namespace {

// Sets up the primitives of one draw range.
class DrawRangeSetup {
 public:
  DrawRangeSetup(const PassContext& context, Chunk& chunk, uint32_t range)
      : context_(context),
        chunk_(chunk),
        range_(range),
        draw_(context.draws[chunk.ranges[range].draw]),
        shaded_(context.shaded[chunk.ranges[range].draw]),
        assembly_(draw_, chunk.ranges[range].first),
        instance_(chunk.ranges[range].instance),
        slot_base_(shaded_.first - instance_ * shaded_.count),
        provoking_(draw_.state.provoking == ProvokingVertex::first ? 0 : 2),
        outlines_directly_(can_outline_directly()) {}

  void submit_point() {
    const uint32_t id = next_slots()[0];
    const Outcode code = shaded_.outcodes[id];
    const float inv_w = shaded_.screen[id].inv_w;
    if (code & kOutNonFinite) {
      ++chunk_.statistics.culled_non_finite;
    } else if ((code & (kOutNear | kOutFar)) != 0 || !(inv_w > 0.0f && inv_w <= 1.0f / kMinW) || beyond_distances(id) != 0) {
      ++chunk_.statistics.culled_outside;
    } else {
      count(append_point(shaded_.sprites[id], shaded_.screen[id], id, 0, Facing::front), 1);
    }
  }

  void submit_line() {
    const std::array<uint32_t, 3> id = next_slots();
    const Outcode any = shaded_.outcodes[id[0]] | shaded_.outcodes[id[1]];
    const Outcode all = shaded_.outcodes[id[0]] & shaded_.outcodes[id[1]] & kOutView;
    const uint32_t beyond_any = beyond_distances(id[0]) | beyond_distances(id[1]);
    if (any & kOutNonFinite) {
      ++chunk_.statistics.culled_non_finite;
    } else if (all || (beyond_distances(id[0]) & beyond_distances(id[1])) != 0) {
      ++chunk_.statistics.culled_outside;
    } else if (const bool needed = (any & kOutNeedsClip) != 0 || beyond_any != 0; needed || context_.samples > 1) {
      clip(id, clip_line, needed);
    } else {
      const std::size_t before = chunk_.triangles.size();
      const uint32_t provoking = draw_.state.provoking == ProvokingVertex::first ? 0 : 1;
      count(append_line({&shaded_.screen[id[0]], &shaded_.screen[id[1]]}, {id[0], id[1]}, 0, provoking, Facing::front), 1);
      note_source(before, id);
    }
  }

  void submit_triangle() { submit_triangle(next_slots()); }

  // Submits the next `count` triangles, at most W.
  void submit_triangles(int count) {
    const uint32_t unclipped = put_triangles(count);
    batch_.set_up(context_, draw_, shaded_, unclipped, provoking_, range_, chunk_.statistics);
    const uint32_t single = (bits(first_lanes<Mask>(count)) & ~unclipped) | batch_.large();  // lanes that are set up individually
    if (single == 0 && batch_.kept() == 0) return;
    if (single == 0) {
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
    }
  }

 private:
  using ClipFunction = ClipPolygon (*)(const Viewport&, const DepthState&, const std::array<glm::vec4, 3>&, const ClipDistances&);

  // Adds the next triangles to the batch. Returns the lanes that need no clipping.
  uint32_t put_triangles(int count) {
    if (shaded_.any_outcode == 0 && put_without_lookup(count)) return bits(first_lanes<Mask>(count));
    uint32_t unclipped = 0;
    std::array<uint32_t, 3> slots{};
    for (int i = 0; i < count; ++i) {
      slots = next_slots();
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
    if (const uint32_t* list = assembly_.next_list(static_cast<uint32_t>(count))) {
      batch_.put_list(list, count, slot_base_);
      return true;
    }
    const std::optional<uint32_t> first = assembly_.next_sequence(static_cast<uint32_t>(count));
    if (first) batch_.put_sequence(*first, count, slot_base_);
    return first.has_value();
  }

  std::array<uint32_t, 3> next_slots() {
    std::array<uint32_t, 3> slots = assembly_.next();
    for (uint32_t& s : slots) s -= slot_base_;
    return slots;
  }

  void submit_triangle(const std::array<uint32_t, 3>& id) {
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
    } else if ((any & kOutNeedsClip) != 0 || shaded_.clip_distances || draw_.state.polygon_mode != PolygonMode::fill) {
      submit_triangle_slowly(id, any);
    } else {
      append_whole(id);
    }
  }

  void count(Cull why, uint64_t n) {
    PassStatistics& s = chunk_.statistics;
    if (why == Cull::degenerate) s.culled_degenerate += n;
    if (why == Cull::face) s.culled_face += n;
    if (why == Cull::no_sample) s.culled_no_sample += n;
  }

  // Returns true if the edges of unclipped triangles are lines between vertices of the draw. Flat varyings are those of the provoking
  // vertex, which may not belong to the edge, and the primitive id refers to clip vertices.
  bool can_outline_directly() const {
    const std::span modes(draw_.kernels.interpolations, static_cast<std::size_t>(draw_.kernels.varying_count));
    return draw_.state.polygon_mode == PolygonMode::line && context_.samples == 1 && !draw_.kernels.uses_id &&
           std::ranges::find(modes, Interpolation::flat) == modes.end();
  }

  // Returns a bit mask of the clip distances for which a vertex is outside.
  uint32_t beyond_distances(uint32_t id) const {
    uint32_t beyond = 0;
    for (int k = 0; k < shaded_.clip_distance_count; ++k) {
      if (!(distances_of(id)[k] >= 0.0f)) beyond |= 1u << k;
    }
    return beyond;
  }
  const float* distances_of(uint32_t id) const {
    return shaded_.clip_distances.get() + std::size_t{id} * static_cast<std::size_t>(shaded_.clip_distance_count);
  }

  void submit_triangle_slowly(const std::array<uint32_t, 3>& id, Outcode any) {
    const uint32_t a = beyond_distances(id[0]), b = beyond_distances(id[1]), c = beyond_distances(id[2]);
    const bool needed = (any & kOutNeedsClip) != 0 || (a | b | c) != 0;
    if ((a & b & c) != 0) {
      ++chunk_.statistics.culled_outside;
    } else if (!needed && outlines_directly_) {
      append_outline(id);
    } else if (needed || draw_.state.polygon_mode != PolygonMode::fill) {
      clip(id, clip_triangle, needed);
    } else {
      append_whole(id);
    }
  }

  // Appends the edges of a triangle that need not be clipped. The result is that of clip() if all varyings are finite; clip() would copy
  // the vertices.
  void append_outline(const std::array<uint32_t, 3>& id) {
    const auto vertex = [&](std::size_t i) -> const ScreenVertex& { return shaded_.screen[id[i % 3]]; };
    const int64_t area = orient2d(vertex(0), vertex(1), vertex(2));
    if (area == 0) return count(Cull::degenerate, 1);
    const bool front = (area > 0) == (draw_.state.front == Winding::counter_clockwise);
    if (is_culled(draw_.state.cull, front)) return count(Cull::face, 1);
    const std::size_t before = chunk_.triangles.size();
    Cull why = Cull::none;
    for (std::size_t i = 0; i < 3; ++i) {
      why = append_line({&vertex(i), &vertex(i + 1)}, {id[i], id[(i + 1) % 3]}, 0, 0, front ? Facing::front : Facing::back);
    }
    if (chunk_.triangles.size() == before) count(why, 1);
    note_source(before, id);
  }

  void append_whole(const std::array<uint32_t, 3>& id) {
    const std::array<const ScreenVertex*, 3> v{&shaded_.screen[id[0]], &shaded_.screen[id[1]], &shaded_.screen[id[2]]};
    count(append(v, id, 0, provoking_, Facing::by_winding), 1);
  }

  Cull append(const std::array<const ScreenVertex*, 3>& v, const std::array<uint32_t, 3>& index, uint32_t flags, uint32_t provoking,
              Facing facing) {
    Triangle t;
    const Cull why = set_up_triangle(draw_, context_, v, index, provoking, facing, t);
    if (why != Cull::none) return why;
    t.flags |= flags | range_ << kDrawRangeShift;
    chunk_.triangles.push_back(t);
    return Cull::none;
  }

  Cull append_point(const PointSpriteRect& r, const ScreenVertex& v, uint32_t id, uint32_t flags, Facing facing) {
    if (r.x0 >= r.x1 || r.y0 >= r.y1) return Cull::degenerate;
    if (facing != Facing::back) flags |= kFrontFacing;
    Triangle t{.x = {r.x0, r.x1 - 1, r.x0},
               .y = {r.y0, r.y1 - 1, r.y0},
               .z0 = v.z,
               .z_edge1 = 0,
               .z_edge2 = 0,
               .z_max = v.z,
               .vertex = {id, id, id},
               .flags = flags | kPointSprite | kSmall | range_ << kDrawRangeShift};
    if (pixel_bounds(draw_, t, draw_.bounds, context_.samples_at).empty()) return Cull::no_sample;
    chunk_.triangles.push_back(t);
    return Cull::none;
  }

  Cull append_line(const std::array<const ScreenVertex*, 2>& v, const std::array<uint32_t, 2>& index, uint32_t flags, uint32_t provoking,
                   Facing facing) {
    Triangle t;
    const Cull why = set_up_line(draw_, context_, v, index, provoking, facing, t);
    if (why != Cull::none) return why;
    t.flags |= flags | range_ << kDrawRangeShift;
    chunk_.triangles.push_back(t);
    return Cull::none;
  }

  // Stores the source of the pieces from index `before` to the end, for the primitive stage.
  void note_source(std::size_t before, const std::array<uint32_t, 3>& id) {
    if (chunk_.triangles.size() != before) chunk_.clip_sources.push_back({static_cast<uint32_t>(before), id});
  }

  // Clips a triangle or line if needed, and appends the pieces.
  void clip(const std::array<uint32_t, 3>& id, ClipFunction clip_primitive, bool needed) {
    alignas(64) std::array<float, 4 * kVertexBatch> rows;
    const std::array<uint32_t, 3> index{id[0] + slot_base_, id[1] + slot_base_, id[2] + slot_base_};
    StreamRoom room;
    draw_.kernels.position(draw_.shader.get(), {at_instance(draw_.vertices, instance_, room), index.data(), 0, 3, 0,
                                                draw_.state.base_vertex, static_cast<int32_t>(instance_), nullptr, rows.data(), nullptr});
    std::array<glm::vec4, 3> pos_clip;
    for (std::size_t i = 0; i < 3; ++i) {
      pos_clip[i] = {rows[i], rows[kVertexBatch + i], rows[2 * kVertexBatch + i], rows[3 * kVertexBatch + i]};
    }
    ClipDistances distances{{}, shaded_.clip_distance_count};
    for (std::size_t i = 0; i < 3 && distances.count != 0; ++i) distances.vertex[i] = distances_of(id[i]);
    const ClipPolygon polygon = clip_primitive(draw_.viewport, draw_.state.depth, pos_clip, distances);
    if (polygon.count == 0) {
      ++chunk_.statistics.culled_outside;
      return;
    }
    if (needed) ++chunk_.statistics.clipped;
    const uint32_t first = add_corners(
        polygon, id, {static_cast<double>(pos_clip[0].w), static_cast<double>(pos_clip[1].w), static_cast<double>(pos_clip[2].w)});
    const std::size_t before = chunk_.triangles.size();
    const Cull why = append_pieces(polygon, first, id);
    if (chunk_.triangles.size() == before) count(why, 1);  // counts as culled only if no piece is left
    note_source(before, id);
  }

  // Adds the corners to the chunk's clip vertices and returns the index of the first one. All of them get the flat varyings of the
  // provoking vertex.
  uint32_t add_corners(const ClipPolygon& polygon, const std::array<uint32_t, 3>& id, const std::array<double, 3>& w) {
    const auto n = static_cast<std::size_t>(shaded_.varying_count);
    const std::size_t weights = draw_.kernels.uses_id ? kClipWeights : 0;
    const float* rows = shaded_.varyings.get();  // null if there are no varyings
    const std::array<const float*, 3> varyings{rows + id[0] * n, rows + id[1] * n, rows + id[2] * n};
    const auto first = static_cast<uint32_t>(chunk_.clip_vertices.size());
    for (int i = 0; i < polygon.count; ++i) {
      const ClipCorner& c = polygon.corners[static_cast<std::size_t>(i)];
      const auto first_varying = static_cast<uint32_t>(chunk_.clip_varyings.size());
      chunk_.clip_varyings.resize(first_varying + n + weights);
      float* const out = chunk_.clip_varyings.data() + first_varying;
      interpolate_corner(c, w, varyings, static_cast<int>(provoking_), {draw_.kernels.interpolations, n}, out);
      for (std::size_t k = 0; k < weights; ++k) out[n + k] = static_cast<float>(c.weights[static_cast<int>(k) + 1]);
      // Corners that are vertices of the triangle have exactly the result of the vertex stage.
      const bool cut = c.vertex < 0;
      const ScreenVertex screen = cut ? project_corner(draw_.viewport, c.pos_clip) : shaded_.screen[id[static_cast<std::size_t>(c.vertex)]];
      chunk_.clip_vertices.push_back({screen, first_varying});
    }
    return first;
  }

  Cull append_pieces(const ClipPolygon& polygon, uint32_t first, const std::array<uint32_t, 3>& id) {
    const auto corners = static_cast<uint32_t>(polygon.count);
    if (is_lines(draw_.state.topology)) return append_clipped_line(first, first + 1, Facing::front);
    if (draw_.state.polygon_mode == PolygonMode::fill) return append_fan(first, corners);
    int64_t area = 0;
    for (uint32_t i = 2; i < corners; ++i) area += orient2d(screen_of(first), screen_of(first + i - 1), screen_of(first + i));
    if (area == 0) return Cull::degenerate;
    const bool front = (area > 0) == (draw_.state.front == Winding::counter_clockwise);
    if (is_culled(draw_.state.cull, front)) return Cull::face;
    const Facing facing = front ? Facing::front : Facing::back;
    Cull why = Cull::none;
    for (uint32_t i = 0; i < corners; ++i) {
      if (draw_.state.polygon_mode == PolygonMode::line) {
        why = append_clipped_line(first + i, first + (i + 1) % corners, facing);
      } else if (const int vertex = polygon.corners[i].vertex; vertex >= 0) {  // corners created by clipping are not drawn as points
        why = append_point(shaded_.sprites[id[static_cast<std::size_t>(vertex)]], screen_of(first + i), first + i, kClipped, facing);
      }
    }
    return why;
  }

  const ScreenVertex& screen_of(uint32_t clip_vertex) const { return chunk_.clip_vertices[clip_vertex].screen; }

  Cull append_fan(uint32_t first, uint32_t corners) {
    const Fan fan = fan_of(chunk_.clip_vertices.data() + first, corners);
    Cull why = Cull::none;
    for (uint32_t i = 2; i < corners; ++i) {
      const std::array<uint32_t, 3> index{first + fan.apex, first + (fan.apex + i - 1) % corners, first + (fan.apex + i) % corners};
      const int64_t area = orient2d(screen_of(index[0]), screen_of(index[1]), screen_of(index[2]));
      if (area != 0 && (area > 0) != fan.counter_clockwise) continue;
      why = append({&screen_of(index[0]), &screen_of(index[1]), &screen_of(index[2])}, index, kClipped, 0, Facing::by_winding);
    }
    return why;
  }

  // Appends a line between two clip vertices. If the pass is multisampled, the line is a rectangle of two triangles.
  Cull append_clipped_line(uint32_t a, uint32_t b, Facing facing) {
    if (context_.samples == 1) return append_line({&screen_of(a), &screen_of(b)}, {a, b}, kClipped, 0, facing);
    const ClipVertex from = chunk_.clip_vertices[a], to = chunk_.clip_vertices[b];
    if (from.screen.x == to.screen.x && from.screen.y == to.screen.y) return Cull::degenerate;
    const auto first = static_cast<uint32_t>(chunk_.clip_vertices.size());
    const std::array<ScreenVertex, 4> corners = line_rectangle(from.screen, to.screen, draw_.state.line_width);
    for (std::size_t i = 0; i < 4; ++i) {
      chunk_.clip_vertices.push_back({corners[i], i == 0 || i == 3 ? from.first_varying : to.first_varying});
    }
    const auto half = [&](uint32_t i, uint32_t j, uint32_t k) {
      return append({&screen_of(first + i), &screen_of(first + j), &screen_of(first + k)}, {first + i, first + j, first + k}, kClipped, 0,
                    facing);
    };
    const Cull why = half(0, 1, 2);
    const Cull other = half(0, 2, 3);
    return why == Cull::none ? why : other;
  }

  const PassContext& context_;
  Chunk& chunk_;
  uint32_t range_;
  const Draw& draw_;
  const ShadedVertices& shaded_;
  Assembly assembly_;
  uint32_t instance_;
  uint32_t slot_base_;  ///< slot of a vertex = its index − slot_base_ (modulo 2^32)
  TriangleBatch batch_;
  uint32_t provoking_;      ///< position of the provoking vertex among a primitive's three indices (a line repeats its second index)
  bool outlines_directly_;  ///< see can_outline_directly()
};

}  // namespace

void set_up_chunk(const PassContext& context, Chunk& chunk) {
  std::size_t primitives = 0;
  for (const DrawRange& range : chunk.ranges) primitives += range.count;
  chunk.triangles.reserve(primitives);
  chunk.statistics.primitives_in = primitives;
  for (uint32_t s = 0; s < chunk.ranges.size(); ++s) {
    DrawRange& range = chunk.ranges[s];
    range.first_triangle = static_cast<uint32_t>(chunk.triangles.size());
    DrawRangeSetup setup(context, chunk, s);
    const Draw& draw = context.draws[range.draw];
    const Topology topology = draw.state.topology;
    if (topology <= Topology::triangle_fan && TriangleBatch::serves(draw) && can_gather(context.shaded[range.draw], draw)) {
      for (uint32_t i = 0; i < range.count; i += kLanes)
        setup.submit_triangles(static_cast<int>(std::min<uint32_t>(kLanes, range.count - i)));
      continue;
    }
    for (uint32_t i = 0; i < range.count; ++i) {
      if (topology == Topology::points) {
        setup.submit_point();
      } else if (is_lines(topology)) {
        setup.submit_line();
      } else {
        setup.submit_triangle();
      }
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

}  // namespace halfspace
