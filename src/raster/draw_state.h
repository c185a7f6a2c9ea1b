// SPDX-License-Identifier: Apache-2.0
//
// State of a draw call. Names follow OpenGL. Defaults are OpenGL's initial values with two exceptions: the depth test is enabled, and a
// BlendState is set up for straight alpha blending. There is no global state; every draw has its own copy.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include <glm/glm.hpp>

#include "halfspace/core/compare_op.h"
#include "halfspace/core/namespace.h"

namespace halfspace::HS_LANES {

/// A rectangle of pixels in window coordinates (origin at the lower left): [x, x + width) × [y, y + height).
struct Rect {
  int x = 0, y = 0, width = 0, height = 0;
  friend bool operator==(const Rect&, const Rect&) = default;
};

/// Returns the intersection of two rectangles. Its width or height is 0 if they do not overlap. The right and upper sides of the rectangles
/// can be beyond the range of int.
constexpr Rect intersect(const Rect& a, const Rect& b) {
  const int x = std::max(a.x, b.x), y = std::max(a.y, b.y);
  const int64_t right = std::min(int64_t{a.x} + a.width, int64_t{b.x} + b.width);
  const int64_t top = std::min(int64_t{a.y} + a.height, int64_t{b.y} + b.height);
  return {x, y, static_cast<int>(std::max<int64_t>(right - x, 0)), static_cast<int>(std::max<int64_t>(top - y, 0))};
}

/// The bounds of a viewport in window coordinates. Fractions are rounded to 1/256 px. A negative height turns the picture upside down, as
/// in Vulkan: y is then the upper side, and the winding of triangles in the window changes with the picture.
struct ViewportRect {
  float x = 0.0f, y = 0.0f, width = 0.0f, height = 0.0f;

