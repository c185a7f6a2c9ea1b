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
// Common look-ups (8-bit RGBA, repeat or clamp, isotropic) are inlined into shaders from here; all others are one call away,
// in texture_lookup.cpp.
// R = double filters in double with unrounded fractions (over the same decoded texels): the accuracy reference.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "core/image.h"
#include "core/lanes.h"
#include "core/srgb.h"
#include "core/vec.h"
#include "shading/footprint.h"

namespace halfspace {

/// What a texel holds. Formats of one channel read as (r, 0, 0, 1).
enum class TexelFormat : uint8_t {
  rgba8,    ///< value = code/255
  srgb8a8,  ///< red, green and blue sRGB-coded; alpha linear, code/255
  r8,       ///< value = code/255
  r16,      ///< value = code/65535
  rgba16f,  ///< linear halfs, finite: beyond ±65504 become ±65504, NaN becomes 0
  rgba32f   ///< linear floats within ±kMaxTexel, which hold what is beyond; NaN becomes 0
};

/// The largest rgba32f texel: half of the largest float, so that the difference of two texels is a float.
inline constexpr float kMaxTexel = 0x1.fffffep126f;

/// GL's NEAREST and LINEAR (both of level 0) and LINEAR_MIPMAP_LINEAR. As a magnification filter trilinear means bilinear.
enum class Filter : uint8_t { nearest, bilinear, trilinear };
/// GL's REPEAT, MIRRORED_REPEAT, CLAMP_TO_EDGE and CLAMP_TO_BORDER.
enum class Wrap : uint8_t { repeat, mirrored, clamp, border };

/// How a texture is read: uniform state, kept apart from the texture as in GL's sampler objects.
struct Sampler {
  Filter mag = Filter::bilinear;   ///< where a texel is larger than a pixel (level of detail <= 0)
  Filter min = Filter::trilinear;  ///< where it is smaller
  Wrap wrap_s = Wrap::repeat;
  Wrap wrap_t = Wrap::repeat;
  /// At most so many probes along a long footprint (footprint.h): 1 (isotropic) … 16. Ignored by sample_level.
  int anisotropy = 1;
  /// Linear; what lies outside of the image where an axis wraps by border. Used as the texture's format could hold it: of
  /// the coded formats held to [0, 1], of those of one channel the red alone.
  glm::vec4 border_color{0.0f};
};

/// An immutable texture. It owns its texels; any number of threads may read it at once.
class Texture2D {
 public:
  static constexpr int kMaxSize = 32768;  ///< per side; all levels together stay below 8 GiB

  /// Level 0 from an image of 1 … kMaxSize texels a side, and all levels below it down to 1 × 1 by mip_chain. rgba8 or
  /// srgb8a8.
  Texture2D(const Image<glm::u8vec4>& base, TexelFormat format);
  explicit Texture2D(const Image<uint8_t>& base);               ///< r8
  explicit Texture2D(const Image<uint16_t>& base);              ///< r16
  Texture2D(const Image<glm::vec4>& base, TexelFormat format);  ///< rgba16f or rgba32f; base is linear
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
    R fraction;  // 0 … 1 − 2^-14
    MaskOf<R> between, nearest;
  };
  // What one look-up in one level needs.
  template <class R>
  struct Level {
    IntOf<R> width, height, offset;
  };
  // Where a look-up falls on one axis: between texel i (−1 … size − 1) and its neighbour, whose weight is fraction.
  template <class R>
  struct Axis {
    IntOf<R> i;
    R fraction;
  };

  template <class Texel>
  void add_chain(const Image<Texel>& base);
  template <class Texel>
  void add_levels(std::span<const Image<Texel>> levels);
  template <class Texel>
  void add_level(const Image<Texel>& image);
  std::size_t index_of(int level, int x, int row) const;

