// SPDX-License-Identifier: Apache-2.0
//
// Triangles that every pixel of a tile shows. The last one hides all before it, so nothing is written of any until something else comes
// to the tile: what lies behind costs no more than its test, in whatever order it comes.
#pragma once

#include <optional>

#include "halfspace/raster/visibility/visibility.h"

namespace halfspace {

/// What waits to be written to one tile: the triangle that all its pixels show, or of a draw without colours its depth, if there is one.
class WholeTile {
 public:
  /// The triangle `index` of chunk `chunk`, which comes next in the tile. True if nothing is left to do: it passes everywhere, and waits
  /// now itself, or nowhere. Else it is still to be rasterized; what waited has been written.
  bool take(const DrawInTile& d, uint32_t chunk, uint32_t index, PassStatistics& statistics) {
    const Triangle& t = d.frame.chunks[chunk].triangles[index];
    if (!waiting_ && !may_cover(t)) return false;  // as a rule
    return take_or_write(d, t, triangle_id(chunk, index), statistics);
  }

  /// Does a triangle wait?
  bool waits() const { return waiting_.has_value(); }
  /// Does one wait that is still to be shaded?
  bool shows() const { return waiting_ && waiting_->draw.mode == VisibilityMode::deferred; }
  /// Writes depth and id of what waits, if something does.
  void write();
  /// Shades what waits (shows() is true), and writes its depth.
  void shade(PassStatistics& statistics);

 private:
  static bool may_cover(const Triangle& t) { return !t.is(kSmall | kSprite | kLine); }
  bool take_or_write(const DrawInTile& d, const Triangle& t, TriangleId id, PassStatistics& statistics);

  struct Waiting {
    DrawInTile draw;
    const Triangle* triangle;
    TriangleId id;
    DepthBounds depth;
  };
  std::optional<Waiting> waiting_;
};

}  // namespace halfspace
