// SPDX-License-Identifier: Apache-2.0
//
// Tests and writes triangles with a stencil test. Replaces OpaqueWriter in the loops over packets.
#pragma once

#include <bit>

#include "halfspace/raster/trace/tile_trace.h"
#include "halfspace/raster/visibility/depth_bounds.h"
#include "halfspace/raster/visibility/depth_stencil_test.h"
#include "halfspace/raster/visibility/visibility.h"

namespace halfspace::HS_LANES {

/// For draws whose visibility depends only on coverage, the depth test and the stencil test (TilePath::stencil), and for the packets that
/// the shader keeps if the stencil test follows the shader.
template <class S>
class StencilWriter {
 public:
  using Statistics = S;
  static constexpr bool kTestsStencil = true;

  StencilWriter(const DrawInTile& d, Statistics& statistics)
      : draw_(d.draw),
        tile_(d.tile),
        statistics_(statistics),
        tests_(d.tests),
        writes_depth_(d.tests && d.draw.state.depth.write),
        writes_id_(d.mode == VisibilityMode::deferred) {}

  Statistics& statistics() const { return statistics_; }
  /// Returns true if fragments that fail the depth test have no effect.
  bool tests() const { return tests_ && face_->fail == StencilOp::keep && face_->depth_fail == StencilOp::keep; }
  bool writes_depth() const { return writes_depth_; }
  CompareOp compare_op() const { return draw_.state.depth.compare; }

  /// Selects the stencil state for the following packets. Call it before the first packet of a triangle.
  void begin(const Triangle& t) { face_ = stencil_face(draw_.state, tile_, t.is(kFrontFacing)); }

  /// See OpaqueWriter.
  template <class Z>
  HS_INLINE bool write(TriangleId id, int packet, uint32_t covered, const Z& z_at, [[maybe_unused]] bool passes = false) {
    statistics_.samples_tested += static_cast<uint64_t>(std::popcount(covered));
    const Real z = tests_ || kTraces<Statistics> ? z_at() : Real(0.0f);
    if constexpr (kTraces<Statistics>)
      statistics_.trace->add(id, packet, covered, FragmentOutcome::stencil_failed, z, stored_depth(packet), tests_);
    return test_and_write(id, packet, covered, z);
  }

  /// See OpaqueWriter.
  bool write_decided(TriangleId id, int packet, uint32_t kept, const Real& z) {
    if constexpr (kTraces<Statistics>) statistics_.trace->set_depth(id, packet, kept, z, stored_depth(packet));
    return test_and_write(id, packet, kept, z);
  }

  HS_INLINE void write_pixel(TriangleId id, std::size_t pixel, float z) {
    const int packet = static_cast<int>(pixel) / kLanes;
    const bool passed = write(id, packet, 1u << pixel % kLanes, [&] { return Real(z); });
    if (passed && writes_depth_) widen_hiz(compare_op(), tile_, packet / kPacketsPerBlock, z, z);
  }

 private:
  Real stored_depth(int packet) const { return load<Real>(&tile_.depth[static_cast<std::size_t>(packet) * kLanes]); }

  HS_INLINE bool test_and_write(TriangleId id, int packet, uint32_t covered, const Real& z) {
    const auto [stencil_passed, passed] =
        test_and_update_stencil(*face_, tile_, packet, mask_from_bits<Mask>(covered), tests_, compare_op(), z);
    const uint32_t lanes = bits(passed);
    if constexpr (kTraces<Statistics>) set_outcomes(id, packet, covered, bits(stencil_passed), lanes);
    statistics_.samples_passed += static_cast<uint64_t>(std::popcount(lanes));
    const std::size_t first = static_cast<std::size_t>(packet) * kLanes;
    if (writes_depth_) store(&tile_.depth[first], select(passed, z, load<Real>(&tile_.depth[first])));
    if (writes_id_) {
      TriangleId* ids = &tile_.visibility[first];
      store(ids, select(passed, Int(std::bit_cast<int32_t>(id)), load<Int>(ids)));
    }
    return lanes != 0;
  }

  // Corrects the outcome of fragments that have been recorded.
  void set_outcomes(TriangleId id, int packet, uint32_t covered, uint32_t stencil_passed, uint32_t passed) {
    const auto set = [&](uint32_t lanes, FragmentOutcome outcome) { statistics_.trace->set_outcome(id, packet, lanes, outcome); };
    set(passed, writes_id_ ? FragmentOutcome::hidden_before_shading : FragmentOutcome::depth_only);
    set(stencil_passed & ~passed, FragmentOutcome::depth_failed);
    set(covered & ~stencil_passed, FragmentOutcome::stencil_failed);
  }

  const Draw& draw_;
  Tile& tile_;
  Statistics& statistics_;
  const StencilFace* face_ = nullptr;
  bool tests_, writes_depth_, writes_id_;
};

}  // namespace halfspace::HS_LANES
