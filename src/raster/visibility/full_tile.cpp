// SPDX-License-Identifier: Apache-2.0
#include "halfspace/raster/visibility/full_tile.h"

#include "halfspace/raster/trace/tile_trace.h"
#include "halfspace/raster/visibility/coverage/depth_plane.h"
#include "halfspace/raster/visibility/coverage/trace_rejected.h"

namespace halfspace::HS_LANES {

namespace {

// Returns the depth bounds of a triangle in the tile.
DepthBounds depth_of(const DrawInTile& d, const Triangle& t) {
  return DepthInTile(t, d.draw, d.tile, d.context.samples_at).at(0, 0, d.tile.size, d.tile.size);
}

}  // namespace

bool FullTileOccluder::test_or_write(const DrawInTile& d, const Triangle& t, TriangleId id, PassStatistics& statistics) {
  const bool replaces_depth = d.tile.depth_format == DepthFormat::none || (d.tests && d.draw.state.depth.write);
  const bool is_occluder = t.is_wide_triangle() && is_opaque(d.path) && d.tile.size == kMaxTileSize && replaces_depth &&
                           !d.needs_bounds_test && covers_tile(d, t);
  if (is_occluder || (pending_ && is_opaque(d.path))) {
    const DepthBounds depth = depth_of(d, t);
    const CompareOp op = d.draw.state.depth.compare;
    const BlockTest test = !d.tests   ? BlockTest::all_pass
                           : pending_ ? test_bounds(op, depth.low, depth.high, pending_->depth.low, pending_->depth.high)
                                      : test_tile(op, d.tile, depth);
    if (test == BlockTest::none_passes) {
      if (d.trace != nullptr) trace_rejected(d, t, id);
      return true;
    }
    if (is_occluder && test == BlockTest::all_pass) {
      statistics.samples_tested += kMaxTilePixels;
      statistics.samples_passed += kMaxTilePixels;
      if (d.trace != nullptr) trace_passed(d, t, id);
      if (is_visible() && d.mode != VisibilityMode::deferred) write();  // the new occluder does not replace its color
      pending_.emplace(Pending{d, &t, id, depth});
      return true;
    }
  }
  write();
  return false;
}

void FullTileOccluder::trace_rejected(const DrawInTile& d, const Triangle& t, TriangleId id) const {
  const RejectedPrimitive primitive{d, t, id, 0, depth_of(d, t)};
  if (pending_) {
    trace_rejected_tile(primitive, pending_->depth, *d.trace);
  } else {
    trace_rejected_tile(primitive, *d.trace);
  }
}

void FullTileOccluder::trace_passed(const DrawInTile& d, const Triangle& t, TriangleId id) const {
  const LargeDepthPlane plane(t, d.draw, d.tile, kPixelCenter);
  const LargeDepthPlane before = pending_ ? LargeDepthPlane(*pending_->triangle, pending_->draw.draw, d.tile, kPixelCenter) : plane;
  const FragmentOutcome outcome = d.mode == VisibilityMode::deferred ? FragmentOutcome::hidden_before_shading : FragmentOutcome::depth_only;
  for (int p = 0; p < kPackets; ++p) {
    const Int x = lane_x() + packet_x(p), y = lane_y() + packet_y(p);
    const Real stored = pending_ ? before.at(x, y) : load<Real>(&d.tile.depth[static_cast<std::size_t>(p) * kLanes]);
    d.trace->add(id, p, kAllBits<Mask>, outcome, plane.at(x, y), stored, d.tests);
  }
}

void FullTileOccluder::write() {
  if (pending_) write_full_tile(pending_->draw, *pending_->triangle, pending_->id);
  pending_.reset();
}

void FullTileOccluder::write_depth() {
  pending_->draw.mode = VisibilityMode::depth_only;
  write();
}

}  // namespace halfspace::HS_LANES
