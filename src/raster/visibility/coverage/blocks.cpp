// SPDX-License-Identifier: Apache-2.0
//
// Visibility of all primitives but small triangles (small_triangles.cpp), block by block.
#include <algorithm>

#include "halfspace/raster/pipeline/pixel_box.h"
#include "halfspace/raster/pipeline/triangle_sizes.h"
#include "halfspace/raster/tile/tile_rect.h"
#include "halfspace/raster/visibility/coverage/depth_plane.h"
#include "halfspace/raster/visibility/coverage/smooth.h"
#include "halfspace/raster/visibility/coverage/thin_line.h"
#include "halfspace/raster/visibility/coverage/traced_writer.h"

namespace halfspace::HS_LANES {

namespace {

// Tests and writes the covered packets of one primitive, block by block. Pixels, packets and blocks are numbered as in the plane of sample
// 0.
template <class Writer>
class Blocks {
 public:
  using Samples = SampleSet<Writer::kMultisampled>;
  using Lanes = PacketLanes<Writer::kMultisampled>;

  Blocks(const DrawInTile& d, const Samples& samples, const Triangle& t, TriangleId id, Writer& writer)
      : d_(d), samples_(samples), triangle_(t), id_(id), writer_(writer) {}

  // Returns true if the depth test rejects depths in [z.low, z.high] everywhere in the tile.
  bool rejects_tile(const DepthBounds& z) {
    if (!writer_.tests() || test_tile(writer_.compare_op(), d_.tile, z) != BlockTest::none_passes) return false;
    for (const std::size_t s : samples_.indices()) writer_.tile_rejected(triangle_, id_, s, z);
    return true;
  }

  // Starts the block with corner (x, y). Depths in it are in [z.low, z.high]. Returns false if the depth test rejects all of its samples.
  // may_refresh: see test_block().
  HS_INLINE bool begin(int x, int y, const DepthBounds& z, bool may_refresh = true) {
    block_ = y / kBlockSize * kBlocksPerRow + x / kBlockSize;
    z_ = z;
    kept_count_ = 0;
    passes_ = ~0u;
    written_ = 0;
    for (const std::size_t s : samples_.indices()) {
      const BlockTest test = writer_.tests() ? test_block(writer_.compare_op(), d_.tile, block_of(s), z, may_refresh) : BlockTest::all_pass;
      if (test == BlockTest::none_passes) {
        writer_.block_rejected(triangle_, id_, s, block_of(s), z);
        continue;
      }
      kept_[kept_count_++] = s;
      if (test == BlockTest::some_may) passes_ &= ~(1u << s);
    }
    return kept_count_ != 0;
  }

  // Writes the covered packets of the block. lanes_at(p, k): covered lanes of packet p at sample kept()[k]; z_at(s, p): returns the depth
  // of packet p at sample s; is_whole: the block is covered everywhere.
  template <class LanesAt, class Depth>
  HS_INLINE void write_some(const LanesAt& lanes_at, const Depth& z_at, bool is_whole = false) {
    const auto all_lanes = [&](int p) {
      Lanes lanes{};
      for (std::size_t k = 0; k < kept().size(); ++k) lanes[kept()[k]] = static_cast<typename Lanes::value_type>(lanes_at(p, k));
      return lanes;
    };
    if constexpr (Writer::kQueues) {
      if (writer_.adds_untested(passes_ == ~0u)) return writer_.add_block(id_, block_, all_lanes);
    }
    // Whether a packet has covered samples is nearly random and a branch would often be mispredicted, so the code has none.
    std::size_t listed = 0;
    for (int p = 0; p < kPacketsPerBlock; ++p) {
      list_[listed] = {static_cast<uint16_t>(p), all_lanes(p)};
      uint32_t any = 0;
      for (const uint32_t of_sample : list_[listed].lanes) any |= of_sample;
      listed += any != 0 ? 1 : 0;
    }
    for (std::size_t i = 0; i < listed; ++i) write(list_[i].packet, list_[i].lanes, z_at);
    update_bounds(is_whole);
  }

  // Writes the packets of the block that overlap r, a rectangle in the block. lanes_at(x, y, k): covered lanes of the packet at (x, y).
  // Does not list the packets first, because nearly all of them have covered samples.
  template <class LanesAt, class Depth>
  HS_INLINE void write_overlapping(const TileRect& r, const LanesAt& lanes_at, const Depth& z_at) {
    for (int y = r.y0 & ~(kPacketHeight - 1); y < r.y1; y += kPacketHeight) {
      for (int x = r.x0 & ~(kPacketWidth - 1); x < r.x1; x += kPacketWidth) {
        Lanes lanes{};
        for (std::size_t k = 0; k < kept().size(); ++k) lanes[kept()[k]] = static_cast<typename Lanes::value_type>(lanes_at(x, y, k));
        write(packet_at(x, y) - block_ * kPacketsPerBlock, lanes, z_at);
      }
    }
    update_bounds(false);
  }

