// SPDX-License-Identifier: Apache-2.0
//
// Visibility of large triangles and of points in multisampled tiles. The coverage of all samples of a block is computed together. Pixels,
// packets and blocks are numbered as in the plane of sample 0.
#pragma once

#include <algorithm>
#include <limits>

#include "halfspace/raster/pipeline/pixel_box.h"
#include "halfspace/raster/visibility/block_edges.h"
#include "halfspace/raster/visibility/depth_bounds.h"
#include "halfspace/raster/visibility/depth_plane.h"
#include "halfspace/raster/visibility/sample_set.h"

namespace halfspace::HS_LANES {

/// Edge functions of a triangle at the samples of a tile. Represented as in TileEdges; the values of an edge are 0 if all samples of the
/// tile are inside it.
class SampleEdges {
 public:
  /// The edge functions at sample s.
  struct AtSample {
    const SampleEdges& edges;
    std::size_t s;
    HS_INLINE Int values(std::size_t i, int x, int y) const { return edges.values(i, s, x, y); }
  };

  SampleEdges(const DrawInTile& d, const SampleSet& samples, const Triangle& t) {
    const int shift = t.is(kSmall) ? 0 : kSubPixelBits;
    for (std::size_t i = 0; i < 3; ++i) put(edge_of(t, i), shift, d.tile, samples, i);
  }

  /// Returns true if no sample of the tile is inside.
  bool outside() const { return outside_; }
  const std::array<int32_t, 3>& bias() const { return bias_; }
  /// Returns how much edge i changes over x and y pixels.
  HS_INLINE int32_t value_step(std::size_t i, int x, int y) const { return step_x_[i] * x + step_y_[i] * y; }
  /// Returns edge i for all pixels of the packet with corner (x, y), at sample s.
  HS_INLINE Int values(std::size_t i, std::size_t s, int x, int y) const { return lanes_[i] + (e_[s][i] + value_step(i, x, y)); }
  /// Returns the edges at sample s, for DepthPlane.
  HS_INLINE AtSample at(std::size_t s) const { return {*this, s}; }
  /// Returns how much of the block with corner (x, y) is inside all edges.
  BlockCoverage block_coverage(int x, int y) const {
    bool whole = true;
    for (std::size_t i = 0; i < 3; ++i) {
      const int32_t step = value_step(i, x, y);
      if (step + highest_[i] < 0) return BlockCoverage::none;
      whole &= step + lowest_[i] >= 0;
    }
    return whole ? BlockCoverage::whole : BlockCoverage::some;
  }

 private:
  // Computes edge i. shift: 0 for small triangles, otherwise kSubPixelBits.
  void put(const Edge& edge, int shift, const Tile& tile, const SampleSet& samples, std::size_t i) {
    const int64_t step_x = -(int64_t{edge.ey} * kSubPixels) >> shift, step_y = (int64_t{edge.ex} * kSubPixels) >> shift;
    const auto smallest_step = [&](int64_t last) { return std::min<int64_t>(0, step_x * last) + std::min<int64_t>(0, step_y * last); };
    const auto largest_step = [&](int64_t last) { return std::max<int64_t>(0, step_x * last) + std::max<int64_t>(0, step_y * last); };
    bias_[i] = fill_bias(edge);
    const int64_t corner = edge.at(int64_t{tile.x0} * kSubPixels, int64_t{tile.y0} * kSubPixels) - bias_[i];
    std::array<int64_t, kMaxSamples> e;
    int64_t lowest = std::numeric_limits<int64_t>::max(), highest = std::numeric_limits<int64_t>::min();
    for (const std::size_t s : samples.indices()) {
      const SamplePosition at = samples.position[s];
      e[s] = (corner + int64_t{edge.ex} * at.y - int64_t{edge.ey} * at.x) >> shift;
      lowest = std::min(lowest, e[s]);
      highest = std::max(highest, e[s]);
    }
    outside_ |= highest + largest_step(tile.size - 1) < 0;
    const bool keeps = !outside_ && (shift == 0 || lowest + smallest_step(tile.size - 1) < 0);
    const auto value = [keeps](int64_t v) { return keeps ? static_cast<int32_t>(v) : 0; };
    step_x_[i] = value(step_x);
    step_y_[i] = value(step_y);
    lanes_[i] = lane_x() * step_x_[i] + lane_y() * step_y_[i];
    lowest_[i] = value(lowest + smallest_step(kBlockSize - 1));
    highest_[i] = value(highest + largest_step(kBlockSize - 1));
    for (const std::size_t s : samples.indices()) e_[s][i] = value(e[s]);
  }

