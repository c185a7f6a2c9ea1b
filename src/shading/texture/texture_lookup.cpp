// SPDX-License-Identifier: Apache-2.0
//
// The lookup of Texture2D for every format, wrap mode and anisotropy. Common lookups of rgba8 without anisotropy are inlined from
// texture.h. Lanes are independent: each has its own probes, levels and texels, and lanes that have finished
// keep their results while others continue.
#include "halfspace/shading/texture/texels.h"
#include "halfspace/shading/texture/texture.h"

namespace halfspace::HS_LANES {

namespace {

/// A coordinate after wrapping, in [0, 1], or in [−1, 2] if the axis wraps to the border.
template <class R>
struct Wrapped {
  R at;
  MaskOf<R> mirrored;  // runs opposite to the image
};

/// The two texels along one axis that a lookup blends.
template <class R>
struct Taps {
  IntOf<R> first, second;  // valid indices
  R fraction;              // weight of the second
  MaskOf<R> first_inside, second_inside;
};

/// Mirrors a coordinate with period 2. At the edges texel −1 is texel 0 and texel n is texel n − 1, as with clamp.
template <class R>
HS_INLINE Wrapped<R> wrapped_mirrored(R coordinate) {
  const R phase = detail::mirror_phase(coordinate);
  const MaskOf<R> back = phase > R(1.0f);
  return {detail::mirrored_at(phase), select(coordinate < R(0.0f), !back, back)};
}

/// Clamps the border color to the range of the format (OpenGL 4.6, section 8.14.2).
glm::vec4 clamped_border(const glm::vec4& color, TexelFormat format) {
  glm::vec4 v;
  store(&v.x, detail::clamped_texel(color));
  if (format == TexelFormat::rgba32f) return v;
  const float high = format == TexelFormat::rgba16f ? kMaxHalf : 1.0f, low = format == TexelFormat::rgba16f ? -kMaxHalf : 0.0f;
  return {clamp(v.x, low, high), clamp(v.y, low, high), clamp(v.z, low, high), clamp(v.w, low, high)};
}

}  // namespace

/// A lookup for any wrap mode and filter. If an axis wraps to the border, it filters linear values, because the border color is linear.
template <class R, class Texels>
struct Texture2D::AnyLookup {
  using Value = typename Texels::Value;

  const Texture2D& texture;
  const Sampler& sampler;
  Texels texels;
  bool has_border = Texture2D::has_border(sampler);
  Value border = detail::uniform_value<Value>(clamped_border(sampler.border_color, texture.format_));

  HS_INLINE static Wrapped<R> wrap(R coordinate, Wrap wrap) {
    if (wrap == Wrap::mirrored) return wrapped_mirrored(coordinate);
    if (wrap == Wrap::border) return {clamp(coordinate, -1.0f, 2.0f), MaskOf<R>(false)};
    return {wrapped(coordinate, wrap), MaskOf<R>(false)};
  }

  /// Returns the texel that contains a coordinate. It may be outside the image if the axis wraps to the border.
  HS_INLINE static IntOf<R> texel_at(const Wrapped<R>& coordinate, IntOf<R> size, Wrap wrap) {
    const R position = coordinate.at * to_real<R>(size);
    R i = floor(position);
    i = select(coordinate.mirrored && i == position, i - R(1.0f), i);  // at a boundary: the texel farther from 0 before mirroring
    const IntOf<R> texel = truncate_to_int(i);
    return wrap == Wrap::border ? texel : min(texel, size - 1);
  }

  HS_INLINE static Taps<R> taps(const Wrapped<R>& coordinate, IntOf<R> size, Wrap wrap, MaskOf<R> nearest) {
    Axis<R> axis = Texture2D::axis<R>(coordinate.at, to_real<R>(size));
    if (any(nearest)) {
      axis.i = select(nearest, texel_at(coordinate, size, wrap), axis.i);
      axis.fraction = select(nearest, R(0.0f), axis.fraction);
    }
    const IntOf<R> last = size - 1, next = axis.i + 1;
    const MaskOf<R> first_inside = is_inside(axis.i, size), second_inside = is_inside(next, size);
    if (wrap == Wrap::repeat) return {select(first_inside, axis.i, last), select(second_inside, next, 0), axis.fraction, true, true};
    const MaskOf<R> no_border(wrap != Wrap::border);
    return {clamped(axis.i, size), clamped(next, size), axis.fraction, first_inside || no_border, second_inside || no_border};
  }

  HS_INLINE static MaskOf<R> is_inside(IntOf<R> i, IntOf<R> size) { return i >= 0 && i < size; }
  HS_INLINE static IntOf<R> clamped(IntOf<R> i, IntOf<R> size) { return min(max(i, IntOf<R>(0)), size - 1); }

