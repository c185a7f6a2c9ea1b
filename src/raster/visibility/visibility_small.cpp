// SPDX-License-Identifier: Apache-2.0
//
// Visibility of small triangles with one sample per pixel. Up to W triangles of a bin are prepared at once, one per lane, in int32. Then
// they are written one by one, in submission order.
#include <algorithm>
#include <bit>

#include "halfspace/raster/pipeline/pixel_box.h"
#include "halfspace/raster/pipeline/triangle_lanes.h"
#include "halfspace/raster/primitives/small_coverage.h"
#include "halfspace/raster/visibility/hidden_triangle.h"
#include "halfspace/raster/visibility/small_triangle.h"
#include "halfspace/raster/visibility/traced_writer.h"

namespace halfspace::HS_LANES {

namespace {

constexpr int kMaxCovered = std::popcount(kCoveredBits);

// Data for writing up to W small triangles, computed for all of them at once.
class SmallTriangles {
 public:
  // indices: 1 to W triangles of the chunk.
  HS_INLINE SmallTriangles(const DrawInTile& d, const Chunk& chunk, std::span<const uint16_t> indices) {
    const auto triangle = [&](int k) { return &chunk.triangles[indices[std::min(static_cast<std::size_t>(k), indices.size() - 1)]]; };
    static_assert(offsetof(Triangle, z_edge1) == offsetof(Triangle, z0) + sizeof(float) &&
                  offsetof(Triangle, z_max) == offsetof(Triangle, z0) + 3 * sizeof(float));
    const auto [x, y] = load_corners(triangle);
    const std::array<Int, 4> depths = load_aos4<Int>([&](int k) { return &triangle(k)->z0; });
    const Int flags = load_vertices_and_flags(triangle)[3];
    const Real low(d.draw.depth_low), high = clamp(as_real(depths[3]), low, Real(d.draw.depth_high));
    const SmallDepth depth{as_real(depths[0]), as_real(depths[1]), as_real(depths[2]), low, high};

    const SampleGrid grid(d.tile, 0);
    const SamplePosition at = grid.position;
    const PixelBox<Int> box = pixel_box(x, y, SampleSpan{at.x, at.x}, SampleSpan{at.y, at.y});
    const Int covered = (flags >> static_cast<int>(kCoveredShift)) & static_cast<int32_t>(kCoveredBits);
    known_ = bits(covered != Int(0));
    wide_ =
        bits(max_of(x) - min_of(x) > Int(kMaxSmallSpan * kSubPixels) || max_of(y) - min_of(y) > Int(kMaxSmallSpan * kSubPixels)) & ~known_;
    if (known_ != 0) find_pixels(d, x, y, intersect(box, d.draw.bounds), covered, depth);
    if ((known_ | wide_) == kAllBits<Mask>) return;
    const PixelBox<Int> seen = intersect(box, d.bounds);
    store(rect_x0_.data(), seen.x0 - grid.x0);
    store(rect_y0_.data(), seen.y0 - grid.y0);
    store(rect_x1_.data(), seen.x1 - grid.x0);
    store(rect_y1_.data(), seen.y1 - grid.y0);
    // Coordinates are relative to the first sample of the grid. They fit in 16 bits, because the triangles are small and touch the tile.
    const Int x_first(grid.x_sub()), y_first(grid.y_sub());
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t a = (i + 1) % 3, b = (i + 2) % 3;
      const Int ex = x[b] - x[a], ey = y[b] - y[a];
      const Int bias = fill_bias(ex, ey);
      store(e_[i].data(), ey * (x[a] - x_first) - ex * (y[a] - y_first) - bias);
      store(step_x_[i].data(), -ey << kSubPixelBits);
      store(step_y_[i].data(), ex << kSubPixelBits);
      if (i != 0) store(bias_[i - 1].data(), bias);
    }
  }

  bool is_wide(std::size_t k) const { return (wide_ >> k & 1) != 0; }
  bool is_known(std::size_t k) const { return (known_ >> k & 1) != 0; }

  // For a triangle whose pixels were found in setup: calls f(pixel of the tile, depth) for each pixel within the bounds.
  template <class F>
  HS_INLINE void for_each_pixel(std::size_t k, const F& f) const {
    for (std::size_t i = 0; i < static_cast<std::size_t>(count_[k]); ++i) {
      if (pixel_[i][k] >= 0) f(static_cast<std::size_t>(pixel_[i][k]), z_[i][k]);
    }
  }

  // Returns the pixels that may be covered, for all other triangles.
  TileRect rect(std::size_t k) const { return {rect_x0_[k], rect_y0_[k], rect_x1_[k], rect_y1_[k]}; }
  SmallEdge edge(std::size_t i, std::size_t k) const { return {e_[i][k], step_x_[i][k], step_y_[i][k]}; }
  int32_t bias(std::size_t i, std::size_t k) const { return bias_[i - 1][k]; }  // edge 1 or 2