  /// Whether the inlined look-up serves, apart from anisotropy.
  bool is_common(const Sampler& sampler) const {
    const auto common = [](Wrap w) { return w == Wrap::repeat || w == Wrap::clamp; };
    return format_ <= TexelFormat::srgb8a8 && common(sampler.wrap_s) && common(sampler.wrap_t);
  }
  // sample and sample_level for every format and sampler. In texture_lookup.cpp, for all Numbers.
  template <class R>
  vec4<R> sample_any(const Sampler& sampler, const vec2<R>& uv, const vec2<R>& duv_dx, const vec2<R>& duv_dy) const;
  template <class R>
  vec4<R> sample_level_any(const Sampler& sampler, const vec2<R>& uv, const R& lod) const;
  // A look-up of any format, written for the texels of one (texels.h), or for common samplers.
  template <class R, class Texels>
  struct AnyLookup;
  template <class R>
  struct CommonLookup;
  template <class R, class Function>
  vec4<R> with_texels(const Function& function) const;
  template <class R, class Function>
  vec4<R> with_lookup(const Sampler& sampler, const Function& function) const;

  // The first N channels (3 or 4).
  template <int N, class R>
  glm::vec<N, R> sample_channels(const Sampler& sampler, const vec2<R>& uv, const vec2<R>& duv_dx, const vec2<R>& duv_dy) const;
  template <int N, class R>
  glm::vec<N, R> sample_level_common(const Sampler& sampler, const vec2<R>& uv, R lod) const;
  template <class R>
  LevelChoice<R> choose_level(const Sampler& sampler, R lod) const;
  template <class R>
  Level<R> level(IntOf<R> index) const;
  template <class R>
  static R wrapped(R coordinate, Wrap wrap);
  template <class R>
  static Axis<R> axis(R coordinate, IntOf<R> size, MaskOf<R> nearest);
  template <int N, class R>
  glm::vec<N, R> filter_row(IntOf<R> index, R fraction) const;
  template <int N, class R>
  glm::vec<N, R> trilinear(const Sampler& sampler, const vec2<R>& uv, const LevelChoice<R>& levels) const;
  template <int N, class R>
  glm::vec<N, R> filter(const Sampler& sampler, const vec2<R>& st, IntOf<R> level_index, MaskOf<R> nearest) const;

  TexelFormat format_;
  int levels_ = 0;
  std::array<int32_t, kMaxLevels> width_{}, height_{}, offset_{};  // offset: index of a level's first texel
  // All levels, texel after texel as texels.h reads them; red in the low byte. After each row its first texel stands once
  // more, so that one 64-bit load brings an RGBA8 texel and its right neighbour, across the seam too.
  std::vector<int32_t, LineAllocator<int32_t>> texels_;
};

/// The full chain of levels below base, largest first, base not included; the last is 1 × 1.
///
/// A side of even size is halved by averaging pairs; one of odd size 2n + 1 becomes n, texel i being the area average of
/// [i, i + 1]·(2n + 1)/n, that is of three texels with the weights n − i, n, i + 1 over 2n + 1: centred, and every texel
/// counts the same. srgb8a8 is averaged in linear light. The chain is computed in float (8-bit codes) or double (all else)
/// from level to level, and only the results are rounded to texels. Channels are averaged one by one (alpha does not
/// weight colour), as GL's do. Texel is u8vec4 (rgba8, srgb8a8), uint8_t (r8), uint16_t (r16) or vec4 (rgba16f, rgba32f).
template <class Texel>
std::vector<Image<Texel>> mip_chain(const Image<Texel>& base, TexelFormat format);

// ---- the look-up, inlined into shaders --------------------------------------------------------------------------

template <class R>
HS_INLINE Texture2D::Level<R> Texture2D::level(IntOf<R> index) const {
  const int32_t first = lane(index, 0);
  if (all(index == IntOf<R>(first))) {  // as a rule
    const auto i = static_cast<std::size_t>(first);
    return {IntOf<R>(width_[i]), IntOf<R>(height_[i]), IntOf<R>(offset_[i])};
  }
  return {gather(width_.data(), index), gather(height_.data(), index), gather(offset_.data(), index)};
}

