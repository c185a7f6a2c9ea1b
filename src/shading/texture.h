// SPDX-License-Identifier: Apache-2.0
//
// A two-dimensional texture: texels, mip levels, and the look-up that turns texture coordinates into a colour.
//
// In: coordinates (s, t) and their screen derivatives, or a level of detail. Out: linear RGBA. The rules are those of
// OpenGL 4.6, section 8.14 (scale factor, wrapping, minification, magnification) and 8.15, and of
// EXT_texture_filter_anisotropic; row 0 of the image is t = 0.
//
// Filtering works on whole codes (rgba8, r8, r16, and alpha of srgb8a8) or on linear values (the colour of srgb8a8, the
// float formats, and every format beside a border). The fraction of a texel is rounded to 1/32768, which is what a float
// position itself resolves from texel 256 on. With that the bilinear code of rgba8 is the exact one rounded once (and then
// divided by 255), and for every format: a constant texture gives exactly its constant, a fraction of zero exactly the
// texel, and no result leaves the interval of the texels it mixes.
//
// Common look-ups (rgba8, repeat or clamp, bilinear or trilinear) are inlined into shaders from here; all others are one call
// away, in texture_lookup.cpp.
// R = double filters in double with unrounded fractions (over the same decoded texels): the accuracy reference.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "halfspace/core/image.h"
#include "halfspace/core/lane_pairs.h"
#include "halfspace/core/lanes.h"
#include "halfspace/core/parallel.h"
#include "halfspace/core/vec.h"
#include "halfspace/shading/footprint.h"
#include "halfspace/shading/packed_texels.h"
#include "halfspace/shading/sampler.h"

namespace halfspace {

/// The largest rgba32f texel: half of the largest float, so that the difference of two texels is a float.
inline constexpr float kMaxTexel = 0x1.fffffep126f;

/// An immutable texture. It owns its texels; any number of threads may read it at once.
class Texture2D {
 public:
  static constexpr int kMaxSize = 32768;  ///< per side; all levels together stay below 8 GiB

  /// Level 0 from an image of 1 … kMaxSize texels a side, and all levels below it down to 1 × 1 by mip_chain. rgba8 or
  /// srgb8a8. workers, if any, share the work; the bits are the same.
  Texture2D(const Image<glm::u8vec4>& base, TexelFormat format, const Workers* workers = nullptr);
  explicit Texture2D(const Image<uint8_t>& base);   ///< r8
  explicit Texture2D(const Image<uint16_t>& base);  ///< r16
  /// rgba16f or rgba32f; base is linear
  Texture2D(const Image<glm::vec4>& base, TexelFormat format, const Workers* workers = nullptr);
  /// Given levels: level 0 as above, then each half of the one before, rounded down, but at least 1. At least one level;
  /// a shorter chain than down to 1 × 1 is allowed, and then ends the choice of levels.
  Texture2D(std::span<const Image<glm::u8vec4>> levels, TexelFormat format);
  Texture2D(std::span<const Image<glm::vec4>> levels, TexelFormat format);  ///< rgba16f or rgba32f

  int width(int level = 0) const { return width_[static_cast<std::size_t>(level)]; }
  int height(int level = 0) const { return height_[static_cast<std::size_t>(level)]; }
  int levels() const { return levels_; }
  TexelFormat format() const { return format_; }
  /// The codes of one texel of rgba8 or srgb8a8; level, x and row must exist.
  glm::u8vec4 texel(int level, int x, int row) const;
  /// The linear colour that a texel of any format stands for; level, x and row must exist.
  glm::vec4 value(int level, int x, int row) const;

  /// The filtered linear colour at uv, for a pixel whose steps to the right and up change uv by duv_dx and duv_dy.
  ///
  /// Any bits are allowed. A NaN coordinate reads as 0, or the border; an infinite one as the edge (clamp), the border, or
  /// 0 (repeat, mirrored). A level of detail of NaN is level 0, and NaN derivatives mean one probe. Coordinates so large that
  /// a float has no fraction left read as 0 under repeat.
  template <Number R>
  vec4<R> sample(const Sampler& sampler, const vec2<R>& uv, const vec2<R>& duv_dx, const vec2<R>& duv_dy) const;

  /// Red, green and blue alone: alpha, which most shaders do not ask for, is a quarter of the filtering.
  template <Number R>
  vec3<R> sample_rgb(const Sampler& sampler, const vec2<R>& uv, const vec2<R>& duv_dx, const vec2<R>& duv_dy) const;

