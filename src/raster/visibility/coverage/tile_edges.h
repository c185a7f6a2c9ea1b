// SPDX-License-Identifier: Apache-2.0
//
// Edge functions of a primitive at the samples of one tile, prepared for stepping from pixel to pixel.
#pragma once

#include <algorithm>
#include <array>
#include <limits>

#include "halfspace/raster/pipeline/edge.h"
#include "halfspace/raster/pipeline/line.h"
#include "halfspace/raster/visibility/coverage/sample_set.h"

namespace halfspace::HS_LANES {

enum class BlockCoverage : uint8_t { none, some, whole };

/// Edge functions of a triangle or line at the samples of a tile. Pixels are numbered from the corner of the tile. For narrow triangles,
/// the values are in (1/256 px)². For all others, they are shifted right by kSubPixelBits, which preserves the sign, and all steps are
/// integers. The bias of the fill rule is subtracted. If all samples of the tile are inside an edge of a larger triangle, all values of
/// that edge are 0.
template <bool multisampled>
class TileEdges {
 public:
  TileEdges(const Draw& draw, const Tile& tile, const SampleSet<multisampled>& samples, const Triangle& t) {
    if (!t.is_triangle()) {
      put_point_or_line(draw, tile, samples, t);
      return;
    }
    const int shift = t.is(kNarrow) ? 0 : kSubPixelBits;
    for (std::size_t i = 0; i < 3; ++i) {
      const Edge edge = edge_of(t, i);
      put(i, edge, 0, fill_bias(edge), shift, tile, samples);
    }
  }

  /// Returns true if no sample of the tile is inside.
  bool outside() const { return outside_; }
  /// Returns true if all samples of the tile are inside. Only for triangles that are not narrow.
  bool cover_tile() const requires(!multisampled) { return step_x_ == kNoSteps && step_y_ == kNoSteps && e_[0] == kNoSteps && !outside_; }
  /// Returns the bias of edge i.
  int32_t bias(std::size_t i) const { return bias_[i]; }
  /// Returns how much edge i changes over x and y pixels.
  HS_INLINE int32_t value_step(std::size_t i, int x, int y) const { return step_x_[i] * x + step_y_[i] * y; }
  /// Returns edge i for all pixels of the packet with corner (x, y), at sample s.
  HS_INLINE Int values(std::size_t i, std::size_t s, int x, int y) const { return lanes_[i] + (e_[s][i] + value_step(i, x, y)); }
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
  static constexpr std::array<int32_t, 3> kNoSteps{};

  // Computes edge i, with `offset` added to its function. shift: 0 for narrow triangles, otherwise kSubPixelBits.
  HS_INLINE void put(std::size_t i, const Edge& edge, int64_t offset, int32_t bias, int shift, const Tile& tile,
                     const SampleSet<multisampled>& samples) {
    const int64_t step_x = -(int64_t{edge.ey} * kSubPixels) >> shift, step_y = (int64_t{edge.ex} * kSubPixels) >> shift;
    const auto smallest_step = [&](int64_t last) { return std::min<int64_t>(0, step_x * last) + std::min<int64_t>(0, step_y * last); };
    const auto largest_step = [&](int64_t last) { return std::max<int64_t>(0, step_x * last) + std::max<int64_t>(0, step_y * last); };
    bias_[i] = bias;
    const int64_t corner = edge.at(int64_t{tile.x0} * kSubPixels, int64_t{tile.y0} * kSubPixels) + offset - bias;
    std::array<int64_t, kSamplesOf<multisampled>> e;
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

  // Computes the edges of a line. A point has no edges, because its bounds are exact.
  __attribute__((noinline)) void put_point_or_line(const Draw& draw, const Tile& tile, const SampleSet<multisampled>& samples,
                                                   const Triangle& t) {
    step_x_ = step_y_ = bias_ = lowest_ = highest_ = {};
    lanes_.fill(Int(0));
    e_ = {};
    if (t.is_point()) return;
    const std::array<BandEdge, 2> band = band_edges(t, line_pixels(draw.state.line_width));
    for (std::size_t i = 0; i < 2; ++i) put(i, band[i].edge, band[i].offset, band[i].bias, kSubPixelBits, tile, samples);
  }

  bool outside_ = false;
  std::array<int32_t, 3> step_x_, step_y_, bias_;
  std::array<Int, 3> lanes_;                                        // offsets from the corner of a packet to its pixels
  std::array<std::array<int32_t, 3>, kSamplesOf<multisampled>> e_;  // values at the samples of pixel (0, 0)
  std::array<int32_t, 3> lowest_, highest_;                         // over all samples of the first block
};

}  // namespace halfspace::HS_LANES
