// SPDX-License-Identifier: Apache-2.0
//
// Visibility of narrow triangles. NarrowTriangles computes the edges of up to W triangles of a bin at once, one per lane, in int32.
// rasterize_narrow() then draws the triangles in submission order. It writes the pixels of a tiny triangle one by one, those of any other
// small triangle by packet, and passes larger triangles to blocks.cpp.
#include <algorithm>
#include <bit>
#include <cstddef>

#include "halfspace/raster/pipeline/pixel_box.h"
#include "halfspace/raster/pipeline/triangle_lanes.h"
#include "halfspace/raster/pipeline/triangle_sizes.h"
#include "halfspace/raster/tile/tile_rect.h"
#include "halfspace/raster/visibility/coverage/depth_plane.h"
#include "halfspace/raster/visibility/coverage/traced_writer.h"
#include "halfspace/raster/visibility/tests/hidden_triangle.h"

namespace halfspace::HS_LANES {

namespace {

constexpr int kMaxCovered = std::popcount(kCoveredBits);

template <class T>
using PerTriangle = std::array<T, static_cast<std::size_t>(kLanes)>;

// Edges, bounds and known pixels of up to W narrow triangles, computed for all of them at once.
template <bool multisampled>
class NarrowTriangles {
 public:
  // indices: 1 to W triangles of the chunk.
  HS_INLINE NarrowTriangles(const DrawInTile& d, const SampleSet<multisampled>& samples, const Chunk& chunk,
                            std::span<const uint16_t> indices) {
    const auto triangle = [&](int k) { return &chunk.triangles[indices[std::min(static_cast<std::size_t>(k), indices.size() - 1)]]; };
    const auto [x, y] = load_corners(triangle);
    const PixelBox<Int> box = pixel_box(x, y, d.context.samples_at, d.context.samples_at);
    if constexpr (!multisampled) {
      const Int flags = load_vertices_and_flags(triangle)[3];
      const Int covered = (flags >> static_cast<int>(kCoveredShift)) & static_cast<int32_t>(kCoveredBits);
      tiny_ = bits(covered != Int(0));
      if (tiny_ != 0) find_pixels(d, x, y, intersect(box, d.draw.bounds), covered, depth_planes(d.draw, triangle));
    }
    constexpr int32_t max_span = kSmallExtent * kSubPixels;
    large_ = bits(max_of(x) - min_of(x) > Int(max_span) || max_of(y) - min_of(y) > Int(max_span)) & ~tiny_;
    if ((tiny_ | large_) == kAllBits<Mask>) return;
    const PixelBox<Int> seen = intersect(box, d.bounds);
    store(rect_x0_.data(), seen.x0 - d.tile.x0);
    store(rect_y0_.data(), seen.y0 - d.tile.y0);
    store(rect_x1_.data(), seen.x1 - d.tile.x0);
    store(rect_y1_.data(), seen.y1 - d.tile.y0);
    // Coordinates are relative to sample 0 of the first pixel. They fit in 16 bits, because the triangles are small and touch the tile.
    const Int x_first(d.tile.x0 * kSubPixels + samples.position[0].x), y_first(d.tile.y0 * kSubPixels + samples.position[0].y);
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t a = (i + 1) % 3, b = (i + 2) % 3;
      const Int ex = x[b] - x[a], ey = y[b] - y[a], bias = fill_bias(ex, ey);
      store(step_x_[i].data(), -ey << kSubPixelBits);
      store(step_y_[i].data(), ex << kSubPixelBits);
      store(bias_[i].data(), bias);
      store(e_[i].data(), ey * (x[a] - x_first) - ex * (y[a] - y_first) - bias);
      for (std::size_t s = 1; s < samples.tile_samples; ++s) {
        const SamplePosition offset = samples.offset(s);
        store(sample_step_[s][i].data(), ex * offset.y - ey * offset.x);
      }
    }
  }

  // Returns true if the triangle is not small.
  bool is_large(std::size_t k) const { return (large_ >> k & 1) != 0; }
  bool is_tiny(std::size_t k) const { return !multisampled && (tiny_ >> k & 1) != 0; }

  // For a tiny triangle: calls f(pixel of the tile, depth) for each pixel within the bounds.
  template <class F>
  HS_INLINE void for_each_pixel(std::size_t k, const F& f) const {
    for (std::size_t i = 0; i < static_cast<std::size_t>(count_[k]); ++i) {
      if (pixel_[i][k] >= 0) f(static_cast<std::size_t>(pixel_[i][k]), z_[i][k]);
    }
  }

