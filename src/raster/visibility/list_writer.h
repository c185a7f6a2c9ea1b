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

namespace halfspace::inline HS_LANES_NAMESPACE {

/// Returns true for draws with depth test "less" whose depth is tested before and after the shader, such as alpha-tested draws.
inline bool lists_undecided(const DrawInTile& d) {
  return d.tests && d.mode != VisibilityMode::early && d.mode != VisibilityMode::cover_only && !d.draw.kernels.writes_depth &&
         d.draw.state.depth.compare == CompareOp::less;
}

/// Queues the packets of a draw. In VisibilityMode::early, depth is tested and written before a packet is queued. In all other modes, depth
/// is tested after the shader; lanes that already fail the test are dropped if they cannot pass it later. Call begin() before each triangle
/// and, in a multisampled tile, begin_sample() before the packets of each of its samples. undecided: compiled for draws with
/// lists_undecided().
template <class S, bool multisampled, bool undecided = false>
class ListWriter {
 public:
  using Statistics = S;
  static constexpr bool kTestsStencil = false;

  ListWriter(const DrawInTile& d, PacketQueue& queue, Statistics& statistics)
      : tile_(d.tile),
        queue_(queue),
        statistics_(statistics),
        compare_(d.draw.state.depth.compare),
        tests_early_(d.mode == VisibilityMode::early),
        may_reject_(d.tests && (tests_early_ || (!d.draw.kernels.writes_depth && fails_for_good(compare_)))),
        writes_depth_(tests_early_ && d.tests && d.draw.state.depth.write),
        lists_depth_(!tests_early_ && d.mode != VisibilityMode::cover_only),
        has_test_(d.tests) {}

  Statistics& statistics() const { return statistics_; }
  bool tests() const { return undecided || may_reject_; }
  bool writes_depth() const { return !undecided && writes_depth_; }
  CompareOp compare_op() const { return undecided ? CompareOp::less : compare_; }

  /// Starts a triangle.
  void begin(const Triangle&) { first_ = queue_.count; }
  /// Starts a sample of the triangle.
  void begin_sample(int sample) requires multisampled {
    sample_ = static_cast<std::size_t>(sample);
    shift_ = packet_shift(sample_plane(tile_.samples, sample, tile_.size));
  }

  /// See OpaqueWriter.
  template <class Z>
  HS_INLINE bool write(TriangleId id, int packet, uint32_t covered, const Z& z_at, bool passes = false) {
    statistics_.samples_tested += static_cast<uint64_t>(std::popcount(covered));
    if constexpr (kTraces<Statistics>) trace(id, packet, covered, z_at());
    uint32_t passed = covered;
    const bool rejects = tests() && (!passes || writes_depth());
    Real z(0.0f);
    if (rejects || lists_depth()) z = z_at();
    if (rejects) {
      float* depth = &tile_.depth[static_cast<std::size_t>(packet) * kLanes];
      const Real old = load<Real>(depth);
      passed &= bits(compare(compare_op(), z, old));
      if (writes_depth()) store(depth, select(mask_from_bits<Mask>(passed), z, old));
    }
    add(id, packet, passed, z);
    return passed != 0;
  }

