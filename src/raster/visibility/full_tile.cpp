// SPDX-License-Identifier: Apache-2.0
#include "halfspace/raster/visibility/full_tile.h"

#include "halfspace/raster/visibility/depth_bounds.h"

namespace halfspace {

bool WholeTile::take_or_write(const DrawInTile& d, const Triangle& t, TriangleId id, PassStatistics& statistics) {
  const bool replaces_depth = d.tile.depth_format == DepthFormat::none || (d.tests && d.draw.state.depth.write);
  const bool covers = may_cover(t) && d.is_plain && replaces_depth && !d.cut && covers_tile(d, t);
  if (covers || (waiting_ && d.is_plain)) {
    const DepthBounds depth = depth_bounds(t, d.draw, d.tile.depth_format);
    const CompareOp op = d.draw.state.depth.compare;
    const BlockTest test = !d.tests   ? BlockTest::all_pass
                           : waiting_ ? test_bounds(op, depth.low, depth.high, waiting_->depth.low, waiting_->depth.high)
                                      : test_tile(op, d.tile, depth.low, depth.high);
    if (test == BlockTest::none_passes) return true;
    if (covers && test == BlockTest::all_pass) {
      statistics.samples_tested += kMaxTilePixels;
      statistics.samples_passed += kMaxTilePixels;
      if (shows() && d.mode != VisibilityMode::deferred) write();  // its colours stay
      waiting_.emplace(Waiting{d, &t, id, depth});
      return true;
    }
  }
  write();
  return false;
}

void WholeTile::write() {
  if (waiting_) write_whole_tile(waiting_->draw, *waiting_->triangle, waiting_->id, waiting_->depth);
  waiting_.reset();
}

void WholeTile::write_depth() {
  waiting_->draw.mode = VisibilityMode::depth_only;
  write();
}

}  // namespace halfspace