  /// The same with a given level of detail (0 is the largest level); lod <= 0 and NaN magnify.
  template <Number R>
  vec4<R> sample_level(const Sampler& sampler, const vec2<R>& uv, std::type_identity_t<R> lod) const;

 private:
  static constexpr std::size_t kMaxLevels = 16;

  // Which levels a look-up reads: level index, and where between, at weight fraction, the one below it.
  template <class R>
  struct LevelChoice {
    IntOf<R> index;
    R fraction;  // 0 … 1 − 2^-14; 0 where not between
    MaskOf<R> between, nearest;
  };
  // What one look-up in one level needs.
  template <class R>
  struct Level {
    IntOf<R> width, height, offset, pitch;
    R columns, rows;  // width and height once more
  };
  // Where a look-up falls on one axis: between texel i (−1 … size − 1) and its neighbour, whose weight is fraction.
  template <class R>
  struct Axis {
    IntOf<R> i;
    R fraction;
  };

  template <class Texel>
  void add_chain(const Image<Texel>& base, const Workers* workers);
  template <class Texel>
  void add_levels(std::span<const Image<Texel>> levels);
  template <class Texel>
  void add_level(const Image<Texel>& image, const Workers* workers);
  std::size_t index_of(int level, int x, int row) const;

  /// Whether CommonLookup reads what the sampler asks for.
  bool is_common(const Sampler& sampler) const {
    const auto common = [](Wrap w) { return w == Wrap::repeat || w == Wrap::clamp; };
    return format_ <= TexelFormat::srgb8a8 && common(sampler.wrap_s) && common(sampler.wrap_t) && sampler.mag != Filter::nearest &&
           sampler.min != Filter::nearest;
  }
  // sample and sample_level for every format and sampler. In texture_lookup.cpp, for all Numbers.
  template <class R>
  vec4<R> sample_any(const Sampler& sampler, const vec2<R>& uv, const vec2<R>& duv_dx, const vec2<R>& duv_dy) const;
  template <class R>
  vec4<R> sample_levels_any(const Sampler& sampler, const vec2<R>& uv, const LevelChoice<R>& levels) const;
  // A look-up of any format, written for the texels of one (texels.h).
  template <class R, class Texels>
  struct AnyLookup;
  // The first N channels (3 or 4) of an 8-bit format, by a common sampler.
  template <int N, TexelFormat texel_format, class R>
  struct CommonLookup;
  template <class R, class Function>
  vec4<R> with_texels(const Function& function) const;
  template <class R, class Function>
  vec4<R> with_lookup(const Sampler& sampler, const Function& function) const;

  template <int N, class R>
  VecN<N, R> sample_channels(const Sampler& sampler, const vec2<R>& uv, const vec2<R>& duv_dx, const vec2<R>& duv_dy) const;
  template <class R>
  LevelChoice<R> choose_level(const Sampler& sampler, R lod, IntOf<R> whole) const;
  /// At a level of detail; and at that of derivatives.
  template <class R>
  LevelChoice<R> levels_at(const Sampler& sampler, R lod) const;
  template <class R>
  LevelChoice<R> levels_of(const Sampler& sampler, const vec2<R>& duv_dx, const vec2<R>& duv_dy) const;
  template <class R>
  Level<R> level(IntOf<R> index) const;
  template <class R>
  static R wrapped(R coordinate, Wrap wrap);
  template <class R>
  static Axis<R> axis(R coordinate, R size);