  // For small triangles that are not tiny: returns the pixels that may have covered samples.
  TileRect rect(std::size_t k) const { return {rect_x0_[k], rect_y0_[k], rect_x1_[k], rect_y1_[k]}; }
  // Returns edge i at sample 0 of the first pixel of the tile, with the bias subtracted.
  int32_t edge(std::size_t i, std::size_t k) const { return e_[i][k]; }
  // Return how much the edge changes from pixel to pixel, and from sample 0 to another sample.
  int32_t step_x(std::size_t i, std::size_t k) const { return step_x_[i][k]; }
  int32_t step_y(std::size_t i, std::size_t k) const { return step_y_[i][k]; }
  int32_t sample_step(std::size_t i, std::size_t s, std::size_t k) const { return sample_step_[s][i][k]; }
  int32_t bias(std::size_t i, std::size_t k) const { return bias_[i][k]; }

 private:
  template <class F>
  HS_INLINE static DepthPlane depth_planes(const Draw& draw, const F& triangle) {
    static_assert(offsetof(Triangle, z_edge1) == offsetof(Triangle, z0) + sizeof(float) &&
                  offsetof(Triangle, z_max) == offsetof(Triangle, z0) + 3 * sizeof(float));
    const std::array<Int, 4> depths = load_aos4<Int>([&](int k) { return &triangle(k)->z0; });
    const Real low(draw.depth_low), high = clamp(as_real(depths[3]), low, Real(draw.depth_high));
    return {as_real(depths[0]), as_real(depths[1]), as_real(depths[2]), low, high};
  }

