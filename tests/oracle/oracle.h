// SPDX-License-Identifier: Apache-2.0
//
// The oracle is an independent implementation of the whole pipeline with the simplest possible loops. Tests compare it with the tile path
// byte for byte. It supports the full draw state. It shares only type definitions with src/raster (draw_state.h, target.h), and the shader
// interface with src/shading. It processes one pixel, one triangle and one fragment at a time, in order, without lanes, tiles, bins,
// incremental evaluation, deferred shading or depth bounds.
//
// If a result depends on the order of float operations, the oracle follows the specifications in shading/pixel.h (weights and components),
// raster/visibility/visibility.h and raster/pipeline/pipeline_data.h (depth) and raster/primitives/clip.h (clipping).
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <span>
#include <vector>

#include "halfspace/raster/draw_state.h"
#include "halfspace/raster/target.h"
#include "halfspace/shading/contract.h"

namespace halfspace::oracle {

/// Statistics. Contains the fields of PassStatistics that do not depend on how a pass organizes its work.
struct Counts {
  uint64_t vertices_shaded = 0;
  uint64_t primitives_in = 0;
  uint64_t culled_non_finite = 0;
  uint64_t culled_outside = 0;
  uint64_t culled_face = 0;
  uint64_t culled_degenerate = 0;
  uint64_t culled_no_sample = 0;
  uint64_t clipped = 0;
  uint64_t triangles = 0;  ///< triangles that may cover a sample
  uint64_t samples_passed = 0;
  bool has_lines = false;  ///< if set, the oracle counts primitives without samples differently from a pass
  std::map<uint32_t, uint64_t> queries;
};

/// A sample of a pixel.
struct Sample {
  int x = 0, y = 0;  ///< window coordinates of the pixel
  int number = 0;
};

/// Color and depth images in the formats and layout of the targets (top row first), accessed by window coordinates. With several samples,
/// there is one image per sample, stored one after the other.
class Framebuffer {
 public:
  Framebuffer(int width, int height, std::vector<ColorFormat> colors, DepthFormat depth, int samples = 1);

  int width() const { return width_; }
  int height() const { return height_; }
  int samples() const { return samples_; }
  const std::vector<ColorFormat>& color_formats() const { return color_formats_; }
  DepthFormat depth_format() const { return depth_format_; }

  void clear_color(std::size_t attachment, glm::vec4 value);
  void clear_depth(float value, uint8_t stencil);

  /// Returns the decoded color of a sample.
  glm::vec4 color(std::size_t attachment, const Sample& s) const;
  void set_color(std::size_t attachment, const Sample& s, glm::vec4 value);
  /// Returns the depth of a sample as stored in the format: an integer (UNORM), or the depth itself for float formats.
  double depth(const Sample& s) const;
  void set_depth(const Sample& s, double value);
  uint8_t stencil(const Sample& s) const;
  void set_stencil(const Sample& s, uint8_t value);
  /// Returns the stored value for a window depth in [0, 1].
  double depth_value(float z) const;
  /// Returns a framebuffer with one sample per pixel: the mean of the colors, and the depth and stencil of the first sample.
  Framebuffer resolved() const;

  std::vector<std::vector<std::byte>> color_bytes;
  std::vector<std::byte> depth_bytes;

 private:
  std::size_t pixel(const Sample& s) const;

