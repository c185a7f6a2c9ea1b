// SPDX-License-Identifier: Apache-2.0
//
// What the stages hand to each other, in the order of the pipeline; each struct says who writes it and who reads it.
//
//   vertex_stage → clip → setup → bin → (per tile) visibility → shade → blend → tile store
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "halfspace/core/default_init_allocator.h"
#include "halfspace/raster/draw_state.h"
#include "halfspace/raster/statistics.h"
#include "halfspace/raster/vertex_input.h"

namespace halfspace {

// ---- window coordinates ----------------------------------------------------------------------------------------

/// Sub-pixel grid: positions are snapped to 1/256 px (D3D11.3, section 3.2.4.1; also llvmpipe's).
inline constexpr int kSubPixelBits = 8;
inline constexpr int kSubPixels = 1 << kSubPixelBits;

/// Positions reach the rasterizer within ±16384 px (2^22 sub-pixels); what goes beyond is clipped. Then edge vectors
/// have 24 bits with their sign and are exact in float and edge functions fit in 48 bits. After the shift by
/// kSubPixelBits, what an edge crossing a tile reaches inside it is below 64·2·2^23 = 2^30, so it fits in int32.
inline constexpr float kGuardBand = 16384.0f;

/// Pixels a side of a tile, at the most: what the bit budget above allows.
inline constexpr int kMaxTileSize = 64;
inline constexpr int kMaxTilePixels = kMaxTileSize * kMaxTileSize;

// ---- vertex stage → clip, setup, shade -------------------------------------------------------------------------

/// A vertex in window coordinates (origin lower left). Undefined where the outcode has kOutNeedsClip or kOutNonFinite.
struct ScreenVertex {
  int32_t x, y;  ///< 24.8 fixed point
  float z;       ///< window depth, before offset and clamp
  float inv_w;   ///< 1 / w_clip
};

/// The pixels of a line along its longer axis, half open, cut to 0 … 2^15.
struct LineRange {
  int first, end;
  uint32_t packed() const { return static_cast<uint32_t>(first) | static_cast<uint32_t>(end) << 16; }
  static LineRange unpack(uint32_t p) { return {static_cast<int>(p & 0xffff), static_cast<int>(p >> 16)}; }
};

/// What a point covers: samples with x0 ≤ x < x1 and y0 ≤ y < y1, in 24.8 fixed point, held to ±2^28.
struct PointSpriteRect {
  int32_t x0, y0, x1, y1;
};

using Outcode = uint8_t;
inline constexpr Outcode kOutLeft = 1, kOutRight = 2, kOutBottom = 4, kOutTop = 8, kOutNear = 16, kOutFar = 32;
inline constexpr Outcode kOutGuard = 64;       ///< beyond the guard band, or w too small: no window position
inline constexpr Outcode kOutNonFinite = 128;  ///< a NaN or Inf among x, y, z, w
inline constexpr Outcode kOutNeedsClip = kOutNear | kOutFar | kOutGuard;
inline constexpr Outcode kOutView = 63;  ///< the six planes of the view volume

/// An array that starts uninitialized and keeps its memory when it is asked for less.
template <class T>
class Buffer {
 public:
  /// Room for n values, whatever they are.
  void reset(std::size_t n) {
    if (n <= capacity_) return;
    data_.reset(new T[n]);  // not make_unique: rows that no index uses need no initialization
    capacity_ = n;
  }
  T* get() const { return data_.get(); }
  T& operator[](std::size_t i) const { return data_[i]; }
  std::size_t bytes() const { return capacity_ * sizeof(T); }