  TexelFormat format_;
  int levels_ = 0;
  std::array<int32_t, kMaxLevels> width_{}, height_{}, offset_{}, pitch_{};  // offset: index of a level's texel (0, 0)
  std::array<int32_t, kMaxLevels> columns_{}, rows_{};                       // width and height as floats' bits
  // All levels, texel after texel as texels.h reads them; red in the low byte. Round each level stands a border of the texels
  // that repeating would show there, so that a texel's neighbours lie beside it, across the seams too. Behind the last
  // are some words that gather_row may read.
  std::vector<int32_t, CacheLineAllocator<int32_t>> texels_;
};

/// The full chain of levels below base, largest first, base not included; the last is 1 × 1.
///
/// A side of even size is halved by averaging pairs; one of odd size 2n + 1 becomes n, texel i being the area average of
/// [i, i + 1]·(2n + 1)/n, that is of three texels with the weights n − i, n, i + 1 over 2n + 1: centred, and every texel
/// counts the same. srgb8a8 is averaged in linear light. The chain is computed in float (8-bit codes) or double (all else)
/// from level to level, and only the results are rounded to texels. Channels are averaged one by one (alpha does not
/// weight colour), as GL's do. workers, if any, share the work; the bits are the same. Texel is u8vec4 (rgba8, srgb8a8), uint8_t (r8),
/// uint16_t (r16) or vec4 (rgba16f, rgba32f).
template <class Texel>
std::vector<Image<Texel>> mip_chain(const Image<Texel>& base, TexelFormat format, const Workers* workers = nullptr);

// ---- the look-up, inlined into shaders --------------------------------------------------------------------------

template <class R>
HS_INLINE Texture2D::Level<R> Texture2D::level(IntOf<R> index) const {
  return {look_up(width_, index),
          look_up(height_, index),
          look_up(offset_, index),
          look_up(pitch_, index),
          R(as_real(look_up(columns_, index))),
          R(as_real(look_up(rows_, index)))};
}

/// A coordinate brought into [0, 1]: all that follows is then in range. NaN becomes 0.
template <class R>
HS_INLINE R Texture2D::wrapped(R coordinate, Wrap wrap) {
  return wrap == Wrap::repeat ? max(coordinate - floor(coordinate), R(0.0f)) : clamp(coordinate, R(0.0f), R(1.0f));
}

/// Texel centres lie at i + 1/2. In: a coordinate in [0, 1].
template <class R>
HS_INLINE Texture2D::Axis<R> Texture2D::axis(R coordinate, R n) {
  if constexpr (std::is_same_v<R, double>) {
    const double u = coordinate * n - 0.5;
    return {truncate_to_int(floor(u)), u - floor(u)};
  } else {
    constexpr int kBits = 15;  // of the fraction; kMaxSize leaves room for them
    const IntOf<R> u = round_to_int(fma(coordinate * R(1 << kBits), n, R(-(1 << kBits) / 2)));
    return {u >> kBits, to_real<R>(u & ((1 << kBits) - 1)) * R(1.0f / (1 << kBits))};
  }
}

template <int N, TexelFormat texel_format, class R>
struct Texture2D::CommonLookup {
  using Value = VecN<N, R>;

  const Texture2D& texture;
  const Sampler& sampler;

  /// Where clamped, what lies beyond the middle of the outermost texels is those alone.
  HS_INLINE static Axis<R> clamped(const Axis<R>& a, IntOf<R> size, Wrap wrap) {
    if (wrap == Wrap::repeat) return a;
    return {max(a.i, IntOf<R>(0)), select(a.i >= 0 && a.i < size - 1, a.fraction, R(0.0f))};
  }

  /// The texels at index and right of it.
  HS_INLINE detail::TexelPair<IntOf<R>> pair(IntOf<R> index) const {
    const auto [left, right] = gather_row<2>(texture.texels_.data(), index);
    return {left, right};
  }

  /// One level, in filtering units. st in [0, 1].
  HS_INLINE Value filter(const vec2<R>& st, IntOf<R> level_index) const {
    const Level<R> l = texture.level<R>(level_index);
    const Axis<R> x = clamped(axis(st.x, l.columns), l.width, sampler.wrap_s), y = clamped(axis(st.y, l.rows), l.height, sampler.wrap_t);
    const IntOf<R> row = y.i * l.pitch + (l.offset + x.i);  // the product comes last
    return detail::mixed_rgba8<N, texel_format>(pair(row), pair(row + l.pitch), x.fraction, y.fraction);
  }

  /// Mixed of one level or two, in filtering units.
  HS_INLINE Value operator()(const vec2<R>& uv, const LevelChoice<R>& levels) const {
    const vec2<R> st(wrapped(uv.x, sampler.wrap_s), wrapped(uv.y, sampler.wrap_t));
    const Value c = filter(st, levels.index);
    if (!any(levels.between)) return c;
    return detail::lerp(c, filter(st, min(levels.index + 1, IntOf<R>(texture.levels_ - 1))), levels.fraction);
  }

