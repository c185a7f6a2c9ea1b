// SPDX-License-Identifier: Apache-2.0
#include "halfspace/raster/loop/constant_tiles.h"

#include <algorithm>
#include <array>

#include "halfspace/raster/pipeline/pixel_box.h"
#include "halfspace/raster/primitives/bin.h"
#include "halfspace/raster/shade/fragment_batch.h"
#include "halfspace/raster/tile/tile_format.h"
#include "halfspace/raster/visibility/coverage/area_coverage.h"

namespace halfspace::HS_LANES {

PixelBounds tile_pixels(const PassContext& context, int tile_x0, int tile_x1, int tile_y) {
  const int size = context.tile_size;
  return {tile_x0 * size, tile_y * size, std::min(tile_x1 * size, context.width), std::min(tile_y * size + size, context.height)};
}

namespace {

// Returns true if a draw writes the same color to all of its pixels.
bool has_one_color(const Draw& draw, const Attachments& attachments) {
  return draw.deferred && draw.kernels.is_constant && draw.kernels.visibility == nullptr &&
         draw.kernels.color_count >= static_cast<int>(attachments.colors.size());
}

// Returns true if a pass clears either the depth or the stencil of a target. The other one must be kept.
bool clears_a_part(const DepthTarget& target) { return has_stencil(target.format) && stencil_load_of(target) != target.load; }

}  // namespace

ConstantTiles constant_tiles(const PassContext& context, const Attachments& attachments, int tile_x0, int tile_x1, int tile_y,
                             PassStatistics& statistics) {
  constexpr ConstantTiles no{};
  std::array<const Triangle*, 2> triangles{};
  std::size_t count = 0;
  const Draw* draw = nullptr;
  for (const Chunk& c : context.chunks) {
    for (int x = tile_x0; x < tile_x1; ++x) {
      for (const uint16_t index : bin_of(c, x, tile_y)) {
        const Triangle& t = c.triangles[index];
        if (&t == triangles[0] || &t == triangles[1]) continue;
        const Draw& of = context.draws[c.ranges[t.range()].draw];
        if (count == triangles.size() || (draw != nullptr && draw != &of) || !has_one_color(of, attachments)) return no;
        draw = &of;
        triangles[count++] = &t;
      }
    }
  }
  if (draw == nullptr) return clears_a_part(attachments.depth) ? no : ConstantTiles{true, nullptr};
  if (attachments.depth.format != DepthFormat::none || context.samples != 1) return no;
  const PixelBounds area = tile_pixels(context, tile_x0, tile_x1, tile_y);
  const bool is_triangle = std::all_of(triangles.begin(), triangles.begin() + count, [](const Triangle* t) { return t->is_triangle(); });
  if (intersect(area, draw->bounds) != area || !is_triangle ||
      !(count == 1 ? covers(*triangles[0], area) : cover_together(*triangles[0], *triangles[1], area))) {
    return no;
  }
  const auto samples = static_cast<uint64_t>(area.x1 - area.x0) * static_cast<uint64_t>(area.y1 - area.y0);
  statistics.tiles_touched += static_cast<uint64_t>(tile_x1 - tile_x0);
  statistics.samples_tested += samples;
  statistics.samples_passed += samples;
  statistics.fragments_shaded += samples;
  if (draw->state.query) statistics.add_to_query(*draw->state.query, samples);
  return {true, draw};
}

void fill_images(const Attachments& attachments, const ConstantArea& area) {
  if (area.pixels.empty()) return;
  FragmentOutput out;
  if (area.draw != nullptr) constant_colors(*area.draw, out);
  for (std::size_t i = 0; i < attachments.colors.size(); ++i) {
    const ColorTarget& c = attachments.colors[i];
    if (area.draw != nullptr) {
      fill_color(c, area.pixels, out.packet_color(i, 0));
    } else if (c.load == LoadOp::clear) {
      fill_color(c, area.pixels, spread_color(c.clear_value));
    }
  }
  if (area.draw == nullptr && attachments.depth.load == LoadOp::clear) fill_depth(attachments.depth, area.pixels);
}

}  // namespace halfspace::HS_LANES