/// A coordinate brought into [0, 1]: all that follows is then in range. NaN becomes 0.
template <class R>
HS_INLINE R Texture2D::wrapped(R coordinate, Wrap wrap) {
  return clamp(wrap == Wrap::repeat ? coordinate - floor(coordinate) : coordinate, R(0.0f), R(1.0f));
}

/// Texel centres lie at i + 1/2. In: a coordinate in [0, 1].
template <class R>
HS_INLINE Texture2D::Axis<R> Texture2D::axis(R coordinate, IntOf<R> size, MaskOf<R> nearest) {
  const R n = to_real<R>(size);
  Axis<R> axis;
  if constexpr (std::is_same_v<R, double>) {
    const double u = coordinate * n - 0.5;
    axis = {truncate_to_int(floor(u)), u - floor(u)};
  } else {
    constexpr int kBits = 15;  // of the fraction; kMaxSize leaves room for them
    const IntOf<R> u = round_to_int(fma(coordinate, n * R(1 << kBits), R(-(1 << kBits) / 2)));
    axis = {u >> kBits, to_real<R>(u & ((1 << kBits) - 1)) * R(1.0f / (1 << kBits))};
  }
  if (any(nearest)) {
    axis.i = select(nearest, truncate_to_int(min(floor(coordinate * n), n - R(1.0f))), axis.i);
    axis.fraction = select(nearest, R(0.0f), axis.fraction);
  }
  return axis;
}

