// SPDX-License-Identifier: Apache-2.0
//
// Triangles that cover an area, individually or as the two halves of a quad.
#pragma once

#include <optional>

#include "halfspace/raster/pipeline/edge.h"
#include "halfspace/raster/pipeline/pass_context.h"

namespace halfspace::HS_LANES {

/// Returns true if the center of every pixel of the area is inside the edge.
inline bool contains(const Edge& e, const PixelBounds& area) {
  const int x = e.ey > 0 ? area.x1 - 1 : area.x0, y = e.ex > 0 ? area.y0 : area.y1 - 1;  // where the edge function is smallest
  return e.at(x * kSubPixels + kSubPixels / 2, y * kSubPixels + kSubPixels / 2) >= fill_bias(e);
}

/// Returns the edge of a triangle that does not contain the area, if there is exactly one.
inline std::optional<Edge> crossing_edge(const Triangle& t, const PixelBounds& area) {
  std::optional<Edge> crossing;
  for (std::size_t i = 0; i < 3; ++i) {
    const Edge e = edge_of(t, i);
    if (contains(e, area)) continue;
    if (crossing) return std::nullopt;
    crossing = e;
  }
  return crossing;
}

/// Returns true if a triangle covers the center of every pixel of the area.
inline bool covers(const Triangle& t, const PixelBounds& area) {
  return contains(edge_of(t, 0), area) && contains(edge_of(t, 1), area) && contains(edge_of(t, 2), area);
}

/// Returns true if two triangles share an edge and together cover the center of every pixel of the area exactly once. The fill rule assigns
/// centers on the shared edge to one of them.
inline bool cover_together(const Triangle& t, const Triangle& u, const PixelBounds& area) {
  const std::optional<Edge> a = crossing_edge(t, area), b = crossing_edge(u, area);
  return a && b && a->ex == -b->ex && a->ey == -b->ey && a->x0 + a->ex == b->x0 && a->y0 + a->ey == b->y0;
}

}  // namespace halfspace::HS_LANES
