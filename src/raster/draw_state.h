// SPDX-License-Identifier: Apache-2.0
//
// The state of a draw: plain values with OpenGL's names and, as defaults, OpenGL's initial values (but for the depth
// test, which is on). Nothing here is global; every draw carries its own.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include <glm/glm.hpp>

namespace halfspace {

/// A rectangle of pixels in window coordinates (origin lower left): [x, x + width) × [y, y + height).
struct Rect {
  int x = 0, y = 0, width = 0, height = 0;
  friend bool operator==(const Rect&, const Rect&) = default;
};

/// The pixels in both; width or height <= 0 where there are none.
constexpr Rect intersect(const Rect& a, const Rect& b) {
  const int x0 = a.x > b.x ? a.x : b.x, y0 = a.y > b.y ? a.y : b.y;
  const int x1 = a.x + a.width < b.x + b.width ? a.x + a.width : b.x + b.width;
  const int y1 = a.y + a.height < b.y + b.height ? a.y + a.height : b.y + b.height;
  return {x0, y0, x1 - x0, y1 - y0};
}

/// How indices make primitives (OpenGL 4.6, section 10.1). Of a strip every other triangle has its first two vertices swapped,
/// so that all face one way.
enum class Topology : uint8_t { triangles, triangle_strip, triangle_fan, points, lines, line_strip, line_loop };
constexpr bool is_lines(Topology t) { return t == Topology::lines || t == Topology::line_strip || t == Topology::line_loop; }

/// What is drawn of a triangle: its inside, its outline or its vertices (glPolygonMode). The outline of a triangle that is clipped is
/// that of what is left of it.
enum class PolygonMode : uint8_t { fill, line, point };

/// Where a point's coordinate (0, 0) lies (GL_POINT_SPRITE_COORD_ORIGIN).
enum class PointOrigin : uint8_t { upper_left, lower_left };

enum class CompareOp : uint8_t { never, less, equal, less_equal, greater, not_equal, greater_equal, always };
enum class CullMode : uint8_t { none, front, back, front_and_back };
constexpr bool is_culled(CullMode mode, bool front_facing) {
  return mode == CullMode::front_and_back || mode == (front_facing ? CullMode::front : CullMode::back);
}
enum class Winding : uint8_t { counter_clockwise, clockwise };
enum class ProvokingVertex : uint8_t { last, first };

/// Where clip-space z lies before the divide.
enum class ClipDepth : uint8_t {
  negative_one_to_one,  ///< OpenGL: −w ≤ z ≤ w, window depth 0.5·z/w + 0.5
  zero_to_one           ///< D3D, Vulkan, reversed Z: 0 ≤ z ≤ w, window depth z/w
};

/// Depth test and write. Reversed Z is ClipDepth::zero_to_one, a projection that maps near to 1, and greater.
struct DepthState {
  bool test = true;
  bool write = true;
  CompareOp compare = CompareOp::less;
  ClipDepth clip = ClipDepth::negative_one_to_one;
  bool clamp = false;       ///< GL_DEPTH_CLAMP: no clipping at near and far, depth held to the range instead
  float range_near = 0.0f;  ///< glDepthRange, both in [0, 1]
  float range_far = 1.0f;
};

/// Polygon offset, added to a filled triangle's window depth: o = slope·m + constant·r, then clamped (OpenGL 4.6, section
/// 14.6.5), with m = max(|dz/dx|, |dz/dy|) and r the smallest step of the depth format (for D32F 2^(e−23), e the
/// exponent of the largest |z| of the triangle). Positive moves away from the eye under the OpenGL convention and
/// towards it under reversed Z.
struct DepthOffset {
  float slope = 0.0f;
  float constant = 0.0f;
  float clamp = 0.0f;  ///< > 0: at most this; < 0: at least this; 0: no clamp
};

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
  src1_color,  ///< this and the next three: of the fragment function's second colour (dual source blending)
  one_minus_src1_color,
  src1_alpha,
  one_minus_src1_alpha
};
enum class BlendEquation : uint8_t { add, subtract, reverse_subtract, min, max };

/// result = src·source + dst·destination, channel by channel (OpenGL 4.6, section 17.3.6). Alpha has its own factors. Colours
/// are linear: what is stored as sRGB is decoded first.
struct BlendState {
  BlendEquation color_equation = BlendEquation::add;
  BlendFactor source_color = BlendFactor::src_alpha, destination_color = BlendFactor::one_minus_src_alpha;
  BlendEquation alpha_equation = BlendEquation::add;
  BlendFactor source_alpha = BlendFactor::one, destination_alpha = BlendFactor::one_minus_src_alpha;
  glm::vec4 constant = glm::vec4(0.0f);  ///< glBlendColor
};

/// Which channels are written.
struct ColorMask {
  bool r = true, g = true, b = true, a = true;
  bool all() const { return r && g && b && a; }
  bool operator[](int k) const { return k == 0 ? r : k == 1 ? g : k == 2 ? b : a; }
};

