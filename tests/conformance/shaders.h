// SPDX-License-Identifier: Apache-2.0
//
// The shaders of the conformance tests, one for each Kind. All use Vertex as input; tests/mesa has the same shaders in GLSL.
#pragma once

#include "conformance/picture.h"

namespace halfspace::conformance {

template <class R>
struct VertexAttributes {
  vec4<R> pos_clip;
  vec4<R> color;
  vec4<R> extra;
};

/// A color, interpolated according to the mode.
struct ColorShader {
  int mode = kSmooth;
  template <class R>
  using Attributes = VertexAttributes<R>;
  template <class R>
  struct Varyings {
    vec4<R> smooth;
    Flat<vec4<R>> flat;
    NoPerspective<vec4<R>> linear;
    Centroid<vec4<R>> centroid;
  };
  template <class R>
  vec4<R> vertex(const Attributes<R>& in, Varyings<R>& out) const {
    out.smooth = out.flat.value = out.linear.value = out.centroid.value = in.color;
    return in.pos_clip;
  }
  template <class R>
  Fragment<R> fragment(const Varyings<R>& in, const Pixel<R>&) const {
    switch (mode) {
      case kFlat: return {in.flat.value};
      case kLinear: return {in.linear.value};
      case kCentroid: return {in.centroid.value};
      default: return {in.smooth};
    }
  }
};

/// The varyings of most shaders.
template <class R>
struct ColorVaryings {
  vec4<R> color;
};

/// Passes the color through.
struct VertexColor {
  template <class R>
  using Attributes = VertexAttributes<R>;
  template <class R>
  using Varyings = ColorVaryings<R>;
  template <class R>
  vec4<R> vertex(const Attributes<R>& in, Varyings<R>& out) const {
    out.color = in.color;
    return in.pos_clip;
  }
};

/// Four clip distances, from `extra`.
struct ClipShader {
  template <class R>
  using Attributes = VertexAttributes<R>;
  template <class R>
  using Varyings = ColorVaryings<R>;
  template <class R>
  PerVertex<R, 4> vertex(const Attributes<R>& in, Varyings<R>& out) const {
    out.color = in.color;
    return {in.pos_clip, R(4.0f), {in.extra.x, in.extra.y, in.extra.z, in.extra.w}};
  }
  template <class R>
  Fragment<R> fragment(const Varyings<R>& in, const Pixel<R>&) const {
    return {in.color};
  }
};

/// Two clip distances and two cull distances, from `extra`.
struct CullShader {
  template <class R>
  using Attributes = VertexAttributes<R>;
  template <class R>
  using Varyings = ColorVaryings<R>;
  template <class R>
  PerVertex<R, 2, 2> vertex(const Attributes<R>& in, Varyings<R>& out) const {
    out.color = in.color;
    return {in.pos_clip, R(4.0f), {in.extra.x, in.extra.y}, {in.extra.z, in.extra.w}};
  }
  template <class R>
  Fragment<R> fragment(const Varyings<R>& in, const Pixel<R>&) const {
    return {in.color};
  }
};

/// The viewport of `extra`.
struct ViewportShader : VertexColor {
  template <class R>
  LayeredVertex<R> vertex(const Attributes<R>& in, Varyings<R>& out) const {
    out.color = in.color;
    return {.position = in.pos_clip, .viewport = truncate_to_int(in.extra.x), .point_size = R(3.0f)};
  }
  template <class R>
  Fragment<R> fragment(const Varyings<R>& in, const Pixel<R>&) const {
    return {in.color};
  }
};

/// The number or the position of the sample.
struct SampleInputsShader : VertexColor {
  static constexpr bool per_sample = true;
  int mode = kSampleId;
  template <class R>
  Fragment<R> fragment(const Varyings<R>&, const Pixel<R>& px) const {
    if (mode == kSampleId) return {vec4<R>(R(static_cast<float>(px.sample) / 8.0f), R(0.0f), R(0.0f), R(1.0f))};
    const vec2<R> at = px.sample_position();
    return {vec4<R>(at.x, at.y, R(0.0f), R(1.0f))};
  }
};

/// The covered samples as the bits of an integer, divided by 255.
struct SampleMaskInShader : VertexColor {
  template <class R>
  Fragment<R> fragment(const Varyings<R>&, const Pixel<R>& px) const {
    return {vec4<R>(to_real<R>(px.sample_mask()) / R(255.0f), R(0.0f), R(0.0f), R(1.0f))};
  }
};

/// Draws white into some of the samples.
struct SampleMaskShader : VertexColor {
  int32_t mask = 0;
  template <class R>
  SampleMasked<R, Fragment<R>> fragment(const Varyings<R>&, const Pixel<R>&) const {
    return {{vec4<R>(R(1.0f))}, IntOf<R>(mask)};
  }
};

/// Discards fragments with a red value below `value`.
struct CutoutShader : VertexColor {
  float value = 0.5f;
  template <class R>
  DiscardingFragment<R> fragment(const Varyings<R>& in, const Pixel<R>&) const {
    return {in.color, in.color.x >= R(value)};
  }
  template <class R>
  Visibility<R> visibility(const Varyings<R>& in, const Pixel<R>& px) const {
    return {in.color.x >= R(value), px.z()};
  }
};

/// Writes the green value as depth.
struct DepthShader : VertexColor {
  template <class R>
  DepthFragment<R> fragment(const Varyings<R>& in, const Pixel<R>&) const {
    return {in.color, R(0.0f) <= R(0.0f), in.color.y};
  }
};

/// Points of extra.x px that output their point coordinate.
struct PointShader {
  template <class R>
  using Attributes = VertexAttributes<R>;
  template <class R>
  using Varyings = ColorVaryings<R>;
  template <class R>
  PerVertex<R> vertex(const Attributes<R>& in, Varyings<R>& out) const {
    out.color = in.color;
    return {in.pos_clip, in.extra.x, {}};
  }
  template <class R>
  Fragment<R> fragment(const Varyings<R>& in, const Pixel<R>& px) const {
    const vec2<R> c = px.point_coord();
    return {vec4<R>(c.x, c.y, in.color.z, in.color.w)};
  }
};

/// Passes extra.x and extra.y through.
struct CoordinatesShader {
  template <class R>
  using Attributes = VertexAttributes<R>;
  template <class R>
  struct Varyings {
    vec2<R> uv;
  };
  template <class R>
  vec4<R> vertex(const Attributes<R>& in, Varyings<R>& out) const {
    out.uv = vec2<R>(in.extra.x, in.extra.y);
    return in.pos_clip;
  }
};

/// Derivatives of extra.x and extra.y, multiplied by `value`.
struct DerivativeShader : CoordinatesShader {
  int mode = kDdx;
  float value = 1.0f;
  template <class R>
  Fragment<R> fragment(const Varyings<R>&, const Pixel<R>& px) const {
    vec2<R> dx, dy;
    if (mode < kQuadDdx) {
      dx = px.ddx(&Varyings<R>::uv);
      dy = px.ddy(&Varyings<R>::uv);
    } else {
      const vec2<R> here = px.template at_quad<Varyings<R>>(0, 0).uv;
      const vec2<R> right = px.template at_quad<Varyings<R>>(1, 0).uv, up = px.template at_quad<Varyings<R>>(0, 1).uv;
      dx = vec2<R>(right.x - here.x, right.y - here.y);
      dy = vec2<R>(up.x - here.x, up.y - here.y);
    }
    const R k(value);
    switch (mode % 3) {
      case kDdx: return {vec4<R>(dx.x * k, dx.y * k, R(0.0f), R(1.0f))};
      case kDdy: return {vec4<R>(dy.x * k, dy.y * k, R(0.0f), R(1.0f))};
      default: return {vec4<R>((abs(dx.x) + abs(dy.x)) * k, (abs(dx.y) + abs(dy.y)) * k, R(0.0f), R(1.0f))};
    }
  }
};

/// Samples a texture at (extra.x, extra.y).
struct TextureShader : CoordinatesShader {
  std::shared_ptr<const Texture2D> texture;
  Sampler sampler;
  int mode = kByDerivatives;
  float value = 0.0f;
  template <class R>
  Fragment<R> fragment(const Varyings<R>& in, const Pixel<R>& px) const {
    if (mode == kByLevel) return {texture->sample_level<R>(sampler, in.uv, R(value))};
    return {texture->sample<R>(sampler, in.uv, px.ddx(&Varyings<R>::uv), px.ddy(&Varyings<R>::uv))};
  }
};

/// Moves each instance to the right by `value` times its number, and by extra. Blue also encodes the instance.
struct InstanceShader {
  float value = 0.0f;
  template <class R>
  using Attributes = VertexAttributes<R>;
  template <class R>
  using Varyings = ColorVaryings<R>;
  template <class R>
  vec4<R> vertex(const Attributes<R>& in, const VertexId<R>& id, Varyings<R>& out) const {
    const R number(static_cast<float>(id.instance));
    out.color = vec4<R>(in.color.x, in.extra.w, number * R(1.0f / 32.0f), in.color.w);
    return vec4<R>(in.pos_clip.x + number * R(value) + in.extra.x, in.pos_clip.y + in.extra.y, in.pos_clip.z, in.pos_clip.w);
  }
  template <class R>
  Fragment<R> fragment(const Varyings<R>& in, const Pixel<R>&) const {
    return {in.color};
  }
};

inline constexpr int kGeometryVertices = 18;
/// The layouts of the geometry functions: every input with every output, and several invocations.
inline constexpr std::array kGeometryLayouts = [] {
  using In = GeometryInputPrimitive;
  using Out = GeometryOutputPrimitive;
  std::array<GeometryLayout, 18> layouts{};
  std::size_t n = 0;
  for (const In in : {In::points, In::lines, In::lines_adjacency, In::triangles, In::triangles_adjacency}) {
    for (const Out out : {Out::points, Out::line_strip, Out::triangle_strip}) layouts[n++] = {in, out, kGeometryVertices, 1};
  }
  for (const int invocations : {2, 8, 32}) layouts[n++] = {In::triangles, Out::triangle_strip, kGeometryVertices, invocations};
  return layouts;
}();

/// A geometry function with one of these layouts. Positions are computed without rounding, so that other programs have the same.
template <std::size_t kLayout>
struct GeometryShader {
  static constexpr GeometryLayout geometry_layout = kGeometryLayouts[kLayout];
  int mode = kWhole;
  float value = 0.0f;  ///< for kAtVertices: emitted vertices + 4 · ends
  template <class R>
  using Attributes = VertexAttributes<R>;
  template <class R>
  using VertexVaryings = ColorVaryings<R>;
  template <class R>
  struct Varyings {
    Flat<vec4<R>> color;
  };
  template <class R>
  vec4<R> vertex(const Attributes<R>& in, VertexVaryings<R>& out) const {
    out.color = in.color;
    return in.pos_clip;
  }
  template <class R, std::size_t N>
  void geometry(const GeometryInput<R, VertexVaryings<R>, N>& in, Emitter<R, Varyings<R>>& out) const {
    const auto emit_at = [&](std::size_t i, const vec4<R>& offset, const vec4<R>& color, MaskOf<R> emits) {
      const vec4<R> p = in.position[i] * R(0.5f);
      out.emit(vec4<R>(p.x + offset.x * p.w, p.y + offset.y * p.w, p.z, p.w), {{color}}, emits);
    };
    const vec4<R> none(R(0));
    if (mode == kWhole) {
      for (std::size_t i = 0; i < N; ++i) {
        emit_at(i, none, in.varyings[i].color, MaskOf<R>(true));
        if (N < 3) emit_at(i, vec4<R>(R(0.25f), R(-0.25f), R(0), R(0)), in.varyings[i].color, MaskOf<R>(true));
        if (N < 3) emit_at(i, vec4<R>(R(0.25f), R(0.25f), R(0), R(0)), in.varyings[i].color, MaskOf<R>(true));
      }
    } else if (mode == kAtVertices) {
      const int vertices = static_cast<int>(value) % 4, ends = static_cast<int>(value) / 4;
      for (std::size_t i = 0; i < N; ++i) {
        for (int k = 0; k < vertices; ++k) {
          const float x = k == 0 ? 0.0f : 0.25f, y = k == 2 ? 0.25f : 0.0f;
          emit_at(i, vec4<R>(R(x), R(y), R(0), R(0)), in.varyings[i].color, MaskOf<R>(true));
        }
        for (int k = 0; k < ends; ++k) out.end_primitive();
      }
    } else {
      const R invocation(static_cast<float>(in.invocation) * (1.0f / 32.0f));
      const vec4<R> color(to_real<R>(in.primitive) * R(0.0625f), to_real<R>(in.instance) * R(0.25f), invocation, R(1));
      const MaskOf<R> emits = ((in.primitive + IntOf<R>(in.invocation)) & IntOf<R>(3)) != IntOf<R>(1);
      for (std::size_t i = 0; i < N; ++i) emit_at(i, vec4<R>(invocation * R(0.5f), invocation * R(-0.5f), R(0), R(0)), color, emits);
    }
  }
  template <class R>
  Fragment<R> fragment(const Varyings<R>& in, const Pixel<R>&) const {
    return {in.color.value};
  }
};

/// The layouts of the tessellation functions: every domain with every spacing, as points, and clockwise.
inline constexpr std::array kTessellationLayouts = [] {
  using Domain = TessellationDomain;
  using Spacing = TessellationSpacing;
  std::array<TessellationLayout, 14> layouts{};
  std::size_t n = 0;
  for (const Domain domain : {Domain::triangles, Domain::quads, Domain::isolines}) {
    const int vertices = domain == Domain::triangles ? 3 : 4;
    for (const Spacing spacing : {Spacing::equal, Spacing::fractional_even, Spacing::fractional_odd})
      layouts[n++] = {vertices, domain, spacing, false, false};
    layouts[n++] = {vertices, domain, Spacing::equal, false, true};
    if (domain != Domain::isolines) layouts[n++] = {vertices, domain, Spacing::equal, true, false};
  }
  return layouts;
}();

/// Divides flat triangles and quads. Each patch has the color of its first vertex.
template <std::size_t kLayout>
struct TessellationShader {
  static constexpr TessellationLayout tessellation_layout = kTessellationLayouts[kLayout];
  static constexpr auto kVertices = static_cast<std::size_t>(tessellation_layout.patch_vertices);
  int mode = kUniform;
  float value = 1.0f;
  template <class R>
  using Attributes = VertexAttributes<R>;
  template <class R>
  using VertexVaryings = ColorVaryings<R>;
  template <class R>
  struct Patch {
    vec4<R> color;
  };
  template <class R>
  struct Varyings {
    Flat<vec4<R>> color;
  };
  template <class R>
  vec4<R> vertex(const Attributes<R>& in, VertexVaryings<R>& out) const {
    out.color = in.color;
    return in.pos_clip;
  }
  template <class R>
  TessellationLevels<R> control(const PatchInput<R, VertexVaryings<R>, kVertices>& in, Patch<R>& patch) const {
    patch.color = in.varyings[0].color;
    TessellationLevels<R> levels;
    for (std::size_t i = 0; i < 4; ++i) levels.outer[i] = R(mode == kUniform ? value : value * (0.5f + 0.25f * static_cast<float>(i)));
    levels.inner = {R(value), R(mode == kUniform ? value : value * 0.5f)};
    if (mode == kDiscardOdd) levels.outer[1] = select((in.patch & IntOf<R>(1)) == IntOf<R>(1), R(0), levels.outer[1]);
    return levels;
  }
  template <class R>
  vec4<R> evaluate(const PatchInput<R, VertexVaryings<R>, kVertices>& in, const Patch<R>& patch, const vec3<R>& at,
                   Varyings<R>& out) const {
    out.color.value = patch.color;
    const auto& p = in.position;
    if constexpr (kVertices == 3) {
      return p[0] * at.x + p[1] * at.y + p[2] * at.z;
    } else {
      const R u = R(1) - at.x, v = R(1) - at.y;
      return (p[0] * u + p[1] * at.x) * v + (p[3] * u + p[2] * at.x) * at.y;
    }
  }
  template <class R>
  Fragment<R> fragment(const Varyings<R>& in, const Pixel<R>&) const {
    return {in.color.value};
  }
};

inline constexpr float kLayerPointSize = 3.0f;
/// What `layer` and `layer_geometry` add to blue for each layer.
inline constexpr float kLayerCode = 16.0f / 255.0f;

template <class R>
struct LayerVaryings {
  vec4<R> color;
  Flat<R> layer;
};
template <class R>
Fragment<R> layer_fragment(const LayerVaryings<R>& in) {
  return {vec4<R>(in.color.x, in.color.y, in.layer.value * R(kLayerCode), in.color.w)};
}

/// The layer of `extra`.
struct LayerShader {
  template <class R>
  using Attributes = VertexAttributes<R>;
  template <class R>
  using Varyings = LayerVaryings<R>;
  template <class R>
  LayeredVertex<R> vertex(const Attributes<R>& in, Varyings<R>& out) const {
    out = {in.color, {in.extra.x}};
    return {.position = in.pos_clip, .layer = truncate_to_int(in.extra.x), .point_size = R(kLayerPointSize)};
  }
  template <class R>
  Fragment<R> fragment(const Varyings<R>& in, const Pixel<R>&) const {
    return layer_fragment(in);
  }
};

inline constexpr int kGeometryLayers = 6;
/// The layouts of `layer_geometry`: an invocation for each layer, and all layers in one invocation.
inline constexpr std::array kLayerLayouts = [] {
  using In = GeometryInputPrimitive;
  using Out = GeometryOutputPrimitive;
  return std::array{GeometryLayout{In::triangles, Out::triangle_strip, 3, kGeometryLayers},
                    GeometryLayout{In::triangles, Out::triangle_strip, 3 * kGeometryLayers, 1},
                    GeometryLayout{In::lines, Out::line_strip, 2 * kGeometryLayers, 1},
                    GeometryLayout{In::points, Out::points, kGeometryLayers, 1}};
}();

/// Emits each primitive into several layers.
template <std::size_t kLayout>
struct LayerGeometryShader {
  static constexpr GeometryLayout geometry_layout = kLayerLayouts[kLayout];
  int mode = kAllLayers;
  template <class R>
  using Attributes = VertexAttributes<R>;
  template <class R>
  using VertexVaryings = ColorVaryings<R>;
  template <class R>
  using Varyings = LayerVaryings<R>;
  template <class R>
  using EmittedVertex = LayeredVertex<R>;
  template <class R>
  vec4<R> vertex(const Attributes<R>& in, VertexVaryings<R>& out) const {
    out.color = in.color;
    return in.pos_clip;
  }
  template <class R, std::size_t N>
  void geometry(const GeometryInput<R, VertexVaryings<R>, N>& in, Emitter<R, Varyings<R>, LayeredVertex<R>>& out) const {
    for (int32_t i = 0; i < kGeometryLayers / geometry_layout.invocations; ++i) {
      const int32_t layer = in.invocation + i;
      const MaskOf<R> emits = mode == kAllLayers ? MaskOf<R>(true) : ((in.primitive + IntOf<R>(layer)) & IntOf<R>(3)) != IntOf<R>(1);
      for (std::size_t k = 0; k < N; ++k) {
        const LayeredVertex<R> v{.position = in.position[k], .layer = IntOf<R>(layer), .point_size = R(kLayerPointSize)};
        out.emit(v, {in.varyings[k].color, {R(static_cast<float>(layer))}}, emits);
      }
      out.end_primitive();
    }
  }
  template <class R>
  Fragment<R> fragment(const Varyings<R>& in, const Pixel<R>&) const {
    return layer_fragment(in);
  }
};

/// Attributes of any format. `position` is in pixels, apart from w.
template <class R>
struct ArrayAttributes {
  vec4<R> position;
  vec4<R> color;
  std::array<IntOf<R>, 4> integers;
  vec4<R> last;
};

/// Outputs the attributes of the provoking vertex. Each instance is 8 px to the right of the one before.
struct ArraysShader {
  float value = 0.0f;  ///< the width of a pixel in NDC
  template <class R>
  using Attributes = ArrayAttributes<R>;
  template <class R>
  struct Varyings {
    Flat<vec4<R>> color;
    Flat<std::array<IntOf<R>, 4>> integers;
    Flat<vec4<R>> last;
  };
  template <class R>
  vec4<R> vertex(const Attributes<R>& in, const VertexId<R>& id, Varyings<R>& out) const {
    out.color.value = in.color;
    out.integers.value = in.integers;
    out.last.value = in.last;
    const vec4<R>& p = in.position;
    return {(p.x + R(8.0f * static_cast<float>(id.instance))) * R(value) - p.w, p.y * R(value) - p.w, p.z, p.w};
  }
  template <class R>
  TypedFragment<R, vec4<R>, ivec4<R>, vec4<R>> fragment(const Varyings<R>& in, const Pixel<R>&) const {
    const std::array<IntOf<R>, 4>& i = in.integers.value;
    return {{in.color.value, ivec4<R>(i[0], i[1], i[2], i[3]), in.last.value}};
  }
};

/// The types of the colors of `outputs`: all of one type, and some that mix them.
inline constexpr std::array kOutputTypes = [] {
  constexpr ColorType r = ColorType::real, s = ColorType::signed_integer, u = ColorType::unsigned_integer;
  return std::array{OutputTypes{r, r, r, r}, OutputTypes{s, s, s, s}, OutputTypes{u, u, u, u}, OutputTypes{r, s, u, r},
                    OutputTypes{s, r, r, u}, OutputTypes{u, u, s, r}, OutputTypes{s, u, r, s}};
}();

/// Colors of several types: fractions of a color, and the integers in `extra`, multiplied by `value`, plus small numbers.
template <std::size_t kTypes>
struct OutputsShader {
  float value = 1.0f;
  template <class R>
  using Attributes = VertexAttributes<R>;
  template <class R>
  struct Varyings {
    vec4<R> color;
    Flat<vec4<R>> numbers;
  };
  template <class R, std::size_t kOutput>
  using OutputOf = std::conditional_t<kOutputTypes[kTypes][kOutput] == ColorType::real, vec4<R>,
                                      std::conditional_t<kOutputTypes[kTypes][kOutput] == ColorType::signed_integer, ivec4<R>, uvec4<R>>>;
  template <class R>
  vec4<R> vertex(const Attributes<R>& in, Varyings<R>& out) const {
    out.color = in.color;
    out.numbers.value = in.extra;
    return in.pos_clip;
  }
  template <class R>
  TypedFragment<R, OutputOf<R, 0>, OutputOf<R, 1>, OutputOf<R, 2>, OutputOf<R, 3>> fragment(const Varyings<R>& in,
                                                                                            const Pixel<R>& px) const {
    return {{output<0>(in, px), output<1>(in, px), output<2>(in, px), output<3>(in, px)}};
  }

