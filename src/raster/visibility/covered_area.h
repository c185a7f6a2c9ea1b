// SPDX-License-Identifier: Apache-2.0
//
// Which triangles cover all pixels of an area, alone or, as the halves of a quad do, in pairs.
#pragma once

#include <algorithm>
#include <optional>

#include "halfspace/raster/pipeline/edge.h"

namespace halfspace {

/// Is the centre of every pixel of the area inside of the edge?
inline bool contains(const Edge& e, const PixelBounds& area) {
  const int x = e.ey > 0 ? area.x1 - 1 : area.x0, y = e.ex > 0 ? area.y0 : area.y1 - 1;  // where the edge function is least
  return e.at(x * kSubPixels + kSubPixels / 2, y * kSubPixels + kSubPixels / 2) >= fill_bias(e);
}

/// The one edge of a triangle that does not contain the area, if it is one alone.
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

/// Does a triangle cover the centre of every pixel of the area?
inline bool covers(const Triangle& t, const PixelBounds& area) {
  return contains(edge_of(t, 0), area) && contains(edge_of(t, 1), area) && contains(edge_of(t, 2), area);
}

/// Do two triangles share an edge and cover together the centre of every pixel of the area, each once? The fill rule gives what lies
/// on the shared edge to one of them.
inline bool cover_together(const Triangle& t, const Triangle& u, const PixelBounds& area) {
  const std::optional<Edge> a = crossing_edge(t, area), b = crossing_edge(u, area);
  return a && b && a->ex == -b->ex && a->ey == -b->ey && a->x0 + a->ex == b->x0 && a->y0 + a->ey == b->y0;
}

}  // namespace halfspace
