// SPDX-License-Identifier: Apache-2.0
//
// Shaders for the property tests. Together they use every part of the shader interface. Each clamps its output so that no picture contains
// a NaN, because the bits of a NaN depend on the operand order of instructions.
#pragma once

#include <array>
#include <limits>
#include <type_traits>

#include "halfspace/raster/pass.h"
#include "support/shaders.h"

namespace halfspace {

template <class R>
vec4<R> clamped(const vec4<R>& c, float limit) {
  return {clamp(c.x, R(-limit), R(limit)), clamp(c.y, R(-limit), R(limit)), clamp(c.z, R(-limit), R(limit)),
          clamp(c.w, R(-limit), R(limit))};
}

template <class R>
struct PositionAndA {
  vec4<R> position;
  vec4<R> a;
};

/// No varyings; uses only the built-in inputs in Pixel.
struct PixelShader {
  glm::mat4 clip_from_model{1.0f};
  glm::vec4 color{1.0f};
  template <class R>
  using Attributes = PositionAttributes<R>;
  template <class R>
  using Varyings = NoVaryings<R>;
  template <class R>
  vec4<R> vertex(const Attributes<R>& in, Varyings<R>&) const {
    return clip_from_model * in.position;
  }
  template <class R>
  Fragment<R> fragment(const Varyings<R>&, const Pixel<R>& px) const {
    const R x = px.x * R(1.0f / 256.0f) + R(color.x);
    const R y = px.y * R(1.0f / 256.0f) * px.z();
    return {clamped(vec4<R>(x, y, px.inv_w() * R(0.125f), select(px.front_facing, R(color.w), R(0.25f))), 4.0f)};
  }
};

/// One smooth color.
struct ColorShader {
  glm::mat4 clip_from_model{1.0f};
  float brightness = 1.0f;
  template <class R>
  struct Attributes {
    vec4<R> position;
    vec3<R> color;
  };
  template <class R>
  struct Varyings {
    vec3<R> color;
  };
  template <class R>
  vec4<R> vertex(const Attributes<R>& in, Varyings<R>& out) const {
    out.color = in.color * brightness;
    return clip_from_model * in.position;
  }
  template <class R>
  Fragment<R> fragment(const Varyings<R>& in, const Pixel<R>&) const {
    return {clamped(vec4<R>(in.color, in.color.x * R(0.5f) + R(0.25f)), 1e6f)};
  }
};

/// Twelve components with all three interpolation qualifiers.
struct MixedShader {
  template <class R>
  struct Attributes {
    vec4<R> position;
    vec4<R> a;
    vec3<R> b;
    vec2<R> c;
  };
  template <class R>
  struct Varyings {
    vec4<R> smooth;
    Flat<vec3<R>> flat;
    NoPerspective<vec2<R>> linear;
    R product;
    vec2<R> uv;
  };
  template <class R>
  vec4<R> vertex(const Attributes<R>& in, Varyings<R>& out) const {
    out.smooth = in.a;
    out.flat.value = in.b;
    out.linear.value = in.c;
    out.product = in.a.x * in.c.y;
    out.uv = vec2<R>(in.b.x, in.a.w);
    return in.position;
  }
  template <class R>
  Fragment<R> fragment(const Varyings<R>& in, const Pixel<R>& px) const {
    const vec3<R> rgb(in.smooth.x + in.flat.value.x * in.linear.value.x, in.smooth.y * in.flat.value.y + in.product,
                      in.linear.value.y - in.uv.x * in.flat.value.z);
    return {clamped(vec4<R>(rgb, select(px.front_facing, in.smooth.w, in.uv.y)), 8.0f)};
  }
};

/// Analytic derivatives and differences within the quad.
struct DerivativeShader {
  template <class R>
  struct Attributes {
    vec4<R> position;
    vec2<R> uv;
    vec3<R> normal;
  };
  template <class R>
  struct Varyings {
    vec2<R> uv;
    vec3<R> normal;
    NoPerspective<R> ramp;
  };
  template <class R>
  vec4<R> vertex(const Attributes<R>& in, Varyings<R>& out) const {
    out.uv = in.uv;
    out.normal = in.normal;
    out.ramp.value = in.uv.x;
    return in.position;
  }
  template <class R>
  static R height(const Varyings<R>& v) {
    return v.uv.x * v.normal.y + v.uv.y * v.ramp.value;
  }
  template <class R>
  Fragment<R> fragment(const Varyings<R>& in, const Pixel<R>& px) const {
    const vec2<R> dx = px.ddx(&Varyings<R>::uv);
    const vec3<R> dy = px.ddy(&Varyings<R>::normal);
    const R here = height(px.template at_quad<Varyings<R>>(0, 0));
    const R right = height(px.template at_quad<Varyings<R>>(1, 0));
    const R up = height(px.template at_quad<Varyings<R>>(0, 1));
    return {clamped(
        vec4<R>(dx.x * R(16.0f) + in.uv.x, dy.y * R(16.0f) + dx.y, (right - here) * R(8.0f), (up - here) * R(8.0f) + in.normal.z), 8.0f)};
  }
};

/// Discards fragments for which the product of two varyings is small. Optionally has a visibility function that predicts this.
template <bool has_visibility>
struct CutoutShader {
  float threshold = 0.2f;
  template <class R>
  using Attributes = PositionAndA<R>;
  template <class R>
  struct Varyings {
    vec2<R> uv;
    Flat<R> id;
    NoPerspective<R> fade;
    Centroid<vec2<R>> inside;
  };
  template <class R>
  vec4<R> vertex(const Attributes<R>& in, Varyings<R>& out) const {
    out.uv = vec2<R>(in.a.x, in.a.y);
    out.id.value = in.a.z;
    out.fade.value = in.a.w;
    out.inside.value = out.uv;
    return in.position;
  }
  template <class R>
  MaskOf<R> keeps(const Varyings<R>& in, const Pixel<R>& px) const {
    return (abs(in.uv.x * in.inside.value.y) > R(threshold)) && (px.z() + in.fade.value * R(0.5f) < R(0.95f));
  }
  template <class R>
  DiscardingFragment<R> fragment(const Varyings<R>& in, const Pixel<R>& px) const {
    return {clamped(vec4<R>(in.uv.x, in.inside.value.y, in.id.value, in.fade.value), 8.0f), keeps(in, px)};
  }
  template <class R>
  Visibility<R> visibility(const Varyings<R>& in, const Pixel<R>& px) const requires has_visibility {
    return {keeps(in, px), px.z()};
  }
};

/// Writes its own depth (sometimes out of range) and discards.
template <bool has_visibility>
struct BumpShader {
  float height = 0.1f;
  template <class R>
  struct Attributes {
    vec4<R> position;
    vec3<R> a;
  };
  template <class R>
  struct Varyings {
    vec3<R> a;
  };
  template <class R>
  vec4<R> vertex(const Attributes<R>& in, Varyings<R>& out) const {
    out.a = in.a;
    return in.position;
  }
  template <class R>
  DepthFragment<R> fragment(const Varyings<R>& in, const Pixel<R>& px) const {
    const Visibility<R> v = decide(in, px);
    return {clamped(vec4<R>(in.a, v.depth), 8.0f), v.keep, v.depth};
  }
  template <class R>
  Visibility<R> decide(const Varyings<R>& in, const Pixel<R>& px) const {
    return {in.a.x + in.a.y > R(0.1f), px.z() + R(height) * (in.a.z - R(0.5f))};
  }
  template <class R>
  Visibility<R> visibility(const Varyings<R>& in, const Pixel<R>& px) const requires has_visibility {
    return decide(in, px);
  }
};

/// Uses the primitive stage to output the face normal and a value that identifies the order of the vertices.
struct FaceShader {
  template <class R>
  struct Attributes {
    vec4<R> position;
    vec3<R> point;
  };
  template <class R>
  struct Varyings {
    vec3<R> point;
    Flat<R> provoking;
  };
  template <class R>
  struct Primitive {
    vec3<R> normal;
    R order;
  };
  template <class R>
  vec4<R> vertex(const Attributes<R>& in, Varyings<R>& out) const {
    out.point = in.point;
    out.provoking.value = in.point.x - in.point.z;
    return in.position;
  }
  template <class R>
  Primitive<R> primitive(const Varyings<R>& v0, const Varyings<R>& v1, const Varyings<R>& v2) const {
    return {cross(v1.point - v0.point, v2.point - v0.point), v0.point.x + R(2.0f) * v1.point.x + R(4.0f) * v2.point.x};
  }
  template <class R>
  Fragment<R> fragment(const Varyings<R>& in, const Primitive<R>& face, const Pixel<R>&) const {
    return {clamped(vec4<R>(face.normal.x + in.point.x, face.normal.y, face.normal.z * in.provoking.value, face.order * R(0.125f)), 8.0f)};
  }
};

/// Primitive stage and discard, with a visibility function.
struct FaceCutoutShader {
  template <class R>
  struct Attributes {
    vec4<R> position;
    vec2<R> uv;
  };
  template <class R>
  struct Varyings {
    vec2<R> uv;
  };
  template <class R>
  struct Primitive {
    R mean;
  };
  template <class R>
  vec4<R> vertex(const Attributes<R>& in, Varyings<R>& out) const {
    out.uv = in.uv;
    return in.position;
  }
  template <class R>
  Primitive<R> primitive(const Varyings<R>& v0, const Varyings<R>& v1, const Varyings<R>& v2) const {
    return {(v0.uv.x + v1.uv.x + v2.uv.x) * R(0.25f) - v1.uv.y};
  }
  template <class R>
  DiscardingFragment<R> fragment(const Varyings<R>& in, const Primitive<R>& face, const Pixel<R>& px) const {
    return {clamped(vec4<R>(in.uv, face.mean, px.z()), 8.0f), in.uv.x > in.uv.y};
  }
  template <class R>
  Visibility<R> visibility(const Varyings<R>& in, const Pixel<R>& px) const {
    return {in.uv.x > in.uv.y, px.z()};
  }
};

/// Moves vertices by the instance number and outputs the vertex number.
struct InstanceShader {
  glm::vec2 step{0.1f, -0.05f};
  template <class R>
  struct Attributes {
    vec4<R> position;
    vec3<R> color;
  };
  template <class R>
  struct Varyings {
    vec3<R> color;
    Flat<R> number;
  };
  template <class R>
  vec4<R> vertex(const Attributes<R>& in, const VertexId<R>& id, Varyings<R>& out) const {
    out.color = in.color;
    out.number.value = to_real<R>(id.vertex & IntOf<R>(7)) * R(0.125f);
    const auto n = static_cast<float>(id.instance);
    vec4<R> p = in.position;
    p.x = p.x + p.w * R(step.x * n);
    p.y = p.y + p.w * R(step.y * n);
    return p;
  }
  template <class R>
  Fragment<R> fragment(const Varyings<R>& in, const Pixel<R>&) const {
    return {clamped(vec4<R>(in.color, in.number.value), 8.0f)};
  }
};

/// Integers and arrays as attributes and varyings.
struct IntegerShader {
  template <class R>
  struct Attributes {
    vec4<R> position;
    std::array<vec2<R>, 2> scales;
    std::array<IntOf<R>, 2> codes;
    R last;
  };
  template <class R>
  struct Varyings {
    Flat<std::array<IntOf<R>, 2>> codes;
    std::array<vec3<R>, 2> colors;
    Flat<IntOf<R>> instance;
    NoPerspective<std::array<R, 2>> ramps;
  };
  template <class R>
  vec4<R> vertex(const Attributes<R>& in, const VertexId<R>& id, Varyings<R>& out) const {
    out.codes.value = {in.codes[1], in.codes[0] ^ id.vertex};
    const R third = to_real<R>(in.codes[0] & IntOf<R>(255)) * R(1.0f / 255.0f);
    out.colors = {vec3<R>(in.scales[0], third), vec3<R>(in.scales[1], in.last)};
    out.instance.value = IntOf<R>(id.instance) - IntOf<R>(3);
    out.ramps.value = {in.last, in.scales[1].y};
    return in.position;
  }
  template <class R>
  Fragment<R> fragment(const Varyings<R>& in, const Pixel<R>&) const {
    const auto fraction = [](const IntOf<R>& i) { return to_real<R>((i >> 8) & IntOf<R>(255)) * R(1.0f / 255.0f); };
    const vec3<R> color = in.colors[0] * fraction(in.codes.value[0]) + in.colors[1] * fraction(in.codes.value[1]);
    return {clamped(vec4<R>(color, in.ramps.value[0] * to_real<R>(in.instance.value) + in.ramps.value[1]), 8.0f)};
  }
};

/// Chooses a layer from -1 to 3 and a viewport from 0 to 2, most often 0.
template <class R, class V>
void choose_layer(const vec4<R>& a, V& vertex) {
  vertex.layer = truncate_to_int(a.x * R(3));
  vertex.viewport = truncate_to_int(a.w * R(1.5f));
}

/// Its vertex function writes the layer and the viewport.
struct LayerShader {
  template <class R>
  using Attributes = PositionAndA<R>;
  template <class R>
  struct Varyings {
    vec3<R> color;
    Flat<R> layer;
  };
  template <class R>
  LayeredVertex<R, 1, 1> vertex(const Attributes<R>& in, Varyings<R>& out) const {
    LayeredVertex<R, 1, 1> v{.position = in.position};
    v.point_size = in.a.y * R(9);
    v.clip_distance = {in.a.z + R(0.75f)};
    v.cull_distance = {in.a.y};
    choose_layer(in.a, v);
    out.color = vec3<R>(in.a.y, in.a.z, in.a.w);
    out.layer.value = to_real<R>(v.layer) * R(0.125f);
    return v;
  }
  template <class R>
  Fragment<R> fragment(const Varyings<R>& in, const Pixel<R>& px) const {
    return {clamped(vec4<R>(in.color, select(px.front_facing, in.layer.value, R(0.75f))), 8.0f)};
  }
};

/// A geometry function that drops some primitives and emits strips of several, between its vertices and those of its neighbors.
template <GeometryInputPrimitive kInput, GeometryOutputPrimitive kOutput>
struct GeometryShader {
  static constexpr GeometryLayout geometry_layout{.input = kInput, .output = kOutput, .max_vertices = 11, .invocations = 2};
  template <class R>
  using Attributes = PositionAndA<R>;
  template <class R>
  struct VertexVaryings {
    vec4<R> a;
    R twice;
  };
  template <class R>
  struct Varyings {
    vec3<R> color;
    Flat<R> number;
    NoPerspective<R> ramp;
  };
  static constexpr bool kChoosesLayer = kInput == GeometryInputPrimitive::triangles;
  template <class R>
  using EmittedVertex = std::conditional_t<kChoosesLayer, LayeredVertex<R, 2>, PerVertex<R, 2>>;