 private:
  std::unique_ptr<T[]> data_;
  std::size_t capacity_ = 0;
};

/// The vertices of one draw. A vertex's slot, by which all later stages know it, is (index − first) + instance · count.
struct ShadedVertices {
  uint32_t first = 0;
  uint32_t count = 0;           ///< slots of an instance
  int varying_count = 0;        ///< floats per vertex in varyings
  Buffer<ScreenVertex> screen;  ///< uninitialized where no index refers to it
  Buffer<Outcode> outcodes;
  Outcode any_outcode = 0;                     ///< their union: 0 where the whole draw is in view
  Buffer<float> varyings;                      ///< behind the last row are kRowSlack more (core/transpose.h), of any value
  std::unique_ptr<PointSpriteRect[]> sprites;  ///< of points alone
  int clip_distance_count = 0;                 ///< floats per vertex in clip_distances
  std::unique_ptr<float[]> clip_distances;

  std::size_t bytes() const { return screen.bytes() + outcodes.bytes() + varyings.bytes(); }
};

// ---- vertex stage → vertex kernels ------------------------------------------------------------------------------

/// Up to kVertexBatch vertices for a vertex kernel.
inline constexpr int kVertexBatch = 256;
struct VertexBatch {
  std::span<const VertexStream> streams;
  const uint32_t* ids;  ///< indices of the vertices, or null: first, first + 1, …
  uint32_t first;
  int count;
  uint32_t slot_base;   ///< varyings of vertex i go to row i − slot_base (modulo 2^32)
  int32_t base_vertex;  ///< index + base_vertex is the row of the streams
  int32_t instance;     ///< all vertices are of this one
  float* varyings;      ///< null for the position kernel
  float* clip;          ///< out: x, y, z, w of clip space as four rows of kVertexBatch
  float* extra;         ///< out, or null: rows of the point size and the clip distances, or a sprite's low x, low y, high x, high y
};
inline constexpr int kMaxClipDistances = 8;
inline constexpr int kMaxExtraRows = 1 + kMaxClipDistances;

// ---- the viewport transform ------------------------------------------------------------------------------------

/// Clip space → window: x_px = x/w · half_width + center_x, and so on.
struct Viewport {
  float half_width, half_height;                           ///< px
  float center_x, center_y;                                ///< px
  float depth_scale, depth_bias;                           ///< window depth = z/w · scale + bias
  float guard_left, guard_right, guard_bottom, guard_top;  ///< x ≥ guard_left·w, x ≤ guard_right·w, …
};

/// The least and the largest coordinate, x or y, of any sample in its pixel, in 1/256 px.
struct SampleSpan {
  int low = kSubPixels / 2, high = kSubPixels / 2;
};

/// Pixels, half open. I: int32_t, or Int for as many boxes as there are lanes.
template <class I>
struct PixelBox {
  I x0, y0, x1, y1;

  bool operator==(const PixelBox&) const = default;
  auto empty() const { return x0 >= x1 || y0 >= y1; }
  auto fits_in(int32_t width, int32_t height) const { return x1 - x0 <= I(width) && y1 - y0 <= I(height); }
};
using PixelBounds = PixelBox<int32_t>;

// ---- clip and setup → bin, visibility, shade -------------------------------------------------------------------

inline constexpr uint32_t kFrontFacing = 1;     ///< the triangle faces front
inline constexpr uint32_t kClipped = 2;         ///< vertex[] index the chunk's clip vertices
inline constexpr uint32_t kSmall = 4;           ///< every edge function fits in int32 without a shift
inline constexpr uint32_t kProvokingShift = 3;  ///< two bits: which of vertex[] is the provoking vertex
inline constexpr uint32_t kPointSprite = 32;    ///< a point: see Triangle
inline constexpr uint32_t kLine = 64;           ///< a line: see Triangle
inline constexpr uint32_t kCoveredShift = 7;    ///< twelve bits: see Triangle::covered
inline constexpr uint32_t kCoveredBits = 0xfff;
inline constexpr uint32_t kDrawRangeShift = 19;  ///< thirteen bits: which segment of the chunk

/// A triangle ready to be rasterized. Vertices are counter-clockwise (y up), vertex 0 the one with the smallest depth.
/// A point (kPointSprite) is one too: x[0] … x[1] and y[0] … y[1] are its first and last 1/256 px, all vertices the one it has.
/// A line (kLine, with one sample a pixel) has its ends as vertices 0 and 1, that of smaller depth first, and a third corner beside
/// the first so that E1 and the area are the products along the line that interpolation needs; vertex[2] is its LineRange.
struct Triangle {
  std::array<int32_t, 3> x, y;  ///< snapped, 24.8
  float z0;                     ///< depth at vertex 0, offset included
  float z_edge1, z_edge2;       ///< depth = z0 + E1·z_edge1 + E2·z_edge2, both ≥ 0 (E as in shading/pixel.h)
  float z_max;                  ///< the largest depth of the three vertices, offset included
  std::array<uint32_t, 3> vertex;
  uint32_t flags;

