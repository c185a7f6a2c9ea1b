// SPDX-License-Identifier: Apache-2.0
//
// Depth test and writes for opaque draws (the common case): only coverage and depth determine visibility.
// The samples of a multisampled pixel are in different packets.
#pragma once

#include <bit>

#include "halfspace/raster/trace/tile_trace.h"
#include "halfspace/raster/visibility/block_edges.h"
#include "halfspace/raster/visibility/depth_bounds.h"
#include "halfspace/raster/visibility/depth_stencil_test.h"
#include "halfspace/raster/visibility/visibility.h"

namespace halfspace::HS_LANES {

/// Tests and writes the triangles of an opaque draw in a tile. nearest: compiled for TilePath::nearest.
template <class S, bool nearest = false>
class OpaqueWriter {
 public:
  using Statistics = S;
  static constexpr bool kTestsStencil = false;

  OpaqueWriter(const DrawInTile& d, Statistics& statistics)
      : tile_(d.tile),
        statistics_(statistics),
        compare_(d.draw.state.depth.compare),
        tests_depth_(d.tests),
        writes_depth_(d.tests && d.draw.state.depth.write),
        writes_id_(d.mode == VisibilityMode::deferred) {}

  Statistics& statistics() const { return statistics_; }
  bool tests() const { return nearest || tests_depth_; }
  bool writes_depth() const { return nearest || writes_depth_; }
  CompareOp compare_op() const { return nearest ? CompareOp::less : compare_; }

  /// Tests and writes lanes of a packet. covered: bit mask of the lanes; z_at(): returns their depth, called only if there is a depth test.
  /// passes: the depth test passes in all lanes. Returns true if a lane passed.
  template <class Z>
  HS_INLINE bool write(TriangleId id, int packet, uint32_t covered, const Z& z_at, [[maybe_unused]] bool passes = false) {
    statistics_.samples_tested += static_cast<uint64_t>(std::popcount(covered));
    if constexpr (kTraces<Statistics>) trace(id, packet, covered, z_at());
    return test_and_write(id, packet, covered, z_at);
  }

  /// The same for lanes that the shader keeps. A QueueWriter has already counted them as tested. z: their depth.
  bool write_decided(TriangleId id, int packet, uint32_t kept, const Real& z) {
    if constexpr (kTraces<Statistics>) trace_decided(id, packet, kept, z);
    return test_and_write(id, packet, kept, [&] { return z; });
  }

  /// Tests and writes one covered pixel of the tile, and updates the depth bounds of its block.
  HS_INLINE void write_pixel(TriangleId id, std::size_t pixel, float z) {
    ++statistics_.samples_tested;
    if constexpr (kTraces<Statistics>) trace(id, static_cast<int>(pixel / kLanes), 1u << pixel % kLanes, Real(z));
    if (tests() && !compare(compare_op(), z, tile_.depth[pixel])) return;
    ++statistics_.samples_passed;
    if (writes_id_) tile_.visibility[pixel] = id;
    if (!writes_depth()) return;
    tile_.depth[pixel] = z;
    widen_hiz(compare_op(), tile_, static_cast<int>(pixel / kPixelsPerBlock), z, z);
  }

  /// Writes a packet in which all lanes are covered and pass the depth test.
  template <class Z>
  HS_INLINE void write_whole(TriangleId id, int packet, const Z& z_at) {
    statistics_.samples_tested += kLanes;
    statistics_.samples_passed += kLanes;
    if constexpr (kTraces<Statistics>) trace(id, packet, kAllBits<Mask>, z_at());
    if (writes_depth()) store(&tile_.depth[static_cast<std::size_t>(packet) * kLanes], z_at());
    if (writes_id_) store(&tile_.visibility[static_cast<std::size_t>(packet) * kLanes], Int(std::bit_cast<int32_t>(id)));
  }

 private:
  // Records fragments before they are tested and written.
  void trace(TriangleId id, int packet, uint32_t covered, Real z) {
    const Real old = load<Real>(&tile_.depth[static_cast<std::size_t>(packet) * kLanes]);
    const uint32_t passed = tests() ? covered & bits(compare(compare_op(), z, old)) : covered;
    statistics_.trace->add(id, packet, passed, writes_id_ ? FragmentOutcome::hidden_before_shading : FragmentOutcome::depth_only, z, old,
                           tests());
    statistics_.trace->add(id, packet, covered & ~passed, FragmentOutcome::depth_failed, z, old, tests());
  }
  // The same for fragments that a QueueWriter has recorded.
  void trace_decided(TriangleId id, int packet, uint32_t kept, Real z) {
    const Real old = load<Real>(&tile_.depth[static_cast<std::size_t>(packet) * kLanes]);
    const uint32_t passed = tests() ? kept & bits(compare(compare_op(), z, old)) : kept;
    statistics_.trace->set_depth(id, packet, kept, z, old);
    statistics_.trace->set_outcome(id, packet, passed, writes_id_ ? FragmentOutcome::hidden_before_shading : FragmentOutcome::depth_only);
    statistics_.trace->set_outcome(id, packet, kept & ~passed, FragmentOutcome::depth_failed);
  }

  template <class Z>
  HS_INLINE bool test_and_write(TriangleId id, int packet, uint32_t covered, const Z& z_at) {
    float* depth = &tile_.depth[static_cast<std::size_t>(packet) * kLanes];
    uint32_t passed = covered;
    if (tests()) {
      const Real old = load<Real>(depth), z = z_at();
      passed &= bits(compare(compare_op(), z, old));
      if (writes_depth()) store(depth, select(mask_from_bits<Mask>(passed), z, old));
    }
    statistics_.samples_passed += static_cast<uint64_t>(std::popcount(passed));
    if (writes_id_ && passed != 0) {
      TriangleId* ids = &tile_.visibility[static_cast<std::size_t>(packet) * kLanes];
      store(ids, select(mask_from_bits<Mask>(passed), Int(std::bit_cast<int32_t>(id)), load<Int>(ids)));
    }
    return passed != 0;
  }

  Tile& tile_;
  Statistics& statistics_;
  CompareOp compare_;
  bool tests_depth_, writes_depth_, writes_id_;
};

}  // namespace halfspace::HS_LANES