  HS_INLINE Value finish(const Value& v) const { return detail::rgba8_to_linear<texel_format>(v); }
};

namespace detail {

/// Levels whose fraction is below this are read alone (it would shift a value by less than contrast/16384): a quad drawn at its own size
/// has a level of detail of some 1e-7.
template <class R>
inline constexpr float kLevelSnap = std::is_same_v<R, double> ? 0.0f : 0x1p-14f;

/// log2(1 + f)/f for log2_of_normal: levels of detail within 2^-16, which shifts a value by less than contrast/65536.
inline constexpr float kLevelLog2[] = {1.44264627f, -0.720555007f, 0.485306472f, -0.390892416f, 0.254752129f};

}  // namespace detail

/// whole: floor(lod + kLevelSnap), or for what is no level any other number beyond the ends.
template <class R>
HS_INLINE Texture2D::LevelChoice<R> Texture2D::choose_level(const Sampler& sampler, R lod, IntOf<R> whole) const {
  const MaskOf<R> minified = lod > R(0.0f);
  const MaskOf<R> nearest = select(minified, MaskOf<R>(sampler.min == Filter::nearest), MaskOf<R>(sampler.mag == Filter::nearest));
  const int32_t last = sampler.min == Filter::trilinear ? levels_ - 1 : 0;
  const IntOf<R> index = min(max(whole, IntOf<R>(0)), IntOf<R>(last));
  const R fraction = lod - to_real<R>(index);
  const MaskOf<R> between = fraction > R(detail::kLevelSnap<R>) && index < IntOf<R>(last);
  return {index, select(between, fraction, R(0.0f)), between, nearest};
}

template <class R>
HS_INLINE Texture2D::LevelChoice<R> Texture2D::levels_at(const Sampler& sampler, R lod) const {
  return choose_level(sampler, lod, truncate_to_int(floor(clamp(lod, R(0.0f), R(kMaxLevels)) + R(detail::kLevelSnap<R>))));
}

/// The whole part is half of the exponent of ρ²: texels can be fetched before the logarithm is known.
template <class R>
HS_INLINE Texture2D::LevelChoice<R> Texture2D::levels_of(const Sampler& sampler, const vec2<R>& duv_dx, const vec2<R>& duv_dy) const {
  const bool same_filter = (sampler.min == Filter::nearest) == (sampler.mag == Filter::nearest);
  if (same_filter && (sampler.min != Filter::trilinear || levels_ == 1)) return choose_level(sampler, R(0.0f), IntOf<R>(0));
  const R rho2 = max(squared_scale_factor(width(), height(), duv_dx, duv_dy), R(0x1p-126f));  // NaN too: level 0
  if constexpr (std::is_same_v<R, double>) {
    return levels_at(sampler, 0.5 * log2(rho2));
  } else {
    constexpr float kSnapFactor = 1.0f + 2 * 0.693147181f * detail::kLevelSnap<R>;
    const IntOf<R> exponent = (as_int(rho2 * R(kSnapFactor)) >> 23) - 127;
    return choose_level(sampler, R(0.5f) * detail::log2_of_normal(rho2, detail::kLevelLog2), exponent >> 1);
  }
}

template <Number R>
vec4<R> Texture2D::sample_level(const Sampler& sampler, const vec2<R>& uv, std::type_identity_t<R> lod) const {
  if (format_ != TexelFormat::rgba8 || !is_common(sampler)) return sample_levels_any<R>(sampler, uv, levels_at(sampler, lod));
  const CommonLookup<4, TexelFormat::rgba8, R> lookup{*this, sampler};
  return lookup.finish(lookup(uv, levels_at(sampler, lod)));
}

template <int N, class R>
HS_INLINE VecN<N, R> Texture2D::sample_channels(const Sampler& sampler, const vec2<R>& uv, const vec2<R>& duv_dx,
                                                const vec2<R>& duv_dy) const {
  if (format_ != TexelFormat::rgba8 || !is_common(sampler) || sampler.anisotropy > 1)
    return VecN<N, R>(sample_any<R>(sampler, uv, duv_dx, duv_dy));
  const CommonLookup<N, TexelFormat::rgba8, R> lookup{*this, sampler};
  return lookup.finish(lookup(uv, levels_of(sampler, duv_dx, duv_dy)));
}

template <Number R>
vec4<R> Texture2D::sample(const Sampler& sampler, const vec2<R>& uv, const vec2<R>& duv_dx, const vec2<R>& duv_dy) const {
  return sample_channels<4, R>(sampler, uv, duv_dx, duv_dy);
}
template <Number R>
vec3<R> Texture2D::sample_rgb(const Sampler& sampler, const vec2<R>& uv, const vec2<R>& duv_dx, const vec2<R>& duv_dy) const {
  return sample_channels<3, R>(sampler, uv, duv_dx, duv_dy);
}

}  // namespace halfspace