 private:
  // box: bounding boxes clipped to the bounds of the draw, as used for the bits of `covered`.
  void find_pixels(const DrawInTile& d, const std::array<Int, 3>& x, const std::array<Int, 3>& y, const PixelBox<Int>& box, Int covered,
                   const SmallDepth& depth) {
    Int count(0);
    for (std::size_t i = 0; any(covered != Int(0)); ++i) {
      count = count + select(covered != Int(0), Int(1), Int(0));
      const Int bit = (as_int(to_real<Real>(covered & -covered)) >> 23) - 127;  // exponent of the lowest set bit
      covered = covered & (covered - 1);
      const Int px = box.x0 + (bit & (kCoverSide - 1)), py = box.y0 + (bit >> std::countr_zero(unsigned{kCoverSide}));
      const Int x_sub = (px << kSubPixelBits) + kSubPixels / 2, y_sub = (py << kSubPixelBits) + kSubPixels / 2;
      const auto edge = [&](std::size_t a, std::size_t b) { return (x[b] - x[a]) * (y_sub - y[a]) - (y[b] - y[a]) * (x_sub - x[a]); };
      store(z_[i].data(), depth.at(d.tile.depth_format, edge(2, 0), edge(0, 1)));
      const Mask seen = px >= Int(d.bounds.x0) && py >= Int(d.bounds.y0) && px < Int(d.bounds.x1) && py < Int(d.bounds.y1);
      store(pixel_[i].data(), select(seen, pixel_at(px - d.tile.x0, py - d.tile.y0), Int(-1)));
    }
    store(count_.data(), count);
  }

  alignas(64) std::array<PerTriangle<int32_t>, kMaxCovered> pixel_;
  alignas(64) std::array<PerTriangle<float>, kMaxCovered> z_;
  alignas(64) PerTriangle<int32_t> count_;
  alignas(64) PerTriangle<int32_t> rect_x0_, rect_y0_, rect_x1_, rect_y1_;
  alignas(64) std::array<PerTriangle<int32_t>, 3> e_, step_x_, step_y_;
  alignas(64) std::array<PerTriangle<int32_t>, 2> bias_;
  uint32_t known_, wide_;
};

// Finds and writes the packets of one of the triangles.
template <class Writer>
class TrianglePackets {
 public:
  // t: triangle k of `triangles`.
  TrianglePackets(const DrawInTile& d, const SmallTriangles& triangles, std::size_t k, const Triangle& t, TriangleId id, Writer& writer)
      : d_(d),
        id_(id),
        writer_(writer),
        rect_(triangles.rect(k)),
        bias1_(triangles.bias(1, k)),
        bias2_(triangles.bias(2, k)),
        bounds_(depth_bounds(t, d.draw, d.tile.depth_format)) {
    for (std::size_t i = 0; i < 3; ++i) {
      edge_[i] = triangles.edge(i, k);
      first_[i] = lane_x() * edge_[i].step_x + lane_y() * edge_[i].step_y + edge_[i].e;
    }
    depth_ = small_depth(t, d.draw.depth_low, d.draw.depth_high);
  }

  void visit() {
    if (rect_.empty()) return;
    const int column0 = rect_.x0 / kPacketWidth, column1 = (rect_.x1 - 1) / kPacketWidth;
    const int row0 = rect_.y0 / kPacketHeight, row1 = (rect_.y1 - 1) / kPacketHeight;
    if ((column1 - column0 + 1) * (row1 - row0 + 1) <= kFewPackets || kLanes == 1) {
      list_each(column0, column1, row0, row1);
    } else {
      list_rows(column0, column1, row0, row1);
    }
    for (std::size_t i = 0; i < listed_; ++i) write(list_[i]);
  }

 private:
  static constexpr int kFewPackets = 40;
  static constexpr std::size_t kMaxPackets = (kMaxSmallSpan / kPacketWidth + 2) * (kMaxSmallSpan / kPacketHeight + 2);

  // A packet with covered pixels.
  struct Covered {
    int packet;
    uint32_t lanes;
    int32_t e1, e2;  // offsets of edges 1 and 2 from their values in the first packet of the grid
  };

  void list_each(int column0, int column1, int row0, int row1) {
    std::array<int32_t, 3> right, up, start;
    for (std::size_t i = 0; i < 3; ++i) {
      right[i] = edge_[i].step_x * kPacketWidth;
      up[i] = edge_[i].step_y * kPacketHeight;
      start[i] = right[i] * column0 + up[i] * row0;
    }
    for (int row = row0; row <= row1; ++row) {
      std::array<int32_t, 3> at = start;
      for (int column = column0; column <= column1; ++column) {
        list(at, column, row);
        for (std::size_t i = 0; i < 3; ++i) at[i] += right[i];
      }
      for (std::size_t i = 0; i < 3; ++i) start[i] += up[i];
    }
  }