  int width_, height_, samples_;
  std::vector<ColorFormat> color_formats_;
  DepthFormat depth_format_;
};

/// A point in the window, in 1/256 px.
struct Point {
  int64_t x = 0, y = 0;
};
Point center_of(int x, int y);
/// Returns the position of a sample, from the standard positions for the given sample count.
Point position_of(const Sample& s, int samples);

/// The output of the vertex function.
struct ShadedVertex {
  glm::vec4 pos_clip{};
  float point_size = 1.0f;
  std::vector<float> clip_distances;
  bool has_bounds = false;  ///< if set, low and high (NDC) are used instead of the size
  glm::vec2 low{}, high{};
  std::vector<float> varyings;
};

/// A vertex of a triangle in the window.
struct Corner {
  int64_t x = 0, y = 0;  ///< 1/256 px
  float z = 0.0f;        ///< window depth before offset and clamping
  float inv_w = 0.0f;
  std::vector<float> varyings;
};

/// A triangle in the window. Corners are in counter-clockwise order (y up) and begin with the one of smallest depth.
struct WindowTriangle {
  std::array<Corner, 3> corner;
  std::vector<float> flat;  ///< varyings of the provoking vertex
  bool front = false;
  int64_t area = 0;                ///< twice the area, in (1/256 px)²
  float z0 = 0, z_max = 0;         ///< smallest and largest depth, including the offset
  float z_step1 = 0, z_step2 = 0;  ///< depth per unit of E1 and E2

  bool is_line = false;  ///< a line of `width` pixels from `from` to `to`; vertex 2 is next to vertex 0
  Point from, to;
  int width = 1;
  bool is_point = false;  ///< a point or sprite at vertex 0 that covers the rectangle from low to high (exclusive)
  Point low, high;
  PointOrigin origin = PointOrigin::upper_left;
};

/// The output of the fragment function.
struct FragmentResult {
  std::vector<glm::vec4> colors;
  bool keep = true;
  float depth = 0.0f;
};

/// Properties of a shader, for the parts of the oracle that do not depend on its type.
struct ShaderFacts {
  bool has_fragment = true;
  bool writes_depth = false;
  std::span<const Interpolation> interpolations;
};

/// Input of interpolation for one triangle. Vertex 0 is the one with the smallest 1/w. If the lanes are planar, the values are planes.
struct Surface {
  TriangleLanes<float> lanes;
  std::vector<float> value0, delta1, delta2;
};

/// A point on the surface of a triangle and its interpolation weights.
struct SurfacePoint {
  Weights<float> weights;
  float dx, dy;  ///< from vertex 0 or the center of the planes, in 1/256 px
  float z;       ///< window depth as passed to shaders
};

Surface make_surface(const WindowTriangle& t, std::span<const Interpolation> interpolations);
/// Returns the input of interpolation for the pixels of a cell of 64 x 64 pixels. whole: the result of make_surface().
Surface surface_in_cell(const WindowTriangle& t, const Surface& whole, std::span<const Interpolation> interpolations, int64_t cell_x,
                        int64_t cell_y);
SurfacePoint surface_point(const Surface& s, const WindowTriangle& t, const DepthState& state, const Point& at);
float component_at(const Surface& s, const SurfacePoint& p, Interpolation mode, std::size_t component);

/// Input of a draw. Attributes come from the row of the vertex, except for the last instance_components, which come from the row of the
/// instance.
template <class S>
struct Input {
  using Row = typename S::template Attributes<float>;
  std::vector<Row> vertices;
  std::vector<uint32_t> indices;
  bool restart = false;  ///< the index kRestart ends a primitive
  std::size_t instance_components = 0;
  std::vector<Row> instances;
  uint32_t divisor = 1;
};
inline constexpr uint32_t kRestart = 0xffffffffu;

/// Returns the triangles that the indices form. The provoking vertex is first or last, as the state requires.
std::vector<std::array<uint32_t, 3>> assemble(const std::vector<uint32_t>& indices, bool restart, const DrawState& state);

class Renderer {
 public:
  /// Draws into the framebuffer, which must outlive the renderer.
  explicit Renderer(Framebuffer& target, bool supersample = false) : target_(target), supersample_(supersample) {}

  template <class S>
  void draw(const S& shader, const Input<S>& input, const DrawState& state);

  const Counts& counts() const { return counts_; }

 private:
  template <class S>
  void draw_instance(const S& shader, const Input<S>& input, const DrawState& state, uint32_t instance);

  // at: where the pixel is evaluated; centroid: where its centroid varyings are evaluated
  using FragmentFunction = std::function<FragmentResult(const WindowTriangle&, const Surface&, const Point& at, const Point& centroid)>;

