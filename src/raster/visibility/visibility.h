// SPDX-License-Identifier: Apache-2.0
//
// Visibility. Input: one triangle and one tile. Output for draws whose visibility does not depend on the shader: the depth and visible
// triangle of each pixel in the tile. Output for other draws: the packets of all triangles, in submission order, in a queue.
//
// Coverage is exact, because edge functions are computed in integer arithmetic (raster/pipeline/edge.h). Depth is z0 + E1·z_edge1 +
// E2·z_edge2. Both products are non-negative, so it keeps its relative accuracy. E is exact for small triangles; otherwise it is computed
// by difference_of_products().
#pragma once

#include <span>

#include "halfspace/raster/tile/tile.h"
#include "halfspace/raster/visibility/depth_plane.h"
#include "halfspace/raster/visibility/packet_batch.h"
#include "halfspace/raster/visibility/packet_queue.h"

namespace halfspace::HS_LANES {

/// What happens to the samples of a triangle before they are shaded.
enum class VisibilityMode : uint8_t {
  deferred,    ///< test, write depth and triangle id
  depth_only,  ///< test, write depth; there is no color to shade
  early,       ///< test, write depth, list samples that pass
  test_only,   ///< test, list samples that pass and their depth; depth is written after shading
  cover_only   ///< list covered samples; depth is tested after shading, because the shader replaces it
};

/// Returns true if visibility is complete without the fragment function, which runs later or never.
constexpr bool shades_later(VisibilityMode mode) { return mode == VisibilityMode::deferred || mode == VisibilityMode::depth_only; }

/// Returns the mode for a draw. Depth is tested before shading where this does not change the result (OpenGL 4.6, section 15.2.4).
VisibilityMode visibility_mode(const Draw& draw);

/// The functions that rasterize the triangles of a draw in a tile, by what determines visibility.
enum class Rasterizer : uint8_t {
  opaque,   ///< only coverage and depth: rasterize_opaque()
  stencil,  ///< coverage, depth and the stencil test: rasterize_opaque()
  queued    ///< the shader: rasterize_queued()
};

/// Returns the rasterizer for a draw with the given mode.
Rasterizer choose_rasterizer(const Draw& draw, VisibilityMode mode, const Tile& tile);

/// Values that all triangles of a draw in one tile share.
struct DrawInTile {
  DrawInTile(const PassContext& context, const Draw& draw, VisibilityMode mode, Tile& tile);

  const PassContext& context;
  const Draw& draw;
  VisibilityMode mode;
  Rasterizer rasterizer;
  Tile& tile;
  PixelBounds bounds;             ///< bounds of the draw in the tile
  bool needs_bounds_test;         ///< covered pixels of the tile can be outside bounds
  bool tests;                     ///< depth is tested, before or after shading
  bool postpones_stencil;         ///< the stencil test follows the shader, which decides which fragments update the stencil values
  bool fetches_vertices;          ///< prefetch vertices
};

// Statistics is PassStatistics, or TracedStatistics, which traces fragments (raster/trace/tile_trace.h).

/// Rasterizes a triangle of an opaque draw in the tile, with or without a stencil test (visibility_blocks.cpp; in multisampled tiles,
/// sample_blocks.h).
template <class Statistics>
void rasterize_opaque(const DrawInTile& d, const Triangle& t, TriangleId id, Statistics& statistics);
/// The same for a triangle of a queued draw. Its packets are listed in the queue until the shader runs.
template <class Statistics>
void rasterize_queued(const DrawInTile& d, const Triangle& t, TriangleId id, PacketQueue& queue, Statistics& statistics);
/// Returns true if the triangle can be drawn by rasterize_small().
inline bool is_small_triangle(const Triangle& t) { return (t.flags & (kSmall | kPointSprite)) == kSmall; }
/// Rasterizes small triangles of an opaque draw, with or without a stencil test, in order. indices: 1 to W triangles of the chunk.
template <class Statistics>
void rasterize_small(const DrawInTile& d, uint32_t chunk, std::span<const uint16_t> indices, Statistics& statistics);
/// The same for a queued draw. Stops when the queue is full. Returns the number of triangles that were added to the queue, at least 1.
template <class Statistics>
std::size_t rasterize_small_queued(const DrawInTile& d, uint32_t chunk, std::span<const uint16_t> indices, PacketQueue& queue,
                                   Statistics& statistics);

/// The same two functions for a multisampled tile (visibility_samples.cpp).
template <class Statistics>
void rasterize_small_samples(const DrawInTile& d, uint32_t chunk, std::span<const uint16_t> indices, Statistics& statistics);
template <class Statistics>
std::size_t rasterize_small_samples_queued(const DrawInTile& d, uint32_t chunk, std::span<const uint16_t> indices, PacketQueue& queue,
                                           Statistics& statistics);

/// Runs the visibility function for all packets of a queue, tests and writes them, and empties the queue (visibility_queue.cpp). d: the
/// draw of the queue, with shades_later(d.mode).
template <class Statistics>
void decide_queued(const DrawInTile& d, PacketQueue& queue, Statistics& statistics);

/// Returns true if a triangle of an opaque draw covers all pixels of the tile's storage.
bool covers_tile(const DrawInTile& d, const Triangle& t);

/// Writes the depth and id of a triangle that covers the whole tile and passes everywhere. Does not change any statistics.
void write_full_tile(const DrawInTile& d, const Triangle& t, TriangleId id);

/// Depth test of a packet: returns the lanes of mask that pass. z is represented as in Tile::depth.
Mask depth_test(const DepthState& state, const Tile& tile, int packet, Real z, Mask mask);

/// Writes z to the lanes in mask if depth writes are enabled, and keeps the depth bounds of the block valid.
void write_depth(const DepthState& state, Tile& tile, int packet, Real z, Mask mask);

}  // namespace halfspace::HS_LANES
