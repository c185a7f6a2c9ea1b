// SPDX-License-Identifier: Apache-2.0
//
// Triangles that every pixel of a tile shows. The last one hides all before it, so nothing is written of any until something else comes
// to the tile: what lies behind costs no more than its test, in whatever order it comes.
#pragma once

#include <algorithm>
#include <optional>

#include "halfspace/raster/pipeline/edge.h"
#include "halfspace/raster/visibility/visibility.h"

namespace halfspace {

/// What waits to be written to one tile: the triangle that all its pixels show, or of a draw without colours its depth, if there is one.
class FullTileOccluder {
 public:
  /// The triangle `index` of chunk `chunk`, which comes next in the tile. True if nothing is left to do: it passes everywhere, and waits
  /// now itself, or nowhere. Else it is still to be rasterized; what waited has been written.
  bool draw(const DrawInTile& d, uint32_t chunk, uint32_t index, PassStatistics& statistics) {
    const Triangle& t = d.context.chunks[chunk].triangles[index];
    if (!pending_ && !may_cover(t)) return false;  // as a rule
    return test_or_write(d, t, triangle_id(chunk, index), statistics);
  }

  /// Does a triangle wait?
  bool is_pending() const { return pending_.has_value(); }
  /// Does one wait that is still to be shaded?
  bool is_visible() const { return pending_ && pending_->draw.mode == VisibilityMode::deferred; }
  /// Writes depth and id of what waits, if something does.
  void write();
  /// The triangle that waits; shows() is true.
  TriangleId triangle() const { return pending_->id; }
  /// Writes the depth of what waits, which has been shaded, and no id.
  void write_depth();

 private:
  static bool may_cover(const Triangle& t) { return !t.is(kSmall | kPointSprite | kLine); }
  bool test_or_write(const DrawInTile& d, const Triangle& t, TriangleId id, PassStatistics& statistics);

  struct Pending {
    DrawInTile draw;
    const Triangle* triangle;
    TriangleId id;
    DepthBounds depth;
  };
  std::optional<Pending> pending_;
};

// ---- which triangles cover an area, alone or as the two halves of a quad ---------------------------------------

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