namespace detail {

/// Packed 8-bit RGBA as the numbers that are filtered: codes, and linear values where the format decodes.
template <class R>
HS_INLINE vec4<R> decode_rgba8(IntOf<R> texel, TexelFormat format) {
  const IntOf<R> r = texel & 255, g = (texel >> 8) & 255, b = (texel >> 16) & 255, a = (texel >> 24) & 255;
  if (format == TexelFormat::srgb8a8) return {srgb_to_linear<R>(r), srgb_to_linear<R>(g), srgb_to_linear<R>(b), to_real<R>(a)};
  return {to_real<R>(r), to_real<R>(g), to_real<R>(b), to_real<R>(a)};
}
/// Filtered numbers as linear values.
template <class R>
HS_INLINE vec3<R> rgba8_to_linear(const vec3<R>& c, TexelFormat format) {
  if (format == TexelFormat::srgb8a8) return c;
  return {unorm8_to_linear(c.x), unorm8_to_linear(c.y), unorm8_to_linear(c.z)};
}
template <class R>
HS_INLINE vec4<R> rgba8_to_linear(const vec4<R>& c, TexelFormat format) {
  return vec4<R>(rgba8_to_linear(vec3<R>(c), format), unorm8_to_linear(c.w));
}

/// a + f·(b − a) for 0 <= f <= 1 − 2^-15. It stays between a and b: the rounding of b − a lengthens it by at most 2^-24 of
/// itself, f shortens it by more, so before the last rounding, which is monotone, the result is between them.
template <class R>
HS_INLINE R lerp(R a, R b, R f) {
  return fma(f, b - a, a);
}
template <class R>
HS_INLINE vec3<R> lerp(const vec3<R>& a, const vec3<R>& b, R f) {
  return {lerp(a.x, b.x, f), lerp(a.y, b.y, f), lerp(a.z, b.z, f)};
}
template <class R>
HS_INLINE vec4<R> lerp(const vec4<R>& a, const vec4<R>& b, R f) {
  return {lerp(a.x, b.x, f), lerp(a.y, b.y, f), lerp(a.z, b.z, f), lerp(a.w, b.w, f)};
}

template <class I>
struct Pair {
  I first, second;
};
/// base[i] and base[i + 1]. Lanes load 64 bits each and are then sorted: faster than gathers, which pay by the element
/// (measured on Sapphire Rapids: bilinear −16% at 16 lanes, −34% at 8; 64-bit gathers gain nothing).
HS_INLINE Pair<int32_t> load_pairs(const int32_t* base, int32_t i) { return {base[i], base[i + 1]}; }
template <int W>
HS_INLINE Pair<IntN<W>> load_pairs(const int32_t* base, IntN<W> i) {
  using V = typename IntN<W>::V;
  alignas(64) int32_t at[W];
  store(at, i);
  [[maybe_unused]] const auto two = [&](int k) { return _mm_set_epi64x(load<int64_t>(base + at[k + 1]), load<int64_t>(base + at[k])); };
#ifdef __AVX512F__
  if constexpr (W == 16) {
    const auto four = [&](int k) { return _mm256_inserti128_si256(_mm256_castsi128_si256(two(k)), two(k + 2), 1); };
    const auto eight = [&](int k) { return _mm512_maskz_inserti64x4(0xff, _mm512_castsi256_si512(four(k)), four(k + 4), 1); };
    const __m512i a = eight(0), b = eight(8);
    const IntN<16> even = iota<IntN<16>>() << 1;
    return {IntN<W>((V)_mm512_permutex2var_epi32(a, (__m512i)even.v, b)),
            IntN<W>((V)_mm512_permutex2var_epi32(a, (__m512i)(even + 1).v, b))};
  }
#endif
#ifdef __AVX__
  if constexpr (W == 8) {  // a holds the pairs of lanes 0 1 4 5, b those of 2 3 6 7: the shuffle works within 128 bits
    const auto four = [&](int k) { return _mm256_castsi256_ps(_mm256_insertf128_si256(_mm256_castsi128_si256(two(k)), two(k + 4), 1)); };
    const __m256 a = four(0), b = four(2);
    return {IntN<W>((V)_mm256_castps_si256(_mm256_shuffle_ps(a, b, 0b10001000))),
            IntN<W>((V)_mm256_castps_si256(_mm256_shuffle_ps(a, b, 0b11011101)))};
  }
#endif
  if constexpr (W == 4) {
    const __m128 a = _mm_castsi128_ps(two(0)), b = _mm_castsi128_ps(two(2));
    return {IntN<W>((V)_mm_castps_si128(_mm_shuffle_ps(a, b, 0b10001000))), IntN<W>((V)_mm_castps_si128(_mm_shuffle_ps(a, b, 0b11011101)))};
  }
  Pair<IntN<W>> r;
  for (int k = 0; k < W; ++k) {
    set_lane(r.first, k, base[at[k]]);
    set_lane(r.second, k, base[at[k] + 1]);
  }
  return r;
}

}  // namespace detail

/// The texels at index and right of it, mixed.
template <int N, class R>
HS_INLINE glm::vec<N, R> Texture2D::filter_row(IntOf<R> index, R fraction) const {
  const auto texels = detail::load_pairs(texels_.data(), index);
  const auto decoded = [&](IntOf<R> texel) { return glm::vec<N, R>(detail::decode_rgba8<R>(texel, format_)); };
  return detail::lerp(decoded(texels.first), decoded(texels.second), fraction);
}

/// One level, bilinear or (where nearest) one texel, in filtering units. st in [0, 1].
template <int N, class R>
HS_INLINE glm::vec<N, R> Texture2D::filter(const Sampler& sampler, const vec2<R>& st, IntOf<R> level_index, MaskOf<R> nearest) const {
  const Level<R> l = level<R>(level_index);
  const IntOf<R> last_x = l.width - 1, last_y = l.height - 1, pitch = l.width + 1;
  Axis<R> x = axis<R>(st.x, l.width, nearest);
  const Axis<R> y = axis<R>(st.y, l.height, nearest);
  // Left of texel 0 lies the last one (its pair crosses the seam); or, where clamped, texel 0 alone, as the last at the end.
  if (sampler.wrap_s == Wrap::clamp) x.fraction = select(x.i >= 0 && x.i < last_x, x.fraction, R(0.0f));
  x.i = select(x.i < 0, sampler.wrap_s == Wrap::repeat ? last_x : IntOf<R>(0), x.i);
  const bool seam = sampler.wrap_t == Wrap::repeat;
  const IntOf<R> row0 = l.offset + select(y.i < 0, seam ? last_y : IntOf<R>(0), y.i) * pitch;
  if (all(nearest)) return glm::vec<N, R>(detail::decode_rgba8<R>(gather(texels_.data(), row0 + x.i), format_));
  const IntOf<R> row1 = l.offset + select(y.i < last_y, y.i + 1, seam ? IntOf<R>(0) : last_y) * pitch;
  return detail::lerp(filter_row<N, R>(row0 + x.i, x.fraction), filter_row<N, R>(row1 + x.i, x.fraction), y.fraction);
}

