// SPDX-License-Identifier: Apache-2.0
//
// A writer that records every covered fragment, whether it passed its tests, and which primitives hierarchical Z rejected.
#pragma once

#include "halfspace/raster/trace/tile_trace.h"
#include "halfspace/raster/visibility/coverage/trace_rejected.h"
#include "halfspace/raster/visibility/sink/writer.h"

namespace halfspace::HS_LANES {

/// A Writer of a draw with DrawInTile::trace. It has the same members as Writer, and calls them after recording the fragments.
template <TilePath path, bool multisampled>
class TracedWriter : public Writer<path, multisampled> {
 public:
  using Base = Writer<path, multisampled>;

  TracedWriter(const DrawInTile& d, PacketQueue* queue, PassStatistics& statistics) : Base(d, queue, statistics), d_(d) {}

  template <class Z>
  bool write(TriangleId id, int packet, uint32_t covered, const Z& z_at, bool passes = false) {
    add(id, packet, covered, z_at());
    return Base::write(id, packet, covered, z_at, passes);
  }
  bool write_decided(TriangleId id, const PacketMask& queued, uint32_t kept, const Real& z) requires(!Base::kQueues) {
    d_.trace->set_outcome(id, queued.packet, queued.lanes & ~kept, FragmentOutcome::discarded);
    d_.trace->set_depth(id, queued.packet, kept, z, stored_depth(queued.packet));
    set_outcomes(id, queued.packet, kept, z);
    return Base::write_decided(id, queued, kept, z);
  }
  void write_pixel(TriangleId id, std::size_t pixel, float z) requires(!multisampled) {
    add(id, static_cast<int>(pixel) / kLanes, 1u << pixel % kLanes, Real(z));
    Base::write_pixel(id, pixel, z);
  }
  template <class Z>
  void write_whole(TriangleId id, int packet, const Z& z_at) requires(!Base::kQueues && !Base::kTestsStencil) {
    add(id, packet, kAllBits<Mask>, z_at());
    Base::write_whole(id, packet, z_at);
  }
  void tile_rejected(const Triangle& t, TriangleId id, std::size_t sample, const DepthBounds& z) const {
    trace_rejected_tile({d_, t, id, sample, z}, *d_.trace);
  }
  void block_rejected(const Triangle& t, TriangleId id, std::size_t sample, int block, const DepthBounds& z) const {
    trace_rejected_block({d_, t, id, sample, z}, block, *d_.trace);
  }
  /// Packets must not be added without recording them.
  bool adds_untested(bool) const requires(Base::kQueues) { return false; }

 private:
  Real stored_depth(int packet) const { return load<Real>(&d_.tile.depth[static_cast<std::size_t>(packet) * kLanes]); }

  void add(TriangleId id, int packet, uint32_t covered, Real z) {
    d_.trace->add(id, packet, covered, FragmentOutcome::stencil_failed, z, stored_depth(packet), d_.tests);
    set_outcomes(id, packet, covered, z);
  }

  // Repeats the tests of fragments that have been added: the outcome is not taken from Writer. The outcome of queued fragments is recorded
  // when the queue is shaded.
  void set_outcomes(TriangleId id, int packet, uint32_t covered, Real z) {
    Mask passed = mask_from_bits<Mask>(covered);
    if constexpr (Base::kTestsStencil) {
      if (this->stored_range() != nullptr) passed = stored_depth_test(*this->stored_range(), d_.tile, packet, passed);
      set(id, packet, covered & ~bits(passed), FragmentOutcome::depth_failed);
      covered = bits(passed);
      if (this->stencil() != nullptr) passed = stencil_test(*this->stencil(), d_.tile, packet, passed);
    }
    set(id, packet, covered & ~bits(passed), FragmentOutcome::stencil_failed);
    set(id, packet, bits(passed), FragmentOutcome::depth_failed);
    if (this->rejects_by_depth()) passed = passed & compare(this->compare_op(), z, stored_depth(packet));
    const bool is_shaded = Base::kQueues || d_.mode == VisibilityMode::deferred;
    set(id, packet, bits(passed), is_shaded ? FragmentOutcome::hidden_before_shading : FragmentOutcome::depth_only);
  }
  void set(TriangleId id, int packet, uint32_t lanes, FragmentOutcome outcome) { d_.trace->set_outcome(id, packet, lanes, outcome); }

  const DrawInTile& d_;
};

/// Calls f.template operator()<W>() with the writer W of a draw, and returns the result. Traced draws use the writers of `opaque` and
/// `queued` for the paths that are compiled for one depth state.
template <bool multisampled, class F>
auto with_writer(const DrawInTile& d, const F& f) {
  const bool is_traced = d.trace != nullptr;
  const auto call = [&]<TilePath p>() {
    return is_traced ? f.template operator()<TracedWriter<p, multisampled>>() : f.template operator()<Writer<p, multisampled>>();
  };
  switch (d.path) {
    case TilePath::nearest:
      if (!is_traced) return f.template operator()<Writer<TilePath::nearest, multisampled>>();
      [[fallthrough]];
    case TilePath::opaque: return call.template operator()<TilePath::opaque>();
    case TilePath::stencil: return call.template operator()<TilePath::stencil>();
    case TilePath::queued_less:
      if (!is_traced) return f.template operator()<Writer<TilePath::queued_less, multisampled>>();
      [[fallthrough]];
    case TilePath::queued: return call.template operator()<TilePath::queued>();
    case TilePath::queued_stencil: break;
  }
  return call.template operator()<TilePath::queued_stencil>();
}

}  // namespace halfspace::HS_LANES
