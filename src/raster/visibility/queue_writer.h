// SPDX-License-Identifier: Apache-2.0
//
// Adds packets whose visibility or color depends on the shader to a PacketQueue. Replaces OpaqueWriter
// in the loops over packets; write_decided() is missing, because the shader has not decided yet.
#pragma once

#include <bit>

#include "halfspace/raster/trace/tile_trace.h"
#include "halfspace/raster/visibility/block_edges.h"
#include "halfspace/raster/visibility/depth_bounds.h"
#include "halfspace/raster/visibility/depth_stencil_test.h"
#include "halfspace/raster/visibility/packet_queue.h"
#include "halfspace/raster/visibility/visibility.h"

namespace halfspace::HS_LANES {

/// Queues the packets of a draw. In VisibilityMode::early, depth is tested and written before a packet is queued. In all other modes, depth
/// is tested after the shader; lanes that already fail the test are dropped if they cannot pass it later and do not update stencil values.
/// multisampled: for multisampled tiles, where write() adds to the current packet. less: compiled for TilePath::queued_less.
template <class S, bool multisampled, bool less = false>
class QueueWriter {
 public:
  using Statistics = S;
  static constexpr bool kTestsStencil = false;

  QueueWriter(const DrawInTile& d, PacketQueue& queue, Statistics& statistics)
      : tile_(d.tile),
        queue_(queue),
        statistics_(statistics),
        compare_(d.draw.state.depth.compare),
        tests_early_(d.mode == VisibilityMode::early),
        may_reject_(d.tests && (tests_early_ || (!d.draw.kernels.writes_depth && !d.postpones_stencil && fails_for_good(compare_)))),
        writes_depth_(tests_early_ && d.tests && d.draw.state.depth.write),
        queues_depth_(!tests_early_ && d.mode != VisibilityMode::cover_only),
        has_test_(d.tests) {}

  Statistics& statistics() const { return statistics_; }
  bool tests() const { return less || may_reject_; }
  bool writes_depth() const { return !less && writes_depth_; }
  CompareOp compare_op() const { return less ? CompareOp::less : compare_; }

  /// Returns true if covered packets can be added without computing depths: the draw neither lists nor writes depths, no fragments are
  /// traced, and nothing is tested or the depth test passes everywhere.
  bool adds_untested(bool passes) const { return !kTraces<Statistics> && !queues_depth() && !writes_depth() && (passes || !tests()); }
  /// Adds the packets of a block without testing them. lanes_at(p): covered lanes of packet p of the block.
  template <class LanesAt>
  HS_INLINE void add_block(TriangleId id, int block, const LanesAt& lanes_at) requires(!multisampled) {
    auto i = static_cast<std::size_t>(queue_.count);
    int covered = 0;
    for (int p = 0; p < kPacketsPerBlock; ++p) {
      const uint32_t lanes = lanes_at(p);
      queue_.packets[i] = {static_cast<uint16_t>(block * kPacketsPerBlock + p), static_cast<uint16_t>(lanes)};
      queue_.ids[i] = id;
      i += lanes != 0 ? 1 : 0;
      covered += std::popcount(lanes);
    }
    queue_.count = static_cast<int>(i);
    count_untested(covered);
  }
  /// Adds a packet of pixels without testing it. See write_samples() in sample_set.h.
  HS_INLINE void add_untested(TriangleId id, int packet, const SampleLanes& lanes) requires multisampled {
    uint32_t any = 0;
    int covered = 0;
    for (const uint16_t of_sample : lanes) {
      any |= of_sample;
      covered += std::popcount(of_sample);
    }
    count_untested(covered);
    const auto i = static_cast<std::size_t>(queue_.count);
    queue_.packets[i] = {static_cast<uint16_t>(packet), static_cast<uint16_t>(any)};
    queue_.ids[i] = id;
    queue_.sample_lanes[i] = lanes;
    queue_.count += any != 0 ? 1 : 0;
  }
  /// Starts a packet of pixels. packet: its number in the plane of sample 0. Call begin_sample() and write() for each sample that has
  /// covered lanes, and end_packet() after the last one.
  void begin_packet(TriangleId id, int packet) requires multisampled {
    const auto i = static_cast<std::size_t>(queue_.count);
    queue_.packets[i] = {static_cast<uint16_t>(packet), 0};
    queue_.ids[i] = id;
    queue_.sample_lanes[i] = {};
  }
  void begin_sample(std::size_t sample) requires multisampled { sample_ = sample; }
  void end_packet() requires multisampled { queue_.count += queue_.packets[static_cast<std::size_t>(queue_.count)].lanes != 0 ? 1 : 0; }

  /// See OpaqueWriter.
  template <class Z>
  HS_INLINE bool write(TriangleId id, int packet, uint32_t covered, const Z& z_at, bool passes = false) {
    statistics_.samples_tested += static_cast<uint64_t>(std::popcount(covered));
    if constexpr (kTraces<Statistics>) trace(id, packet, covered, z_at());
    uint32_t passed = covered;
    const bool rejects = tests() && (!passes || writes_depth());
    Real z(0.0f);
    if (rejects || queues_depth()) z = z_at();
    if (rejects) {
      float* depth = &tile_.depth[static_cast<std::size_t>(packet) * kLanes];
      const Real old = load<Real>(depth);
      passed &= bits(compare(compare_op(), z, old));
      if (writes_depth()) store(depth, select(mask_from_bits<Mask>(passed), z, old));
    }
    add(id, packet, passed, z);
    return passed != 0;
  }

