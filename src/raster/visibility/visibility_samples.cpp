// SPDX-License-Identifier: Apache-2.0
//
// Visibility of small triangles in multisampled tiles. Like visibility_small.cpp, but the coverage of all samples of a packet is computed
// together: the edge functions of a sample differ from those of the first sample by a constant.
#include "halfspace/raster/pipeline/pixel_box.h"
#include "halfspace/raster/pipeline/triangle_lanes.h"
#include "halfspace/raster/visibility/hidden_triangle.h"
#include "halfspace/raster/visibility/sample_set.h"
#include "halfspace/raster/visibility/small_triangle.h"
#include "halfspace/raster/visibility/traced_writer.h"

namespace halfspace::HS_LANES {

namespace {

// Edge functions of up to W small triangles, computed for all of them at once.
class SampledTriangles {
 public:
  // indices: 1 to W triangles of the chunk.
  SampledTriangles(const DrawInTile& d, const SampleSet& samples, const Chunk& chunk, std::span<const uint16_t> indices) {
    const auto triangle = [&](int k) { return &chunk.triangles[indices[std::min(static_cast<std::size_t>(k), indices.size() - 1)]]; };
    const auto [x, y] = load_corners(triangle);
    constexpr int32_t max_span = kMaxSmallSpan * kSubPixels;
    wide_ = bits(max_of(x) - min_of(x) > Int(max_span) || max_of(y) - min_of(y) > Int(max_span));
    const PixelBox<Int> box = intersect(pixel_box(x, y, d.context.samples_at, d.context.samples_at), d.bounds);
    store(rect_x0_.data(), box.x0 - d.tile.x0);
    store(rect_y0_.data(), box.y0 - d.tile.y0);
    store(rect_x1_.data(), box.x1 - d.tile.x0);
    store(rect_y1_.data(), box.y1 - d.tile.y0);
    // As in SmallTriangles, but relative to the corner of the tile.
    const Int x_first(d.tile.x0 * kSubPixels), y_first(d.tile.y0 * kSubPixels);
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t a = (i + 1) % 3, b = (i + 2) % 3;
      const Int ex = x[b] - x[a], ey = y[b] - y[a], bias = fill_bias(ex, ey);
      const Int corner = ey * (x[a] - x_first) - ex * (y[a] - y_first) - bias;
      store(step_x_[i].data(), -ey << kSubPixelBits);
      store(step_y_[i].data(), ex << kSubPixelBits);
      store(bias_[i].data(), bias);
      for (std::size_t s = 0; s < samples.tile_samples; ++s) {
        const SamplePosition at = samples.position[s];
        store(e_[s][i].data(), corner - ey * at.x + ex * at.y);
      }
    }
  }

  bool is_wide(std::size_t k) const { return (wide_ >> k & 1) != 0; }
  // Returns the pixels that may have covered samples.
  TileRect rect(std::size_t k) const { return {rect_x0_[k], rect_y0_[k], rect_x1_[k], rect_y1_[k]}; }
  // Returns edge i at sample s, in the first pixel of the tile, with the bias subtracted.
  int32_t edge(std::size_t i, std::size_t s, std::size_t k) const { return e_[s][i][k]; }
  int32_t step_x(std::size_t i, std::size_t k) const { return step_x_[i][k]; }
  int32_t step_y(std::size_t i, std::size_t k) const { return step_y_[i][k]; }
  int32_t bias(std::size_t i, std::size_t k) const { return bias_[i][k]; }

 private:
  alignas(64) PerTriangle<int32_t> rect_x0_, rect_y0_, rect_x1_, rect_y1_;
  alignas(64) std::array<PerTriangle<int32_t>, 3> step_x_, step_y_, bias_;
  alignas(64) std::array<std::array<PerTriangle<int32_t>, 3>, kMaxSamples> e_;
  uint32_t wide_;
};

// Rejects a triangle if hierarchical Z shows that no fragment can pass, and returns whether it did. rect: the pixels of the tile that may
// be covered.
template <class Writer>
bool reject_hidden(const DrawInTile& d, const SampleSet& samples, const Triangle& t, TriangleId id, const TileRect& rect,
                   const Writer& writer) {
  const auto in_plane = [&](std::size_t s) {
    const SamplePlane p = samples.plane[s];
    return TileRect{rect.x0 + p.x, rect.y0 + p.y, rect.x1 + p.x, rect.y1 + p.y};
  };
  // Alpha to coverage covers the last samples of a pixel least often, so they are most likely to show that the triangle is not hidden.
  for (std::size_t k = samples.count; k-- > 0;) {
    if (!is_hidden(d, t, in_plane(samples.index[k]), writer)) return false;
  }
  for (const std::size_t s : samples.indices()) report_hidden(d, t, id, in_plane(s), s, writer);
  return true;
}

// Finds and writes the packets of one of the triangles.
template <class Writer>
class SampledPackets {
 public:
  // t: triangle k of `triangles`.
  SampledPackets(const DrawInTile& d, const SampleSet& samples, const SampledTriangles& triangles, std::size_t k, const Triangle& t,
                 TriangleId id, Writer& writer)
      : d_(d),
        samples_(samples),
        id_(id),
        writer_(writer),
        rect_(triangles.rect(k)),
        depth_(small_depth(t, d.draw.depth_low, d.draw.depth_high)),
        bounds_(depth_bounds(t, d.draw, d.tile.depth_format)) {
    for (std::size_t i = 0; i < 3; ++i) {
      step_x_[i] = triangles.step_x(i, k);
      step_y_[i] = triangles.step_y(i, k);
      lanes_[i] = lane_x() * step_x_[i] + lane_y() * step_y_[i];
      bias_[i] = triangles.bias(i, k);
      highest_[i] = triangles.edge(i, 0, k);
      for (std::size_t s = 0; s < samples.tile_samples; ++s) {
        e_[s][i] = triangles.edge(i, s, k);
        highest_[i] = std::max(highest_[i], e_[s][i]);
      }
    }
  }

