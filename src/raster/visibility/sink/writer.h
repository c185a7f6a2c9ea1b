// SPDX-License-Identifier: Apache-2.0
//
// What happens with the covered packets that the loops over primitives find: the stencil and depth tests before the shader, and then the
// visibility buffer or, on queued paths, the queue. decide_queued() uses the writers of `opaque` and `stencil` after the shader, at any
// sample count.
#pragma once

#include <bit>

#include "halfspace/raster/visibility/sink/packet_queue.h"
#include "halfspace/raster/visibility/tests/depth_bounds.h"
#include "halfspace/raster/visibility/tests/depth_stencil_test.h"
#include "halfspace/raster/visibility/tests/replaced_depth.h"
#include "halfspace/raster/visibility/visibility.h"

namespace halfspace::HS_LANES {

/// Tests and writes the primitives of a draw in a tile. On queued paths, depth is tested and written before a packet is queued in
/// VisibilityMode::early. In all other modes, depth is tested after the shader; lanes that already fail the test are dropped if they cannot
/// pass it later and do not update stencil values. multisampled: for multisampled tiles, in which write() of a queued path adds to the
/// current packet, and there is no write_pixel(). TracedWriter (traced_writer.h) records what these functions do.
template <TilePath path, bool multisampled>
class Writer {
 public:
  static constexpr bool kMultisampled = multisampled;
  static constexpr bool kQueues = is_queued(path);
  static constexpr bool kTestsStencil = path == TilePath::stencil || path == TilePath::queued_stencil;

  /// The arguments must outlive this object. queue: may be null for paths that do not queue.
  Writer(const DrawInTile& d, PacketQueue* queue, PassStatistics& statistics)
      : state_(d.draw.state),
        tile_(d.tile),
        queue_(queue),
        statistics_(statistics),
        compare_(d.draw.state.depth.compare),
        is_final_(!kQueues || d.mode == VisibilityMode::early),
        tests_depth_(d.tests),
        may_reject_(d.tests && (is_final_ || ((!d.draw.kernels.writes_depth || rejects_by_bound(d.draw)) && !d.postpones_stencil &&
                                              fails_for_good(compare_)))),
        writes_depth_(is_final_ && d.tests && d.draw.state.depth.write),
        queues_depth_(!is_final_ && (d.mode != VisibilityMode::cover_only || has_depth_bound(d.draw))),
        writes_id_(d.mode == VisibilityMode::deferred),
        updates_stencil_(kTestsStencil && tests_stencil(d.draw.state, d.tile) && updates_stencil(d.draw.state)),
        stored_range_(kTestsStencil && is_final_ && tests_stored_depth(d.draw.state, d.tile) ? &*d.draw.state.depth_bounds : nullptr) {}

  /// Returns true if fragments that fail the depth test have no effect.
  bool tests() const {
    if constexpr (kTestsStencil) {
      if (updates_stencil_ && (face_->fail != StencilOp::keep || face_->depth_fail != StencilOp::keep)) return false;
    }
    return rejects_by_depth();
  }
  bool writes_depth() const { return path == TilePath::nearest || (path != TilePath::queued_less && writes_depth_); }
  CompareOp compare_op() const { return kIsLess ? CompareOp::less : compare_; }

  /// Starts a primitive and selects its stencil state. Call it before tests().
  void begin([[maybe_unused]] const Triangle& t) {
    if constexpr (kTestsStencil) face_ = stencil_face(state_, tile_, t.is(kFrontFacing));
  }

  /// Tests and writes lanes of a packet. covered: bit mask of the lanes; z_at(): returns their depth, called only if it is needed. passes:
  /// the depth test passes in all lanes. Returns true if a lane passed.
  template <class Z>
  HS_INLINE bool write(TriangleId id, int packet, uint32_t covered, const Z& z_at, bool passes = false) {
    const Tested tested = count_and_test(packet, covered, z_at, passes);
    add(id, packet, tested.lanes, tested.z);
    return tested.lanes != 0;
  }

  /// The same for the lanes of a queued packet that the shader keeps. The writer of the queued path has already counted them as tested. z:
  /// their depth.
  bool write_decided(TriangleId id, const PacketMask& queued, uint32_t kept, const Real& z) requires(!kQueues) {
    const Tested tested = test(
        queued.packet, kept, [&] { return z; }, false);
    add(id, queued.packet, tested.lanes, z);
    return tested.lanes != 0;
  }

  /// Tests and writes one covered pixel of the tile, and updates the depth bounds of its block.
  HS_INLINE void write_pixel(TriangleId id, std::size_t pixel, float z) requires(!multisampled) {
    const int packet = static_cast<int>(pixel) / kLanes, lane = static_cast<int>(pixel) % kLanes;
    if constexpr (kTestsStencil) {
      if (count_and_test(
              packet, 1u << lane, [&] { return Real(z); }, false)
              .lanes == 0)
        return;
    } else {
      ++statistics_.samples_tested;
      if (tests() && !compare(compare_op(), z, tile_.depth[pixel])) return;
      if (writes_depth()) tile_.depth[pixel] = z;
    }
    add_pixel(id, packet, lane, z);
    if (writes_depth()) widen_hiz(compare_op(), tile_, packet / kPacketsPerBlock, {z, z});
  }