  HS_INLINE Value texel(IntOf<R> index, MaskOf<R> inside) const {
    const Value v = texels(index);
    return has_border ? select(inside, texels.to_linear(v), border) : v;
  }

  HS_INLINE Value nearest_texel(const Wrapped<R>& s, const Wrapped<R>& t, const Level<R>& l) const {
    const IntOf<R> x = texel_at(s, l.width, sampler.wrap_s), y = texel_at(t, l.height, sampler.wrap_t);
    return texel(l.offset + clamped(y, l.height) * l.pitch + clamped(x, l.width), is_inside(x, l.width) && is_inside(y, l.height));
  }

  /// Filters one level, bilinearly or to the nearest texel.
  HS_INLINE Value filter(const Wrapped<R>& s, const Wrapped<R>& t, IntOf<R> level_index, MaskOf<R> nearest) const {
    const Level<R> l = texture.level<R>(level_index);
    if (all(nearest)) return nearest_texel(s, t, l);
    const Taps<R> x = taps(s, l.width, sampler.wrap_s, nearest), y = taps(t, l.height, sampler.wrap_t, nearest);
    // Large areas outside the image are common, for example around a decal.
    if (has_border && !any((x.first_inside || x.second_inside) && (y.first_inside || y.second_inside))) return border;
    const IntOf<R> row0 = l.offset + y.first * l.pitch, row1 = l.offset + y.second * l.pitch;
    const Value first = texel(row0 + x.first, x.first_inside && y.first_inside);
    const Value upper = detail::lerp(first, texel(row0 + x.second, x.second_inside && y.first_inside), x.fraction);
    const Value lower = detail::lerp(texel(row1 + x.first, x.first_inside && y.second_inside),
                                     texel(row1 + x.second, x.second_inside && y.second_inside), x.fraction);
    return detail::lerp(upper, lower, y.fraction);
  }

  HS_INLINE Value operator()(const vec2<R>& uv, const LevelChoice<R>& levels) const {
    const Wrapped<R> s = wrap(uv.x, sampler.wrap_s), t = wrap(uv.y, sampler.wrap_t);
    const Value c = filter(s, t, levels.index, levels.nearest);
    if (!any(levels.between)) return c;
    const Value smaller = filter(s, t, min(levels.index + 1, IntOf<R>(texture.levels_ - 1)), levels.nearest);
    return detail::lerp(c, smaller, levels.fraction);
  }

