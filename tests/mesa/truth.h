// SPDX-License-Identifier: Apache-2.0
//
// Computes a pixel in double precision, following the OpenGL specification as directly as possible: all triangles in order, no clipping
// (coverage follows from the signs of clip-space weights), and the shader evaluated with R = double. If two renderers differ, this
// determines which one is at fault. Vertex functions are evaluated in float, as in both renderers. The target stores 8-bit values: the
// result of every fragment is rounded to 8 bits, and the next blend reads the rounded value.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "halfspace/shading/shader_traits.h"
#include "mesa/mesa_draw.h"

namespace halfspace::test {

/// Vertex positions: as computed, or rounded to the 1/256 px grid. Triangles that reach w ≤ 0 are never rounded.
enum class Positions { exact, snapped };

/// Current contents of a pixel.
struct TruthPixel {
  glm::u8vec4 codes{0};
  double depth = 1.0;
};

bool passes(CompareOp op, double value, double stored);
/// Returns the stored 8-bit values of a linear color.
glm::u8vec4 truth_codes(const glm::dvec4& color, ColorFormat format);
/// Blends the color of a fragment with the stored 8-bit values of a pixel.
glm::u8vec4 truth_blend(const glm::dvec4& source, const glm::u8vec4& stored, const BlendState& blend, ColorFormat format);

/// A triangle in window coordinates, in 1/256 px. Weights and w can be negative, because the formulas are projective.
struct TruthTriangle {
  std::array<double, 3> x, y, z, q;  ///< q = 1/w
  double area;

  /// Returns the window-space (linear) weights at a point, in 1/256 px.
  std::array<double, 3> weights(double px, double py) const;
  /// Returns whether the point with these weights belongs to the triangle. With fill_rule, points exactly on an edge follow the fill rule;
  /// otherwise they all belong to it.
  bool covers(const std::array<double, 3>& b, bool fill_rule) const;
};
TruthTriangle truth_triangle(const std::array<glm::vec4, 3>& pos_clip, const ViewportRect& viewport, const DrawState& state,
                             Positions positions);
bool truth_culled(const TruthTriangle& t, const DrawState& state);

/// A draw call that can be evaluated at a single pixel.
class TruthDraw {
 public:
  virtual ~TruthDraw() = default;
  /// Draws to one pixel. `center` is its center in window coordinates (y up).
  virtual void draw(const glm::dvec2& center, Positions positions, TruthPixel& pixel) const = 0;
};

template <Shader S>
class TruthDrawOf final : public TruthDraw {
  using V = typename S::template Varyings<float>;
  using VD = typename S::template Varyings<double>;
  static constexpr std::size_t kN = kComponents<V>;

 public:
  TruthDrawOf(const S& shader, const VertexView& view, std::vector<uint32_t> indices, const DrawState& state, const TargetSpec& target)
      : shader_(shader),
        indices_(std::move(indices)),
        state_(state),
        format_(target.format),
        viewport_(state.viewport ? *state.viewport : Rect{0, 0, target.width, target.height}) {
    for (std::size_t i = 0; i < view.vertex_count; ++i) shade_vertex(view, i);
    for (std::size_t i = 0; i + 2 < indices_.size(); i += 3) {
      const std::array<glm::vec4, 3> p{pos_clip_[indices_[i]], pos_clip_[indices_[i + 1]], pos_clip_[indices_[i + 2]]};
      exact_.push_back(truth_triangle(p, viewport_, state, Positions::exact));
      snapped_.push_back(truth_triangle(p, viewport_, state, Positions::snapped));
    }
  }

  void draw(const glm::dvec2& center, Positions positions, TruthPixel& pixel) const override {
    const auto inside = [&center](const ViewportRect& v) {
      const glm::dvec2 a(v.x, v.y), size(v.width, v.height), low = min(a, a + size), high = max(a, a + size);
      return center.x >= low.x && center.x < high.x && center.y >= low.y && center.y < high.y;
    };
    if (!inside(viewport_) || (state_.scissor && !inside(*state_.scissor))) return;
    for (std::size_t i = 0; i < exact_.size(); ++i) draw_triangle(i, center, positions, pixel);
  }

