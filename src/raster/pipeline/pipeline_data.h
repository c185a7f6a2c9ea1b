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
#include <memory_resource>
#include <utility>
#include <vector>

#include "halfspace/core/default_init_allocator.h"
#include "halfspace/raster/draw_state.h"
#include "halfspace/raster/statistics.h"
#include "halfspace/raster/target.h"
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
struct SpriteRect {
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
  Outcode any_outcode = 0;                ///< their union: 0 where the whole draw is in view
  Buffer<float> varyings;                 ///< behind the last row are kRowSlack more (core/transpose.h), of any value
  std::unique_ptr<SpriteRect[]> sprites;  ///< of points alone
  int clip_distance_count = 0;            ///< floats per vertex in clip_distances
  std::unique_ptr<float[]> clip_distances;

  std::size_t bytes() const { return screen.bytes() + outcodes.bytes() + varyings.bytes(); }
};

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
  auto is_at_most(int32_t width, int32_t height) const { return x1 - x0 <= I(width) && y1 - y0 <= I(height); }
};
using PixelBounds = PixelBox<int32_t>;

// ---- clip and setup → bin, visibility, shade -------------------------------------------------------------------

inline constexpr uint32_t kFrontFacing = 1;     ///< the triangle faces front
inline constexpr uint32_t kClipped = 2;         ///< vertex[] index the chunk's clip vertices
inline constexpr uint32_t kSmall = 4;           ///< every edge function fits in int32 without a shift
inline constexpr uint32_t kProvokingShift = 3;  ///< two bits: which of vertex[] is the provoking vertex
inline constexpr uint32_t kSprite = 32;         ///< a point: see Triangle
inline constexpr uint32_t kLine = 64;           ///< a line: see Triangle
inline constexpr uint32_t kCoveredShift = 7;    ///< twelve bits: see Triangle::covered
inline constexpr uint32_t kCoveredBits = 0xfff;
inline constexpr uint32_t kSegmentShift = 19;  ///< thirteen bits: which segment of the chunk

/// A triangle ready to be rasterized. Vertices are counter-clockwise (y up), vertex 0 the one with the smallest depth.
/// A point (kSprite) is one too: x[0] … x[1] and y[0] … y[1] are its first and last 1/256 px, all vertices the one it has.
/// A line (kLine, with one sample a pixel) has its ends as vertices 0 and 1, that of smaller depth first, and a third corner beside
/// the first so that E1 and the area are the products along the line that interpolation needs; vertex[2] is its LineRange.
struct Triangle {
  std::array<int32_t, 3> x, y;  ///< snapped, 24.8
  float z0;                     ///< depth at vertex 0, offset included
  float z_edge1, z_edge2;       ///< depth = z0 + E1·z_edge1 + E2·z_edge2, both ≥ 0 (E as in shading/pixel.h)
  float z_max;                  ///< the largest depth of the three vertices, offset included
  std::array<uint32_t, 3> vertex;
  uint32_t flags;

