// SPDX-License-Identifier: Apache-2.0
//
// Runs the stencil test for packets before they are added to a PacketQueue. Replaces QueueWriter for draws with a stencil test that can
// precede the shader: the draw does not update the stencil values, or only coverage, the depth test and the stencil test decide which
// fragments do (TilePath::queued_stencil).
#pragma once

#include "halfspace/raster/visibility/queue_writer.h"

namespace halfspace::HS_LANES {

/// See QueueWriter. Call begin() before each triangle and before tests(), which depends on the face of the triangle.
template <class S, bool multisampled>
class StencilQueueWriter : public QueueWriter<S, multisampled> {
  using Base = QueueWriter<S, multisampled>;

 public:
  static constexpr bool kTestsStencil = true;

  StencilQueueWriter(const DrawInTile& d, PacketQueue& queue, S& statistics)
      : Base(d, queue, statistics), state_(d.draw.state), tests_depth_(d.tests), updates_(updates_stencil(d.draw.state)) {}

  /// Returns true if fragments that fail the depth test have no effect.
  bool tests() const { return Base::tests() && (!updates_ || (face_->fail == StencilOp::keep && face_->depth_fail == StencilOp::keep)); }

  /// See QueueWriter. Each packet needs a stencil test.
  bool adds_untested(bool) const { return false; }
  /// Starts a triangle and selects its stencil state.
  void begin(const Triangle& t) { face_ = stencil_face(state_, tile_, t.is(kFrontFacing)); }

  /// See OpaqueWriter.
  template <class Z>
  HS_INLINE bool write(TriangleId id, int packet, uint32_t covered, const Z& z_at, bool passes = false) {
    if (!updates_) {
      const uint32_t lanes = passes_stencil(id, packet, covered, z_at);
      return lanes != 0 && Base::write(id, packet, lanes, z_at, passes);
    }
    const Tested tested = test_and_update(id, packet, covered, z_at);
    this->add(id, packet, tested.lanes, tested.z);
    return tested.lanes != 0;
  }
  HS_INLINE void write_pixel(TriangleId id, std::size_t pixel, float z) requires(!multisampled) {
    const int packet = static_cast<int>(pixel) / kLanes, lane = static_cast<int>(pixel) % kLanes;
    const auto z_at = [&] { return Real(z); };
    if (!updates_) {
      if (passes_stencil(id, packet, 1u << lane, z_at) != 0) Base::write_pixel(id, pixel, z);
      return;
    }
    if (test_and_update(id, packet, 1u << lane, z_at).lanes == 0) return;
    this->add_pixel(id, packet, lane, z);
    if (this->writes_depth()) widen_hiz(this->compare_op(), tile_, packet / kPacketsPerBlock, z, z);
  }

 private:
  using Base::tile_;

  struct Tested {
    uint32_t lanes;  // passed both tests
    Real z;          // 0 without a depth test
  };

  // Returns the lanes that pass the stencil test.
  template <class Z>
  HS_INLINE uint32_t passes_stencil(TriangleId id, int packet, uint32_t covered, const Z& z_at) {
    const uint32_t lanes = bits(stencil_test(*face_, tile_, packet, mask_from_bits<Mask>(covered)));
    this->statistics().samples_tested += static_cast<uint64_t>(std::popcount(covered & ~lanes));
    if constexpr (kTraces<S>) trace(id, packet, covered & ~lanes, FragmentOutcome::stencil_failed, z_at());
    return lanes;
  }

  // Tests stencil and depth, and updates the stencil values and the depth.
  template <class Z>
  HS_INLINE Tested test_and_update(TriangleId id, int packet, uint32_t covered, const Z& z_at) {
    this->statistics().samples_tested += static_cast<uint64_t>(std::popcount(covered));
    float* depth = &tile_.depth[static_cast<std::size_t>(packet) * kLanes];
    const Real z = tests_depth_ ? z_at() : Real(0.0f);
    const auto [stencil_passed, passed] =
        test_and_update_stencil(*face_, tile_, packet, mask_from_bits<Mask>(covered), tests_depth_, this->compare_op(), z);
    const uint32_t lanes = bits(passed);
    if constexpr (kTraces<S>) {
      trace(id, packet, lanes, FragmentOutcome::hidden_before_shading, z_at());
      trace(id, packet, bits(stencil_passed & !passed), FragmentOutcome::depth_failed, z_at());
      trace(id, packet, covered & ~bits(stencil_passed), FragmentOutcome::stencil_failed, z_at());
    }
    if (this->writes_depth()) store(depth, select(passed, z, load<Real>(depth)));
    return {lanes, z};
  }

  void trace(TriangleId id, int packet, uint32_t lanes, FragmentOutcome outcome, Real z) {
    const Real stored = load<Real>(&tile_.depth[static_cast<std::size_t>(packet) * kLanes]);
    this->statistics().trace->add(id, packet, lanes, outcome, z, stored, tests_depth_);
  }

  const DrawState& state_;
  const StencilFace* face_ = nullptr;
  bool tests_depth_;
  bool updates_;  // stencil values; only in VisibilityMode::early
};

}  // namespace halfspace::HS_LANES