  /// Writes a packet in which all lanes are covered and pass the depth test.
  template <class Z>
  HS_INLINE void write_whole(TriangleId id, int packet, const Z& z_at) requires(!kQueues && !kTestsStencil) {
    statistics_.samples_tested += kLanes;
    statistics_.samples_passed += kLanes;
    if (writes_depth()) store(&tile_.depth[first_of(packet)], z_at());
    if (writes_id_) store(&tile_.visibility[first_of(packet)], Int(std::bit_cast<int32_t>(id)));
  }

  /// Called when hierarchical Z rejects a primitive in the tile or in one of its blocks. sample: number of the sample; z: the depth bounds
  /// of the primitive.
  void tile_rejected(const Triangle&, TriangleId, std::size_t /*sample*/, const DepthBounds& /*z*/) const {}
  void block_rejected(const Triangle&, TriangleId, std::size_t /*sample*/, int /*block*/, const DepthBounds& /*z*/) const {}

  // ---- queued paths ----------------------------------------------------------------------------------------------

  /// Returns true if covered packets can be added without computing depths: the draw neither queues nor writes depths, each packet needs no
  /// stencil test, and nothing is tested or the depth test passes everywhere.
  bool adds_untested(bool passes) const requires kQueues {
    return !kTestsStencil && !queues_depth() && !writes_depth() && (passes || !tests());
  }
  /// Adds a packet of pixels without testing it. packet: its number in the plane of sample 0; lanes: covered lanes of each sample.
  template <class Lanes>
  HS_INLINE void add_untested(TriangleId id, int packet, const Lanes& lanes) requires kQueues {
    int covered = 0;
    queue_->count = put_untested(queue_->count, id, packet, lanes, covered);
    count_untested(covered);
  }
  /// The same for the packets of a block, with the count in a register. lanes_at(p): covered lanes of each sample of packet p of the block.
  template <class LanesAt>
  HS_INLINE void add_block(TriangleId id, int block, const LanesAt& lanes_at) requires kQueues {
    int count = queue_->count, covered = 0;
    for (int p = 0; p < kPacketsPerBlock; ++p) count = put_untested(count, id, block * kPacketsPerBlock + p, lanes_at(p), covered);
    queue_->count = count;
    count_untested(covered);
  }
  /// Starts a packet of pixels. packet: its number in the plane of sample 0. Call begin_sample() and write() for each sample that has
  /// covered lanes, and end_packet() after the last one.
  void begin_packet(TriangleId id, int packet) requires(kQueues&& multisampled) {
    const auto i = static_cast<std::size_t>(queue_->count);
    queue_->packets[i] = {static_cast<uint16_t>(packet), 0};
    queue_->ids[i] = id;
    queue_->sample_lanes[i] = {};
  }
  void begin_sample(std::size_t sample) requires(kQueues&& multisampled) { sample_ = sample; }
  void end_packet() requires(kQueues&& multisampled) {
    queue_->count += queue_->packets[static_cast<std::size_t>(queue_->count)].lanes != 0 ? 1 : 0;
  }

 protected:
  /// The stencil state of the current primitive, or null.
  const StencilFace* stencil() const { return face_; }
  /// The range of stored depths that pass, or null.
  const StoredDepthRange* stored_range() const { return stored_range_; }
  /// Returns true if fragments that fail the depth test are not drawn, even if they update stencil values.
  bool rejects_by_depth() const { return kIsLess || may_reject_; }

 private:
  static constexpr bool kIsLess = path == TilePath::nearest || path == TilePath::queued_less;

  struct Tested {
    uint32_t lanes;  // passed all tests
    Real z;          // undefined unless it was needed
  };

  static std::size_t first_of(int packet) { return static_cast<std::size_t>(packet) * kLanes; }
  bool is_final() const { return path != TilePath::queued_less && is_final_; }  // the shader does not change which lanes are drawn
  bool queues_depth() const { return path == TilePath::queued_less || (kQueues && queues_depth_); }

  // Returns true if a fragment that fails the test would also fail it after other fragments of the draw have been written.
  static bool fails_for_good(CompareOp op) { return op != CompareOp::not_equal && op != CompareOp::always; }

  template <class Z>
  HS_INLINE Tested count_and_test(int packet, uint32_t covered, const Z& z_at, bool passes) {
    statistics_.samples_tested += static_cast<uint64_t>(std::popcount(covered));
    return test(packet, covered, z_at, passes);
  }

