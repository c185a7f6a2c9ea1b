// SPDX-License-Identifier: Apache-2.0
//
// Data that the pipeline stages exchange, in pipeline order. The section headings name the stages that write and read it.
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

namespace halfspace::HS_LANES {

// ---- window coordinates ----------------------------------------------------------------------------------------

/// Sub-pixel grid. Positions are snapped to 1/256 px, as in D3D11.3 (section 3.2.4.1) and llvmpipe.
inline constexpr int kSubPixelBits = 8;
inline constexpr int kSubPixels = 1 << kSubPixelBits;

/// Positions reach the rasterizer within ±16384 px (2^22 sub-pixels); primitives that extend farther are clipped. Edge vectors then have 24
/// bits including the sign and are exact in float, and edge functions fit in 48 bits. If an edge crosses a tile, its edge function in the
/// tile, shifted right by kSubPixelBits, is below 64·2·2^23 = 2^30 and fits in int32.
inline constexpr float kGuardBand = 16384.0f;

/// Maximum tile size in pixels; larger tiles would exceed the bit budget above.
inline constexpr int kMaxTileSize = 64;
inline constexpr int kMaxTilePixels = kMaxTileSize * kMaxTileSize;

// ---- vertex stage → clip, setup, shade -------------------------------------------------------------------------

/// Vertex in window coordinates (origin at the lower left). Do not use the position if the outcode has kOutNeedsClip or kOutNonFinite.
struct ScreenVertex {
  int32_t x, y;  ///< 24.8 fixed point
  float z;       ///< window depth, before polygon offset and clamping
  float inv_w;   ///< 1 / w_clip
};

/// Half-open range of pixels that a line covers along its major axis, clamped to 0 … 2^15.
struct LineRange {
  int first, end;
  uint32_t packed() const { return static_cast<uint32_t>(first) | static_cast<uint32_t>(end) << 16; }
  static LineRange unpack(uint32_t p) { return {static_cast<int>(p & 0xffff), static_cast<int>(p >> 16)}; }
};

/// Samples covered by a point: x0 ≤ x < x1 and y0 ≤ y < y1, in 24.8 fixed point.
struct PointSpriteRect {
  int32_t x0, y0, x1, y1;
};

using Outcode = uint8_t;
inline constexpr Outcode kOutLeft = 1, kOutRight = 2, kOutBottom = 4, kOutTop = 8, kOutNear = 16, kOutFar = 32;
inline constexpr Outcode kOutGuard = 64;       ///< outside the guard band, or w too small: no window position
inline constexpr Outcode kOutNonFinite = 128;  ///< x, y, z, w or a distance is NaN or Inf
inline constexpr Outcode kOutNeedsClip = kOutNear | kOutFar | kOutGuard;
inline constexpr Outcode kOutView = 63;  ///< the six planes of the view volume

/// An uninitialized array that does not shrink: it keeps its memory when a smaller size is requested.
template <class T>
class Buffer {
 public:
  /// Makes room for n values. The contents are unspecified.
  void reset(std::size_t n) {
    if (n <= capacity_) return;
    data_.reset(new T[n]);  // not make_unique: rows that no index uses need not be initialized
    capacity_ = n;
  }
  T* get() const { return data_.get(); }
  T& operator[](std::size_t i) const { return data_[i]; }
  std::size_t bytes() const { return capacity_ * sizeof(T); }

 private:
  std::unique_ptr<T[]> data_;
  std::size_t capacity_ = 0;
};

/// Shaded vertices of one draw. All later stages refer to a vertex by its slot: (index − first) + instance · count.
struct ShadedVertices {
  uint32_t first = 0;
  uint32_t count = 0;           ///< slots per instance
  int varying_count = 0;        ///< floats per vertex in varyings
  Buffer<ScreenVertex> screen;  ///< uninitialized for slots that no index refers to
  Buffer<Outcode> outcodes;
  Outcode any_outcode = 0;  ///< union of all outcodes; 0 if the whole draw is in view
  Buffer<float> varyings;   ///< followed by kRowSlack floats of padding (core/transpose.h)
  bool has_sprites = false;
  Buffer<PointSpriteRect> sprites;  ///< only for points
  int clip_distance_count = 0, cull_distance_count = 0;
  Buffer<float> distances;  ///< of each vertex: clip distances, cull distances