  // Returns a submitted point in the window; empty if it is culled.
  std::vector<WindowTriangle> window_points(const DrawState& state, const ShadedVertex& v);
  // Returns the pieces of a submitted triangle in the window: none if it is culled, several if it is clipped. For a line, the third vertex
  // equals the second.
  std::vector<WindowTriangle> window_triangles(const DrawState& state, const ShaderFacts& facts,
                                               const std::array<const ShadedVertex*, 3>& v);
  std::vector<WindowTriangle> window_line(const DrawState& state, const Corner& a, const Corner& b, const std::vector<float>& flat,
                                          bool front);
  std::vector<WindowTriangle> window_outline(const DrawState& state, const std::vector<Corner>& corners, const std::vector<int>& vertex,
                                             const std::array<const ShadedVertex*, 3>& v, const std::vector<float>& flat);
  void rasterize(const DrawState& state, const ShaderFacts& facts, const WindowTriangle& t, const FragmentFunction& shade);
  void draw_pixel(const DrawState& state, const ShaderFacts& facts, const WindowTriangle& t, const Surface& surface, int x, int y,
                  const FragmentFunction& shade);
  void draw_sample(const DrawState& state, const ShaderFacts& facts, const WindowTriangle& t, const Sample& s,
                   const FragmentResult& result);
  bool depth_passes(const DrawState& state, const Sample& s, double z) const;
  bool tests_pass(const DrawState& state, bool front, const Sample& s, double z);
  void write_colors(const DrawState& state, const Sample& s, const std::vector<glm::vec4>& colors);

