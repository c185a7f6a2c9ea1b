// SPDX-License-Identifier: Apache-2.0
//
// Visibility of all primitives but most small triangles, which visibility_small.cpp and visibility_samples.cpp draw. sample_blocks.h has
// the loops over the blocks of multisampled tiles.
#include <algorithm>

#include "halfspace/raster/pipeline/pixel_box.h"
#include "halfspace/raster/visibility/sample_blocks.h"
#include "halfspace/raster/visibility/thin_line.h"
#include "halfspace/raster/visibility/traced_writer.h"

namespace halfspace::HS_LANES {

namespace {

// Finds the covered packets of one block after the other and writes them.
template <bool small, class Writer>
class BlockPackets {
 public:
  BlockPackets(const DrawInTile& d, const Triangle& t, const TileEdges& tile_edges, const SampleGrid& grid, const TileRect& rect,
               TriangleId id, Writer& writer)
      : edges_(tile_edges), plane_(t, tile_edges.bias, d.draw, grid, d.tile.depth_format), rect_(rect), id_(id), writer_(writer) {
    for (int p = 0; p < kPacketsPerBlock; ++p) {
      for (std::size_t i = 0; i < 3; ++i) step_[static_cast<std::size_t>(p)][i] = edges_.value_step(i, packet_x(p), packet_y(p));
    }
  }

  const BlockEdges& edges() const { return edges_; }

  // Writes a block that is covered everywhere and passes everywhere. x, y: its corner.
  void write_whole(int block, int x, int y) {
    if constexpr (Writer::kQueues) {
      if (writer_.adds_untested(true)) return writer_.add_block(id_, block, [](int) { return kAllBits<Mask>; });
    }
    for (int p = 0; p < kPacketsPerBlock; ++p)
      writer_.write_whole(id_, block * kPacketsPerBlock + p, [&] { return plane_.at(edges_, x + packet_x(p), y + packet_y(p)); });
  }

  // Writes the covered packets of any other block. passes: the depth test passes everywhere.
  void write_some(int block, int x, int y, bool is_cut, bool passes) {
    const std::array<Int, 3> corner{edges_.values(0, x, y), edges_.values(1, x, y), edges_.values(2, x, y)};
    const auto lanes_at = [&](int p) {
      const std::array<int32_t, 3>& step = step_[static_cast<std::size_t>(p)];
      const uint32_t lanes = kAllBits<Mask> & ~negative_bits((corner[0] + step[0]) | (corner[1] + step[1]) | (corner[2] + step[2]));
      return is_cut ? lanes & bits(inside(rect_, x + packet_x(p), y + packet_y(p))) : lanes;
    };
    if constexpr (Writer::kQueues) {
      if (writer_.adds_untested(passes)) return writer_.add_block(id_, block, lanes_at);
    }
    // Whether a packet has covered lanes is nearly random and a branch would often be mispredicted, so the code has none.
    std::size_t listed = 0;
    for (int p = 0; p < kPacketsPerBlock; ++p) {
      const uint32_t lanes = lanes_at(p);
      list_[listed] = {static_cast<uint16_t>(p), static_cast<uint16_t>(lanes)};
      listed += lanes != 0 ? 1 : 0;
    }
    for (std::size_t i = 0; i < listed; ++i) {
      const int p = list_[i].packet;
      const auto z_at = [&] { return plane_.at(edges_, x + packet_x(p), y + packet_y(p)); };
      writer_.write(id_, block * kPacketsPerBlock + p, list_[i].lanes, z_at, passes);
    }
  }