  int distance_count() const { return clip_distance_count + cull_distance_count; }
  std::size_t bytes() const { return screen.bytes() + outcodes.bytes() + varyings.bytes() + sprites.bytes() + distances.bytes(); }
};

// ---- vertex stage → emitting stages -----------------------------------------------------------------------------

/// Outputs of the vertex function for emitting stages and for capture(), by slot (see ShadedVertices).
struct ClipVertices {
  uint32_t first = 0;
  uint32_t count = 0;           ///< slots per instance
  Buffer<glm::vec4> positions;  ///< clip space; uninitialized for slots that no index refers to
  Buffer<float> varyings;
};

/// The layer and the viewport that a vertex chooses.
struct Destination {
  int32_t layer = 0, viewport = 0;
  friend bool operator==(const Destination&, const Destination&) = default;
  friend auto operator<=>(const Destination&, const Destination&) = default;
};

// ---- vertex stage → vertex kernels ------------------------------------------------------------------------------

/// Maximum number of vertices per call of a vertex kernel.
inline constexpr int kVertexBatch = 256;
/// Vertices for a vertex kernel.
struct VertexBatch {
  std::span<const VertexStream> streams{};  ///< streams of floats, read in place
  const uint32_t* ids = nullptr;            ///< vertex indices, or null: first, first + 1, …
  uint32_t first = 0;
  int count = 0;
  uint32_t slot_base = 0;     ///< the varyings of vertex i are written to row i − slot_base (modulo 2^32)
  int32_t base_vertex = 0;    ///< index + base_vertex is the row in the streams
  int32_t instance = 0;       ///< the same for all vertices
  float* varyings = nullptr;  ///< null: varyings are not written
  float* clip = nullptr;      ///< output: clip-space x, y, z and w in four rows of kVertexBatch floats; unused by VertexOutput::layer
  /// Output rows, or null: the point size and distances, or the min x, min y, max x and max y of a point sprite.
  float* extra = nullptr;
  bool is_converted = false;  ///< row i of the streams belongs to vertex i of the batch, not to the vertex with that index
};
inline constexpr int kMaxDistances = 8;  ///< clip and cull distances (GL_MAX_COMBINED_CLIP_AND_CULL_DISTANCES)
inline constexpr int kMaxExtraRows = 1 + kMaxDistances;

// ---- the viewport transform ------------------------------------------------------------------------------------

/// Transform from clip space to window coordinates: x_px = x/w · half_width + center_x, and the same for y.
struct Viewport {
  float half_width, half_height;                           ///< px; half_height is negative if the picture is upside down
  float center_x, center_y;                                ///< px
  float depth_scale, depth_bias;                           ///< window depth = z/w · scale + bias
  float guard_left, guard_right, guard_bottom, guard_top;  ///< x ≥ guard_left·w, x ≤ guard_right·w, and the same for y
};

/// Minimum and maximum of the x and y coordinates of all samples within their pixel, in 1/256 px.
struct SampleSpan {
  int low = kSubPixels / 2, high = kSubPixels / 2;
};

/// Half-open box of pixels. I is int32_t, or Int for one box per lane.
template <class I>
struct PixelBox {
  I x0, y0, x1, y1;

  bool operator==(const PixelBox&) const = default;
  auto empty() const { return x0 >= x1 || y0 >= y1; }
  auto fits_in(int32_t width, int32_t height) const { return x1 - x0 <= I(width) && y1 - y0 <= I(height); }
};
using PixelBounds = PixelBox<int32_t>;

// ---- clip and setup → bin, visibility, shade -------------------------------------------------------------------

inline constexpr uint32_t kFrontFacing = 1;     ///< the triangle is front-facing
inline constexpr uint32_t kClipped = 2;         ///< vertex[] contains indices of the chunk's clip vertices
inline constexpr uint32_t kNarrow = 4;          ///< the extent is at most kNarrowExtent (triangle_sizes.h)
inline constexpr uint32_t kProvokingShift = 3;  ///< two bits: index of the provoking vertex in vertex[]
inline constexpr uint32_t kPointSprite = 32;    ///< a point; see Triangle
inline constexpr uint32_t kLine = 64;           ///< a line; see Triangle
inline constexpr uint32_t kCoveredShift = 7;    ///< twelve bits; see Triangle::covered
inline constexpr uint32_t kCoveredBits = 0xfff;
inline constexpr uint32_t kDrawRangeShift = 19;  ///< thirteen bits: index of the draw range in the chunk

/// A primitive that is ready to be rasterized. The vertices of a triangle are in counter-clockwise order (y up), starting with the one with
/// the smallest depth.
///
/// For a point, x[0] … x[1] and y[0] … y[1] are the first and last covered positions in 1/256 px; see sprite(). All three elements of
/// vertex are the same.
///
/// For a line (only with one sample per pixel), vertices 0 and 1 are the end points, the one with the smaller depth first. The third
/// vertex is offset from vertex 0 perpendicularly to the line. E1 is then the dot product with the line vector, and the area is its squared
/// length, as needed for interpolation along the line. vertex[2] contains the pixels; see line_range().
struct Triangle {
  std::array<int32_t, 3> x, y;  ///< snapped, 24.8
  float z0;                     ///< depth at vertex 0, including polygon offset
  float z_edge1, z_edge2;       ///< depth = z0 + E1·z_edge1 + E2·z_edge2, both ≥ 0 (E as in shading/pixel.h)
  float z_max;                  ///< largest depth of the three vertices, including polygon offset
  std::array<uint32_t, 3> vertex;
  uint32_t flags;

  uint32_t range() const { return flags >> kDrawRangeShift; }
  uint32_t provoking() const { return (flags >> kProvokingShift) & 3; }
  bool is(uint32_t flag) const { return (flags & flag) != 0; }

