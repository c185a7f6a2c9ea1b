// SPDX-License-Identifier: Apache-2.0
//
// A two-dimensional texture: 8-bit texels, mip levels, and the look-up that turns texture coordinates into a colour.
//
// In: coordinates (s, t) and their screen derivatives, or a level of detail. Out: linear RGBA. The rules are those of
// OpenGL 4.6, section 8.14 (scale factor, minification, magnification) and 8.15; row 0 of the image is t = 0.
//
// Filtering works on whole codes 0 … 255 (rgba8, and alpha) or on decoded linear values (the colour of srgb8a8). The
// fraction of a texel is rounded to 1/32768, finer than a float coordinate itself resolves from 512 texels on. With that
// the bilinear value of rgba8 is the exact one rounded once, and for every format: a constant texture gives exactly its
// constant, a fraction of zero exactly the texel, and no result leaves the interval of the texels it mixes.
// R = double filters in double with unrounded fractions (over the same decoded texels): the accuracy reference.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "core/image.h"
#include "core/lane_math.h"
#include "core/lanes.h"
#include "core/srgb.h"
#include "core/vec.h"

namespace halfspace {

enum class TexelFormat : uint8_t {
  rgba8,   ///< value = code/255
  srgb8a8  ///< red, green and blue sRGB-coded; alpha linear, code/255
};

/// GL's NEAREST and LINEAR (both of level 0) and LINEAR_MIPMAP_LINEAR. As a magnification filter trilinear means bilinear.
enum class Filter : uint8_t { nearest, bilinear, trilinear };
/// GL's REPEAT and CLAMP_TO_EDGE.
enum class Wrap : uint8_t { repeat, clamp };

/// How a texture is read: uniform state, kept apart from the texture as in GL's sampler objects.
struct Sampler {
  Filter mag = Filter::bilinear;   ///< where a texel is larger than a pixel (level of detail <= 0)
  Filter min = Filter::trilinear;  ///< where it is smaller
  Wrap wrap_s = Wrap::repeat;
  Wrap wrap_t = Wrap::repeat;
};

/// GL's λ (8.14.1, without bias): log2 of the longer of the two lengths that a pixel step to the right or up covers, in
/// texels of a level 0 of width × height. Zero derivatives give −inf.
template <Number R>
HS_INLINE R level_of_detail(int width, int height, const vec2<R>& duv_dx, const vec2<R>& duv_dy) {
  const R w(static_cast<float>(width)), h(static_cast<float>(height));
  const R ux = duv_dx.x * w, vx = duv_dx.y * h;
  const R uy = duv_dy.x * w, vy = duv_dy.y * h;
  return R(0.5f) * log2(max(fma(ux, ux, vx * vx), fma(uy, uy, vy * vy)));
}

/// An immutable texture. It owns its texels; any number of threads may read it at once.
class Texture2D {
 public:
  static constexpr int kMaxSize = 32768;  ///< per side: all levels together stay below 2^31 texels

  /// Level 0 from an image of 1 … kMaxSize texels a side, and all levels below it down to 1 × 1 by mip_chain.
  Texture2D(const Image<glm::u8vec4>& base, TexelFormat format);
  /// Given levels: level 0 as above, then each half of the one before, rounded down, but at least 1. At least one level;
  /// a shorter chain than down to 1 × 1 is allowed, and then ends the choice of levels.
  Texture2D(std::span<const Image<glm::u8vec4>> levels, TexelFormat format);

  int width(int level = 0) const { return width_[static_cast<std::size_t>(level)]; }
  int height(int level = 0) const { return height_[static_cast<std::size_t>(level)]; }
  int levels() const { return levels_; }
  TexelFormat format() const { return format_; }
  /// The codes of one texel; level, x and row must exist.
  glm::u8vec4 texel(int level, int x, int row) const;

  /// The filtered linear colour at uv, for a pixel whose steps to the right and up change uv by duv_dx and duv_dy.
  ///
  /// Any bits are allowed: a NaN or infinite coordinate reads as 0 or the edge (clamp; infinite) or as 0 (repeat); NaN
  /// derivatives mean level 0. Coordinates so large that a float has no fraction left read as 0 under repeat.
  template <Number R>
  vec4<R> sample(const Sampler& sampler, const vec2<R>& uv, const vec2<R>& duv_dx, const vec2<R>& duv_dy) const;