/// Colour attachments of a pass, at the most.
inline constexpr int kMaxColorTargets = 4;

/// How one colour attachment takes a fragment's colour.
struct AttachmentState {
  std::optional<BlendState> blend{};  ///< default: replace
  ColorMask mask{};
};

enum class StencilOp : uint8_t { keep, zero, replace, increment_clamp, decrement_clamp, invert, increment_wrap, decrement_wrap };

/// The stencil test of one face (OpenGL 4.6, section 17.3.3): passes where (reference & read_mask) compares as asked with
/// (stored & read_mask).
struct StencilFace {
  CompareOp compare = CompareOp::always;
  StencilOp fail = StencilOp::keep;        ///< done where the stencil test fails
  StencilOp depth_fail = StencilOp::keep;  ///< where it passes and the depth test fails
  StencilOp pass = StencilOp::keep;        ///< where both pass
  uint8_t reference = 0;
  uint8_t read_mask = 0xff;
  uint8_t write_mask = 0xff;
};
/// Points and lines are front faces.
struct StencilState {
  StencilFace front{}, back{};
};

/// Everything that a draw sets besides its shader and vertices.
struct DrawState {
  Topology topology = Topology::triangles;
  int32_t base_vertex = 0;  ///< added to every index
  uint32_t instances = 1;   ///< the draw is repeated this many times; see VertexId and per_instance()
  float point_size = 1.0f;  ///< px, where the vertex function gives none: the side of the square that a point covers
  PointOrigin point_origin = PointOrigin::upper_left;
  float line_width = 1.0f;  ///< px, at most 4096; with one sample a pixel the nearest whole number, with several a rectangle
  PolygonMode polygon_mode = PolygonMode::fill;
  std::optional<Rect> viewport{};  ///< default: the whole target
  std::optional<Rect> scissor{};   ///< default: no scissor test
  CullMode cull = CullMode::none;
  Winding front = Winding::counter_clockwise;
  ProvokingVertex provoking = ProvokingVertex::last;
  DepthState depth{};
  DepthOffset offset{};
  std::optional<StencilState> stencil{};  ///< default: no stencil test
  bool sample_shading = false;            ///< the fragment function runs for every sample, at its place, not for every pixel
  bool alpha_to_coverage = false;         ///< with several samples: the first colour's alpha says how many of them are drawn
  uint32_t sample_mask = 0xffffffffu;     ///< with several samples: those that may be drawn, as bits
  std::optional<BlendState> blend{};      ///< default: replace
  ColorMask color_mask{};
  std::array<std::optional<AttachmentState>, kMaxColorTargets> attachments{};  ///< where given, instead of blend and color_mask
  std::optional<uint32_t> query{};  ///< an occlusion query: samples that pass are counted in PassStatistics::queries[query]
};

/// Blend equations in common use, for DrawState::blend.
inline constexpr BlendState kAlphaBlend{};  ///< straight alpha, back to front: src·a + dst·(1 − a)
inline constexpr BlendState kAdditiveBlend{
    .source_color = BlendFactor::src_alpha, .destination_color = BlendFactor::one, .destination_alpha = BlendFactor::one};

/// Reversed Z: for projections that map the near plane to depth 1 and the far plane to 0 (perspective_reversed in geometry/camera.h), with
/// depth cleared to 0.
inline constexpr DepthState kReversedZ{.compare = CompareOp::greater, .clip = ClipDepth::zero_to_one};

/// Draw states in common use. A draw that needs more starts from one of them: DrawState state = kOpaqueState; state.cull = CullMode::back.
inline constexpr DrawState kOpaqueState{};                                                      ///< replaces colour; depth test less
inline constexpr DrawState kAlphaBlendState{.depth = {.write = false}, .blend = kAlphaBlend};   ///< tests depth, does not write it
inline constexpr DrawState kAdditiveState{.depth = {.write = false}, .blend = kAdditiveBlend};  ///< tests depth, does not write it
inline constexpr DrawState kDepthOnlyState{.color_mask = {false, false, false, false}};         ///< writes no colour
inline constexpr DrawState kReversedZState{.depth = kReversedZ};
inline constexpr DrawState kWireframeState{.polygon_mode = PolygonMode::line};  ///< the outlines of triangles

/// How colour attachment i takes what is drawn.
constexpr const std::optional<BlendState>& blend_of(const DrawState& s, std::size_t i) {
  return s.attachments[i] ? s.attachments[i]->blend : s.blend;
}
constexpr const ColorMask& color_mask_of(const DrawState& s, std::size_t i) {
  return s.attachments[i] ? s.attachments[i]->mask : s.color_mask;
}

/// Are there points among what is drawn?
constexpr bool draws_points(const DrawState& s) {
  return s.topology == Topology::points || (!is_lines(s.topology) && s.polygon_mode == PolygonMode::point);
}

}  // namespace halfspace
