// SPDX-License-Identifier: Apache-2.0
//
// Post step: applies a functor to the final colors of a tile while it is in cache, for tone mapping and encoding.
#pragma once

#include <concepts>
#include <memory>
#include <span>

#include "halfspace/core/vec.h"
#include "halfspace/raster/target.h"
#include "halfspace/raster/tile/tile.h"

namespace halfspace::HS_LANES {

/// Packets of a tile at the end of the pass, and their colors, which the kernel replaces.
struct PostBatch {
  int tile_x0, tile_y0;  ///< window coordinates of the tile's pixel (0, 0)
  std::span<const PacketMask> packets;
  PacketColor* colors;  ///< one per packet
};

using PostKernel = void (*)(const void* function, const PostBatch& batch);

/// Post step set by Pass::post().
struct PostStep {
  std::shared_ptr<const void> function;
  PostKernel kernel = nullptr;  ///< null: the pass has no post step
  ColorTarget target;           ///< its image has the size of the pass and one sample
};

/// Applies the functor to the colors of the tile's first attachment and stores the result in the post step's target.
void run_post_step(const PostStep& post, const Tile& tile, ColorBuffer& scratch);

namespace detail {

template <class F>
void post_kernel(const void* function, const PostBatch& batch) {
  const F& f = *static_cast<const F*>(function);
  for (std::size_t i = 0; i < batch.packets.size(); ++i) {
    PacketColor& color = batch.colors[i];
    vec4<Real> out(color[0], color[1], color[2], color[3]);
    if constexpr (std::invocable<const F&, vec4<Real>, Int, Int>) {
      const int packet = batch.packets[i].packet;
      out = f(out, Int(batch.tile_x0 + packet_x(packet)) + lane_x(), Int(batch.tile_y0 + packet_y(packet)) + lane_y());
    } else {
      out = f(out);
    }
    color = {out.x, out.y, out.z, out.w};
  }
}

}  // namespace detail

}  // namespace halfspace::HS_LANES
