// SPDX-License-Identifier: Apache-2.0
//
// The lookups of TextureView, for all kinds and formats, compiled once for each number type.
#include "halfspace/shading/texture/texture_view.h"

#include <tuple>

#include "halfspace/shading/texture/footprint.h"
#include "halfspace/shading/texture/texture_lookup.h"

namespace halfspace::HS_LANES::detail {

namespace {

/// Where a lookup samples, and the level of detail from the derivatives.
template <class R>
struct Sampled {
  LevelPlace<R> at;
  R lod;
};

const TextureLevel& finest(const TextureSource& source) { return source.table.level[0]; }

/// Returns the array layer next to a coordinate (OpenGL 4.6, section 8.14.2): rounds half up, and clamps. NaN becomes 0.
template <class R>
IntOf<R> array_layer(R layer, int layers) {
  return truncate_to_int(clamp(floor(layer + R(0.5f)), 0.0f, R(static_cast<float>(layers - 1))));
}

/// Returns the level of detail of three-dimensional coordinates.
template <class R>
R volume_lod(const TextureLevel& l, const TextureSlopes<R>& slopes) {
  const vec3<R> size(R(static_cast<float>(l.width)), R(static_cast<float>(l.height)), R(static_cast<float>(l.depth)));
  const auto squared = [&](const vec3<R>& d) {
    const vec3<R> texels = d * size;
    return dot(texels, texels);
  };
  return R(0.5f) * log2(max(squared(slopes.dx), squared(slopes.dy)));
}

/// Returns the place within a level, with the layer or the face.
template <class R>
Sampled<R> sampled(const TextureSource& source, const TexturePlace<R>& place, const TextureSlopes<R>& slopes) {
  const TextureTable& table = source.table;
  const TextureLevel& l = finest(source);
  const auto flat_lod = [&](int width, int height) { return level_of_detail(width, height, vec2<R>(slopes.dx), vec2<R>(slopes.dy)); };
  switch (table.kind) {
    case TextureKind::cube:
    case TextureKind::cube_array: {
      const CubeCoordinates<R> on_face = cube_coordinates(l.width, place.p, slopes.dx, slopes.dy);
      const IntOf<R> cube = array_layer(place.layer, l.depth / 6);
      return {{vec3<R>(on_face.st, R(0.0f)), cube * IntOf<R>(6) + on_face.face}, on_face.lod};
    }
    case TextureKind::three_d: return {{place.p, IntOf<R>(0)}, volume_lod(l, slopes)};
    case TextureKind::rectangle: return {{place.p, IntOf<R>(0)}, flat_lod(1, 1)};
    case TextureKind::one_d_array:
    case TextureKind::two_d_array: return {{place.p, array_layer(place.layer, l.depth)}, flat_lod(l.width, l.height)};
    default: return {{place.p, IntOf<R>(0)}, flat_lod(l.width, l.height)};
  }
}
template <class R>
LevelPlace<R> sampled_place(const TextureSource& source, const TexturePlace<R>& place) {
  const vec3<R> still(R(0.0f));
  return sampled(source, place, TextureSlopes<R>{still, still}).at;
}

template <class Value>
Value swizzled_channel(Swizzle s, const Value (&rgba)[4], const Value& zero, const Value& one) {
  switch (s) {
    case Swizzle::zero: return zero;
    case Swizzle::one: return one;
    default: return rgba[static_cast<std::size_t>(s)];
  }
}
template <class Vec, class Value>
Vec swizzled(const TextureTable& table, const Vec& v, const Value& zero, const Value& one) {
  const Value rgba[] = {v.x, v.y, v.z, v.w};
  const auto channel = [&](std::size_t k) { return swizzled_channel(table.swizzle[k], rgba, zero, one); };
  return {channel(0), channel(1), channel(2), channel(3)};
}
template <class R>
vec4<R> swizzled(const TextureTable& table, const vec4<R>& v) {
  return swizzled(table, v, R(0.0f), R(1.0f));
}

/// Returns the red channel of (result, 0, 0, 1): the swizzle also applies to the results of comparisons.
template <class R>
R swizzled_result(const TextureTable& table, R result) {
  const R rgba[] = {result, R(0.0f), R(0.0f), R(1.0f)};
  return swizzled_channel(table.swizzle[0], rgba, R(0.0f), R(1.0f));
}

template <class R>
LevelChoice<R> levels_at(const TextureSource& source, const Sampler& sampler, R lod) {
  return choose_level(sampler, source.table.levels, kMaxLevels, lod);
}

/// Returns whether a lookup in a layer of two dimensions uses several probes.
bool is_anisotropic(const TextureTable& table, const Sampler& sampler) {
  return sampler.anisotropy > 1 && (table.kind == TextureKind::two_d || table.kind == TextureKind::two_d_array);
}

/// A lookup with derivatives, in linear values. Texels as in TextureLookup.
template <class R, class Texels>
auto sample_with(const Texels& texels, const TextureSource& source, const Sampler& sampler, const TexturePlace<R>& place,
                 const TextureSlopes<R>& slopes, const LookupOptions& options) {
  const TextureLookup<R, Texels> lookup{source.base, source.table, sampler, texels, {source.table.kind, options.offset}};
  const Sampled<R> s = sampled(source, place, slopes);
  if (!is_anisotropic(source.table, sampler)) return lookup.finish(lookup(s.at, levels_at(source, sampler, s.lod + R(options.bias))));
  const TextureLevel& l = finest(source);
  const Footprint<R> area =
      footprint(l.width, l.height, vec2<R>(slopes.dx), vec2<R>(slopes.dy), std::min(sampler.anisotropy, kMaxAnisotropy));
  const LevelChoice<R> levels = levels_at(source, sampler, area.lod + R(options.bias));
  return lookup.finish(mean_of_probes<R>(area, [&](R along) {
    LevelPlace<R> at = s.at;
    at.st.x = fma(area.span.x, along, at.st.x);
    at.st.y = fma(area.span.y, along, at.st.y);
    return lookup(at, levels);
  }));
}

template <class R, class Texels>
auto sample_level_with(const Texels& texels, const TextureSource& source, const Sampler& sampler, const TexturePlace<R>& place, R lod,
                       const glm::ivec3& offset) {
  const TextureLookup<R, Texels> lookup{source.base, source.table, sampler, texels, {source.table.kind, offset}};
  return lookup.finish(lookup(sampled_place(source, place), levels_at(source, sampler, lod)));
}

/// Clamps the reference of a comparison to the range of a normalized format (OpenGL 4.6, section 8.23.1).
template <class R>
R clamped_reference(TexelFormat format, R reference) {
  const bool is_float = texel_info(format).kind == TexelKind::floats || format == TexelFormat::d32f || format == TexelFormat::d32fs8;
  return is_float ? reference : clamp(reference, 0.0f, 1.0f);
}
template <class R>
ComparedRed<R> compared_red(const TextureSource& source, const Sampler& sampler, R reference) {
  return {sampler.compare, clamped_reference(source.table.format, reference)};
}

/// Returns the linear values of the four texels that a bilinear lookup of level 0 blends, in the order of GLSL.
template <class R, class Texels>
auto gathered(const Texels& texels, const TextureSource& source, const Sampler& sampler, const TexturePlace<R>& place,
              const glm::ivec3& offset) {
  using Lookup = TextureLookup<R, Texels>;
  using Value = typename Texels::Value;
  const Lookup lookup{source.base, source.table, sampler, texels, {source.table.kind, offset}};
  const LevelPlace<R> at = sampled_place(source, place);
  const TextureLevel& l = finest(source);
  const TexelReader<R> from = lookup.reader(l);
  const MaskOf<R> linear(false);
  std::array<Value, 4> v;
  if (is_cube(source.table.kind)) {
    const TexelAxis axis = lookup.axis_of(l.width, Wrap::clamp);
    const IntOf<R> face = Lookup::cube_face_of(at.layer);
    const std::array<Value, 4> square =
        lookup.cube_square(l, at.layer - face, face, between_texels(wrap_coordinate(at.st.x, axis), axis, linear).i,
                           between_texels(wrap_coordinate(at.st.y, axis), axis, linear).i);
    for (std::size_t k = 0; k < 4; ++k) v[k] = lookup.finish(square[k]);
    return std::array<Value, 4>{v[2], v[3], v[1], v[0]};
  }
  const AxisTaps<R> x = Lookup::ordered_taps_at(at.st.x, lookup.axis_of(l.width, sampler.wrap_s), offset.x),
                    y = Lookup::ordered_taps_at(at.st.y, lookup.axis_of(l.height, sampler.wrap_t), offset.y);
  const IntOf<R> layer = at.layer * IntOf<R>(l.layer_pitch);
  const auto texel = [&](IntOf<R> i, MaskOf<R> column_inside, IntOf<R> j, MaskOf<R> row_inside) {
    const IntOf<R> index = layer + j * IntOf<R>(l.row_pitch) + lookup.in_row(i);
    return lookup.finish(lookup.texel(from, index, column_inside && row_inside));
  };
  return std::array<Value, 4>{
      texel(x.first, x.first_inside, y.second, y.second_inside), texel(x.second, x.second_inside, y.second, y.second_inside),
      texel(x.second, x.second_inside, y.first, y.first_inside), texel(x.first, x.first_inside, y.first, y.first_inside)};
}

/// Calls f(reader of the level, index of the texel) for each level that occurs, and returns its values, or 0 for lanes whose texel does not
/// exist.
template <class Value, class R, class F>
Value fetched(const TextureSource& source, const ivec3<R>& texel, IntOf<R> level, const F& f) {
  const TextureTable& table = source.table;
  const int stride = texel_info(table.format).bytes / texel_unit(table.format);
  const MaskOf<R> exists = level >= IntOf<R>(0) && level < IntOf<R>(table.levels);
  return for_each_level<Value, R>(clamped_index<R>(level, table.levels), [&](int k) {
    const TextureLevel& l = table.level[static_cast<std::size_t>(k)];
    const MaskOf<R> inside = exists && is_inside<R>(texel.x, l.width) && is_inside<R>(texel.y, l.height) && is_inside<R>(texel.z, l.depth);
    const IntOf<R> x = clamped_index<R>(texel.x, l.width), y = clamped_index<R>(texel.y, l.height), z = clamped_index<R>(texel.z, l.depth);
    const IntOf<R> index = z * IntOf<R>(l.layer_pitch) + y * IntOf<R>(l.row_pitch) + x * IntOf<R>(stride);
    return select(inside, f(TexelReader<R>{table.format, source.base + l.offset}, index), Value{});
  });
}

/// Reads integers, or stencil values.
template <class R>
ivec4<R> read_integers(const TexelReader<R>& from, IntOf<R> i) {
  if (is_depth(from.format)) return {from.stencil(i), IntOf<R>(0), IntOf<R>(0), IntOf<R>(1)};
  const std::array<IntOf<R>, 4> c = from.codes(i);
  return {c[0], c[1], c[2], c[3]};
}

/// Integers that are never blended, as the Texels of a lookup that reads the nearest texel.
template <class R>
struct IntegerTexels {
  static constexpr bool is_one_unit = false;
  struct Value {
    ivec4<R> v;
    friend HS_INLINE Value select(MaskOf<R> m, const Value& a, const Value& b) {
      return {ivec4<R>(select(m, a.v.x, b.v.x), select(m, a.v.y, b.v.y), select(m, a.v.z, b.v.z), select(m, a.v.w, b.v.w))};
    }
    friend HS_INLINE Value lerp(const Value& a, const Value&, R) { return a; }
    friend HS_INLINE Value operator+(const Value& a, const Value&) { return a; }
    friend HS_INLINE Value operator*(const Value& a, R) { return a; }
  };
  HS_INLINE Value operator()(const TexelReader<R>& from, IntOf<R> i) const { return {read_integers(from, i)}; }
  HS_INLINE Value to_linear(const TexelReader<R>&, const Value& v) const { return v; }
  HS_INLINE Value border(const glm::vec4& color, TexelFormat format) const {
    const glm::vec4 c = clamped_border(color, format);
    const auto integer = [](float x) { return IntOf<R>(round_to_int(x)); };
    return {ivec4<R>(integer(c.x), integer(c.y), integer(c.z), integer(c.w))};
  }
};

}  // namespace

template <class R>
vec4<R> sample_texture(const TextureSource& source, const Sampler& sampler, const TexturePlace<R>& place, const TextureSlopes<R>& slopes,
                       const LookupOptions& options) {
  HS_DCHECK(!is_integer(source.table.format));
  return swizzled(source.table, sample_with(AllChannels<R>{}, source, sampler, place, slopes, options));
}

template <class R>
vec4<R> sample_texture_level(const TextureSource& source, const Sampler& sampler, const TexturePlace<R>& place, const R& lod,
                             const glm::ivec3& offset) {
  HS_DCHECK(!is_integer(source.table.format));
  return swizzled(source.table, sample_level_with(AllChannels<R>{}, source, sampler, place, lod, offset));
}

template <class R>
R compare_texture(const TextureSource& source, const Sampler& sampler, const TexturePlace<R>& place, const R& reference,
                  const TextureSlopes<R>& slopes, const LookupOptions& options) {
  HS_DCHECK(!is_integer(source.table.format));
  return swizzled_result(source.table, sample_with(compared_red(source, sampler, reference), source, sampler, place, slopes, options));
}

template <class R>
R compare_texture_level(const TextureSource& source, const Sampler& sampler, const TexturePlace<R>& place, const R& reference, const R& lod,
                        const glm::ivec3& offset) {
  HS_DCHECK(!is_integer(source.table.format));
  return swizzled_result(source.table, sample_level_with(compared_red(source, sampler, reference), source, sampler, place, lod, offset));
}

template <class R>
vec4<R> gather_texture(const TextureSource& source, const Sampler& sampler, const TexturePlace<R>& place, int component,
                       const glm::ivec3& offset) {
  HS_DCHECK(!is_integer(source.table.format));
  const std::array<vec4<R>, 4> v = gathered(AllChannels<R>{}, source, sampler, place, offset);
  const auto channel = [&](std::size_t k) { return swizzled(source.table, v[k])[component]; };
  return {channel(0), channel(1), channel(2), channel(3)};
}

template <class R>
vec4<R> gather_compared(const TextureSource& source, const Sampler& sampler, const TexturePlace<R>& place, const R& reference,
                        const glm::ivec3& offset) {
  const std::array<R, 4> v = gathered(compared_red(source, sampler, reference), source, sampler, place, offset);
  const auto result = [&](std::size_t k) { return swizzled_result(source.table, v[k]); };
  return {result(0), result(1), result(2), result(3)};
}

template <class R>
ivec4<R> gather_integer_texture(const TextureSource& source, const Sampler& sampler, const TexturePlace<R>& place, int component,
                                const glm::ivec3& offset) {
  const auto v = gathered(IntegerTexels<R>{}, source, sampler, place, offset);
  const auto channel = [&](std::size_t k) { return swizzled(source.table, v[k].v, IntOf<R>(0), IntOf<R>(1))[component]; };
  return {channel(0), channel(1), channel(2), channel(3)};
}

template <class R>
ivec4<R> sample_integer_texture(const TextureSource& source, const Sampler& sampler, const TexturePlace<R>& place, const R& lod,
                                const glm::ivec3& offset) {
  const IntegerTexels<R> texels;
  const TextureLookup<R, IntegerTexels<R>> lookup{source.base, source.table, sampler, texels, {source.table.kind, offset}};
  Sampler nearest = sampler;
  nearest.mag = Filter::nearest;
  nearest.min = sampler.min <= Filter::bilinear ? Filter::nearest : Filter::nearest_mipmap_nearest;
  const LevelChoice<R> levels = choose_level(nearest, source.table.levels, kMaxLevels, lod);
  return swizzled(source.table, lookup(sampled_place(source, place), levels).v, IntOf<R>(0), IntOf<R>(1));
}

template <class R>
vec4<R> fetch_texel(const TextureSource& source, const ivec3<R>& texel, const IntOf<R>& level) {
  const auto read = [](const TexelReader<R>& from, IntOf<R> i) { return from.to_linear(from(i)); };
  return swizzled(source.table, fetched<vec4<R>, R>(source, texel, level, read));
}

template <class R>
ivec4<R> fetch_integer_texel(const TextureSource& source, const ivec3<R>& texel, const IntOf<R>& level) {
  using Value = typename IntegerTexels<R>::Value;
  const auto read = [](const TexelReader<R>& from, IntOf<R> i) { return Value{read_integers(from, i)}; };
  return swizzled(source.table, fetched<Value, R>(source, texel, level, read).v, IntOf<R>(0), IntOf<R>(1));
}

template <class R>
vec2<R> query_texture_lod(const TextureSource& source, const Sampler& sampler, const TexturePlace<R>& place,
                          const TextureSlopes<R>& slopes) {
  const R derived = sampled(source, place, slopes).lod;
  const R limited = clamp(controlled_lod(sampler.lod, derived), 0.0f, R(static_cast<float>(source.table.levels - 1)));
  const R before = biased_lod(sampler.lod, derived);
  if (sampler.min <= Filter::bilinear) return {R(0.0f), before};
  const bool one_level = sampler.min == Filter::nearest_mipmap_nearest || sampler.min == Filter::bilinear_mipmap_nearest;
  return {one_level ? nearest_level(limited) : limited, before};
}

/// Instantiates all lookups of a number type.
template <class R>
struct Instances {
  static constexpr auto kAll =
      std::tuple{&sample_texture<R>, &sample_texture_level<R>, &compare_texture<R>,        &compare_texture_level<R>,
                 &gather_texture<R>, &gather_compared<R>,      &gather_integer_texture<R>, &sample_integer_texture<R>,
                 &fetch_texel<R>,    &fetch_integer_texel<R>,  &query_texture_lod<R>};
};
template struct Instances<float>;
template struct Instances<double>;
template struct Instances<RealN<4>>;
template struct Instances<RealN<8>>;
template struct Instances<FragmentReal>;
#if HALFSPACE_LANES == 16  // as in texture.cpp
template struct Instances<RealN<16>>;
#endif

}  // namespace halfspace::HS_LANES::detail