  /// The same with a given level of detail (0 is the largest level); lod <= 0 and NaN magnify.
  template <Number R>
  vec4<R> sample_level(const Sampler& sampler, const vec2<R>& uv, std::type_identity_t<R> lod) const;

 private:
  static constexpr std::size_t kMaxLevels = 16;

  // What one look-up in one level needs.
  template <class R>
  struct Level {
    IntOf<R> width, height, offset;
  };
  // The two texels of one axis, and the weight of the second.
  template <class R>
  struct Axis {
    IntOf<R> i0, i1;
    R fraction;
  };

  void add_level(const Image<glm::u8vec4>& image);
  template <class R>
  Level<R> level(IntOf<R> index) const;
  template <class R>
  static R wrapped(R coordinate, Wrap wrap);
  template <class R>
  static Axis<R> axis(R coordinate, IntOf<R> size, Wrap wrap, MaskOf<R> nearest);
  template <class R>
  vec4<R> fetch(IntOf<R> index) const;
  template <class R>
  vec4<R> filter(const Sampler& sampler, const vec2<R>& st, IntOf<R> level_index, MaskOf<R> nearest) const;

  TexelFormat format_;
  int levels_ = 0;
  std::array<int32_t, kMaxLevels> width_{}, height_{}, offset_{};  // offset: index of a level's first texel
  std::vector<int32_t> texels_;                                    // all levels; red in the low byte
};

/// The full chain of levels below base, largest first, base not included; the last is 1 × 1.
///
/// A side of even size is halved by averaging pairs; one of odd size 2n + 1 becomes n, texel i being the area average of
/// [i, i + 1]·(2n + 1)/n, that is of three texels with the weights n − i, n, i + 1 over 2n + 1: centred, and every texel
/// counts the same. srgb8a8 is averaged in linear light. The chain is computed in float from level to level and only
/// the results are rounded to codes. Channels are averaged one by one (alpha does not weight colour), as GL's do.
std::vector<Image<glm::u8vec4>> mip_chain(const Image<glm::u8vec4>& base, TexelFormat format);

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

/// Texel centres lie at i + 1/2. In: a coordinate in [0, 1]. Out: indices in [0, size − 1].
template <class R>
HS_INLINE Texture2D::Axis<R> Texture2D::axis(R coordinate, IntOf<R> size, Wrap wrap, MaskOf<R> nearest) {
  const R n = to_real<R>(size);
  const R u = fma(coordinate, n, R(-0.5f));  // in [−1/2, size − 1/2]
  R i = floor(u);
  R fraction = u - i;
  if constexpr (!std::is_same_v<R, double>) {
    fraction = (fraction + R(256.0f)) - R(256.0f);  // to a multiple of 2^-15, the last bit beside 256
    const MaskOf<R> up = fraction >= R(1.0f);
    i = select(up, i + R(1.0f), i);
    fraction = select(up, R(0.0f), fraction);
  }
  if (any(nearest)) {
    i = select(nearest, min(floor(coordinate * n), n - R(1.0f)), i);
    fraction = select(nearest, R(0.0f), fraction);
  }
  const IntOf<R> last = size - 1;
  const IntOf<R> before = wrap == Wrap::repeat ? last : IntOf<R>(0);   // what stands for texel −1
  const IntOf<R> behind = wrap == Wrap::repeat ? IntOf<R>(0) : last;   // and for texel size
  const IntOf<R> i0 = truncate_to_int(i);
  const IntOf<R> i1 = i0 + 1;
  return {select(i0 < 0, before, i0), select(i1 > last, behind, i1), fraction};
}

/// One texel as the numbers that are filtered: codes, and linear values where the format decodes.
template <class R>
HS_INLINE vec4<R> Texture2D::fetch(IntOf<R> index) const {
  const IntOf<R> texel = gather(texels_.data(), index);
  const IntOf<R> r = texel & 255, g = (texel >> 8) & 255, b = (texel >> 16) & 255, a = (texel >> 24) & 255;
  if (format_ == TexelFormat::srgb8a8) return {srgb_to_linear<R>(r), srgb_to_linear<R>(g), srgb_to_linear<R>(b), to_real<R>(a)};
  return {to_real<R>(r), to_real<R>(g), to_real<R>(b), to_real<R>(a)};
}

namespace detail {

/// a + f·(b − a), channel by channel. It stays between a and b: where b − a is not exact, b is more than twice a (or
/// less than half), and f <= 1 − 2^-15 keeps the result farther from b than the rounding of b − a could push it.
template <class R>
HS_INLINE vec4<R> lerp(const vec4<R>& a, const vec4<R>& b, R f) {
  return {fma(f, b.x - a.x, a.x), fma(f, b.y - a.y, a.y), fma(f, b.z - a.z, a.z), fma(f, b.w - a.w, a.w)};
}

}  // namespace detail

/// One level, bilinear or (where nearest) one texel, in filtering units. st in [0, 1].
template <class R>
HS_INLINE vec4<R> Texture2D::filter(const Sampler& sampler, const vec2<R>& st, IntOf<R> level_index, MaskOf<R> nearest) const {
  const Level<R> l = level<R>(level_index);
  const Axis<R> x = axis<R>(st.x, l.width, sampler.wrap_s, nearest);
  const Axis<R> y = axis<R>(st.y, l.height, sampler.wrap_t, nearest);
  const IntOf<R> row0 = l.offset + y.i0 * l.width;
  if (all(nearest)) return fetch<R>(row0 + x.i0);
  const IntOf<R> row1 = l.offset + y.i1 * l.width;
  const vec4<R> low = detail::lerp(fetch<R>(row0 + x.i0), fetch<R>(row0 + x.i1), x.fraction);
  const vec4<R> high = detail::lerp(fetch<R>(row1 + x.i0), fetch<R>(row1 + x.i1), x.fraction);
  return detail::lerp(low, high, y.fraction);
}

template <Number R>
vec4<R> Texture2D::sample_level(const Sampler& sampler, const vec2<R>& uv, std::type_identity_t<R> lod) const {
  const MaskOf<R> minified = lod > R(0.0f);
  const MaskOf<R> nearest = select(minified, MaskOf<R>(sampler.min == Filter::nearest), MaskOf<R>(sampler.mag == Filter::nearest));
  const vec2<R> st(wrapped(uv.x, sampler.wrap_s), wrapped(uv.y, sampler.wrap_t));

  const float last = sampler.min == Filter::trilinear ? static_cast<float>(levels_ - 1) : 0.0f;
  const R held = clamp(lod, R(0.0f), R(last));
  // A fraction below 2^-14 is not worth a second level (it would shift a value by less than contrast/16384): a quad drawn
  // at its own size has a level of detail of some 1e-7.
  constexpr float kSnap = std::is_same_v<R, double> ? 0.0f : 0x1p-14f;
  const R whole = floor(held + R(kSnap));
  const R fraction = held - whole;
  const MaskOf<R> between = fraction > R(kSnap);
  const IntOf<R> index = truncate_to_int(whole);

  vec4<R> c = filter<R>(sampler, st, index, nearest);
  if (any(between)) {
    const vec4<R> smaller = filter<R>(sampler, st, min(index + 1, IntOf<R>(levels_ - 1)), nearest);
    c = select(between, detail::lerp(c, smaller, fraction), c);
  }
  if (format_ == TexelFormat::srgb8a8) return {c.x, c.y, c.z, unorm8_to_linear(c.w)};
  return {unorm8_to_linear(c.x), unorm8_to_linear(c.y), unorm8_to_linear(c.z), unorm8_to_linear(c.w)};
}

template <Number R>
vec4<R> Texture2D::sample(const Sampler& sampler, const vec2<R>& uv, const vec2<R>& duv_dx, const vec2<R>& duv_dy) const {
  const bool same_filter = (sampler.min == Filter::nearest) == (sampler.mag == Filter::nearest);
  if (same_filter && (sampler.min != Filter::trilinear || levels_ == 1)) return sample_level(sampler, uv, R(0.0f));
  return sample_level(sampler, uv, level_of_detail(width(), height(), duv_dx, duv_dy));
}

}  // namespace halfspace