  Framebuffer& target_;
  bool supersample_;
  Counts counts_;
};

/// Applies the function to every pixel of `from`, like Pass::post, and writes the results to a new framebuffer without depth.
template <class F>
Framebuffer post(const Framebuffer& from, const F& function, ColorFormat format) {
  Framebuffer to(from.width(), from.height(), {format}, DepthFormat::none);
  for (int y = 0; y < from.height(); ++y) {
    for (int x = 0; x < from.width(); ++x) to.set_color(0, {x, y, 0}, glm::vec4(function(vec4<float>(from.color(0, {x, y, 0})))));
  }
  return to;
}

// ---- code that depends on the shader type ----------------------------------------------------------------------

namespace detail {

inline void take_vertex(const glm::vec4& v, ShadedVertex& out) { out.pos_clip = v; }
template <std::size_t N>
void take_vertex(const PerVertex<float, N>& v, ShadedVertex& out) {
  out.pos_clip = v.position;
  out.point_size = v.point_size;
  out.clip_distances.assign(v.clip_distance.begin(), v.clip_distance.end());
}
inline void take_vertex(const PointSpriteVertex<float>& v, ShadedVertex& out) {
  out.pos_clip = {0.0f, 0.0f, v.depth, v.drawn ? 1.0f : -1.0f};
  out.has_bounds = true;
  out.low = v.low;
  out.high = v.high;
}

template <class T>
std::vector<float> components_of(const T& t) {
  const auto a = to_components<float>(t);
  return {a.begin(), a.end()};
}

template <class T>
T struct_of(const std::vector<float>& components) {
  std::array<float, kComponents<T>> a{};
  for (std::size_t i = 0; i < a.size(); ++i) a[i] = components[i];
  return from_components<T, float>(a);
}

template <class S>
FragmentResult call_shader(const S& shader, const PrimitiveOf<S, float>& face, const WindowTriangle& t, const Surface& s,
                           const DepthState& state, const Point& at, const Point& centroid) {
  using V = typename S::template Varyings<float>;
  constexpr std::size_t n = kComponents<V>;
  const SurfacePoint p = surface_point(s, t, state, at), inside = surface_point(s, t, state, centroid);
  ComponentLanes<float, n> components{};
  std::array<float, n> values{};
  for (std::size_t i = 0; i < n; ++i) {
    components.value0[i] = s.value0[i];
    components.delta1[i] = s.delta1[i];
    components.delta2[i] = s.delta2[i];
    const Interpolation mode = kInterpolations<V>[i];
    values[i] = component_at(s, mode == Interpolation::centroid ? inside : p, mode, i);
  }
  Pixel<float> px;
  px.x = static_cast<float>(at.x) / 256.0f;
  px.y = static_cast<float>(at.y) / 256.0f;
  px.find_z = [](const Pixel<float>& pixel) { return *static_cast<const float*>(pixel.z_source); };
  px.z_source = &p.z;
  px.front_facing = t.front;
  px.triangle = &s.lanes;
  px.component_lanes = &components;
  px.weights = p.weights;
  px.dx = p.dx;
  px.dy = p.dy;
  px.quad_x = static_cast<float>(at.x / 256 % 2);
  px.quad_y = static_cast<float>(at.y / 256 % 2);
  FragmentResult result;
  if constexpr (HasFragmentFunction<S>) {
    const auto fragment = call_fragment<S, float>(shader, from_components<V, float>(values), face, px);
    for (std::size_t i = 0; i < kColors<S>; ++i) result.colors.push_back(halfspace::detail::nth_color(fragment.color, i));
    if constexpr (kDiscards<S>) result.keep = fragment.keep;
    if constexpr (kWritesDepth<S>) result.depth = fragment.depth;
  }
  return result;
}

template <class S>
ShaderFacts facts_of() {
  ShaderFacts facts;
  facts.interpolations = kInterpolations<typename S::template Varyings<float>>;
  facts.has_fragment = HasFragmentFunction<S>;
  if constexpr (HasFragmentFunction<S>) facts.writes_depth = kWritesDepth<S>;
  return facts;
}

}  // namespace detail

template <class S>
void Renderer::draw(const S& shader, const Input<S>& input, const DrawState& state) {
  for (uint32_t instance = 0; instance < state.instances; ++instance) draw_instance(shader, input, state, instance);
}

template <class S>
void Renderer::draw_instance(const S& shader, const Input<S>& input, const DrawState& state, uint32_t instance) {
  using V = typename S::template Varyings<float>;
  using P = PrimitiveOf<S, float>;
  const ShaderFacts facts = detail::facts_of<S>();
  std::map<uint32_t, ShadedVertex> shaded;
  for (const uint32_t i : input.indices) {
    if ((input.restart && i == kRestart) || shaded.contains(i)) continue;
    ++counts_.vertices_shaded;
    const auto row = static_cast<uint32_t>(static_cast<int64_t>(i) + state.base_vertex);
    auto attributes = detail::components_of(input.vertices[row]);
    for (std::size_t k = attributes.size() - input.instance_components; k < attributes.size(); ++k) {
      attributes[k] = detail::components_of(input.instances[instance / input.divisor])[k];
    }
    V out{};
    const VertexId<float> id{static_cast<int32_t>(row), static_cast<int32_t>(instance)};
    const auto vertex = call_vertex<S, float>(shader, detail::struct_of<typename Input<S>::Row>(attributes), id, out);
    shaded[i].point_size = state.point_size;
    detail::take_vertex(vertex, shaded[i]);
    shaded[i].varyings = detail::components_of(out);
  }
  for (const auto& [a, b, c] : assemble(input.indices, input.restart, state)) {
    const std::array<const ShadedVertex*, 3> v{&shaded[a], &shaded[b], &shaded[c]};
    P face{};
    if constexpr (HasPrimitive<S>) {
      face = shader.primitive(detail::struct_of<V>(v[0]->varyings), detail::struct_of<V>(v[1]->varyings),
                              detail::struct_of<V>(v[2]->varyings));
    }
    const bool points = state.topology == Topology::points;
    for (const WindowTriangle& t : points ? window_points(state, *v[0]) : window_triangles(state, facts, v)) {
      rasterize(state, facts, t, [&](const WindowTriangle& triangle, const Surface& surface, const Point& at, const Point& centroid) {
        return detail::call_shader(shader, face, triangle, surface, state.depth, at, centroid);
      });
    }
  }
}

}  // namespace halfspace::oracle