  void visit() {
    if (rect_.empty()) return;
    const int column0 = rect_.x0 / kPacketWidth, column1 = (rect_.x1 - 1) / kPacketWidth;
    const int row0 = rect_.y0 / kPacketHeight, row1 = (rect_.y1 - 1) / kPacketHeight;
    const bool has_many = (column1 - column0 + 1) * (row1 - row0 + 1) > kFewPackets;
    for (int row = row0; row <= row1; ++row) {
      for (int column = column0; column <= column1; ++column) list(column, row, has_many);
    }
    for (std::size_t i = 0; i < listed_; ++i) write(list_[i]);
  }

 private:
  static constexpr int kFewPackets = 6;
  static constexpr int kMaxSide = largest_tile(2);
  static constexpr std::size_t kMaxPackets = std::size_t{kMaxSide / kPacketWidth} * (kMaxSide / kPacketHeight);

  // A packet with covered samples.
  struct Covered {
    uint16_t packet;  // of sample 0
    SampleLanes lanes;
    int32_t e1, e2;  // offsets of edges 1 and 2 from their values in the first packet of the tile
  };

  // Lists a packet if it has covered samples. All packets are listed before the first one is written, without a branch that depends on
  // the result. may_skip: first checks whether any pixel can have covered samples.
  HS_INLINE void list(int column, int row, bool may_skip) {
    const int x = column * kPacketWidth, y = row * kPacketHeight;
    std::array<int32_t, 3> at;
    for (std::size_t i = 0; i < 3; ++i) at[i] = step_x_[i] * x + step_y_[i] * y;
    if (may_skip) {
      const Int best = (lanes_[0] + (at[0] + highest_[0])) | (lanes_[1] + (at[1] + highest_[1])) | (lanes_[2] + (at[2] + highest_[2]));
      if (negative_bits(best) == kAllBits<Mask>) return;
    }
    const uint32_t seen = d_.needs_bounds_test ? bits(inside(rect_, x, y)) : kAllBits<Mask>;
    Covered& c = list_[listed_];
    c.packet = static_cast<uint16_t>(packet_at(x, y));
    c.e1 = at[1];
    c.e2 = at[2];
    c.lanes = {};
    uint32_t any = 0;
    for (std::size_t s = 0; s < samples_.tile_samples; ++s) {
      const Int edges = (lanes_[0] + (at[0] + e_[s][0])) | (lanes_[1] + (at[1] + e_[s][1])) | (lanes_[2] + (at[2] + e_[s][2]));
      const uint32_t covered = seen & samples_.lanes[s] & ~negative_bits(edges);
      c.lanes[s] = static_cast<uint16_t>(covered);
      any |= covered;
    }
    listed_ += any != 0 ? 1 : 0;
  }

  HS_INLINE void write(const Covered& c) {
    const auto z_at = [&](std::size_t s) {
      return depth_.at(d_.tile.depth_format, lanes_[1] + (c.e1 + e_[s][1] + bias_[1]), lanes_[2] + (c.e2 + e_[s][2] + bias_[2]));
    };
    write_samples(writer_, samples_, id_, c.packet, c.lanes, 0, z_at, [&](std::size_t, int packet) {
      widen_hiz(writer_.compare_op(), d_.tile, packet / kPacketsPerBlock, bounds_.low, bounds_.high);
    });
  }

  const DrawInTile& d_;
  const SampleSet& samples_;
  TriangleId id_;
  Writer& writer_;
  TileRect rect_;
  std::array<int32_t, 3> step_x_, step_y_, bias_;
  std::array<Int, 3> lanes_;                           // offsets from the corner of a packet to its pixels
  std::array<std::array<int32_t, 3>, kMaxSamples> e_;  // edges at the samples of the first pixel of the tile
  std::array<int32_t, 3> highest_;                     // their largest values
  SmallDepth depth_;
  DepthBounds bounds_;
  std::size_t listed_ = 0;
  std::array<Covered, kMaxPackets + 1> list_;  // the element after the last one may be written
};

template <class W>
std::size_t rasterize_small_samples(const DrawInTile& d, uint32_t chunk, std::span<const uint16_t> indices, PacketQueue& queue,
                                    PassStatistics& statistics) {
  const SampleSet samples(d);
  if (samples.count == 0) return indices.size();
  const SampledTriangles triangles(d, samples, d.context.chunks[chunk], indices);
  W writer(d, &queue, statistics);
  std::size_t k = 0;
  do {
    const Triangle& t = d.context.chunks[chunk].triangles[indices[k]];
    const TriangleId id = triangle_id(chunk, indices[k]);
    writer.begin(t);
    if (triangles.is_wide(k)) {
      rasterize_function(d)(d, t, id, queue, statistics);
    } else if (!reject_hidden(d, samples, t, id, triangles.rect(k), writer)) {
      SampledPackets(d, samples, triangles, k, t, id, writer).visit();
    }
  } while (++k < indices.size() && !(W::kQueues && queue.is_full()));
  return k;
}

}  // namespace

RasterizeSmallFunction rasterize_small_samples_function(const DrawInTile& d) {
  return with_writer<true>(d, []<class W>() -> RasterizeSmallFunction { return rasterize_small_samples<W>; });
}

}  // namespace halfspace::HS_LANES