 private:
  void shade_vertex(const VertexView& view, std::size_t i) {
    using A = typename S::template Attributes<float>;
    std::array<float, kComponents<A>> row;
    read_vertex(view.used_streams(), i, row);
    V out{};
    pos_clip_.push_back(call_vertex<S, float>(shader_, from_components<A, float>(row), {}, out));
    varyings_.push_back(to_components<float>(out));
  }

  void draw_triangle(std::size_t triangle, const glm::dvec2& center, Positions positions, TruthPixel& pixel) const {
    const TruthTriangle& t = positions == Positions::snapped ? snapped_[triangle] : exact_[triangle];
    if (t.area == 0.0 || truth_culled(t, state_)) return;
    const std::array<double, 3> b = t.weights(center.x * 256.0, center.y * 256.0);
    if (!t.covers(b, positions == Positions::snapped)) return;
    const DepthState& depth = state_.depth;
    double z = b[0] * t.z[0] + b[1] * t.z[1] + b[2] * t.z[2];
    const double low = static_cast<double>(std::min(depth.range_near, depth.range_far));
    const double high = static_cast<double>(std::max(depth.range_near, depth.range_far));
    if (!depth.clamp && (z < low || z > high)) return;
    z = std::clamp(z, low, high);
    if (depth.test && !passes(depth.compare, z, pixel.depth)) return;
    if (depth.test && depth.write) pixel.depth = z;
    const glm::dvec4 color = shade(t, b, {indices_[3 * triangle], indices_[3 * triangle + 1], indices_[3 * triangle + 2]}, center, z);
    pixel.codes = state_.blend ? truth_blend(color, pixel.codes, *state_.blend, format_) : truth_codes(color, format_);
  }

  glm::dvec4 shade(const TruthTriangle& t, const std::array<double, 3>& b, const std::array<uint32_t, 3>& id, const glm::dvec2& center,
                   double z) const {
    const double q = b[0] * t.q[0] + b[1] * t.q[1] + b[2] * t.q[2];
    const std::size_t provoking = id[state_.provoking == ProvokingVertex::last ? 2 : 0];
    std::array<double, kN> varyings;
    ComponentLanes<double, kN> lanes;
    for (std::size_t c = 0; c < kN; ++c) {
      const std::array<double, 3> v{static_cast<double>(varyings_[id[0]][c]), static_cast<double>(varyings_[id[1]][c]),
                                    static_cast<double>(varyings_[id[2]][c])};
      const double linear = b[0] * v[0] + b[1] * v[1] + b[2] * v[2];
      const double smooth = (b[0] * t.q[0] * v[0] + b[1] * t.q[1] * v[1] + b[2] * t.q[2] * v[2]) / q;
      const Interpolation mode = kInterpolations<V>[c];
      varyings[c] = mode == Interpolation::flat     ? static_cast<double>(varyings_[provoking][c])
                    : mode == Interpolation::linear ? linear
                                                    : smooth;
      lanes.value0[c] = v[0];
      lanes.delta1[c] = v[1] - v[0];
      lanes.delta2[c] = v[2] - v[0];
    }
    TriangleLanes<double> triangle{
        t.x[0], t.y[0], t.x[1] - t.x[0], t.y[1] - t.y[0], t.x[2] - t.x[0], t.y[2] - t.y[0], t.area, t.q[0], t.q[1], t.q[2], 1.0};
    Pixel<double> px{};
    px.x = center.x;
    px.y = center.y;
    px.find_z = [](const Pixel<double>& pixel) { return *static_cast<const double*>(pixel.z_source); };
    px.z_source = &z;
    px.triangle = &triangle;
    px.component_lanes = &lanes;
    px.dx = px.x * 256.0 - t.x[0];
    px.dy = px.y * 256.0 - t.y[0];
    px.weights = weights_at(triangle, px.dx, px.dy);
    px.quad_x = std::fmod(std::floor(center.x), 2.0);
    px.quad_y = std::fmod(std::floor(center.y), 2.0);
    return shader_.fragment(from_components<VD, double>(varyings), px).color;
  }

  S shader_;
  std::vector<uint32_t> indices_;
  DrawState state_;
  ColorFormat format_;
  ViewportRect viewport_;
  std::vector<glm::vec4> pos_clip_;
  std::vector<std::array<float, kN>> varyings_;
  std::vector<TruthTriangle> exact_, snapped_;
};

}  // namespace halfspace::test