  HS_INLINE vec4<R> finish(const Value& v) const { return detail::to_rgba(has_border ? v : texels.to_linear(v)); }
};

/// Reads one texel of level 0. No axis may wrap to the border.
template <class R>
HS_INLINE vec4<R> Texture2D::sample_nearest(const Sampler& sampler, const vec2<R>& uv) const {
  return with_texels<R>([&](const auto& texels) {
    using Any = AnyLookup<R, std::remove_cvref_t<decltype(texels)>>;
    const auto at = [](R coordinate, int size, Wrap wrap) -> IntOf<R> {
      if (wrap == Wrap::mirrored) return Any::clamped(Any::texel_at(Any::wrap(coordinate, wrap), size, wrap), size);
      return min(truncate_to_int(wrapped(coordinate, wrap) * R(static_cast<float>(size))), IntOf<R>(size - 1));
    };
    const IntOf<R> x = at(uv.x, width(), sampler.wrap_s), y = at(uv.y, height(), sampler.wrap_t);
    return detail::to_rgba(texels.to_linear(texels(y * pitch_[0] + x + offset_[0])));
  });
}

/// Calls function with a reader for the texel format of this texture.
template <class R, class Function>
HS_INLINE vec4<R> Texture2D::with_texels(const Function& function) const {
  const int32_t* words = texels_.data();
  switch (format_) {
    case TexelFormat::rgba8: return function(detail::Rgba8Texels<TexelFormat::rgba8, R>{words});
    case TexelFormat::srgb8a8: return function(detail::Rgba8Texels<TexelFormat::srgb8a8, R>{words});
    case TexelFormat::r8: return function(detail::R8Texels<R>{words});
    case TexelFormat::r16: return function(detail::R16Texels<R>{words});
    case TexelFormat::rgba16f: return function(detail::Rgba16fTexels<R>{words});
    default: return function(detail::Rgba32fTexels<R>{words});
  }
}

/// Calls function with a lookup that supports this texture and the sampler.
template <class R, class Function>
HS_INLINE vec4<R> Texture2D::with_lookup(const Sampler& sampler, const Function& function) const {
  if (is_common(sampler)) {
    switch (format_) {
      case TexelFormat::rgba8: return function(CommonLookup<vec4<R>, TexelFormat::rgba8, R>{*this, sampler});
      case TexelFormat::rgba16f: return function(CommonLookup<vec4<R>, TexelFormat::rgba16f, R>{*this, sampler});
      case TexelFormat::rgba32f: return function(CommonLookup<vec4<R>, TexelFormat::rgba32f, R>{*this, sampler});
      default: return function(CommonLookup<vec4<R>, TexelFormat::srgb8a8, R>{*this, sampler});
    }
  }
  return with_texels<R>([&](const auto& texels) {
    return function(AnyLookup<R, std::remove_cvref_t<decltype(texels)>>{*this, sampler, texels});
  });
}

template <class R>
vec4<R> Texture2D::sample_levels_any(const Sampler& sampler, const vec2<R>& uv, const LevelChoice<R>& levels) const {
  if (is_nearest(sampler)) return sample_nearest(sampler, uv);
  return with_lookup<R>(sampler, [&](const auto& lookup) { return lookup.finish(lookup(uv, levels)); });
}

template <class R>
vec4<R> Texture2D::sample_any(const Sampler& sampler, const vec2<R>& uv, const vec2<R>& duv_dx, const vec2<R>& duv_dy) const {
  if (sampler.anisotropy <= 1 && is_nearest(sampler)) return sample_nearest(sampler, uv);
  if (sampler.anisotropy <= 1) return sample_levels_any<R>(sampler, uv, levels_of(sampler, duv_dx, duv_dy));

  HS_DCHECK(sampler.anisotropy <= 16);
  const Footprint<R> area = footprint(width(), height(), duv_dx, duv_dy, sampler.anisotropy);
  const LevelChoice<R> levels = levels_at(sampler, area.lod);
  const R step = R(1.0f) / max(to_real<R>(area.probes) - R(1.0f), R(1.0f));
  return with_lookup<R>(sampler, [&](const auto& lookup) {
    const auto probe = [&](int i) {
      const R along = fma(R(static_cast<float>(i)), step, R(-0.5f));
      return lookup(vec2<R>(fma(area.span.x, along, uv.x), fma(area.span.y, along, uv.y)), levels);
    };
    // A running mean: with lerp it stays within the range of the probes, and is exact if all probes are equal.
    auto mean = probe(0);
    for (int i = 1;; ++i) {
      const MaskOf<R> more = area.probes > i;
      if (!any(more)) return lookup.finish(mean);
      mean = select(more, detail::lerp(mean, probe(i), R(1.0f / static_cast<float>(i + 1))), mean);
    }
  });
}

glm::vec4 Texture2D::value(int level, int x, int row) const {
  const auto i = static_cast<int32_t>(index_of(level, x, row));
  return with_texels<float>([i](const auto& texels) { return detail::to_rgba(texels.to_linear(texels(i))); });
}

template vec4<float> Texture2D::sample_any(const Sampler&, const vec2<float>&, const vec2<float>&, const vec2<float>&) const;
template vec4<double> Texture2D::sample_any(const Sampler&, const vec2<double>&, const vec2<double>&, const vec2<double>&) const;
template vec4<RealN<4>> Texture2D::sample_any(const Sampler&, const vec2<RealN<4>>&, const vec2<RealN<4>>&, const vec2<RealN<4>>&) const;
template vec4<RealN<8>> Texture2D::sample_any(const Sampler&, const vec2<RealN<8>>&, const vec2<RealN<8>>&, const vec2<RealN<8>>&) const;
template vec4<FragmentReal> Texture2D::sample_any(const Sampler&, const vec2<FragmentReal>&, const vec2<FragmentReal>&,
                                                  const vec2<FragmentReal>&) const;
template vec4<float> Texture2D::sample_levels_any(const Sampler&, const vec2<float>&, const LevelChoice<float>&) const;
template vec4<double> Texture2D::sample_levels_any(const Sampler&, const vec2<double>&, const LevelChoice<double>&) const;
template vec4<RealN<4>> Texture2D::sample_levels_any(const Sampler&, const vec2<RealN<4>>&, const LevelChoice<RealN<4>>&) const;
template vec4<RealN<8>> Texture2D::sample_levels_any(const Sampler&, const vec2<RealN<8>>&, const LevelChoice<RealN<8>>&) const;
template vec4<FragmentReal> Texture2D::sample_levels_any(const Sampler&, const vec2<FragmentReal>&, const LevelChoice<FragmentReal>&) const;
// On builds with 8 lanes, GCC 12 would need 70 s for these two, which nothing there uses.
#if HALFSPACE_LANES == 16
template vec4<RealN<16>> Texture2D::sample_any(const Sampler&, const vec2<RealN<16>>&, const vec2<RealN<16>>&,
                                               const vec2<RealN<16>>&) const;
template vec4<RealN<16>> Texture2D::sample_levels_any(const Sampler&, const vec2<RealN<16>>&, const LevelChoice<RealN<16>>&) const;
#endif

}  // namespace halfspace::HS_LANES
