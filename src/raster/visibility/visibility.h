// SPDX-License-Identifier: Apache-2.0
//
// Visibility. Input: primitives of a draw and one tile. Output: the depth and visible triangle of each pixel in the tile or, on queued
// paths, the packets of all primitives, in submission order, in a queue.
//
// Coverage is exact, because edge functions are computed in integer arithmetic (raster/pipeline/edge.h). Depth is z0 + E1·z_edge1 +
// E2·z_edge2. Both products are non-negative, so it keeps its relative accuracy. E is exact for narrow triangles; otherwise it is computed
// by difference_of_products().
#pragma once

#include <span>
#include <string_view>

#include "halfspace/raster/pipeline/pass_context.h"
#include "halfspace/raster/tile/tile.h"

namespace halfspace::HS_LANES {

class TileTrace;     // raster/trace/tile_trace.h
struct PacketQueue;  // sink/packet_queue.h

/// What happens to the samples of a triangle before they are shaded.
enum class VisibilityMode : uint8_t {
  deferred,    ///< test, write depth and triangle id
  depth_only,  ///< test, write depth; there is no color to shade
  early,       ///< test, write depth, queue samples that pass
  test_only,   ///< test, queue samples that pass and their depth; depth is written after shading
  cover_only   ///< queue covered samples, except those that a promise of the shader rejects; depth is tested after shading, because the
              ///< shader replaces it
};

/// Returns true if visibility is complete without the fragment function, which runs later or never.
constexpr bool shades_later(VisibilityMode mode) { return mode == VisibilityMode::deferred || mode == VisibilityMode::depth_only; }

/// Returns the mode for a draw. Depth is tested before shading where this does not change the result (OpenGL 4.6, section 15.2.4).
VisibilityMode visibility_mode(const Draw& draw);

/// How the triangles of a draw get from the bins of a tile to the visibility buffer or to the queue. Each path is compiled for narrow
/// triangles and for all other primitives, and for tiles with one sample and with several samples per pixel. `nearest` and `queued_less`
/// give the same results as `opaque` and `queued`. They exist because the depth state is then known at compile time: tiny_1m took 0.97x the
/// time, and scene_garden_1, where draws are queued, 0.94x (e0fe8f50).
enum class TilePath : uint8_t { nearest, opaque, stencil, queued, queued_less, queued_stencil };  // queued paths come last

/// One row of the table of paths.
struct PathRow {
  TilePath path;
  std::string_view name;
  std::string_view decided_by;   ///< what decides which fragments are visible
  std::string_view depth_state;  ///< the depth states for which the path is compiled
  std::string_view output;
};
/// Returns the rows of all paths, in the order of TilePath. docs/explanation/architecture.md shows this table.
std::span<const PathRow> path_rows();

/// Returns the path of a draw with the given mode.
TilePath choose_path(const Draw& draw, VisibilityMode mode, const Tile& tile);

/// Returns true if only coverage and depth decide which fragments of a path are visible.
constexpr bool is_opaque(TilePath path) { return path == TilePath::nearest || path == TilePath::opaque; }

/// Returns true if the triangles of a path are queued until the shader runs.
constexpr bool is_queued(TilePath path) { return path >= TilePath::queued; }

/// Values that all triangles of a draw in one tile share.
struct DrawInTile {
  /// trace: records the fragments of the tile; null if they are not traced.
  DrawInTile(const PassContext& context, const Draw& draw, VisibilityMode mode, Tile& tile, TileTrace* trace = nullptr);

  const PassContext& context;
  const Draw& draw;
  VisibilityMode mode;
  TilePath path;
  Tile& tile;
  PixelBounds bounds;      ///< bounds of the draw in the tile
  bool needs_bounds_test;  ///< covered pixels of the tile can be outside bounds
  bool tests;              ///< depth is tested, before or after shading
  bool postpones_stencil;  ///< the stencil test follows the shader, which decides which fragments update the stencil values
  bool fetches_vertices;   ///< prefetch vertices
  TileTrace* trace;
};

/// Rasterizes a primitive in the tile. Queued paths add its packets to the queue, others ignore the queue.
using RasterizeFunction = void (*)(const DrawInTile& d, const Triangle& t, TriangleId id, PacketQueue& queue, PassStatistics& statistics);
/// Returns the function of a draw for any primitive (coverage/blocks.cpp).
RasterizeFunction rasterize_function(const DrawInTile& d);

/// Rasterizes narrow triangles, in order. indices: 1 to W triangles of the chunk. Queued paths stop when the queue is full. Returns the
/// number of triangles that were drawn, at least 1.
using RasterizeNarrowFunction = std::size_t (*)(const DrawInTile& d, uint32_t chunk, std::span<const uint16_t> indices, PacketQueue& queue,
                                                PassStatistics& statistics);
/// Returns the function of a draw for narrow triangles (coverage/small_triangles.cpp).
RasterizeNarrowFunction rasterize_narrow_function(const DrawInTile& d);

/// Returns true if a triangle of an opaque draw covers all pixels of the tile's storage.
bool covers_tile(const DrawInTile& d, const Triangle& t);

/// Writes the depth and id of a triangle that covers the whole tile and passes everywhere. Does not change any statistics.
void write_full_tile(const DrawInTile& d, const Triangle& t, TriangleId id);

/// Depth test of a packet: returns the lanes of mask that pass. z is represented as in Tile::depth.
Mask depth_test(const DepthState& state, const Tile& tile, int packet, Real z, Mask mask);

/// Writes z to the lanes in mask if depth writes are enabled, and keeps the depth bounds of the block valid.
void write_depth(const DepthState& state, Tile& tile, int packet, Real z, Mask mask);

}  // namespace halfspace::HS_LANES