  // Processes one row of packets at a time. Tests for W columns at once whether their packets can have covered pixels.
  void list_rows(int column0, int column1, int row0, int row1) {
    std::array<Int, 3> best;  // largest edge values in the packets of row 0
    for (std::size_t i = 0; i < 3; ++i) {
      const SmallEdge& e = edge_[i];
      const int32_t rise = std::max(0, e.step_x * (kPacketWidth - 1)) + std::max(0, e.step_y * (kPacketHeight - 1));
      best[i] = iota<Int>() * (e.step_x * kPacketWidth) + (e.e + rise);
    }
    const auto step = [&](std::size_t i, int column, int row) {
      return edge_[i].step_x * (column * kPacketWidth) + edge_[i].step_y * (row * kPacketHeight);
    };
    for (int row = row0; row <= row1; ++row) {
      for (int group = column0 / kLanes * kLanes; group <= column1; group += kLanes) {
        const Int column = iota<Int>() + group;
        const Mask reaches =
            ((best[0] + step(0, group, row)) | (best[1] + step(1, group, row)) | (best[2] + step(2, group, row))) >= Int(0);
        const Mask asked = (column >= Int(column0)) & (column <= Int(column1));
        for (uint32_t rest = bits(reaches & asked); rest != 0; rest &= rest - 1) {
          const int c = group + std::countr_zero(rest);
          list({step(0, c, row), step(1, c, row), step(2, c, row)}, c, row);
        }
      }
    }
  }

  // Appends a packet to the list if it has covered pixels. at: differences of the edge functions from their values in the first packet of
  // the tile. The outcome is nearly random and a branch would often be mispredicted, so the code has none. The list is complete before the
  // first packet is written.
  HS_INLINE void list(const std::array<int32_t, 3>& at, int column, int row) {
    uint32_t lanes = kAllBits<Mask> & ~negative_bits((first_[0] + at[0]) | (first_[1] + at[1]) | (first_[2] + at[2]));
    if (d_.needs_bounds_test) lanes &= bits(inside(rect_, column * kPacketWidth, row * kPacketHeight));
    list_[listed_] = {packet_at(column * kPacketWidth, row * kPacketHeight), lanes, at[1], at[2]};
    listed_ += lanes != 0 ? 1 : 0;
  }

  HS_INLINE void write(const Covered& c) {
    const auto z_at = [&] { return depth_.at(d_.tile.depth_format, first_[1] + (c.e1 + bias1_), first_[2] + (c.e2 + bias2_)); };
    const bool passed = writer_.write(id_, c.packet, c.lanes, z_at);
    if (passed && writer_.writes_depth()) widen_hiz(writer_.compare_op(), d_.tile, c.packet / kPacketsPerBlock, bounds_.low, bounds_.high);
  }

  const DrawInTile& d_;
  TriangleId id_;
  Writer& writer_;
  TileRect rect_;
  std::array<SmallEdge, 3> edge_;
  int32_t bias1_, bias2_;
  std::array<Int, 3> first_;  // edge values in the first packet of the grid
  SmallDepth depth_;
  DepthBounds bounds_;
  std::size_t listed_ = 0;
  std::array<Covered, kMaxPackets + 1> list_;  // the element after the last one may be written
};

// Draws triangle k of `triangles`, which is `index` of the chunk.
template <class Writer, class Large>
HS_INLINE void write_triangle(const DrawInTile& d, const SmallTriangles& triangles, std::size_t k, uint32_t chunk, uint16_t index,
                              Writer& writer, const Large& rasterize_large) {
  const TriangleId id = triangle_id(chunk, index);
  const Triangle& t = d.context.chunks[chunk].triangles[index];
  writer.begin(t);
  if (triangles.is_known(k)) {
    triangles.for_each_pixel(k, [&](std::size_t pixel, float z) { writer.write_pixel(id, pixel, z); });
  } else if (triangles.is_wide(k)) {
    rasterize_large(t, id);
  } else if (is_hidden(d, t, triangles.rect(k), writer)) {
    report_hidden(d, t, id, triangles.rect(k), 0, writer);
  } else {
    TrianglePackets<Writer>(d, triangles, k, t, id, writer).visit();
  }
}

template <class W>
std::size_t rasterize_small(const DrawInTile& d, uint32_t chunk, std::span<const uint16_t> indices, PacketQueue& queue,
                            PassStatistics& statistics) {
  const SmallTriangles triangles(d, d.context.chunks[chunk], indices);
  const auto large = [&](const Triangle& t, TriangleId id) { rasterize_function(d)(d, t, id, queue, statistics); };
  W writer(d, &queue, statistics);
  std::size_t k = 0;
  do {
    write_triangle(d, triangles, k, chunk, indices[k], writer, large);
  } while (++k < indices.size() && !(W::kQueues && queue.is_full()));
  return k;
}

}  // namespace

RasterizeSmallFunction rasterize_small_function(const DrawInTile& d) {
  return with_writer<false>(d, []<class W>() -> RasterizeSmallFunction { return rasterize_small<W>; });
}

}  // namespace halfspace::HS_LANES
