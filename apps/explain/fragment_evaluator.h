// SPDX-License-Identifier: Apache-2.0
//
// Evaluates the fragment function of a shader for one fragment, with the shader's own uniforms or with changed ones.
#pragma once

#include <array>

#include "explain/fragment_values.h"

namespace halfspace {

/// Returns the perspective-correct weights of the submitted vertices, given the weights that the shader receives, which refer to the
/// clipped triangle.
glm::vec3 submitted_weights(const InspectedTriangle& t, const Weights<float>& weights, const glm::dvec2& position_px);

/// Whether the shader computes lighting per vertex or per triangle, so that its varyings depend on its lights.
template <class S>
inline constexpr bool kLightsVertices = [] {
  if constexpr (requires { S::kByVertex; }) return S::kByVertex || HasPrimitive<S>;
  return false;
}();

template <class S>
class FragmentEvaluator {
 public:
  using V = typename S::template Varyings<float>;
  static constexpr std::size_t kCount = kComponents<V>;
  static_assert(!kUsesCentroid<V> && !kUsesPrimitiveId<S>, "no shader of a scene uses these");

  FragmentEvaluator(const S& shader, const FragmentPlace& place) : place_(place) {
    set_triangle();
    set_pixel();
    varyings_ = to_components<float>(interpolate_all<V>(px_.weights, components_, std::make_index_sequence<kCount>()));
    if constexpr (HasPrimitive<S>) {
      std::array<float, kComponents<PrimitiveOf<S, float>>> row;
      std::copy_n(place.triangle.source.primitive, row.size(), row.begin());
      face_ = from_components<PrimitiveOf<S, float>, float>(row);
    }
    barycentrics_ = submitted_weights(place.triangle, corner_weights(), glm::dvec2(px_.x, px_.y));
    if constexpr (kLightsVertices<S>) unchanged_ = vertices_of(shader);
  }
  FragmentEvaluator(const FragmentEvaluator&) = delete;
  FragmentEvaluator& operator=(const FragmentEvaluator&) = delete;

  const std::array<float, kCount>& varyings() const { return varyings_; }
  const glm::vec3& barycentrics() const { return barycentrics_; }
  float inv_w() const { return px_.inv_w(); }

  /// Returns the color of the shader that the evaluator was created with.
  glm::vec4 color(const S& shader) const { return color_of(shader, from_components<V, float>(varyings_), face_); }

  /// Returns the color of a shader with the same geometry but different uniforms.
  glm::vec4 color_with(const S& shader) const {
    if constexpr (kLightsVertices<S>) {
      const std::array<V, 3> vertices = vertices_of(shader);
      PrimitiveOf<S, float> face{};
      if constexpr (HasPrimitive<S>) face = shader.primitive(vertices[0], vertices[1], vertices[2]);
      return color_of(shader, from_components<V, float>(changed_varyings(vertices)), face);
    } else {
      return color(shader);
    }
  }

 private:
  glm::vec4 color_of(const S& shader, const V& in, const PrimitiveOf<S, float>& face) const {
    const auto fragment = call_fragment<S, float>(shader, in, face, px_);
    const vec4<float>& c = detail::nth_color(fragment.color, 0);
    return {c.x, c.y, c.z, c.w};
  }

  static TriangleLanes<float> lanes_of(const detail::TriangleScalars<kCount>& s) {
    return {s.x0, s.y0, s.e1x, s.e1y, s.e2x, s.e2y, s.area, s.q0, s.q1, s.q2, s.q_unscale, s.planar};
  }

  void set_triangle() {
    const detail::TriangleScalars<kCount> s =
        detail::scalars_in_cell<V>(place_.triangle.source, PlaneCell::of(place_.pixel.x, place_.pixel.y));
    lanes_ = lanes_of(s);
    components_ = {s.value0, s.delta1, s.delta2};
    px_.front_facing = s.front;
  }

  // Returns the weights of the triangle's vertices, even if the shader receives planes.
  Weights<float> corner_weights() const {
    const TriangleLanes<float> t = lanes_of(detail::triangle_scalars<V>(place_.triangle.source));
    return weights_at<kUsesNoPerspective<V>>(t, px_.x * kSubPixels - t.x0, px_.y * kSubPixels - t.y0);
  }

  void set_pixel() {
    const auto in_sub_pixels = [](int pixel, int at) { return static_cast<float>(pixel * kSubPixels + at); };
    const auto odd = [](int pixel) { return static_cast<float>(pixel & 1); };
    place_pixel<V>(px_, lanes_, components_, in_sub_pixels(place_.pixel.x, place_.at.x), in_sub_pixels(place_.pixel.y, place_.at.y),
                   odd(place_.pixel.x), odd(place_.pixel.y));
    px_.find_z = [](const Pixel<float>& pixel) { return *static_cast<const float*>(pixel.z_source); };
    px_.z_source = &place_.depth;
  }

  // Runs the vertex function for the three submitted vertices.
  std::array<V, 3> vertices_of(const S& shader) const {
    using A = typename S::template Attributes<float>;
    const InspectedTriangle& t = place_.triangle;
    StreamStorage storage;
    const std::span<const VertexStream> streams = at_instance(t.draw->vertices, t.instance, storage);
    std::array<V, 3> out;
    for (std::size_t i = 0; i < out.size(); ++i) {
      const auto row = static_cast<int64_t>(t.index[i]) + t.draw->state.base_vertex;
      std::array<float, kComponents<A>> in{};
      read_vertex(streams, static_cast<std::size_t>(row), in);
      call_vertex<S, float>(shader, from_components<A, float>(in), {static_cast<int32_t>(row), static_cast<int32_t>(t.instance)}, out[i]);
    }
    return out;
  }

  // Returns the varyings, with new values for those that depend on the changed uniforms.
  std::array<float, kCount> changed_varyings(const std::array<V, 3>& vertices) const {
    std::array<float, kCount> out = varyings_;
    std::array<std::array<float, kCount>, 3> before, after;
    for (std::size_t i = 0; i < 3; ++i) {
      before[i] = to_components<float>(unchanged_[i]);
      after[i] = to_components<float>(vertices[i]);
    }
    const std::size_t provoking = place_.triangle.draw->state.provoking == ProvokingVertex::first ? 0 : 2;
    for (std::size_t c = 0; c < kCount; ++c) {
      if (before[0][c] == after[0][c] && before[1][c] == after[1][c] && before[2][c] == after[2][c]) continue;
      const bool flat = kInterpolations<V>[c] == Interpolation::flat;
      out[c] = flat ? after[provoking][c] : dot(barycentrics_, glm::vec3(after[0][c], after[1][c], after[2][c]));
    }
    return out;
  }

  const FragmentPlace& place_;
  TriangleLanes<float> lanes_;
  ComponentLanes<float, kCount> components_;
  Pixel<float> px_{};
  std::array<float, kCount> varyings_;
  PrimitiveOf<S, float> face_{};
  glm::vec3 barycentrics_;
  std::array<V, 3> unchanged_{};  // varyings of the submitted vertices, if they depend on the lights
};

}  // namespace halfspace