  // The kind of the primitive. Triangles are narrow or wide; see kNarrowExtent.
  bool is_point() const { return is(kPointSprite); }
  bool is_line() const { return is(kLine); }
  bool is_triangle() const { return !is(kPointSprite | kLine); }
  bool is_narrow_triangle() const { return (flags & (kNarrow | kPointSprite)) == kNarrow; }
  bool is_wide_triangle() const { return !is(kNarrow | kPointSprite | kLine); }

  /// Returns the samples that a point covers.
  PointSpriteRect sprite() const { return {x[0], y[0], x[1] + 1, y[1] + 1}; }
  /// Returns the pixels of a line along its major axis.
  LineRange line_range() const { return LineRange::unpack(vertex[2]); }
  /// Covered pixels of a tiny triangle, or 0 if they are not known. They are only known with one sample per pixel, and for a bounding box
  /// of at most kTinySide x kTinyRows pixels. Bit 4r + c is pixel c of row r of the bounding box, clipped to the bounds of the draw.
  uint32_t covered() const { return flags >> kCoveredShift & kCoveredBits; }
};

/// Vertex created or copied by the clipper. Its flat varyings are copied from the provoking vertex. For shaders that use a PrimitiveId,
/// two more values follow the varyings: the barycentric weights of the second and third submitted vertex at this vertex.
struct ClipVertex {
  ScreenVertex screen;
  uint32_t first_varying;  ///< index into Chunk::clip_varyings
};
inline constexpr std::size_t kClipWeights = 2;

/// Row of Chunk::primitives for a shader that uses a PrimitiveId. The values are integers, stored as the bits of floats.
enum IdRow : std::size_t {
  kIdPrimitive,
  kIdInstance,
  kIdSecond,  ///< slot of the second submitted vertex; kNoSlot for points
  kIdThird,   ///< slot of the third submitted vertex; kNoSlot for points and lines
  kIdRow      ///< number of values
};
inline constexpr uint32_t kNoSlot = 0xffffffffu;

/// Range of consecutive primitives of one instance of a draw.
struct DrawRange {
  uint32_t draw, instance;
  uint32_t first, count;         ///< range in the draw's list of primitives
  uint32_t first_triangle = 0;   ///< written by setup: index of the first triangle in Chunk::triangles
  uint32_t first_primitive = 0;  ///< written by the primitive stage: index of the first value in Chunk::primitives
};

/// Up to a few thousand submitted primitives on their way through clipping, setup and binning. Written by one task, then only read.
struct Chunk {
  std::vector<DrawRange> ranges;
  std::vector<Triangle, DefaultInitAllocator<Triangle>> triangles;
  std::vector<ClipVertex> clip_vertices;
  std::vector<float> clip_varyings;
  /// Number, in its draw, of the primitive from which each triangle was created. Only set for the triangles of draws for which
  /// needs_primitive_numbers() is true; there may be fewer elements than triangles.
  std::vector<uint32_t> primitive_numbers;
  std::vector<float> primitives;  ///< output of the primitive stage, one row per triangle; see IdRow

  // Bins: triangle indices per tile, in submission order.
  int tile_x0 = 0, tile_y0 = 0, tile_x1 = 0, tile_y1 = 0;  ///< half-open range of tiles that have a bin
  std::vector<uint32_t> bin_start;                         ///< (tiles + 1) offsets into bin_triangles
  std::vector<uint16_t> bin_triangles;

  PassStatistics statistics;

  /// Returns the end of the triangles of ranges[range], which start at its first_triangle.
  uint32_t end_triangle(std::size_t range) const {
    return range + 1 < ranges.size() ? ranges[range + 1].first_triangle : static_cast<uint32_t>(triangles.size());
  }
  /// Returns the index in `ranges` of the range that a triangle belongs to.
  std::size_t range_of(uint32_t triangle) const { return ranges.size() == 1 ? 0 : triangles[triangle].range(); }

  /// Clears all contents but keeps the memory.
  void clear();
  /// Returns the size of the larger arrays in bytes.
  std::size_t bytes() const;
};

/// Identifies a triangle: index of the chunk and index in the chunk. Stored for each pixel.
using TriangleId = uint32_t;
/// Consecutive ids.
struct TriangleIds {
  TriangleId first = 0;
  uint32_t count = 0;
};
inline constexpr TriangleId kNoTriangle = 0xffffffffu;
inline constexpr uint32_t kMaxChunks = 0xffff;
inline constexpr uint32_t kMaxTrianglesPerChunk = 0xffff;
/// Maximum number of submitted primitives per chunk; each of them may have its own draw range. A chunk has at most 4369 filled triangles,
/// because clipping can turn each of them into 15.
inline constexpr uint32_t kMaxPrimitivesPerChunk = 1u << (32 - kDrawRangeShift);
constexpr TriangleId triangle_id(uint32_t chunk, uint32_t triangle) { return chunk << 16 | triangle; }
/// These return the two parts of an id other than kNoTriangle: the chunk, and the index into its triangles.
constexpr uint32_t chunk_of(TriangleId id) { return id >> 16; }
constexpr uint32_t index_in_chunk(TriangleId id) { return id & 0xffff; }

}  // namespace halfspace::HS_LANES