  uint32_t range() const { return flags >> kDrawRangeShift; }
  uint32_t provoking() const { return (flags >> kProvokingShift) & 3; }
  bool is(uint32_t flag) const { return (flags & flag) != 0; }
  /// Of a small triangle in few pixels (one sample a pixel) those that it covers: bit 4r + c is pixel c of row r of its box within the
  /// draw's bounds. 0: not said here.
  uint32_t covered() const { return flags >> kCoveredShift & kCoveredBits; }
};

/// A vertex made or copied by the clipper. Its flat varyings are those of its triangle's provoking vertex.
struct ClipVertex {
  ScreenVertex screen;
  uint32_t first_varying;  ///< into Chunk::clip_varyings
};

/// Where a clipped triangle came from, for the primitive stage: the vertices of the triangle that was submitted.
struct ClipSource {
  uint32_t triangle;  ///< index into Chunk::triangles of the first piece
  std::array<uint32_t, 3> vertex;
};

/// A run of consecutive primitives of one instance of a draw.
struct DrawRange {
  uint32_t draw, instance;
  uint32_t first, count;         ///< primitives of the draw's index list
  uint32_t first_triangle = 0;   ///< written by setup: where its triangles start in Chunk::triangles
  uint32_t first_primitive = 0;  ///< written by the primitive stage: where its values start in Chunk::primitives
};

/// Up to some thousand submitted triangles, through clip, setup and bin: written by one task, then only read.
struct Chunk {
  std::vector<DrawRange> ranges;
  std::vector<Triangle, DefaultInitAllocator<Triangle>> triangles;
  std::vector<ClipVertex> clip_vertices;
  std::vector<float> clip_varyings;
  std::vector<ClipSource> clip_sources;
  std::vector<float> primitives;  ///< primitive stage's floats, one row a triangle

  // Bins: triangle indices by tile, each list in submission order.
  int tile_x0 = 0, tile_y0 = 0, tile_x1 = 0, tile_y1 = 0;  ///< the tiles that have a list, half open
  std::vector<uint32_t> bin_start;                         ///< (tiles + 1) offsets into bin_triangles
  std::vector<uint16_t> bin_triangles;

  PassStatistics statistics;

  /// Empty, but with its memory.
  void clear();
  /// What its larger arrays take.
  std::size_t bytes() const;
};

/// A triangle as a pixel remembers it: chunk and index in the chunk.
using TriangleId = uint32_t;
inline constexpr TriangleId kNoTriangle = 0xffffffffu;
inline constexpr uint32_t kMaxChunks = 0xffff;
inline constexpr uint32_t kMaxTrianglesPerChunk = 0xffff;
/// Submitted, one a segment at the least. Filled triangles end a chunk at 4369: clipping may make 15 of one.
inline constexpr uint32_t kMaxPrimitivesPerChunk = 1u << (32 - kDrawRangeShift);
constexpr TriangleId triangle_id(uint32_t chunk, uint32_t triangle) { return chunk << 16 | triangle; }
/// The parts of an id other than kNoTriangle: the chunk, and the index into its triangles.
constexpr uint32_t chunk_of(TriangleId id) { return id >> 16; }
constexpr uint32_t index_in_chunk(TriangleId id) { return id & 0xffff; }

}  // namespace halfspace
