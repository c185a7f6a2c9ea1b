// SPDX-License-Identifier: Apache-2.0
#include "halfspace/raster/depth_pyramid.h"

#include <algorithm>
#include <cstring>
#include <limits>

#include "halfspace/core/check.h"

namespace halfspace::HS_LANES {

namespace {

constexpr int kBlock = 8;       // side of a block of level 0, in pixels
constexpr int kMostBlocks = 5;  // visited per row and column; with fewer, the bounds are less tight

int blocks_of(int pixels, int side) { return (pixels + side - 1) / side; }

// The union of no bounds.
constexpr DepthPyramid::Bounds kNone{std::numeric_limits<float>::infinity(), -std::numeric_limits<float>::infinity()};

void add(DepthPyramid::Bounds& to, const DepthPyramid::Bounds& b) {
  to.low = std::min(to.low, b.low);
  to.high = std::max(to.high, b.high);
}

}  // namespace

bool DepthPyramid::is_of(const DepthTarget& depth) const {
  const TexelView view = target_texels(depth);
  return view.format == TexelFormat::d32f && view.data == texels_ && view.row_pitch == row_pitch_ && view.width == width_ &&
         view.height == height_;
}

DepthPyramid::DepthPyramid(const DepthTarget& target, const Workers& workers) : width_(target.width), height_(target.height) {
  HS_CHECK(target.format == DepthFormat::d32f, "DepthPyramid: the depth has another format; expected d32f");
  HS_CHECK(target.samples == 1 && target.layers == 1, "DepthPyramid: the depth has several samples or layers; expected one of each");
  HS_CHECK(target.data != nullptr && width_ >= 1 && height_ >= 1, "DepthPyramid: the depth has no pixels; expected at least one");
  const ConstTexelView depth = target_texels(target);
  texels_ = depth.data;
  row_pitch_ = depth.row_pitch;
  Level& finest = levels_.emplace_back(Level{blocks_of(width_, kBlock), blocks_of(height_, kBlock), {}});
  finest.blocks.assign(static_cast<std::size_t>(finest.width) * static_cast<std::size_t>(finest.height), kNone);
  workers.for_each(finest.height, [&](int row) {
    Bounds* const blocks = &finest.blocks[static_cast<std::size_t>(row) * static_cast<std::size_t>(finest.width)];
    std::vector<float> pixels(static_cast<std::size_t>(width_));
    for (int y = row * kBlock; y < std::min(height_, (row + 1) * kBlock); ++y) {
      std::memcpy(pixels.data(), depth.at(0, y), pixels.size() * sizeof(float));
      for (std::size_t x = 0; x < pixels.size(); ++x) add(blocks[x / kBlock], {pixels[x], pixels[x]});
    }
  });
  while (levels_.back().width > 1 || levels_.back().height > 1) {
    const Level& fine = levels_.back();
    Level coarse{blocks_of(fine.width, 2), blocks_of(fine.height, 2), {}};
    coarse.blocks.assign(static_cast<std::size_t>(coarse.width) * static_cast<std::size_t>(coarse.height), kNone);
    for (std::size_t y = 0, i = 0; y < static_cast<std::size_t>(fine.height); ++y) {
      for (std::size_t x = 0; x < static_cast<std::size_t>(fine.width); ++x)
        add(coarse.blocks[y / 2 * static_cast<std::size_t>(coarse.width) + x / 2], fine.blocks[i++]);
    }
    levels_.push_back(std::move(coarse));
  }
}

DepthPyramid::Bounds DepthPyramid::bounds(int x0, int y0, int x1, int y1) const {
  HS_DCHECK(x0 >= 0 && y0 >= 0 && x0 < x1 && y0 < y1 && x1 <= width_ && y1 <= height_);
  int left = x0 / kBlock, right = (x1 - 1) / kBlock, bottom = y0 / kBlock, top = (y1 - 1) / kBlock;  // the last ones are included
  std::size_t level = 0;
  for (; right - left >= kMostBlocks || top - bottom >= kMostBlocks; ++level) {
    left /= 2;
    right /= 2;
    bottom /= 2;
    top /= 2;
  }
  const Level& l = levels_[level];
  Bounds out = kNone;
  for (int y = bottom; y <= top; ++y) {
    for (int x = left; x <= right; ++x) {
      add(out, l.blocks[static_cast<std::size_t>(y) * static_cast<std::size_t>(l.width) + static_cast<std::size_t>(x)]);
    }
  }
  return out;
}

}  // namespace halfspace::HS_LANES