  template <class R>
  vec4<R> vertex(const Attributes<R>& in, VertexVaryings<R>& out) const {
    out = {in.a, in.a.x + in.a.x};
    return in.position;
  }
  template <class R, std::size_t N>
  void geometry(const GeometryInput<R, VertexVaryings<R>, N>& in, Emitter<R, Varyings<R>, EmittedVertex<R>>& out) const {
    const R t(0.125f * static_cast<float>(1 + in.invocation));
    const IntOf<R> kind = (in.primitive + in.instance) & IntOf<R>(3);
    for (std::size_t i = 0; i < 2 * N; ++i) {
      const std::size_t a = i % N, b = (i + 1 + static_cast<std::size_t>(in.invocation)) % N;
      const vec4<R> p = in.position[a] + (in.position[b] - in.position[a]) * t;
      const vec4<R>& value = in.varyings[a].a;
      Varyings<R> v;
      v.color = vec3<R>(value.x, in.varyings[b].twice, value.z);
      v.number.value = to_real<R>(in.primitive & IntOf<R>(15)) * R(0.0625f);
      v.ramp.value = value.y;
      EmittedVertex<R> vertex{.position = p};
      vertex.point_size = value.w * R(9);
      vertex.clip_distance = {value.x + R(0.75f), value.y + R(1)};
      if constexpr (kChoosesLayer) choose_layer(value, vertex);
      out.emit(vertex, v, kind != IntOf<R>(static_cast<int32_t>(i % 5)));
      if (i % 4 == 3) out.end_primitive(kind < IntOf<R>(2));
    }
  }
  template <class R>
  Fragment<R> fragment(const Varyings<R>& in, const Pixel<R>& px) const {
    return {clamped(vec4<R>(in.color.x, in.color.y + in.ramp.value, in.number.value, select(px.front_facing, in.color.z, R(0.5f))), 8.0f)};
  }
};

/// Divides patches of N vertices along two of their edges, by levels that depend on their values.
template <TessellationDomain kDomain, TessellationSpacing kSpacing, bool kPoints, int N>
struct PatchShader {
  static constexpr TessellationLayout tessellation_layout{
      .patch_vertices = N, .domain = kDomain, .spacing = kSpacing, .clockwise = N % 2 == 0, .point_mode = kPoints};
  template <class R>
  using Attributes = PositionAndA<R>;
  template <class R>
  struct VertexVaryings {
    vec4<R> a;
  };
  template <class R>
  struct Patch {
    vec2<R> shift;
  };
  template <class R>
  struct Varyings {
    vec3<R> color;
    Flat<R> number;
  };