  // Tests lanes of a packet, and writes the depth and the stencil values.
  template <class Z>
  HS_INLINE Tested test(int packet, uint32_t covered, const Z& z_at, bool passes) {
    float* depth = &tile_.depth[first_of(packet)];
    Real z(0.0f);
    uint32_t lanes = covered;
    if constexpr (kTestsStencil) {
      if (stored_range_ != nullptr) lanes = bits(stored_depth_test(*stored_range_, tile_, packet, mask_from_bits<Mask>(lanes)));
      if (updates_stencil_) {
        if (tests_depth_) z = z_at();
        const Mask passed = test_and_update_stencil(*face_, tile_, packet, mask_from_bits<Mask>(lanes), tests_depth_, compare_op(), z);
        if (writes_depth()) store(depth, select(passed, z, load<Real>(depth)));
        return {bits(passed), z};
      }
      if (face_ != nullptr) lanes = bits(stencil_test(*face_, tile_, packet, mask_from_bits<Mask>(lanes)));
      if (lanes == 0) return {0, z};
    }
    const bool rejects = tests() && (!passes || writes_depth());
    if (rejects || queues_depth()) z = z_at();
    if (rejects) {
      const Real old = load<Real>(depth);
      lanes &= bits(compare(compare_op(), z, old));
      if (writes_depth()) store(depth, select(mask_from_bits<Mask>(lanes), z, old));
    }
    return {lanes, z};
  }

  // Stores a packet of pixels behind the first `count` elements of the queue, and adds its samples to `covered`. Returns the new count.
  template <class Lanes>
  HS_INLINE int put_untested(int count, TriangleId id, int packet, const Lanes& lanes, int& covered) {
    uint32_t any = 0;
    for (const uint32_t of_sample : lanes) {
      any |= of_sample;
      covered += std::popcount(of_sample);
    }
    const auto i = static_cast<std::size_t>(count);
    queue_->packets[i] = {static_cast<uint16_t>(packet), static_cast<uint16_t>(any)};
    queue_->ids[i] = id;
    if constexpr (multisampled) queue_->sample_lanes[i] = lanes;
    return count + (any != 0 ? 1 : 0);
  }
  void count_untested(int covered) {
    statistics_.samples_tested += static_cast<uint64_t>(covered);
    if (is_final()) statistics_.samples_passed += static_cast<uint64_t>(covered);
  }

  // Adds lanes that passed all tests before the shader.
  HS_INLINE void add(TriangleId id, int packet, uint32_t lanes, const Real& z) {
    if (is_final()) statistics_.samples_passed += static_cast<uint64_t>(std::popcount(lanes));
    if constexpr (!kQueues) {
      if (writes_id_ && lanes != 0) {
        TriangleId* ids = &tile_.visibility[first_of(packet)];
        store(ids, select(mask_from_bits<Mask>(lanes), Int(std::bit_cast<int32_t>(id)), load<Int>(ids)));
      }
    } else if constexpr (multisampled) {
      const auto i = static_cast<std::size_t>(queue_->count);
      queue_->packets[i].lanes = static_cast<uint16_t>(queue_->packets[i].lanes | lanes);
      queue_->sample_lanes[i][sample_] = static_cast<uint16_t>(lanes);
      if (queues_depth()) queue_->sample_depth(tile_, i, static_cast<int>(sample_)) = z;
    } else {
      const auto i = static_cast<std::size_t>(queue_->count);
      queue_->packets[i] = {static_cast<uint16_t>(packet), static_cast<uint16_t>(lanes)};
      queue_->ids[i] = id;
      if (queues_depth()) queue_->depth[i] = z;
      queue_->count += lanes != 0 ? 1 : 0;
    }
  }

  // The same for one lane. It is added to the last element of the queue if that has the same packet and triangle.
  HS_INLINE void add_pixel(TriangleId id, int packet, int lane, [[maybe_unused]] float z) {
    if (is_final()) ++statistics_.samples_passed;
    if constexpr (!kQueues) {
      if (writes_id_) tile_.visibility[first_of(packet) + static_cast<std::size_t>(lane)] = id;
    } else {
      const bool is_same = queue_->count != 0 && queue_->ids[static_cast<std::size_t>(queue_->count) - 1] == id &&
                           queue_->packets[static_cast<std::size_t>(queue_->count) - 1].packet == packet;
      const auto i = static_cast<std::size_t>(is_same ? queue_->count - 1 : queue_->count++);
      PacketMask& p = queue_->packets[i];
      if (!is_same) {
        p = {static_cast<uint16_t>(packet), 0};
        queue_->ids[i] = id;
        if (queues_depth()) queue_->depth[i] = Real(0.0f);
      }
      p.lanes = static_cast<uint16_t>(p.lanes | 1u << lane);
      if (queues_depth()) set_lane(queue_->depth[i], lane, z);
    }
  }

  const DrawState& state_;
  Tile& tile_;
  PacketQueue* queue_;
  PassStatistics& statistics_;
  const StencilFace* face_ = nullptr;
  CompareOp compare_;
  bool is_final_, tests_depth_, may_reject_, writes_depth_, queues_depth_, writes_id_, updates_stencil_;
  const StoredDepthRange* stored_range_;  // only tested on paths with a stencil test; null if it is not tested before the shader
  std::size_t sample_ = 0;                // current sample of a multisampled tile
};

}  // namespace halfspace::HS_LANES