 private:
  template <std::size_t kOutput, class R>
  OutputOf<R, kOutput> output(const Varyings<R>& in, const Pixel<R>& px) const {
    if constexpr (kOutputTypes[kTypes][kOutput] == ColorType::real) {
      return in.color * R(1.0f - 0.25f * static_cast<float>(kOutput));
    } else {
      const ivec4<R> n(in.numbers.value), factor(IntOf<R>(static_cast<int32_t>(value)));
      const IntOf<R> x = truncate_to_int(px.x) + IntOf<R>(static_cast<int32_t>(kOutput));
      const ivec4<R> small(x, x + IntOf<R>(1), x + IntOf<R>(2), x + IntOf<R>(3));
      return OutputOf<R, kOutput>(n * factor + (small & ivec4<R>(IntOf<R>(3))));
    }
  }
};

/// Computes N colors from two, for several attachments or for dual-source blending.
template <std::size_t N>
struct ColorsShader {
  template <class R>
  using Attributes = VertexAttributes<R>;
  template <class R>
  struct Varyings {
    vec4<R> color, other;
  };
  template <class R>
  vec4<R> vertex(const Attributes<R>& in, Varyings<R>& out) const {
    out.color = in.color;
    out.other = in.extra;
    return in.pos_clip;
  }
  template <class R>
  FragmentMRT<R, N> fragment(const Varyings<R>& in, const Pixel<R>&) const {
    FragmentMRT<R, N> out;
    out.color[0] = in.color;
    out.color[1] = in.other;
    for (std::size_t i = 2; i < N; ++i) {
      const R t(static_cast<float>(i) * 0.25f);
      for (int k = 0; k < 4; ++k) out.color[i][k] = in.color[k] * t + in.other[k] * (R(1.0f) - t);
    }
    return out;
  }
};

}  // namespace halfspace::conformance