  // box: bounding boxes clipped to the bounds of the draw, as used for the bits of `covered`.
  void find_pixels(const DrawInTile& d, const std::array<Int, 3>& x, const std::array<Int, 3>& y, const PixelBox<Int>& box, Int covered,
                   const DepthPlane& depth) {
    Int count(0);
    for (std::size_t i = 0; any(covered != Int(0)); ++i) {
      count = count + select(covered != Int(0), Int(1), Int(0));
      const Int bit = (as_int(to_real<Real>(covered & -covered)) >> 23) - 127;  // exponent of the lowest set bit
      covered = covered & (covered - 1);
      const Int px = box.x0 + (bit & (kTinySide - 1)), py = box.y0 + (bit >> std::countr_zero(unsigned{kTinySide}));
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
  alignas(64) std::array<PerTriangle<int32_t>, 3> e_, step_x_, step_y_, bias_;
  alignas(64) std::array<std::array<PerTriangle<int32_t>, 3>, kSamplesOf<multisampled>> sample_step_;
  uint32_t tiny_ = 0, large_;
};

// Rejects a triangle if hierarchical Z shows that no fragment can pass, and returns whether it did. Triangles that may cover only a few
// pixels are not tested. rect: the pixels that may be covered.
template <class Writer>
bool reject_hidden(const DrawInTile& d, const SampleSet<Writer::kMultisampled>& samples, const Triangle& t, TriangleId id,
                   const TileRect& rect, const Writer& writer) {
  if (!writer.tests() || rect.empty() || rect.width() * rect.height() < kTestedPixels) return false;
  const DepthBounds z = depth_bounds(t, d.draw, d.tile.depth_format);
  const auto in_plane = [&](std::size_t s) {
    const SamplePlane p = samples.plane[s];
    return TileRect{rect.x0 + p.x, rect.y0 + p.y, rect.x1 + p.x, rect.y1 + p.y};
  };
  // Alpha to coverage covers the last samples of a pixel least often, so they are most likely to show that the triangle is not hidden.
  for (std::size_t k = samples.count; k-- > 0;) {
    if (!is_hidden(writer.compare_op(), d.tile, in_plane(samples.index[k]), z)) return false;
  }
  for (const std::size_t s : samples.indices()) {
    all_blocks(in_plane(s), [&](int block) {
      writer.block_rejected(t, id, s, block, z);
      return true;
    });
  }
  return true;
}

// Finds and writes the packets of one of the triangles.
template <class Writer>
class TrianglePackets {
 public:
  using Samples = SampleSet<Writer::kMultisampled>;

  // t: triangle k of `triangles`.
  TrianglePackets(const DrawInTile& d, const Samples& samples, const NarrowTriangles<Writer::kMultisampled>& triangles, std::size_t k,
                  const Triangle& t, TriangleId id, Writer& writer)
      : d_(d),
        samples_(samples),
        id_(id),
        writer_(writer),
        rect_(triangles.rect(k)),
        depth_(depth_plane(t, d.draw)),
        bounds_(depth_bounds(t, d.draw, d.tile.depth_format)) {
    for (std::size_t i = 0; i < 3; ++i) {
      step_x_[i] = triangles.step_x(i, k);
      step_y_[i] = triangles.step_y(i, k);
      lanes_[i] = lane_x() * step_x_[i] + lane_y() * step_y_[i];
      bias_[i] = triangles.bias(i, k);
      e_[i] = triangles.edge(i, k);
      for (std::size_t s = 1; s < samples.tile_samples; ++s) {
        sample_step_[s][i] = triangles.sample_step(i, s, k);
        highest_step_[i] = std::max(highest_step_[i], sample_step_[s][i]);
      }
    }
  }

  void visit() {
    if (rect_.empty()) return;
    const int column0 = rect_.x0 / kPacketWidth, column1 = (rect_.x1 - 1) / kPacketWidth;
    const int row0 = rect_.y0 / kPacketHeight, row1 = (rect_.y1 - 1) / kPacketHeight;
    if ((column1 - column0 + 1) * (row1 - row0 + 1) <= kFewPackets || kLanes == 1) {
      list_each(column0, column1, row0, row1);
    } else {
      list_reached(column0, column1, row0, row1);
    }
    for (std::size_t i = 0; i < listed_; ++i) write(list_[i]);
  }

 private:
  static constexpr int kFewPackets = Writer::kMultisampled ? 6 : 40;
  static constexpr std::size_t kMaxPackets = (kSmallExtent / kPacketWidth + 2) * (kSmallExtent / kPacketHeight + 2);

  using Lane = typename PacketLanes<Writer::kMultisampled>::value_type;

  // A packet with covered samples.
  struct Covered {
    uint16_t packet;  // of sample 0
    PacketLanes<Writer::kMultisampled> lanes;
    int32_t e1, e2;  // edges 1 and 2 at sample 0 of the first pixel
  };

  // Returns edge i at sample 0 of the first pixel of a packet.
  HS_INLINE int32_t edge(std::size_t i, int column, int row) const {
    return e_[i] + step_x_[i] * (column * kPacketWidth) + step_y_[i] * (row * kPacketHeight);
  }
  // Returns how much edge i changes from sample 0 to sample s.
  HS_INLINE int32_t sample_step(std::size_t i, std::size_t s) const { return Writer::kMultisampled ? sample_step_[s][i] : 0; }

  // Lists the packets of a rectangle that have covered samples.
  void list_each(int column0, int column1, int row0, int row1) {
    std::array<int32_t, 3> right, up, start;
    for (std::size_t i = 0; i < 3; ++i) {
      right[i] = step_x_[i] * kPacketWidth;
      up[i] = step_y_[i] * kPacketHeight;
      start[i] = e_[i] + right[i] * column0 + up[i] * row0;
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

  // The same, but first finds, for W columns of a row at once, the packets that can have any.
  void list_reached(int column0, int column1, int row0, int row1) {
    std::array<Int, 3> best;  // largest edge values in the packets of row 0
    for (std::size_t i = 0; i < 3; ++i) {
      const int32_t rise = std::max(0, step_x_[i] * (kPacketWidth - 1)) + std::max(0, step_y_[i] * (kPacketHeight - 1));
      best[i] = iota<Int>() * (step_x_[i] * kPacketWidth) + (highest_step_[i] + rise);
    }
    for (int row = row0; row <= row1; ++row) {
      for (int group = column0 / kLanes * kLanes; group <= column1; group += kLanes) {
        const Int column = iota<Int>() + group;
        const Mask reaches =
            ((best[0] + edge(0, group, row)) | (best[1] + edge(1, group, row)) | (best[2] + edge(2, group, row))) >= Int(0);
        const Mask asked = (column >= Int(column0)) & (column <= Int(column1));
        for (uint32_t rest = bits(reaches & asked); rest != 0; rest &= rest - 1) {
          const int c = group + std::countr_zero(rest);
          list({edge(0, c, row), edge(1, c, row), edge(2, c, row)}, c, row);
        }
      }
    }
  }

  // Appends a packet to the list if it has covered samples. at: the edges at sample 0 of its first pixel. The outcome is nearly random and
  // a branch would often be mispredicted, so the code has none. The list is complete before the first packet is written.
  HS_INLINE void list(const std::array<int32_t, 3>& at, int column, int row) {
    const int x = column * kPacketWidth, y = row * kPacketHeight;
    const uint32_t seen = d_.needs_bounds_test ? bits(inside(rect_, x, y)) : kAllBits<Mask>;
    Covered& c = list_[listed_];
    c = {static_cast<uint16_t>(packet_at(x, y)), {}, at[1], at[2]};
    uint32_t any = 0;
    for (std::size_t s = 0; s < samples_.tile_samples; ++s) {
      const Int edges =
          (lanes_[0] + (at[0] + sample_step(0, s))) | (lanes_[1] + (at[1] + sample_step(1, s))) | (lanes_[2] + (at[2] + sample_step(2, s)));
      const uint32_t covered = seen & samples_.lanes[s] & ~negative_bits(edges);
      c.lanes[s] = static_cast<Lane>(covered);
      any |= covered;
    }
    listed_ += any != 0 ? 1 : 0;
  }

  HS_INLINE void write(const Covered& c) {
    const auto z_at = [&](std::size_t s) {
      return depth_.at(d_.tile.depth_format, lanes_[1] + (c.e1 + sample_step(1, s) + bias_[1]),
                       lanes_[2] + (c.e2 + sample_step(2, s) + bias_[2]));
    };
    write_samples(writer_, samples_, id_, c.packet, c.lanes, 0, z_at,
                  [&](std::size_t, int packet) { widen_hiz(writer_.compare_op(), d_.tile, packet / kPacketsPerBlock, bounds_); });
  }

  const DrawInTile& d_;
  const Samples& samples_;
  TriangleId id_;
  Writer& writer_;
  TileRect rect_;
  std::array<int32_t, 3> e_, step_x_, step_y_, bias_;  // e_: at sample 0 of the first pixel of the tile
  std::array<Int, 3> lanes_;                           // offsets from the corner of a packet to its pixels
  std::array<std::array<int32_t, 3>, kSamplesOf<Writer::kMultisampled>> sample_step_{};
  std::array<int32_t, 3> highest_step_{};  // the largest of sample_step_
  DepthPlane depth_;
  DepthBounds bounds_;
  std::size_t listed_ = 0;
  std::array<Covered, kMaxPackets + 1> list_;  // the element after the last one may be written
};

template <class Writer>
std::size_t rasterize_narrow(const DrawInTile& d, uint32_t chunk, std::span<const uint16_t> indices, PacketQueue& queue,
                             PassStatistics& statistics) {
  const SampleSet<Writer::kMultisampled> samples(d);
  if (samples.count == 0) return indices.size();
  const NarrowTriangles<Writer::kMultisampled> triangles(d, samples, d.context.chunks[chunk], indices);
  Writer writer(d, &queue, statistics);
  std::size_t k = 0;
  do {
    const TriangleId id = triangle_id(chunk, indices[k]);
    const Triangle& t = d.context.chunks[chunk].triangles[indices[k]];
    writer.begin(t);
    if (triangles.is_tiny(k)) {
      if constexpr (!Writer::kMultisampled)
        triangles.for_each_pixel(k, [&](std::size_t pixel, float z) { writer.write_pixel(id, pixel, z); });
    } else if (triangles.is_large(k)) {
      rasterize_function(d)(d, t, id, queue, statistics);
    } else if (!reject_hidden(d, samples, t, id, triangles.rect(k), writer)) {
      TrianglePackets<Writer>(d, samples, triangles, k, t, id, writer).visit();
    }
  } while (++k < indices.size() && !(Writer::kQueues && queue.is_full()));
  return k;
}

}  // namespace

RasterizeNarrowFunction rasterize_narrow_function(const DrawInTile& d) {
  const auto function = []<class Writer>() -> RasterizeNarrowFunction { return rasterize_narrow<Writer>; };
  return d.tile.samples > 1 ? with_writer<true>(d, function) : with_writer<false>(d, function);
}

}  // namespace halfspace::HS_LANES