  HS_INLINE void write_pixel(TriangleId id, std::size_t pixel, float z) {
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
  HS_INLINE void write_whole(TriangleId id, int packet, const Z& z_at) {
    statistics_.samples_tested += kLanes;
    if constexpr (kTraces<Statistics>) trace(id, packet, kAllBits<Mask>, z_at());
    Real z(0.0f);
    if (writes_depth() || lists_depth()) z = z_at();
    if (writes_depth()) store(&tile_.depth[static_cast<std::size_t>(packet) * kLanes], z);
    add(id, packet, kAllBits<Mask>, z);
  }

 protected:
  // Adds lanes that passed all tests before the shader.
  HS_INLINE void add(TriangleId id, int packet, uint32_t lanes, const Real& z) {
    if (is_final()) statistics_.samples_passed += static_cast<uint64_t>(std::popcount(lanes));
    if constexpr (multisampled) return add_sample(id, packet - shift_, lanes, z);
    const auto i = static_cast<std::size_t>(queue_.count);
    queue_.packets[i] = {static_cast<uint16_t>(packet), static_cast<uint16_t>(lanes)};
    queue_.ids[i] = id;
    if (lists_depth()) queue_.depth[i] = z;
    queue_.count += lanes != 0 ? 1 : 0;
  }
  // Adds a pixel to the last element of the queue if it has the same packet and triangle, otherwise as a new element.
  HS_INLINE void add_pixel(TriangleId id, int packet, int lane, float z) {
    if (is_final()) ++statistics_.samples_passed;
    const auto bit = static_cast<uint16_t>(1u << lane);
    const bool is_same = queue_.count != 0 && queue_.ids[static_cast<std::size_t>(queue_.count) - 1] == id &&
                         queue_.packets[static_cast<std::size_t>(queue_.count) - 1].packet == packet;
    const auto i = static_cast<std::size_t>(is_same ? queue_.count - 1 : queue_.count++);
    PacketMask& p = queue_.packets[i];
    if (!is_same) {
      p = {static_cast<uint16_t>(packet), 0};
      queue_.ids[i] = id;
      if (lists_depth()) queue_.depth[i] = Real(0.0f);
    }
    p.lanes = static_cast<uint16_t>(p.lanes | bit);
    if (lists_depth()) set_lane(queue_.depth[i], lane, z);
  }

  Tile& tile_;

 private:
  // Returns true if the depth test before the shader is the only one.
  bool is_final() const { return !undecided && tests_early_; }
  bool lists_depth() const { return undecided || lists_depth_; }

  // Records fragments before they are tested and queued. The outcome of queued fragments is recorded when the queue is shaded.
  void trace(TriangleId id, int packet, uint32_t covered, Real z) {
    const Real old = load<Real>(&tile_.depth[static_cast<std::size_t>(packet) * kLanes]);
    const uint32_t passed = tests() ? covered & bits(compare(compare_op(), z, old)) : covered;
    statistics_.trace->add(id, packet, passed, FragmentOutcome::hidden_before_shading, z, old, has_test_);
    statistics_.trace->add(id, packet, covered & ~passed, FragmentOutcome::depth_failed, z, old, has_test_);
  }

  /// Returns true if a fragment that fails the test would also fail it after other fragments of the draw have been written.
  static bool fails_for_good(CompareOp op) { return op != CompareOp::not_equal && op != CompareOp::always; }

  /// Adds the current sample of the pixels of a packet, which the triangle may already have in the queue for other samples.
  HS_INLINE void add_sample(TriangleId id, int packet, uint32_t lanes, const Real& z) {
    if (lanes == 0) return;
    int i = queue_.position[static_cast<std::size_t>(packet)];
    if (i < first_ || i >= queue_.count || queue_.packets[static_cast<std::size_t>(i)].packet != packet) {
      i = queue_.count++;
      queue_.position[static_cast<std::size_t>(packet)] = static_cast<uint16_t>(i);
      queue_.packets[static_cast<std::size_t>(i)] = {static_cast<uint16_t>(packet), 0};
      queue_.ids[static_cast<std::size_t>(i)] = id;
      queue_.sample_lanes[static_cast<std::size_t>(i)] = {};
    }
    const auto n = static_cast<std::size_t>(i);
    queue_.packets[n].lanes = static_cast<uint16_t>(queue_.packets[n].lanes | lanes);
    queue_.sample_lanes[n][sample_] = static_cast<uint16_t>(lanes);
    if (lists_depth()) queue_.sample_depth(tile_, n, static_cast<int>(sample_)) = z;
  }

  PacketQueue& queue_;
  Statistics& statistics_;
  CompareOp compare_;
  bool tests_early_, may_reject_, writes_depth_, lists_depth_;
  bool has_test_;  // depth is tested before or after the shader
  // Only for multisampled tiles:
  int first_ = 0;           // position of the triangle's first packet in the queue
  std::size_t sample_ = 0;  // current sample
  int shift_ = 0;           // distance of its packets from those of sample 0
};

}  // namespace halfspace::inline HS_LANES_NAMESPACE