 private:
  BlockEdges edges_;
  DepthPlane<small> plane_;
  TileRect rect_;
  TriangleId id_;
  Writer& writer_;
  std::array<std::array<int32_t, 3>, kPacketsPerBlock> step_;  // of the edges, from the first packet of a block to each packet
  std::array<PacketMask, kPacketsPerBlock + 1> list_;          // covered packets of a block; the element after the last one may be written
};

template <bool small, class Writer>
void rasterize_blocks(const DrawInTile& d, const Triangle& t, const TileEdges& tile_edges, const SampleGrid& grid, const TileRect& rect,
                      TriangleId id, Writer& writer) {
  Tile& tile = d.tile;
  const DepthInTile depth(t, d.draw, grid, tile.depth_format);
  const bool needs_bounds_test = d.needs_bounds_test || t.is(kPointSprite | kLine);
  const bool spans_many = (rect.x1 - rect.x0) * (rect.y1 - rect.y0) >= kMaxTilePixels / 4;
  if (spans_many && writer.tests()) {
    const DepthBounds z = depth.at(rect.x0, rect.y0, rect.x1 - rect.x0, rect.y1 - rect.y0);
    if (test_tile(writer.compare_op(), tile, z.low, z.high) == BlockTest::none_passes) return writer.tile_rejected(t, id, 0, z);
  }
  BlockPackets<small, Writer> packets(d, t, tile_edges, grid, rect, id, writer);
  constexpr int mask_to_block = ~(kBlockSize - 1);
  for (int y = rect.y0 & mask_to_block; y < rect.y1; y += kBlockSize) {
    for (int x = rect.x0 & mask_to_block; x < rect.x1; x += kBlockSize) {
      const BlockCoverage coverage = block_coverage(packets.edges(), x, y);
      if (coverage == BlockCoverage::none) continue;
      const int block = y / kBlockSize * kBlocksPerRow + x / kBlockSize;
      const DepthBounds z = depth.at(x, y, kBlockSize, kBlockSize);
      const BlockTest test = writer.tests() ? test_block(writer.compare_op(), tile, block, z.low, z.high) : BlockTest::all_pass;
      if (test == BlockTest::none_passes) {
        writer.block_rejected(t, id, 0, block, z);
        continue;
      }
      const bool is_cut = needs_bounds_test && !rect.contains_block(x, y);
      const bool passes = test == BlockTest::all_pass;
      if constexpr (!Writer::kTestsStencil) {
        if (coverage == BlockCoverage::whole && passes && !is_cut) {
          packets.write_whole(block, x, y);
          if (writer.writes_depth()) set_hiz(tile, block, z.low, z.high);
          continue;
        }
      }
      packets.write_some(block, x, y, is_cut, passes);
      if (writer.writes_depth()) widen_hiz(writer.compare_op(), tile, block, z.low, z.high);
    }
  }
}

// A point covers a rectangle and has a constant depth.
template <class Writer>
void rasterize_point(const DrawInTile& d, const Triangle& t, const TileRect& rect, TriangleId id, Writer& writer) {
  const DepthBounds z = depth_bounds(t, d.draw, d.tile.depth_format);
  for (int by = rect.y0 & ~(kBlockSize - 1); by < rect.y1; by += kBlockSize) {
    for (int bx = rect.x0 & ~(kBlockSize - 1); bx < rect.x1; bx += kBlockSize) {
      const int block = by / kBlockSize * kBlocksPerRow + bx / kBlockSize;
      const int x0 = std::max(bx, rect.x0), y0 = std::max(by, rect.y0);
      const int x1 = std::min(bx + kBlockSize, rect.x1), y1 = std::min(by + kBlockSize, rect.y1);
      const bool may_refresh = (x1 - x0) * (y1 - y0) >= kManyPixels;
      if (writer.tests() && test_block(writer.compare_op(), d.tile, block, z.low, z.high, may_refresh) == BlockTest::none_passes) {
        writer.block_rejected(t, id, 0, block, z);
        continue;
      }
      for (int y = y0 & ~(kPacketHeight - 1); y < y1; y += kPacketHeight) {
        for (int x = x0 & ~(kPacketWidth - 1); x < x1; x += kPacketWidth)
          writer.write(id, packet_at(x, y), bits(inside(rect, x, y)), [&] { return Real(z.low); });
      }
      if (writer.writes_depth()) widen_hiz(writer.compare_op(), d.tile, block, z.low, z.high);
    }
  }
}

// Rasterizes a primitive in a tile with one sample per pixel.
template <class Writer>
void rasterize_one_sample(const DrawInTile& d, const Triangle& t, TriangleId id, Writer writer) {
  writer.begin(t);
  const SampleGrid grid(d.tile, 0);
  const PixelBounds b = pixel_bounds(d.draw, t, d.bounds, grid.position);
  if (b.empty()) return;
  const TileRect rect = tile_rect(b, grid.x0, grid.y0);
  if (t.is(kPointSprite)) return rasterize_point(d, t, rect, id, writer);
  if (t.is(kLine) && line_pixels(d.draw.state.line_width) == 1) return rasterize_thin_line(d, t, b, id, writer);
  const TileEdges edges = tile_edges(d.draw, t, grid, d.tile.size);
  if (edges.outside) return;
  if (t.is(kSmall)) {
    rasterize_blocks<true>(d, t, edges, grid, rect, id, writer);
  } else {
    rasterize_blocks<false>(d, t, edges, grid, rect, id, writer);
  }
}

// Rasterizes a primitive in a tile.
template <class W>
void rasterize(const DrawInTile& d, const Triangle& t, TriangleId id, PacketQueue& queue, PassStatistics& statistics) {
  if constexpr (W::kMultisampled) {
    rasterize_all_samples(d, t, id, W(d, &queue, statistics));
  } else {
    rasterize_one_sample(d, t, id, W(d, &queue, statistics));
  }
}

}  // namespace

bool covers_tile(const DrawInTile& d, const Triangle& t) {
  if (t.is(kSmall | kPointSprite | kLine)) return false;
  const TileEdges edges = tile_edges(d.draw, t, SampleGrid(d.tile, 0), d.tile.size);
  bool whole = !edges.outside;
  for (std::size_t i = 0; i < 3; ++i) whole &= edges.e[i] == 0 && edges.step_x[i] == 0 && edges.step_y[i] == 0;
  return whole;
}

void write_full_tile(const DrawInTile& d, const Triangle& t, TriangleId id) {
  const SampleGrid grid(d.tile, 0);
  const TileEdges tile_edges{};
  const DepthPlane<false> plane(t, tile_edges.bias, d.draw, grid, d.tile.depth_format);
  const BlockEdges edges(tile_edges);
  PassStatistics counted_before;
  Writer<TilePath::opaque, false> writer(d, nullptr, counted_before);
  if (d.mode == VisibilityMode::depth_only && !writer.writes_depth()) return;
  for (int p = 0; p < kPackets; ++p) writer.write_whole(id, p, [&] { return plane.at(edges, packet_x(p), packet_y(p)); });
  if (!writer.writes_depth()) return;
  const DepthInTile depth(t, d.draw, grid, d.tile.depth_format);
  for (int b = 0; b < kBlocks; ++b) {
    const auto [low, high] = depth.at(b % kBlocksPerRow * kBlockSize, b / kBlocksPerRow * kBlockSize, kBlockSize, kBlockSize);
    set_hiz(d.tile, b, low, high);
  }
}

RasterizeFunction rasterize_function(const DrawInTile& d) {
  const auto function = []<class W>() -> RasterizeFunction { return rasterize<W>; };
  return d.tile.samples > 1 ? with_writer<true>(d, function) : with_writer<false>(d, function);
}

}  // namespace halfspace::HS_LANES