  bool outside_ = false;
  std::array<int32_t, 3> step_x_, step_y_, bias_;
  std::array<Int, 3> lanes_;                           // offsets from the corner of a packet to its pixels
  std::array<std::array<int32_t, 3>, kMaxSamples> e_;  // values at the samples of pixel (0, 0)
  std::array<int32_t, 3> lowest_, highest_;            // over all samples of the first block
};

/// Tests and writes the covered packets of one primitive, block by block.
template <class Writer>
class SampleBlocks {
 public:
  SampleBlocks(const DrawInTile& d, const SampleSet& samples, const Triangle& t, TriangleId id, Writer& writer)
      : d_(d), samples_(samples), triangle_(t), id_(id), writer_(writer) {}

  /// Returns true if the depth test rejects depths in [z.low, z.high] everywhere in the tile.
  bool rejects_tile(const DepthBounds& z) {
    if (!writer_.tests() || test_tile(writer_.compare_op(), d_.tile, z.low, z.high) != BlockTest::none_passes) return false;
    for (const std::size_t s : samples_.indices()) writer_.tile_rejected(triangle_, id_, s, z);
    return true;
  }

  /// Starts the block with corner (x, y). Depths in it are in [z.low, z.high]. Returns false if the depth test rejects all of its samples.
  /// may_refresh: see test_block().
  bool begin(int x, int y, const DepthBounds& z, bool may_refresh = true) {
    block_ = y / kBlockSize * kBlocksPerRow + x / kBlockSize;
    z_ = z;
    listed_ = 0;
    kept_count_ = 0;
    passes_ = ~0u;
    written_ = 0;
    for (const std::size_t s : samples_.indices()) {
      const BlockTest test =
          writer_.tests() ? test_block(writer_.compare_op(), d_.tile, block_of(s), z.low, z.high, may_refresh) : BlockTest::all_pass;
      if (test == BlockTest::none_passes) {
        writer_.block_rejected(triangle_, id_, s, block_of(s), z);
        continue;
      }
      kept_[kept_count_++] = s;
      if (test == BlockTest::some_may) passes_ &= ~(1u << s);
    }
    return kept_count_ != 0;
  }

  /// Lists packet p of the block if it has covered samples. lanes_at(k): covered lanes of sample kept()[k]. All packets of the block are
  /// listed before the first one is written, without a branch that depends on the result.
  template <class LanesAt>
  HS_INLINE void list(int p, const LanesAt& lanes_at) {
    Listed& packet = list_[listed_];
    packet = {static_cast<uint16_t>(p), {}};
    uint32_t any = 0;
    for (std::size_t k = 0; k < kept_count_; ++k) {
      const uint32_t lanes = lanes_at(k);
      packet.lanes[kept_[k]] = static_cast<uint16_t>(lanes);
      any |= lanes;
    }
    listed_ += any != 0 ? 1 : 0;
  }

  /// Writes the listed packets. z_at(s, p): returns the depth of packet p at sample s.
  template <class Depth>
  void write_listed(const Depth& z_at) {
    for (std::size_t i = 0; i < listed_; ++i) write(list_[i].packet, list_[i].lanes, z_at);
    update_bounds(false);
  }

  /// Writes a block that is covered everywhere. z_at: as in write_listed().
  template <class Depth>
  void write_whole(const Depth& z_at) {
    if constexpr (Writer::kQueues || Writer::kTestsStencil) {
      SampleLanes lanes{};
      for (const std::size_t s : kept()) lanes[s] = static_cast<uint16_t>(kAllBits<Mask>);
      for (int p = 0; p < kPacketsPerBlock; ++p) write(p, lanes, z_at);
    } else {
      for (const std::size_t s : kept()) write_whole(s, z_at);
    }
    update_bounds(true);
  }