  HS_INLINE void write_pixel(TriangleId id, std::size_t pixel, float z) requires(!multisampled) {
    ++statistics_.samples_tested;
    if constexpr (kTraces<Statistics>) trace(id, static_cast<int>(pixel) / kLanes, 1u << pixel % kLanes, Real(z));
    if (tests() && !compare(compare_op(), z, tile_.depth[pixel])) return;
    const int packet = static_cast<int>(pixel) / kLanes, lane = static_cast<int>(pixel) % kLanes;
    add_pixel(id, packet, lane, z);
    if (!writes_depth()) return;
    tile_.depth[pixel] = z;
    widen_hiz(compare_op(), tile_, static_cast<int>(pixel / kPixelsPerBlock), z, z);
  }

  template <class Z>
  HS_INLINE void write_whole(TriangleId id, int packet, const Z& z_at) requires(!multisampled) {
    statistics_.samples_tested += kLanes;
    if constexpr (kTraces<Statistics>) trace(id, packet, kAllBits<Mask>, z_at());
    Real z(0.0f);
    if (writes_depth() || queues_depth()) z = z_at();
    if (writes_depth()) store(&tile_.depth[static_cast<std::size_t>(packet) * kLanes], z);
    add(id, packet, kAllBits<Mask>, z);
  }

 protected:
  // Adds lanes that passed all tests before the shader.
  HS_INLINE void add(TriangleId id, int packet, uint32_t lanes, const Real& z) {
    if (is_final()) statistics_.samples_passed += static_cast<uint64_t>(std::popcount(lanes));
    if constexpr (multisampled) return add_sample(lanes, z);
    const auto i = static_cast<std::size_t>(queue_.count);
    queue_.packets[i] = {static_cast<uint16_t>(packet), static_cast<uint16_t>(lanes)};
    queue_.ids[i] = id;
    if (queues_depth()) queue_.depth[i] = z;
    queue_.count += lanes != 0 ? 1 : 0;
  }
  // Adds a pixel to the last element of the queue if it has the same packet and triangle, otherwise as a new element.
  HS_INLINE void add_pixel(TriangleId id, int packet, int lane, float z) requires(!multisampled) {
    if (is_final()) ++statistics_.samples_passed;
    const auto bit = static_cast<uint16_t>(1u << lane);
    const bool is_same = queue_.count != 0 && queue_.ids[static_cast<std::size_t>(queue_.count) - 1] == id &&
                         queue_.packets[static_cast<std::size_t>(queue_.count) - 1].packet == packet;
    const auto i = static_cast<std::size_t>(is_same ? queue_.count - 1 : queue_.count++);
    PacketMask& p = queue_.packets[i];
    if (!is_same) {
      p = {static_cast<uint16_t>(packet), 0};
      queue_.ids[i] = id;
      if (queues_depth()) queue_.depth[i] = Real(0.0f);
    }
    p.lanes = static_cast<uint16_t>(p.lanes | bit);
    if (queues_depth()) set_lane(queue_.depth[i], lane, z);
  }

  Tile& tile_;

 private:
  // Returns true if the depth test before the shader is the only one.
  bool is_final() const { return !less && tests_early_; }
  bool queues_depth() const { return less || queues_depth_; }

  void count_untested(int covered) {
    statistics_.samples_tested += static_cast<uint64_t>(covered);
    if (is_final()) statistics_.samples_passed += static_cast<uint64_t>(covered);
  }

  // Records fragments before they are tested and queued. The outcome of queued fragments is recorded when the queue is shaded.
  void trace(TriangleId id, int packet, uint32_t covered, Real z) {
    const Real old = load<Real>(&tile_.depth[static_cast<std::size_t>(packet) * kLanes]);
    const uint32_t passed = tests() ? covered & bits(compare(compare_op(), z, old)) : covered;
    statistics_.trace->add(id, packet, passed, FragmentOutcome::hidden_before_shading, z, old, has_test_);
    statistics_.trace->add(id, packet, covered & ~passed, FragmentOutcome::depth_failed, z, old, has_test_);
  }

  /// Returns true if a fragment that fails the test would also fail it after other fragments of the draw have been written.
  static bool fails_for_good(CompareOp op) { return op != CompareOp::not_equal && op != CompareOp::always; }

  /// Adds lanes of the current sample to the current packet.
  HS_INLINE void add_sample(uint32_t lanes, const Real& z) {
    const auto i = static_cast<std::size_t>(queue_.count);
    queue_.packets[i].lanes = static_cast<uint16_t>(queue_.packets[i].lanes | lanes);
    queue_.sample_lanes[i][sample_] = static_cast<uint16_t>(lanes);
    if (queues_depth()) queue_.sample_depth(tile_, i, static_cast<int>(sample_)) = z;
  }

  PacketQueue& queue_;
  Statistics& statistics_;
  CompareOp compare_;
  bool tests_early_, may_reject_, writes_depth_, queues_depth_;
  bool has_test_;           // depth is tested before or after the shader
  std::size_t sample_ = 0;  // current sample of a multisampled tile
};

}  // namespace halfspace::HS_LANES