  uint32_t segment() const { return flags >> kSegmentShift; }
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
struct Segment {
  uint32_t draw, instance;
  uint32_t first, count;         ///< primitives of the draw's index list
  uint32_t first_triangle = 0;   ///< written by setup: where its triangles start in Chunk::triangles
  uint32_t first_primitive = 0;  ///< written by the primitive stage: where its values start in Chunk::primitives
};

/// Up to some thousand submitted triangles, through clip, setup and bin: written by one task, then only read.
struct Chunk {
  std::vector<Segment> segments;
  std::vector<Triangle, RawAllocator<Triangle>> triangles;
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
inline constexpr uint32_t kMaxPrimitivesPerChunk = 1u << (32 - kSegmentShift);
constexpr TriangleId triangle_id(uint32_t chunk, uint32_t triangle) { return chunk << 16 | triangle; }

// ---- a draw ----------------------------------------------------------------------------------------------------

struct VertexBatch;
struct PrimitiveBatch;
struct FragmentBatch;
struct VisibilityBatch;

/// The thin functions that call one shader; everything else in the pipeline is shared by all shaders.
struct ShaderKernels {
  void (*vertex)(const void* shader, const VertexBatch&) = nullptr;
  void (*position)(const void* shader, const VertexBatch&) = nullptr;      ///< as vertex, without varyings
  void (*primitive)(const void* shader, const PrimitiveBatch&) = nullptr;  ///< null: no primitive stage
  void (*visibility)(const void* shader, VisibilityBatch&) = nullptr;      ///< null: the triangle decides
  void (*fragment)(const void* shader, const FragmentBatch&) = nullptr;
  int varying_count = 0;                          ///< floats per vertex
  int primitive_count = 0;                        ///< floats per triangle
  const Interpolation* interpolations = nullptr;  ///< varying_count entries
  bool uses_centroid = false;                     ///< some varying does
  bool gives_point_size = false;                  ///< the vertex function does
  bool gives_sprite = false;                      ///< and bounds of points
  int clip_distance_count = 0;                    ///< and clip distances
  int color_count = 1;                            ///< colours that the fragment function returns
  bool discards = false;
  bool writes_depth = false;
  bool is_constant = false;  ///< one colour for the whole draw: the fragment kernel reads nothing of its batch but the count
};

/// Where a list, strip or fan begins after a primitive restart.
struct IndexRun {
  uint32_t first_primitive;  ///< primitives of the draw before it
  uint32_t first_index;      ///< its place in the index list
};

/// A copy of the caller's shader, so that uniforms may change after draw(). Its memory is the frame's; the deleter ends its life alone.
using KeptShader = std::unique_ptr<const void, void (*)(const void*)>;

/// A draw as the pass keeps it: its arguments, and what follows from them once for all triangles. A pass may have many thousands, so it
/// holds no more than it needs: streams and shader lie in the frame's memory, one behind the other.
struct Draw {
  const ShaderKernels& kernels;  ///< one for each type of shader, for ever
  KeptShader shader;
  std::shared_ptr<const Indices> indices;
  VertexStreams vertices;
  DrawState state;

  // These are set when the draw's vertices are shaded.
  Viewport viewport{};
  PixelBounds bounds{};    ///< viewport ∩ scissor ∩ target
  float depth_low = 0.0f;  ///< depth range in order
  float depth_high = 1.0f;
  bool deferred = false;        ///< shaded after visibility, once per visible pixel: replaces all colours; else shaded at once, in order
  bool writes_color = false;    ///< some channel of some attachment
  bool shades_samples = false;  ///< the fragment function runs for each sample, not for each pixel
  uint32_t sample_mask = 1;     ///< samples that may be drawn

  std::size_t vertex_count = 0;  ///< that its indices use, of all instances
  uint32_t primitive_count = 0;  ///< of one instance
  std::vector<IndexRun> runs{};  ///< those with a primitive in them; empty where no index is a restart

  Draw(const ShaderKernels& kernels_, KeptShader shader_, std::shared_ptr<const Indices> indices_, const VertexStreams& vertices_,
       const DrawState& state_)
      : kernels(kernels_), shader(std::move(shader_)), indices(std::move(indices_)), vertices(vertices_), state(state_) {}
};

/// Are a draw's vertices few enough that a row's place in their arrays fits in a gather's index?
inline bool can_gather(const ShadedVertices& v, const Draw& draw) {
  const std::size_t floats = std::size_t{v.count} * draw.state.instances * static_cast<std::size_t>(std::max(4, v.varying_count));
  return floats <= std::size_t{std::numeric_limits<int32_t>::max()};
}

/// Everything the stages after the vertex stage read.
struct Frame {
  std::unique_ptr<std::pmr::monotonic_buffer_resource> memory;  ///< of the draws' shaders and streams
  std::vector<Draw> draws;
  std::vector<ShadedVertices> shaded;  ///< one a draw
  std::vector<Chunk> chunks;
  int width = 0, height = 0;  ///< target, px
  int tile_size = 64;
  int tiles_x = 0, tiles_y = 0;
  DepthFormat depth_format = DepthFormat::none;  ///< without its stencil
  int samples = 1;                               ///< of a pixel
  SampleSpan samples_at{};
};

}  // namespace halfspace
