// SPDX-License-Identifier: Apache-2.0
#include "halfspace/raster/visibility/full_tile.h"

#include "halfspace/raster/visibility/depth_bounds.h"

namespace halfspace {

bool FullTileOccluder::test_or_write(const DrawInTile& d, const Triangle& t, TriangleId id, PassStatistics& statistics) {
  const bool replaces_depth = d.tile.depth_format == DepthFormat::none || (d.tests && d.draw.state.depth.write);
  const bool covers = may_cover(t) && d.is_opaque && replaces_depth && !d.needs_bounds_test && covers_tile(d, t);
  if (covers || (pending_ && d.is_opaque)) {
    const DepthBounds depth = depth_bounds(t, d.draw, d.tile.depth_format);
    const CompareOp op = d.draw.state.depth.compare;
    const BlockTest test = !d.tests   ? BlockTest::all_pass
                           : pending_ ? test_bounds(op, depth.low, depth.high, pending_->depth.low, pending_->depth.high)
                                      : test_tile(op, d.tile, depth.low, depth.high);
    if (test == BlockTest::none_passes) return true;
    if (covers && test == BlockTest::all_pass) {
      statistics.samples_tested += kMaxTilePixels;
      statistics.samples_passed += kMaxTilePixels;
      if (is_visible() && d.mode != VisibilityMode::deferred) write();  // the new occluder does not replace its color
      pending_.emplace(Pending{d, &t, id, depth});
      return true;
    }
  }
  write();
  return false;
}

void FullTileOccluder::write() {
  if (pending_) write_full_tile(pending_->draw, *pending_->triangle, pending_->id, pending_->depth);
  pending_.reset();
}

void FullTileOccluder::write_depth() {
  pending_->draw.mode = VisibilityMode::depth_only;
  write();
}

}  // namespace halfspace