  /// Returns the samples that the depth test did not reject in this block.
  std::span<const std::size_t> kept() const { return {kept_.data(), kept_count_}; }

 private:
  // A packet of the block with covered samples.
  struct Listed {
    uint16_t packet;
    SampleLanes lanes;
  };

  template <class Depth>
  HS_INLINE void write(int p, const SampleLanes& lanes, const Depth& z_at) {
    write_samples(
        writer_, samples_, id_, block_ * kPacketsPerBlock + p, lanes, passes_, [&](std::size_t s) { return z_at(s, p); },
        [&](std::size_t s, int) { written_ |= 1u << s; });
  }

  // Writes sample s of a block that is covered everywhere.
  template <class Depth>
  void write_whole(std::size_t s, const Depth& z_at) {
    for (int p = 0; p < kPacketsPerBlock; ++p) {
      const int packet = block_of(s) * kPacketsPerBlock + p;
      const auto z = [&] { return z_at(s, p); };
      if (passes(s)) {
        writer_.write_whole(id_, packet, z);
      } else {
        writer_.write(id_, packet, kAllBits<Mask>, z);
      }
    }
    written_ |= 1u << s;
  }

  // Updates the depth bounds of samples that were written. is_whole: the block is covered everywhere.
  void update_bounds(bool is_whole) {
    if (!writer_.writes_depth()) return;
    for (const std::size_t s : kept()) {
      if ((written_ >> s & 1) == 0) continue;
      if (is_whole && passes(s) && !Writer::kTestsStencil) {
        set_hiz(d_.tile, block_of(s), z_.low, z_.high);
      } else {
        widen_hiz(writer_.compare_op(), d_.tile, block_of(s), z_.low, z_.high);
      }
    }
  }

  bool passes(std::size_t s) const { return (passes_ >> s & 1) != 0; }
  int block_of(std::size_t s) const { return block_ + samples_.shift[s] / kPacketsPerBlock; }