  // Writes a block that is covered everywhere. z_at: as in write_some().
  template <class Depth>
  HS_INLINE void write_whole(const Depth& z_at) {
    if constexpr (Writer::kQueues || Writer::kTestsStencil) {
      write_some([](int, std::size_t) { return kAllBits<Mask>; }, z_at, true);
    } else {
      for (const std::size_t s : kept()) write_whole(s, z_at);
      update_bounds(true);
    }
  }

  // Returns the samples that the depth test did not reject in this block.
  auto kept() const {
    if constexpr (Writer::kMultisampled) {
      return std::span<const std::size_t>(kept_.data(), kept_count_);
    } else {
      return Samples::indices();
    }
  }

 private:
  // A packet of the block with covered samples.
  struct Listed {
    uint16_t packet;
    Lanes lanes;
  };

  template <class Depth>
  HS_INLINE void write(int p, const Lanes& lanes, const Depth& z_at) {
    write_samples(
        writer_, samples_, id_, block_ * kPacketsPerBlock + p, lanes, passes_, [&](std::size_t s) { return z_at(s, p); },
        [&](std::size_t s, int) { written_ |= 1u << s; });
  }

  // Writes sample s of a block that is covered everywhere.
  template <class Depth>
  HS_INLINE void write_whole(std::size_t s, const Depth& z_at) {
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
  HS_INLINE void update_bounds(bool is_whole) {
    if (!writer_.writes_depth()) return;
    for (const std::size_t s : kept()) {
      if ((written_ >> s & 1) == 0) continue;
      if (is_whole && passes(s) && !Writer::kTestsStencil) {
        set_hiz(d_.tile, block_of(s), z_);
      } else {
        widen_hiz(writer_.compare_op(), d_.tile, block_of(s), z_);
      }
    }
  }

  bool passes(std::size_t s) const { return (passes_ >> s & 1) != 0; }
  int block_of(std::size_t s) const { return block_ + samples_.shift[s] / kPacketsPerBlock; }

  const DrawInTile& d_;
  const Samples& samples_;
  const Triangle& triangle_;
  TriangleId id_;
  Writer& writer_;
  // The current block:
  int block_ = 0;
  DepthBounds z_{};
  uint32_t passes_ = 0;   // bit s: the depth test passes in all covered lanes of sample s
  uint32_t written_ = 0;  // bit s: the depth of sample s may have been written
  std::array<std::size_t, kSamplesOf<Writer::kMultisampled>> kept_;
  std::size_t kept_count_ = 0;
  std::array<Listed, kPacketsPerBlock + 1> list_;  // the element after the last one may be written
};

// Rasterizes a triangle or line. rect: the pixels that may have covered samples. narrow: the primitive has kNarrow.
template <bool narrow, class Writer>
void rasterize_edges(const DrawInTile& d, const SampleSet<Writer::kMultisampled>& samples, const Triangle& t, const TileRect& rect,
                     TriangleId id, Writer& writer) {
  const TileEdges<Writer::kMultisampled> edges(d.draw, d.tile, samples, t);
  if (edges.outside()) return;
  Blocks<Writer> blocks(d, samples, t, id, writer);
  const DepthInTile depth(t, d.draw, d.tile, d.context.samples_at);
  const bool spans_many = rect.width() * rect.height() * static_cast<int>(samples.tile_samples) >= kMaxTilePixels / 4;
  if (spans_many && blocks.rejects_tile(depth.at(rect.x0, rect.y0, rect.width(), rect.height()))) return;

  const PacketDepth<narrow, Writer::kMultisampled> packet_depth(t, d.draw, d.tile, samples, edges);
  std::array<std::array<int32_t, 3>, kPacketsPerBlock> step;  // of the edges, from the first packet of a block to each packet
  for (int p = 0; p < kPacketsPerBlock; ++p) {
    for (std::size_t i = 0; i < 3; ++i) step[static_cast<std::size_t>(p)][i] = edges.value_step(i, packet_x(p), packet_y(p));
  }
  const bool needs_bounds_test = d.needs_bounds_test || t.is_line();
  constexpr int mask_to_block = ~(kBlockSize - 1);
  for (int y = rect.y0 & mask_to_block; y < rect.y1; y += kBlockSize) {
    for (int x = rect.x0 & mask_to_block; x < rect.x1; x += kBlockSize) {
      const BlockCoverage coverage = edges.block_coverage(x, y);
      if (coverage == BlockCoverage::none || !blocks.begin(x, y, depth.at(x, y, kBlockSize, kBlockSize))) continue;
      const auto z_at = [&](std::size_t s, int p) { return packet_depth.at(s, x + packet_x(p), y + packet_y(p)); };
      const bool is_cut = needs_bounds_test && !rect.contains_block(x, y);
      if (coverage == BlockCoverage::whole && !is_cut) {
        blocks.write_whole(z_at);
        continue;
      }
      std::array<std::array<Int, 3>, kSamplesOf<Writer::kMultisampled>> corner;
      for (std::size_t k = 0; k < blocks.kept().size(); ++k) {
        for (std::size_t i = 0; i < 3; ++i) corner[k][i] = edges.values(i, blocks.kept()[k], x, y);
      }
      const auto lanes_at = [&](int p, std::size_t k) {
        const std::array<int32_t, 3>& by = step[static_cast<std::size_t>(p)];
        const uint32_t seen = is_cut ? bits(inside(rect, x + packet_x(p), y + packet_y(p))) : kAllBits<Mask>;
        return seen & ~negative_bits((corner[k][0] + by[0]) | (corner[k][1] + by[1]) | (corner[k][2] + by[2]));
      };
      blocks.write_some(lanes_at, z_at);
    }
  }
}

// Rasterizes a point, which covers a rectangle of each sample plane and has a constant depth. rect: their union.
template <class Writer>
void rasterize_point(const DrawInTile& d, const SampleSet<Writer::kMultisampled>& samples, const Triangle& t, const TileRect& rect,
                     TriangleId id, Writer& writer) {
  std::array<TileRect, kSamplesOf<Writer::kMultisampled>> covered{rect};
  if constexpr (Writer::kMultisampled) {
    for (const std::size_t s : samples.indices()) covered[s] = tile_rect(pixel_bounds(d.draw, t, d.bounds, samples.position[s]), d.tile);
  }
  const DepthBounds z = depth_bounds(t, d.draw, d.tile.depth_format);
  Blocks<Writer> blocks(d, samples, t, id, writer);
  for (int by = rect.y0 & ~(kBlockSize - 1); by < rect.y1; by += kBlockSize) {
    for (int bx = rect.x0 & ~(kBlockSize - 1); bx < rect.x1; bx += kBlockSize) {
      const TileRect r{std::max(bx, rect.x0), std::max(by, rect.y0), std::min(bx + kBlockSize, rect.x1),
                       std::min(by + kBlockSize, rect.y1)};
      if (!blocks.begin(bx, by, z, r.width() * r.height() >= kTestedPixels)) continue;
      blocks.write_overlapping(
          r, [&](int x, int y, std::size_t k) { return bits(inside(covered[blocks.kept()[k]], x, y)); },
          [&](std::size_t, int) { return Real(z.low); });
    }
  }
}

template <class Writer>
void rasterize(const DrawInTile& d, const Triangle& t, TriangleId id, PacketQueue& queue, PassStatistics& statistics) {
  const SampleSet<Writer::kMultisampled> samples(d);
  const PixelBounds b = pixel_bounds(d.draw, t, d.bounds, d.context.samples_at);
  if (samples.count == 0 || b.empty()) return;
  Writer writer(d, &queue, statistics);
  writer.begin(t);
  const TileRect rect = tile_rect(b, d.tile);
  if (t.is_point()) return rasterize_point(d, samples, t, rect, id, writer);
  if constexpr (!Writer::kMultisampled) {
    if (t.is_line() && line_pixels(d.draw.state.line_width) == 1) return rasterize_thin_line(d, t, b, id, writer);
  }
  if (t.is(kNarrow)) return rasterize_edges<true>(d, samples, t, rect, id, writer);
  rasterize_edges<false>(d, samples, t, rect, id, writer);
}

}  // namespace

bool covers_tile(const DrawInTile& d, const Triangle& t) {
  if (!t.is_wide_triangle()) return false;
  return TileEdges<false>(d.draw, d.tile, SampleSet<false>(d), t).cover_tile();
}

void write_full_tile(const DrawInTile& d, const Triangle& t, TriangleId id) {
  const LargeDepthPlane plane(t, d.draw, d.tile, kPixelCenter);
  PassStatistics counted_before;
  Writer<TilePath::opaque, false> writer(d, nullptr, counted_before);
  if (d.mode == VisibilityMode::depth_only && !writer.writes_depth()) return;
  for (int p = 0; p < kPackets; ++p) writer.write_whole(id, p, [&] { return plane.at(lane_x() + packet_x(p), lane_y() + packet_y(p)); });
  if (!writer.writes_depth()) return;
  const DepthInTile depth(t, d.draw, d.tile, d.context.samples_at);
  for (int b = 0; b < kBlocks; ++b) {
    set_hiz(d.tile, b, depth.at(b % kBlocksPerRow * kBlockSize, b / kBlocksPerRow * kBlockSize, kBlockSize, kBlockSize));
  }
}

RasterizeFunction rasterize_function(const DrawInTile& d) {
  if (d.draw.is_smooth) return with_writer<false>(d, []<class Writer>() -> RasterizeFunction { return rasterize_smooth<Writer>; });
  const auto function = []<class Writer>() -> RasterizeFunction { return rasterize<Writer>; };
  return d.tile.samples > 1 ? with_writer<true>(d, function) : with_writer<false>(d, function);
}

}  // namespace halfspace::HS_LANES
