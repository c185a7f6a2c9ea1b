// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "explain/pixel_history.h"
#include "explain/stage_geometry.h"
#include "halfspace/render/frame/add_draw.h"
#include "view/overlay.h"

namespace halfspace {

namespace {

// Adds the alpha of each fragment, which is 1 for opaque surfaces.
constexpr BlendState kCountFragments{.source_color = BlendFactor::zero,
                                     .destination_color = BlendFactor::zero,
                                     .source_alpha = BlendFactor::one,
                                     .destination_alpha = BlendFactor::one};

// Returns the average of two colors.
glm::u8vec4 mixed(const glm::u8vec4& a, const glm::u8vec4& b) { return glm::u8vec4((glm::ivec4(a) + glm::ivec4(b)) / 2); }

// The numbers of primitives in the bins of a frame.
struct TileCounts {
  int tile_size = 0, columns = 0;
  std::vector<uint64_t> counts;  // row by row from the lower left
};

TileCounts tile_counts(const PreparedScene& scene, const Workers& workers) {
  TileCounts out;
  visit_set_up_scene(scene, workers, [&](const PassContext& context, int) {
    const std::vector<uint32_t> bins = triangles_per_tile(context);
    out.tile_size = context.tile_size;
    out.columns = context.tiles_x;
    out.counts.resize(bins.size());
    for (std::size_t i = 0; i < bins.size(); ++i) out.counts[i] += bins[i];
  });
  return out;
}

}  // namespace

std::string draw_overdraw_overlay(OverlayFrame frame) {
  const int width = frame.picture.width(), height = frame.picture.height();
  Image<glm::vec4> counts(width, height);
  Pass pass(width, height, rgba32f_target(counts), {});
  for (const PreparedDraw& draw : frame.scene.draws) {
    if (draw.source.object < 0) continue;  // the background
    DrawState state = draw.state;
    state.depth.test = state.depth.write = state.order_independent = false;
    state.blend = kCountFragments;
    add_draw(pass, draw, state);
  }
  pass.run(frame.workers);
  constexpr double kMaxShown = 8.0;
  float largest = 0.0f;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const float count = counts.at(x, y).w;
      largest = std::max(largest, count);
      frame.picture.at(x, y) = heat_color(count / kMaxShown);
    }
  }
  return fmt::format("fragments per pixel without a depth test: dark 0, white 8 or more; largest {:.0f}", largest);
}

std::string draw_tiles_overlay(OverlayFrame frame) {
  const TileCounts tiles = tile_counts(frame.scene, frame.workers);
  const uint64_t largest = std::max(uint64_t{1}, std::ranges::max(tiles.counts));
  const int size = tiles.tile_size, height = frame.picture.height();
  for (int y = 0; y < height; ++y) {
    const int row = height - 1 - y;  // from the lower left, like tiles
    for (int x = 0; x < frame.picture.width(); ++x) {
      glm::u8vec4& pixel = frame.picture.at(x, y);
      const bool border = x % size == 0 || row % size == 0;
      const uint64_t count = tiles.counts[static_cast<std::size_t>(row / size * tiles.columns + x / size)];
      const double heat = std::log2(1.0 + static_cast<double>(count)) / std::log2(1.0 + static_cast<double>(largest));
      pixel = border ? glm::u8vec4(255, 255, 255, 255) : mixed(pixel, heat_color(heat));
    }
  }
  return fmt::format("tiles of {0}x{0} pixels: number of primitives in each bin, on a logarithmic scale; largest {1}", size, largest);
}

}  // namespace halfspace