  constexpr ViewportRect() = default;
  constexpr ViewportRect(float x_, float y_, float width_, float height_) : x(x_), y(y_), width(width_), height(height_) {}
  constexpr ViewportRect(const Rect& r)
      : x(static_cast<float>(r.x)), y(static_cast<float>(r.y)), width(static_cast<float>(r.width)), height(static_cast<float>(r.height)) {}
  friend bool operator==(const ViewportRect&, const ViewportRect&) = default;
};

/// Primitive topology (OpenGL 4.6, section 10.1). In a strip, every other triangle has two of its vertices swapped so that all triangles
/// have the same winding. The topologies with adjacency have the vertices of neighbors, which only geometry functions read; other draws
/// ignore them.
enum class Topology : uint8_t {
  triangles,
  triangle_strip,
  triangle_fan,
  points,
  lines,
  line_strip,
  line_loop,
  lines_adjacency,
  line_strip_adjacency,
  triangles_adjacency,
  triangle_strip_adjacency,
  patches  ///< for shaders with tessellation (shading/tessellation_stage.h), which state the number of vertices of a patch
};
constexpr bool has_adjacency(Topology t) { return t >= Topology::lines_adjacency && t <= Topology::triangle_strip_adjacency; }
constexpr bool is_lines(Topology t) {
  return t == Topology::lines || t == Topology::line_strip || t == Topology::line_loop || t == Topology::lines_adjacency ||
         t == Topology::line_strip_adjacency;
}
constexpr bool is_triangles(Topology t) { return t != Topology::points && t != Topology::patches && !is_lines(t); }

/// How triangles are rasterized: filled, as outlines, or as points at their vertices (glPolygonMode). The outline of a clipped triangle is
/// the outline of the polygon that remains.
enum class PolygonMode : uint8_t { fill, line, point };

/// Corner of a point at which its point coordinate is (0, 0) (GL_POINT_SPRITE_COORD_ORIGIN).
enum class PointOrigin : uint8_t { upper_left, lower_left };

enum class CullMode : uint8_t { none, front, back, front_and_back };
constexpr bool is_culled(CullMode mode, bool front_facing) {
  return mode == CullMode::front_and_back || mode == (front_facing ? CullMode::front : CullMode::back);
}
enum class Winding : uint8_t { counter_clockwise, clockwise };
enum class ProvokingVertex : uint8_t { last, first };

/// Where y = −1 in clip space is in the viewport (glClipControl). With upper_left, the picture is upside down, but triangles keep their
/// sides: the sign of their area in the window is negated (OpenGL 4.6, section 14.6.1).
enum class ClipOrigin : uint8_t { lower_left, upper_left };

/// Depth range of the view volume in clip space.
enum class ClipDepth : uint8_t {
  negative_one_to_one,  ///< OpenGL: −w ≤ z ≤ w, window depth 0.5·z/w + 0.5
  zero_to_one           ///< D3D, Vulkan, reversed Z: 0 ≤ z ≤ w, window depth z/w
};

/// Depth test and depth writes. For reversed Z, use ClipDepth::zero_to_one, CompareOp::greater and a projection that maps the near plane to
/// 1; see kReversedZ.
struct DepthState {
  bool test = true;
  bool write = true;
  CompareOp compare = CompareOp::less;
  ClipDepth clip = ClipDepth::negative_one_to_one;
  bool clamp = false;       ///< GL_DEPTH_CLAMP: no clipping at the near and far planes, depth is clamped to the depth range instead
  float range_near = 0.0f;  ///< glDepthRange; both values must be in [0, 1]
  float range_far = 1.0f;
  friend bool operator==(const DepthState&, const DepthState&) = default;
};

/// Polygon offset (OpenGL 4.6, section 14.6.5). It has no effect on points and lines. The offset slope·m + constant·r is clamped and then
/// added to the window depth. Here m = max(|dz/dx|, |dz/dy|), and r is the smallest resolvable difference of the depth format. For 32-bit
/// float depth, r = 2^(e−23), where e is the exponent of the largest |z| of the triangle. A positive offset moves the triangle away from
/// the eye, or towards it with reversed Z.
struct DepthOffset {
  float slope = 0.0f;
  float constant = 0.0f;
  float clamp = 0.0f;     ///< > 0: upper limit of the offset; < 0: lower limit; 0: no limit
  bool fill = true;       ///< of filled triangles (GL_POLYGON_OFFSET_FILL)
  bool outlines = false;  ///< of triangles drawn as outlines (GL_POLYGON_OFFSET_LINE)
  bool corners = false;   ///< of triangles drawn as points (GL_POLYGON_OFFSET_POINT)
  friend bool operator==(const DepthOffset&, const DepthOffset&) = default;
};

/// Returns true if triangles drawn in this mode have a polygon offset.
constexpr bool has_offset(const DepthOffset& o, PolygonMode mode) {
  const bool applies = mode == PolygonMode::fill ? o.fill : mode == PolygonMode::line ? o.outlines : o.corners;
  return applies && (o.slope != 0.0f || o.constant != 0.0f);
}

enum class BlendFactor : uint8_t {
  zero,
  one,
  src_color,
  one_minus_src_color,
  dst_color,
  one_minus_dst_color,
  src_alpha,
  one_minus_src_alpha,
  dst_alpha,
  one_minus_dst_alpha,
  constant_color,
  one_minus_constant_color,
  constant_alpha,
  one_minus_constant_alpha,
  src_alpha_saturate,
  src1_color,  ///< src1 factors refer to the second color of the fragment function (dual-source blending)
  one_minus_src1_color,
  src1_alpha,
  one_minus_src1_alpha
};
enum class BlendEquation : uint8_t { add, subtract, reverse_subtract, min, max };

/// Blending: result = src·source + dst·destination for each channel (OpenGL 4.6, section 17.3.6). Alpha has its own equation and factors.
/// The defaults are straight alpha blending with a correct alpha of the result: glBlendFuncSeparate(SRC_ALPHA, ONE_MINUS_SRC_ALPHA, ONE,
/// ONE_MINUS_SRC_ALPHA). glBlendFunc(SRC_ALPHA, ONE_MINUS_SRC_ALPHA) has source_alpha = src_alpha, and OpenGL's initial state is (one,
/// zero). Blending is linear: colors stored as sRGB are decoded first. The src1 factors require a single color attachment and a fragment
/// function that returns at least two colors.
struct BlendState {
  BlendEquation color_equation = BlendEquation::add;
  BlendFactor source_color = BlendFactor::src_alpha, destination_color = BlendFactor::one_minus_src_alpha;
  BlendEquation alpha_equation = BlendEquation::add;
  BlendFactor source_alpha = BlendFactor::one, destination_alpha = BlendFactor::one_minus_src_alpha;
  glm::vec4 constant = glm::vec4(0.0f);  ///< glBlendColor
  friend bool operator==(const BlendState&, const BlendState&) = default;
};

/// Color channels that are written (glColorMask).
struct ColorMask {
  bool r = true, g = true, b = true, a = true;
  bool all() const { return r && g && b && a; }
  bool operator[](int k) const { return k == 0 ? r : k == 1 ? g : k == 2 ? b : a; }
  friend bool operator==(const ColorMask&, const ColorMask&) = default;
};

/// Maximum number of color attachments of a pass.
inline constexpr int kMaxColorTargets = 12;
/// Number of occlusion queries and of timers of a pass, and the largest width of a line in pixels.
inline constexpr uint32_t kMaxQueries = 1 << 16;
inline constexpr float kMaxLineWidth = 4096.0f;

/// Blending and color mask of one color attachment.
struct AttachmentState {
  std::optional<BlendState> blend{};  ///< default: no blending, the color is replaced
  ColorMask mask{};
  friend bool operator==(const AttachmentState&, const AttachmentState&) = default;
};

/// Logic operations (glLogicOp), in OpenGL's order: bit 0 of the number is the result for bits 1 of the source and 1 of the destination,
/// bit 1 for 1 and 0, bit 2 for 0 and 1, and bit 3 for 0 and 0.
enum class LogicOp : uint8_t {
  clear,
  bit_and,
  and_reverse,  ///< source & ~destination
  copy,
  and_inverted,  ///< ~source & destination
  noop,
  bit_xor,
  bit_or,
  nor,
  equiv,
  invert,  ///< ~destination
  or_reverse,
  copy_inverted,
  or_inverted,
  nand,
  set
};

/// A coverage that does not depend on the fragments (glSampleCoverage): the first round(value · samples) samples are drawn or, if inverted,
/// all others.
struct SampleCoverage {
  float value = 1.0f;  ///< 0 to 1
  bool invert = false;
  friend bool operator==(const SampleCoverage&, const SampleCoverage&) = default;
};

enum class StencilOp : uint8_t { keep, zero, replace, increment_clamp, decrement_clamp, invert, increment_wrap, decrement_wrap };

/// Stencil test of one face (OpenGL 4.6, section 17.3.3). Compares (reference & read_mask) with (stored & read_mask).
struct StencilFace {
  CompareOp compare = CompareOp::always;
  StencilOp fail = StencilOp::keep;        ///< applied if the stencil test fails
  StencilOp depth_fail = StencilOp::keep;  ///< applied if the stencil test passes and the depth test fails
  StencilOp pass = StencilOp::keep;        ///< applied if both tests pass
  uint8_t reference = 0;
  uint8_t read_mask = 0xff;
  uint8_t write_mask = 0xff;
  friend bool operator==(const StencilFace&, const StencilFace&) = default;
};
/// Stencil test for front and back faces. Points and lines are front-facing.
struct StencilState {
  StencilFace front{}, back{};
  friend bool operator==(const StencilState&, const StencilState&) = default;
};

/// One of several viewports (glViewportIndexed, glScissorIndexed, glDepthRangeIndexed).
struct IndexedViewport {
  std::optional<ViewportRect> viewport{};  ///< default: the whole target
  std::optional<Rect> scissor{};           ///< default: no scissor test
  float range_near = 0.0f, range_far = 1.0f;
};
/// The viewports of a draw: 1 to kMaxViewports. Each change of the viewport from one instance to the next costs as much as a draw, and each
/// change from one primitive to the next, if the pixels that two viewports can change overlap.
using ViewportArray = std::vector<IndexedViewport>;
inline constexpr std::size_t kMaxViewports = 16;

/// Draws only if a sample has passed in the draws of this pass with DrawState::query = `query` that were added before
/// (glBeginConditionalRender with GL_QUERY_WAIT); inverted: only if none has.
struct DrawCondition {
  uint32_t query = 0;
  bool inverted = false;
  friend bool operator==(const DrawCondition&, const DrawCondition&) = default;
};

class Clusters;
class DepthPyramid;

/// Skips triangles of a draw that cannot cover a sample before their vertices are shaded (Clusters). The picture stays the same, bit for
/// bit; in PassStatistics, these triangles count as culled_cluster. Requires one instance of a triangle list without base_vertex and
/// without stages that emit primitives, and a shader whose clip-space position is clip_from_world · (world_from_object · (position, 1)) in
/// float, up to 2^-20 of the sum of the absolute values of all products. A shader with a single matrix leaves out the second one.
struct ClusterCulling {
  const Clusters* clusters = nullptr;  ///< of the index list and the positions of the draw; must stay valid until Pass::run() returns
  glm::mat4 clip_from_world{1.0f}, world_from_object{1.0f};
  /// Also skips clusters all of whose depths fail the depth test against those of this pyramid. The pass must load the depth from which the
  /// pyramid was built, which must not have changed, and no draw or clear before this draw may change a depth so that more would pass; the
  /// latter is checked. Has no effect where a hidden triangle can change something, or its depth is not that of its plane: if `compare` is
  /// none of less, less_equal, greater and greater_equal, with a polygon offset, depth clamp, smooth polygons or outlines, and if the
  /// shader computes the depth. Tiles with nothing but hidden triangles are not touched, so attachments with LoadOp::dont_care keep what
  /// they had, and flushes (PassTuning::bin_budget) can come later. Must stay valid until Pass::run() returns.
  const DepthPyramid* hidden_by = nullptr;
  friend bool operator==(const ClusterCulling&, const ClusterCulling&) = default;
};

/// Bounds of the stored depth (glDepthBoundsEXT): a fragment passes for a sample only if the depth that is stored for it at this time,
/// before the fragment, is in [low, high]. They have no effect without a depth buffer.
struct StoredDepthRange {
  float low = 0.0f, high = 1.0f;  ///< both in [0, 1], low ≤ high
  friend bool operator==(const StoredDepthRange&, const StoredDepthRange&) = default;
};

/// Complete state of a draw call, apart from the shader, vertices and indices. As in OpenGL, state for multisampling has no effect in
/// passes with one sample per pixel, the depth test always passes without a depth buffer, and the size of points, the width of lines and
/// the provoking vertex are for draws that have such. The same state can therefore be used with different passes and topologies.
struct DrawState {
  Topology topology = Topology::triangles;
  uint32_t first = 0;               ///< the first vertex of a draw without indices, or the place of the first index in the list
  std::optional<uint32_t> count{};  ///< number of vertices or indices from `first` on; default: all
  int32_t base_vertex = 0;          ///< added to every index
  uint32_t instances = 1;           ///< number of instances; see VertexId and per_instance()
  uint32_t base_instance = 0;  ///< row of the per-instance streams at which instance 0 starts; VertexId::instance starts at 0 all the same
  float point_size = 1.0f;     ///< side length of a point in pixels, at least 0; ignored if vertices are a PerVertex or a LayeredVertex
  PointOrigin point_origin = PointOrigin::upper_left;
  float line_width = 1.0f;  ///< in pixels, 0 to kMaxLineWidth; rounded to an integer if there is one sample per pixel
  PolygonMode polygon_mode = PolygonMode::fill;
  /// One sample per pixel only: lines (and outlines), or filled triangles, cover all pixels that they overlap, and the alpha of their
  /// colors is multiplied by the area of the overlap (GL_LINE_SMOOTH, GL_POLYGON_SMOOTH). Meant for blending. The area is exact; the width
  /// of a smooth line is not rounded. Varyings are evaluated at pixel centers, also where these are outside of the primitive. A triangle
  /// that is cut by a clip plane is drawn as several triangles, each of which is smooth at all its sides.
  bool line_smooth = false, polygon_smooth = false;
  std::optional<ViewportRect> viewport{};  ///< default: the whole target
  ClipOrigin clip_origin = ClipOrigin::lower_left;
  /// Viewports for shaders that return a LayeredVertex, or null. They replace `viewport`, `scissor` and the depth range. Not owned; must
  /// stay valid and unchanged until Pass::run() returns.
  const ViewportArray* viewports = nullptr;
  std::optional<Rect> scissor{};  ///< of any size, at least 0 x 0; default: no scissor test
  CullMode cull = CullMode::none;
  Winding front = Winding::counter_clockwise;
  ProvokingVertex provoking = ProvokingVertex::last;
  DepthState depth{};
  DepthOffset offset{};
  std::optional<StoredDepthRange> depth_bounds{};  ///< default: no test
  std::optional<StencilState> stencil{};           ///< default: no stencil test; without a stencil buffer, the test always passes
  bool sample_shading = false;  ///< multisampling only: run the fragment function once per sample, at the sample position
  /// With sample_shading: the fraction of the samples that need values of their own, 0 to 1 (glMinSampleShading). All samples are shaded
  /// unless one value per pixel is enough.
  float min_sample_shading = 1.0f;
  /// Multisampling only: the alpha of the first color determines how many samples are drawn. Has no effect if the first color attachment
  /// contains integers.
  bool alpha_to_coverage = false;
  bool alpha_to_one = false;           ///< multisampling only: colors get the alpha 1 after alpha_to_coverage; not for integers
  uint32_t sample_mask = 0xffffffffu;  ///< multisampling only: bit s enables sample s
  std::optional<SampleCoverage> sample_coverage{};  ///< multisampling only; combined with sample_mask
  /// Blends fragments in depth order, regardless of the order in which they are submitted. Fragments of these draws are kept until the next
  /// draw that writes color in another way, or the end of the pass, and then blended from the farthest to the nearest. The result is exact
  /// for up to 8 layers per sample; further layers are merged into the farthest. Opaque draws must come first. Colors have straight alpha.
  /// Requires one color attachment without integers, no `blend`, no color mask, and a depth state that does not write and whose `compare`
  /// (less, less_equal, greater or greater_equal) tells which fragments are nearer. If a pass is flushed (PassTuning::bin_budget,
  /// DrawState::condition), fragments are sorted within each flush only. The shader must not have early_fragment_tests.
  bool order_independent = false;
  std::optional<BlendState> blend{};  ///< default: no blending, the color is replaced
  ColorMask color_mask{};
  /// Entry i replaces both blend and color_mask for attachment i, which the pass must have.
  std::array<std::optional<AttachmentState>, kMaxColorTargets> attachments{};
  /// Combines the codes of unsigned normalized and integer formats bit by bit (OpenGL 4.6, section 17.3.9). Requires that all attachments
  /// have such formats, except sRGB, and no blending.
  std::optional<LogicOp> logic_op{};
  std::optional<uint32_t> query{};  ///< occlusion query: passing samples are added to PassStatistics::queries[query]; below kMaxQueries
  /// Default: the draw is always drawn. If draws with this query have been added since the last draw that waited for a query, the pass is
  /// flushed (PassStatistics::flushes) to know the result. A draw that is not drawn is in no counter, except those of vertex, control,
  /// evaluation and geometry functions if it has one of the last three or chooses layers: these run in any case. Requires a pass with one
  /// layer, and another query than that of the draw itself.
  std::optional<DrawCondition> condition{};
  std::optional<ClusterCulling> clusters{};  ///< default: all vertices are shaded
  std::optional<uint32_t> timer{};           ///< the time that the draw takes is added to PassStatistics::times[timer]; below kMaxQueries
  friend bool operator==(const DrawState&, const DrawState&) = default;
};

/// One of several draws with the same shader, vertices and indices. The layout in memory is that of OpenGL's DrawElementsIndirectCommand.
struct DrawRecord {
  uint32_t count = 0;
  uint32_t instances = 1;
  uint32_t first = 0;
  int32_t base_vertex = 0;
  uint32_t base_instance = 0;
};
/// Returns the state of the draw of a record.
inline DrawState with_record(DrawState s, const DrawRecord& r) {
  s.count = r.count;
  s.instances = r.instances;
  s.first = r.first;
  s.base_vertex = r.base_vertex;
  s.base_instance = r.base_instance;
  return s;
}

/// Common blend states, for DrawState::blend.
inline constexpr BlendState kAlphaBlend{};  ///< straight alpha, drawn back to front: src·a + dst·(1 − a)
inline constexpr BlendState kAdditiveBlend{
    .source_color = BlendFactor::src_alpha, .destination_color = BlendFactor::one, .destination_alpha = BlendFactor::one};

/// Depth state for reversed Z: the projection maps the near plane to depth 1 and the far plane to 0 (perspective_reversed in
/// geometry/camera.h). Depth must be cleared to 0.
inline constexpr DepthState kReversedZ{.compare = CompareOp::greater, .clip = ClipDepth::zero_to_one};

/// Common draw states. To change one, make a copy: DrawState state = kOpaqueState; state.cull = CullMode::back.
inline constexpr DrawState kOpaqueState{};                                                      ///< replaces the color; depth test less
inline constexpr DrawState kAlphaBlendState{.depth = {.write = false}, .blend = kAlphaBlend};   ///< tests depth but does not write it
inline constexpr DrawState kAdditiveState{.depth = {.write = false}, .blend = kAdditiveBlend};  ///< tests depth but does not write it
inline constexpr DrawState kDepthOnlyState{.color_mask = {false, false, false, false}};         ///< writes no color
inline constexpr DrawState kReversedZState{.depth = kReversedZ};
inline constexpr DrawState kWireframeState{.polygon_mode = PolygonMode::line};  ///< triangle outlines

/// Returns the blend state of color attachment i.
constexpr const std::optional<BlendState>& blend_of(const DrawState& s, std::size_t i) {
  return s.attachments[i] ? s.attachments[i]->blend : s.blend;
}
/// Returns the color mask of color attachment i.
constexpr const ColorMask& color_mask_of(const DrawState& s, std::size_t i) {
  return s.attachments[i] ? s.attachments[i]->mask : s.color_mask;
}

/// Returns true if triangles of a draw with this winding in the window are front-facing.
constexpr bool is_front(const DrawState& s, bool counter_clockwise) {
  return counter_clockwise == ((s.front == Winding::counter_clockwise) == (s.clip_origin == ClipOrigin::lower_left));
}

/// Returns true if primitives of the draw are smooth in a pass with one sample per pixel.
constexpr bool is_smooth(const DrawState& s) {
  if (is_lines(s.topology)) return s.line_smooth;
  if (!is_triangles(s.topology)) return false;
  return s.polygon_mode == PolygonMode::line ? s.line_smooth : s.polygon_mode == PolygonMode::fill && s.polygon_smooth;
}

/// Returns true if the draw produces points.
constexpr bool draws_points(const DrawState& s) {
  return s.topology == Topology::points || (!is_lines(s.topology) && s.polygon_mode == PolygonMode::point);
}

}  // namespace halfspace::HS_LANES