  const DrawInTile& d_;
  const SampleSet& samples_;
  const Triangle& triangle_;
  TriangleId id_;
  Writer& writer_;
  // The current block:
  int block_ = 0;
  DepthBounds z_{};
  uint32_t passes_ = 0;   // bit s: the depth test passes in all covered lanes of sample s
  uint32_t written_ = 0;  // bit s: the depth of sample s may have been written
  std::array<std::size_t, kMaxSamples> kept_;
  std::size_t kept_count_ = 0, listed_ = 0;
  std::array<Listed, kPacketsPerBlock + 1> list_;  // the element after the last one may be written
};

/// Rasterizes a triangle. rect: the pixels that may have covered samples. small: the triangle has kSmall.
template <bool small, class Writer>
void rasterize_sampled_triangle(const DrawInTile& d, const SampleSet& samples, const Triangle& t, const TileRect& rect, TriangleId id,
                                Writer& writer) {
  const SampleEdges edges(d, samples, t);
  if (edges.outside()) return;
  SampleBlocks blocks(d, samples, t, id, writer);
  const DepthInTile depth(t, d.draw, d.tile, d.context.samples_at);
  const bool spans_many = (rect.x1 - rect.x0) * (rect.y1 - rect.y0) * d.tile.samples >= kMaxTilePixels / 4;
  if (spans_many && blocks.rejects_tile(depth.at(rect.x0, rect.y0, rect.x1 - rect.x0, rect.y1 - rect.y0))) return;

  const DepthPlane<small> plane(t, edges.bias(), d.draw, SampleGrid(d.tile, 0), d.tile.depth_format);
  const SamplePosition first = sample_position(d.tile.samples, 0);
  std::array<std::array<int32_t, 3>, kPacketsPerBlock> step;  // of the edges, from the first packet of a block to each packet
  for (int p = 0; p < kPacketsPerBlock; ++p) {
    for (std::size_t i = 0; i < 3; ++i) step[static_cast<std::size_t>(p)][i] = edges.value_step(i, packet_x(p), packet_y(p));
  }
  constexpr int mask_to_block = ~(kBlockSize - 1);
  for (int y = rect.y0 & mask_to_block; y < rect.y1; y += kBlockSize) {
    for (int x = rect.x0 & mask_to_block; x < rect.x1; x += kBlockSize) {
      const BlockCoverage coverage = edges.block_coverage(x, y);
      if (coverage == BlockCoverage::none || !blocks.begin(x, y, depth.at(x, y, kBlockSize, kBlockSize))) continue;
      const auto z_at = [&](std::size_t s, int p) {
        const SamplePosition at = samples.position[s];
        return plane.at(edges.at(s), x + packet_x(p), y + packet_y(p), {at.x - first.x, at.y - first.y});
      };
      const bool is_cut = d.needs_bounds_test && !rect.contains_block(x, y);
      if (coverage == BlockCoverage::whole && !is_cut) {
        blocks.write_whole(z_at);
        continue;
      }
      std::array<std::array<Int, 3>, kMaxSamples> corner;
      for (std::size_t k = 0; k < blocks.kept().size(); ++k) {
        for (std::size_t i = 0; i < 3; ++i) corner[k][i] = edges.values(i, blocks.kept()[k], x, y);
      }
      for (int p = 0; p < kPacketsPerBlock; ++p) {
        const std::array<int32_t, 3>& by = step[static_cast<std::size_t>(p)];
        const uint32_t seen = is_cut ? bits(inside(rect, x + packet_x(p), y + packet_y(p))) : kAllBits<Mask>;
        blocks.list(p, [&](std::size_t k) {
          return seen & ~negative_bits((corner[k][0] + by[0]) | (corner[k][1] + by[1]) | (corner[k][2] + by[2]));
        });
      }
      blocks.write_listed(z_at);
    }
  }
}

/// Rasterizes a point, which covers a rectangle of each sample plane and has a constant depth. rect: their union.
template <class Writer>
void rasterize_sampled_point(const DrawInTile& d, const SampleSet& samples, const Triangle& t, const TileRect& rect, TriangleId id,
                             Writer& writer) {
  std::array<TileRect, kMaxSamples> covered;
  for (const std::size_t s : samples.indices()) {
    const PixelBounds b = pixel_bounds(d.draw, t, d.bounds, samples.position[s]);
    covered[s] = tile_rect(b, d.tile.x0, d.tile.y0);
  }
  const DepthBounds bounds = depth_bounds(t, d.draw, d.tile.depth_format);
  SampleBlocks blocks(d, samples, t, id, writer);
  for (int by = rect.y0 & ~(kBlockSize - 1); by < rect.y1; by += kBlockSize) {
    for (int bx = rect.x0 & ~(kBlockSize - 1); bx < rect.x1; bx += kBlockSize) {
      const int x0 = std::max(bx, rect.x0), y0 = std::max(by, rect.y0);
      const int x1 = std::min(bx + kBlockSize, rect.x1), y1 = std::min(by + kBlockSize, rect.y1);
      if (!blocks.begin(bx, by, bounds, (x1 - x0) * (y1 - y0) >= kManyPixels)) continue;
      for (int y = y0 & ~(kPacketHeight - 1); y < y1; y += kPacketHeight) {
        for (int x = x0 & ~(kPacketWidth - 1); x < x1; x += kPacketWidth)
          blocks.list(packet_at(x, y) % kPacketsPerBlock, [&](std::size_t k) { return bits(inside(covered[blocks.kept()[k]], x, y)); });
      }
      blocks.write_listed([&](std::size_t, int) { return Real(bounds.low); });
    }
  }
}

/// Rasterizes a triangle or point at all samples in the sample mask of the draw. The tile must be multisampled.
template <class Writer>
void rasterize_all_samples(const DrawInTile& d, const Triangle& t, TriangleId id, Writer writer) {
  writer.begin(t);
  const SampleSet samples(d);
  const PixelBounds b = pixel_bounds(d.draw, t, d.bounds, d.context.samples_at);
  if (samples.count == 0 || b.empty()) return;
  const TileRect rect = tile_rect(b, d.tile.x0, d.tile.y0);
  if (t.is(kPointSprite)) return rasterize_sampled_point(d, samples, t, rect, id, writer);
  if (t.is(kSmall)) return rasterize_sampled_triangle<true>(d, samples, t, rect, id, writer);
  rasterize_sampled_triangle<false>(d, samples, t, rect, id, writer);
}

}  // namespace halfspace::HS_LANES