template <class R>
HS_INLINE Texture2D::LevelChoice<R> Texture2D::choose_level(const Sampler& sampler, R lod) const {
  const MaskOf<R> minified = lod > R(0.0f);
  const MaskOf<R> nearest = select(minified, MaskOf<R>(sampler.min == Filter::nearest), MaskOf<R>(sampler.mag == Filter::nearest));
  const float last = sampler.min == Filter::trilinear ? static_cast<float>(levels_ - 1) : 0.0f;
  const R held = clamp(lod, R(0.0f), R(last));
  // A fraction below 2^-14 is not worth a second level (it would shift a value by less than contrast/16384): a quad drawn
  // at its own size has a level of detail of some 1e-7.
  constexpr float kSnap = std::is_same_v<R, double> ? 0.0f : 0x1p-14f;
  const R whole = floor(held + R(kSnap));
  const R fraction = held - whole;
  return {truncate_to_int(whole), fraction, fraction > R(kSnap), nearest};
}

/// Mixed of one level or two, in filtering units.
template <int N, class R>
HS_INLINE glm::vec<N, R> Texture2D::trilinear(const Sampler& sampler, const vec2<R>& uv, const LevelChoice<R>& levels) const {
  const vec2<R> st(wrapped(uv.x, sampler.wrap_s), wrapped(uv.y, sampler.wrap_t));
  const glm::vec<N, R> c = filter<N, R>(sampler, st, levels.index, levels.nearest);
  if (!any(levels.between)) return c;
  const glm::vec<N, R> smaller = filter<N, R>(sampler, st, min(levels.index + 1, IntOf<R>(levels_ - 1)), levels.nearest);
  return select(levels.between, detail::lerp(c, smaller, levels.fraction), c);
}

template <int N, class R>
HS_INLINE glm::vec<N, R> Texture2D::sample_level_common(const Sampler& sampler, const vec2<R>& uv, R lod) const {
  return detail::rgba8_to_linear(trilinear<N, R>(sampler, uv, choose_level(sampler, lod)), format_);
}

template <Number R>
vec4<R> Texture2D::sample_level(const Sampler& sampler, const vec2<R>& uv, std::type_identity_t<R> lod) const {
  if (!is_common(sampler)) return sample_level_any<R>(sampler, uv, lod);
  return sample_level_common<4, R>(sampler, uv, lod);
}

template <int N, class R>
HS_INLINE glm::vec<N, R> Texture2D::sample_channels(const Sampler& sampler, const vec2<R>& uv, const vec2<R>& duv_dx,
                                                    const vec2<R>& duv_dy) const {
  if (!is_common(sampler) || sampler.anisotropy > 1) return glm::vec<N, R>(sample_any<R>(sampler, uv, duv_dx, duv_dy));
  const bool same_filter = (sampler.min == Filter::nearest) == (sampler.mag == Filter::nearest);
  if (same_filter && (sampler.min != Filter::trilinear || levels_ == 1)) return sample_level_common<N, R>(sampler, uv, R(0.0f));
  return sample_level_common<N, R>(sampler, uv, level_of_detail(width(), height(), duv_dx, duv_dy));
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
