// SPDX-License-Identifier: Apache-2.0
#include "halfspace/raster/primitives/setup_clipped.h"

#include <cstdlib>

#include "halfspace/raster/primitives/append_lines.h"
#include "halfspace/raster/primitives/setup_points.h"
#include "halfspace/raster/primitives/vertex_stage.h"

namespace halfspace::HS_LANES {

namespace {

// Adds the corners to the chunk's clip vertices and returns the index of the first one. All of them get the flat varyings of the
// provoking vertex. w: clip-space w of the three vertices.
uint32_t add_corners(SetupRange& r, const ClipPolygon& polygon, const PrimitiveSlots& slots, const std::array<double, 3>& w) {
  const auto n = static_cast<std::size_t>(r.shaded.varying_count);
  const std::size_t weights = r.draw.kernels.uses_id ? kClipWeights : 0;
  const float* rows = r.shaded.varyings.get();  // null if there are no varyings
  const std::array<const float*, 3> varyings{rows + slots[0] * n, rows + slots[1] * n, rows + slots[2] * n};
  const auto first = static_cast<uint32_t>(r.chunk.clip_vertices.size());
  for (int i = 0; i < polygon.count; ++i) {
    const ClipCorner& c = polygon.corners[static_cast<std::size_t>(i)];
    const auto first_varying = static_cast<uint32_t>(r.chunk.clip_varyings.size());
    r.chunk.clip_varyings.resize(first_varying + n + weights);
    float* const out = r.chunk.clip_varyings.data() + first_varying;
    interpolate_corner(c, w, varyings, static_cast<int>(r.provoking()), {r.draw.kernels.interpolations, n}, out);
    for (std::size_t k = 0; k < weights; ++k) out[n + k] = static_cast<float>(c.weights[static_cast<int>(k) + 1]);
    // Corners that are vertices of the triangle get exactly the result of the vertex stage.
    const bool is_new = c.vertex < 0;
    const ScreenVertex screen =
        is_new ? project_corner(r.draw.viewport, c.pos_clip) : r.shaded.screen[slots[static_cast<std::size_t>(c.vertex)]];
    r.chunk.clip_vertices.push_back({screen, first_varying});
  }
  return first;
}

Cull append_fan(SetupRange& r, uint32_t first, uint32_t corners) {
  const Fan fan = fan_of(r.chunk.clip_vertices.data() + first, corners);
  Cull why = Cull::none;
  for (uint32_t i = 2; i < corners; ++i) {
    const std::array<uint32_t, 3> index{first + fan.apex, first + (fan.apex + i - 1) % corners, first + (fan.apex + i) % corners};
    const int64_t area = orient2d(r.clip_vertex(index[0]), r.clip_vertex(index[1]), r.clip_vertex(index[2]));
    if (area != 0 && (area > 0) != fan.counter_clockwise) continue;
    why = r.append_clip_triangle(index, Facing::by_winding);
  }
  return why;
}

// Adds the polygon offset to the depths of the corners. It is that of the largest triangle of the fan from the first corner.
void offset_corners(SetupRange& r, uint32_t first, uint32_t corners) {
  std::array<const ScreenVertex*, 3> largest{};
  int64_t largest_area = -1;
  for (uint32_t i = 2; i < corners; ++i) {
    const std::array<const ScreenVertex*, 3> triangle{&r.clip_vertex(first), &r.clip_vertex(first + i - 1), &r.clip_vertex(first + i)};
    const int64_t area = std::abs(orient2d(*triangle[0], *triangle[1], *triangle[2]));
    if (area > largest_area) largest_area = area, largest = triangle;
  }
  const float offset = outline_offset(r.draw.state.offset, r.context.depth_format, largest);
  for (uint32_t i = 0; i < corners; ++i) r.chunk.clip_vertices[first + i].screen.z += offset;
}

Cull append_pieces(SetupRange& r, const ClipPolygon& polygon, uint32_t first, const PrimitiveSlots& slots) {
  const auto corners = static_cast<uint32_t>(polygon.count);
  const DrawState& state = r.draw.state;
  if (is_lines(state.topology)) return append_clip_line(r, first, first + 1, Facing::front);
  if (state.polygon_mode == PolygonMode::fill) return append_fan(r, first, corners);
  int64_t area = 0;
  for (uint32_t i = 2; i < corners; ++i) area += orient2d(r.clip_vertex(first), r.clip_vertex(first + i - 1), r.clip_vertex(first + i));
  if (area == 0) return Cull::degenerate;
  const bool front = is_front(state, area > 0);
  if (is_culled(state.cull, front)) return Cull::face;
  const Facing facing = front ? Facing::front : Facing::back;
  if (has_offset(state.offset, state.polygon_mode)) offset_corners(r, first, corners);
  Cull why = Cull::none;
  for (uint32_t i = 0; i < corners; ++i) {
    if (state.polygon_mode == PolygonMode::line) {
      why = append_clip_line(r, first + i, first + (i + 1) % corners, facing);
    } else if (const int vertex = polygon.corners[i].vertex; vertex >= 0) {  // corners created by clipping are not drawn as points
      const PointSpriteRect& rect = r.shaded.sprites[slots[static_cast<std::size_t>(vertex)]];
      why = append_point(r, rect, r.clip_vertex(first + i), first + i, kClipped, facing);
    }
  }
  return why;
}

}  // namespace

void set_up_clipped(SetupRange& r, const PrimitiveSlots& slots, ClipFunction clip, bool is_cut) {
  const std::array<glm::vec4, 3> pos_clip =
      clip_positions(r.draw, r.instance, {slots[0] + r.slot_base, slots[1] + r.slot_base, slots[2] + r.slot_base});
  ClipDistances distances{{}, r.shaded.clip_distance_count};
  for (std::size_t i = 0; i < 3 && distances.count != 0; ++i) distances.vertex[i] = r.distances_of(slots[i]);
  const ClipPolygon polygon = clip(r.draw.viewport, r.draw.state.depth, pos_clip, distances);
  if (polygon.count == 0) {
    ++r.chunk.statistics.culled_outside;
    return;
  }
  if (is_cut) ++r.chunk.statistics.clipped;
  const uint32_t first = add_corners(
      r, polygon, slots, {static_cast<double>(pos_clip[0].w), static_cast<double>(pos_clip[1].w), static_cast<double>(pos_clip[2].w)});
  const std::size_t before = r.chunk.triangles.size();
  const Cull why = append_pieces(r, polygon, first, slots);
  if (r.chunk.triangles.size() == before) r.count(why);  // counts as culled only if no piece is left
}

}  // namespace halfspace::HS_LANES