  template <class R>
  vec4<R> vertex(const Attributes<R>& in, VertexVaryings<R>& out) const {
    out.a = in.a;
    return in.position;
  }
  template <class R>
  TessellationLevels<R> control(const PatchInput<R, VertexVaryings<R>, std::size_t{N}>& in, Patch<R>& patch) const {
    patch.shift = vec2<R>(in.varyings[N - 1].a.x, to_real<R>(in.instance)) * R(0.0625f);
    const vec4<R>& a = in.varyings[0].a;
    TessellationLevels<R> levels;
    levels.outer = {a.x * R(6), a.y * R(6), a.z * R(6), a.w * R(6)};
    levels.inner = {a.x * R(5) + R(1), a.w * R(5)};
    return levels;
  }
  template <class R>
  PerVertex<R, 1> evaluate(const PatchInput<R, VertexVaryings<R>, std::size_t{N}>& in, const Patch<R>& patch, const vec3<R>& at,
                           Varyings<R>& out) const {
    const std::size_t b = 1 % N, c = 2 % N;
    const vec4<R> p = in.position[0] + (in.position[b] - in.position[0]) * at.x + (in.position[c] - in.position[0]) * at.y;
    out.color = vec3<R>(at.x, at.y, in.varyings[b].a.x);
    out.number.value = to_real<R>(in.patch & IntOf<R>(15)) * R(0.0625f) + at.z;
    return {vec4<R>(p.x + patch.shift.x, p.y, p.z, p.w), R(1) + at.x * R(8), {patch.shift.y + in.varyings[c].a.y + R(0.5f)}};
  }
  template <class R>
  Fragment<R> fragment(const Varyings<R>& in, const Pixel<R>& px) const {
    return {clamped(vec4<R>(in.color.x, in.color.y, in.number.value, select(px.front_facing, in.color.z, R(0.5f))), 8.0f)};
  }
};

/// Patches whose triangles a geometry function turns into lines.
struct PatchGeometryShader : PatchShader<TessellationDomain::quads, TessellationSpacing::equal, false, 4> {
  using Base = PatchShader<TessellationDomain::quads, TessellationSpacing::equal, false, 4>;
  static constexpr GeometryLayout geometry_layout{.output = GeometryOutputPrimitive::line_strip, .max_vertices = 3};
  template <class R>
  struct EvaluatedVaryings {
    vec4<R> value;
  };
  template <class R>
  vec4<R> evaluate(const PatchInput<R, VertexVaryings<R>, 4>& in, const Patch<R>& patch, const vec3<R>& at,
                   EvaluatedVaryings<R>& out) const {
    Varyings<R> v;
    const PerVertex<R, 1> vertex = Base::evaluate(in, patch, at, v);
    out.value = vec4<R>(v.color, v.number.value);
    return vertex.position;
  }
  template <class R>
  void geometry(const GeometryInput<R, EvaluatedVaryings<R>, 3>& in, Emitter<R, Varyings<R>>& out) const {
    for (std::size_t i = 0; i < 3; ++i) {
      const vec4<R>& v = in.varyings[i].value;
      out.emit(in.position[i], {vec3<R>(v.x, v.y, v.z), {v.w}}, (in.primitive & IntOf<R>(3)) != IntOf<R>(static_cast<int32_t>(i)));
    }
  }
};

/// N colors, one of which can be the second source for blending; discards in stripes.
template <std::size_t N>
struct ManyColorsShader {
  float width = 0.2f;
  template <class R>
  using Attributes = PositionAndA<R>;
  template <class R>
  struct Varyings {
    vec4<R> a;
  };
  template <class R>
  vec4<R> vertex(const Attributes<R>& in, Varyings<R>& out) const {
    out.a = in.a;
    return in.position;
  }
  template <class R>
  DiscardingFragmentMRT<R, N> fragment(const Varyings<R>& in, const Pixel<R>& px) const {
    DiscardingFragmentMRT<R, N> out;
    for (std::size_t i = 0; i < N; ++i) {
      const R n(static_cast<float>(i) * 0.25f);
      out.color[i] = clamped(vec4<R>(in.a.x + n, in.a.y * n, in.a.z, in.a.w - n), 8.0f);
    }
    out.keep = keeps(in, px);
    return out;
  }
  template <class R>
  MaskOf<R> keeps(const Varyings<R>& in, const Pixel<R>&) const {
    return abs(in.a.x - R(0.5f)) > R(width);
  }
  template <class R>
  Visibility<R> visibility(const Varyings<R>& in, const Pixel<R>& px) const {
    return {keeps(in, px), px.z()};
  }
};

/// Points whose size comes from an attribute, cut to a disk by the point coordinate.
template <bool has_visibility>
struct PointShader {
  float size = 10.0f;
  template <class R>
  using Attributes = PositionAndA<R>;
  template <class R>
  struct Varyings {
    vec3<R> color;
    NoPerspective<R> fade;
  };
  template <class R>
  PerVertex<R> vertex(const Attributes<R>& in, Varyings<R>& out) const {
    out.color = vec3<R>(in.a.x, in.a.y, in.a.z);
    out.fade.value = in.a.w;
    return {in.position, in.a.w * R(size), {}};
  }
  template <class R>
  MaskOf<R> keeps(const Pixel<R>& px) const {
    const vec2<R> c = px.point_coord();
    const R x = c.x - R(0.5f), y = c.y - R(0.4f);
    return x * x + y * y < R(0.25f);
  }
  template <class R>
  DiscardingFragment<R> fragment(const Varyings<R>& in, const Pixel<R>& px) const {
    const vec2<R> c = px.point_coord();
    return {clamped(vec4<R>(c.x, c.y, in.color.z * px.inv_w(), in.fade.value + in.color.x), 8.0f), keeps(px)};
  }
  template <class R>
  Visibility<R> visibility(const Varyings<R>&, const Pixel<R>& px) const requires has_visibility {
    return {keeps(px), px.z()};
  }
};

/// Sprites that specify the rectangle they cover, with per-pixel depth.
template <bool has_visibility>
struct BoundsShader {
  float size = 0.1f;
  template <class R>
  using Attributes = PositionAndA<R>;
  template <class R>
  struct Varyings {
    vec4<R> a;
  };
  template <class R>
  PointSpriteVertex<R> vertex(const Attributes<R>& in, Varyings<R>& out) const {
    out.a = in.a;
    const vec2<R> center(clamp(in.position.x, R(-9.0f), R(9.0f)), clamp(in.position.y, R(-9.0f), R(9.0f)));
    const R left = in.a.x * R(size), right = in.a.y * R(size), up = in.a.z * R(size);
    return {vec2<R>(center.x - left, center.y - up), vec2<R>(center.x + right, center.y + up), in.a.w, in.a.x < R(1.3f)};
  }
  template <class R>
  Visibility<R> decide(const Varyings<R>& in, const Pixel<R>& px) const {
    const vec2<R> c = px.point_coord();
    return {c.x + c.y > R(0.3f), px.z() + R(0.2f) * (c.x - c.y * in.a.z)};
  }
  template <class R>
  DepthFragment<R> fragment(const Varyings<R>& in, const Pixel<R>& px) const {
    const Visibility<R> v = decide(in, px);
    return {clamped(vec4<R>(in.a.x, in.a.y, px.point_coord().x, v.depth), 8.0f), v.keep, v.depth};
  }
  template <class R>
  Visibility<R> visibility(const Varyings<R>& in, const Pixel<R>& px) const requires has_visibility {
    return decide(in, px);
  }
};

/// N clip distances.
template <std::size_t N>
struct ClipShader {
  template <class R>
  using Attributes = PositionAndA<R>;
  template <class R>
  struct Varyings {
    vec4<R> a;
    Flat<R> id;
    NoPerspective<R> ramp;
  };
  template <class R>
  PerVertex<R, N> vertex(const Attributes<R>& in, Varyings<R>& out) const {
    out.a = in.a;
    out.id.value = in.a.x;
    out.ramp.value = in.a.y;
    PerVertex<R, N> v{in.position, R(4.0f), {}};
    for (std::size_t i = 0; i < N; ++i) {
      const R turn(static_cast<float>(i) * 0.125f);
      v.clip_distance[i] = in.a.x - turn * in.a.y + (in.a.z + R(0.4f)) * (R(1.0f) - turn);
    }
    // A tenth of the vertices has an infinite distance.
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    v.clip_distance[0] = select(in.a.w > R(1.3f), R(kInfinity), v.clip_distance[0]);
    return v;
  }
  template <class R>
  Fragment<R> fragment(const Varyings<R>& in, const Pixel<R>&) const {
    return {clamped(vec4<R>(in.a.x, in.a.y + in.id.value, in.ramp.value, in.a.w), 8.0f)};
  }
};

/// Runs per sample, has clip and cull distances, and returns a sample mask, a depth and whether fragments are kept.
template <bool early, ConservativeDepth bound>
struct SampleShader {
  static constexpr bool per_sample = true;
  static constexpr bool early_fragment_tests = early;
  static constexpr ConservativeDepth conservative_depth = bound;
  float value = 0.0f;
  template <class R>
  using Attributes = PositionAndA<R>;
  template <class R>
  struct Varyings {
    PerSample<vec4<R>> a;
  };
  template <class R>
  PerVertex<R, 1, 2> vertex(const Attributes<R>& in, Varyings<R>& out) const {
    out.a.value = in.a;
    return {in.position, R(3.0f), {in.a.x + R(0.6f)}, {in.a.y - R(0.2f), in.a.z + R(value)}};
  }
  template <class R>
  SampleMasked<R, DepthFragment<R>> fragment(const Varyings<R>& in, const Pixel<R>& px) const {
    const vec4<R>& a = in.a.value;
    const IntOf<R> covered = px.sample_mask();
    const vec4<R> elsewhere = px.template at_sample<Varyings<R>>(px.samples - 1).a.value;
    SampleMasked<R, DepthFragment<R>> out;
    out.color = clamped(vec4<R>(a.x, R(0.1f * static_cast<float>(px.sample)), to_real<R>(covered) * R(0.01f), elsewhere.w), 8.0f);
    out.keep = a.y > R(value);
    const R shift = abs(a.x) * R(0.1f);
    out.depth = px.z() + (bound == ConservativeDepth::greater ? shift : bound == ConservativeDepth::less ? -shift : a.x * R(0.1f));
    out.sample_mask = covered ^ (truncate_to_int(px.x) & IntOf<R>(3));
    return out;
  }
};

/// Draws only depth. Computes the same positions as ColorShader.
using DepthShader = MatrixShader;

/// A post step: a tone curve that uses only addition, subtraction, multiplication and division.
struct Curve {
  template <class R>
  vec4<R> operator()(const vec4<R>& c) const {
    const auto curve = [](R x) {
      const R a = abs(x);
      return a / (a + R(0.5f));
    };
    return {curve(c.x), curve(c.y), curve(c.z), c.w};
  }
};

}  // namespace halfspace
