// SPDX-License-Identifier: Apache-2.0
//
// Visibility. In: one triangle and one tile. Out, for deferred draws: the tile's depth and visible triangle; for
// immediate draws: the packets to shade now, sample after sample.
//
// Coverage is exact: edge functions in whole numbers (raster/pipeline/edge.h). Depth is z0 + E1·z_edge1 + E2·z_edge2 with
// non-negative terms, so it keeps its relative accuracy: E exact for small triangles, else a difference of products.
#pragma once

#include <span>

#include "halfspace/raster/tile/tile.h"
#include "halfspace/raster/visibility/depth_plane.h"

namespace halfspace {

/// Room for what one triangle covers in a tile.
struct CoverageList {
  std::array<PacketMask, kPackets> packets;
  int count = 0;
  std::array<int, kMaxSamples> sample_end;  ///< where each sample's packets end
  /// Depth of the covered pixels, as Tile::depth holds it; valid where a mask has its bit.
  alignas(64) std::array<float, kMaxTilePixels> depth;
};

/// What a triangle's samples do to the tile before they are shaded.
enum class VisibilityMode : uint8_t {
  deferred,    ///< test, write depth and triangle id
  depth_only,  ///< test, write depth: there is no colour to shade
  early,       ///< test, write depth, list what passed
  test_only,   ///< test, list what passed: depth is written after the shader has spoken
  cover_only   ///< list what is covered: the shader replaces the depth, and the test comes after it
};

/// May a depth test come before the fragment function (OpenGL 4.6, section 15.2.4 allows it where no one can tell)?
VisibilityMode visibility_mode(const Draw& draw);

/// What the triangles of one draw have in common in one tile.
struct DrawInTile {
  DrawInTile(const PassContext& context, const Draw& draw, VisibilityMode mode, Tile& tile);

  const PassContext& context;
  const Draw& draw;
  VisibilityMode mode;
  Tile& tile;
  PixelBounds bounds;      ///< of the draw in the tile
  bool needs_bounds_test;  ///< a covered pixel of the tile may lie outside of bounds
  bool tests;              ///< there is a depth test in this stage (where the stencil does not put it off)
  bool asks_shader;        ///< the shader's visibility function decides
  bool fetches_vertices;   ///< vertices are worth fetching ahead: they are points', or several triangles share each
  bool is_opaque;          ///< one sample a pixel, and only coverage and depth decide
};

/// Rasterizes triangle `index` of chunk `chunk` in the tile. list is needed but for VisibilityMode::deferred and depth_only.
void rasterize(const DrawInTile& d, uint32_t chunk, uint32_t index, CoverageList* list, PassStatistics& statistics);

/// The same for a plain draw (visibility_blocks.cpp).
void rasterize_opaque(const DrawInTile& d, const Triangle& t, TriangleId id, PassStatistics& statistics);

/// Is this for rasterize_small?
inline bool is_small_triangle(const Triangle& t) { return (t.flags & (kSmall | kPointSprite)) == kSmall; }
/// Rasterizes small triangles of a plain draw in the tile, one after the other: at most W of the chunk's, by their indices, not none.
void rasterize_small(const DrawInTile& d, uint32_t chunk, std::span<const uint16_t> indices, PassStatistics& statistics);

/// Covers the triangle of a plain draw every pixel of the tile's room?
bool covers_tile(const DrawInTile& d, const Triangle& t);

/// Writes depth and id of a triangle that covers the tile's room and passes everywhere; bounds: of its depths. Counts nothing.
void write_full_tile(const DrawInTile& d, const Triangle& t, TriangleId id, const DepthBounds& bounds);

/// The depth test of a packet: which lanes of mask pass, with z as Tile::depth holds it.
Mask depth_test(const DepthState& state, const Tile& tile, int packet, Real z, Mask mask);

/// Writes z where mask says, if the state writes depth, and keeps the block's bounds true.
void write_depth(const DepthState& state, Tile& tile, int packet, Real z, Mask mask);

/// Packets that a visibility kernel decides in one call.
inline constexpr int kVisibilityBatch = 16;

/// Packets of one triangle for a shader's visibility function.
struct VisibilityBatch {
  const PassContext* context;
  TriangleId id;
  int tile_x0, tile_y0;     ///< window coordinates of pixel (0, 0) of the tile's room
  SamplePosition position;  ///< where in their pixels the shader looks
  int count = 0;            ///< ≤ kVisibilityBatch
  std::array<uint16_t, kVisibilityBatch> packets;
  const SamplePosition* centroids;  ///< as in FragmentBatch
  /// In: the triangle's depths; out, if the shader writes depth: the shader's (it sees in px.z() what fragment will see, so both
  /// say the same).
  alignas(64) std::array<Real, kVisibilityBatch> depth;
  std::array<uint32_t, kVisibilityBatch> lanes;  ///< in and out: bits of the covered lanes, then of those kept
};

}  // namespace halfspace
