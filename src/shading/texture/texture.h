// SPDX-License-Identifier: Apache-2.0
//
// Two-dimensional textures: texels, mip levels, and the lookup that converts texture coordinates to a color.
//
// A lookup takes coordinates (s, t) with their screen-space derivatives or a level of detail, and returns linear RGBA. It follows
// OpenGL 4.6, sections 8.14 (scale factor, wrapping, minification, magnification) and 8.15, and EXT_texture_filter_anisotropic.
// Row 0 of the image is t = 0. Images have their top row first, so t points down in the picture, whereas y points up in the window. A
// shader that samples a rendered image at the same place needs s = 0.5 + 0.5·x and t = 0.5 − 0.5·y of normalized device coordinates (x, y).
// OpenGL differs: row 0 of its framebuffers is the bottom row, so that t = 0.5 + 0.5·y there.
//
// Filtering uses integers (rgba8, r8, r16, and alpha of srgb8a8) or linear values (color of srgb8a8, the float formats, and all formats if
// an axis wraps to the border color). Texel fractions are rounded to 1/32768, which is the resolution of a float position at texel 256 and
// above. As a result, a bilinear lookup of rgba8 rounds the exact value once, before the division by 255. For every format, a constant
// texture gives exactly its constant, a fraction of zero gives exactly the texel, and no result is outside the range of the texels that it
// blends.
//
// Common lookups (rgba8, any wrap mode but the border, bilinear or trilinear) are inlined into shaders from this header. All others call
// texture.cpp.
// R = double filters in double with unrounded fractions, on the same decoded texels. It is the accuracy reference.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "halfspace/core/image.h"
#include "halfspace/core/lane_pairs.h"
#include "halfspace/core/lanes.h"
#include "halfspace/core/parallel.h"
#include "halfspace/core/vec.h"
#include "halfspace/shading/texture/footprint.h"
#include "halfspace/shading/texture/level_choice.h"
#include "halfspace/shading/texture/sampler.h"
#include "halfspace/shading/texture/texel_filter.h"
#include "halfspace/shading/texture/texture_axis.h"
#include "halfspace/shading/texture/texture_table.h"

namespace halfspace::HS_LANES {

/// An immutable texture that owns its texels. Any number of threads may read it concurrently.
///
/// The formats are r8, r16, rgba8, srgb8a8, rgba16f (always finite: values are clamped to ±65504, NaN becomes 0) and rgba32f (clamped to
/// ±kMaxTexel, NaN becomes 0). TextureView (texture_view.h) reads all formats, and textures of other kinds.
class Texture2D {
 public:
  static constexpr int kMaxSize = 32768;  ///< per side; all levels together must be smaller than 8 GiB

  /// Creates an rgba8 or srgb8a8 texture from level 0, which must have 1 … kMaxSize texels per side. The coarser levels, down to 1 x 1, are
  /// computed by mip_chain. If workers are given they share the work; the result is bit-identical.
  Texture2D(const Image<glm::u8vec4>& base, TexelFormat format, const Workers* workers = nullptr);
  explicit Texture2D(const Image<uint8_t>& base);   ///< r8
  explicit Texture2D(const Image<uint16_t>& base);  ///< r16
  /// rgba16f or rgba32f; base is linear.
  Texture2D(const Image<glm::vec4>& base, TexelFormat format, const Workers* workers = nullptr);
  /// Creates a texture from one or more given levels. Each level must be half the size of the previous one, rounded down but at least 1.
  /// The chain may end before 1 x 1; lookups then use only the given levels.
  Texture2D(std::span<const Image<glm::u8vec4>> levels, TexelFormat format);
  Texture2D(std::span<const Image<glm::vec4>> levels, TexelFormat format);  ///< rgba16f or rgba32f

  int width(int level = 0) const { return width_[static_cast<std::size_t>(level)]; }
  int height(int level = 0) const { return height_[static_cast<std::size_t>(level)]; }
  int levels() const { return levels_; }
  TexelFormat format() const { return format_; }
  /// Returns the stored 8-bit values of a texel of an rgba8 or srgb8a8 texture. level, x and row must be valid.
  glm::u8vec4 texel(int level, int x, int row) const;
  /// Returns the linear color of a texel of any format. level, x and row must be valid.
  glm::vec4 value(int level, int x, int row) const;

  /// Returns the filtered linear color at uv. duv_dx and duv_dy are the changes in uv to the next pixel to the right and to the
  /// next pixel up. If uv is a varying times a factor, its derivatives must be multiplied as well; otherwise the mip level is wrong.
  ///
  /// All inputs are safe. A NaN coordinate is treated as 0 or as the border. An infinite one is treated as the edge (clamp), the border,
  /// or 0 (repeat, mirrored). A level of detail that is NaN means level 0, and NaN derivatives mean one probe. With repeat,
  /// coordinates that are so large that a float has no fraction bits are treated as 0.
  template <Number R>
  vec4<R> sample(const Sampler& sampler, const vec2<R>& uv, const vec2<R>& duv_dx, const vec2<R>& duv_dy) const;

  /// Returns only red, green and blue. Most shaders do not need alpha.
  template <Number R>
  vec3<R> sample_rgb(const Sampler& sampler, const vec2<R>& uv, const vec2<R>& duv_dx, const vec2<R>& duv_dy) const;

  /// Returns only alpha, which is all that an alpha test needs.
  template <Number R>
  R sample_alpha(const Sampler& sampler, const vec2<R>& uv, const vec2<R>& duv_dx, const vec2<R>& duv_dy) const;

  /// Samples at a given level of detail, where 0 is the finest level. lod <= 0 and NaN use the magnification filter.
  template <Number R>
  vec4<R> sample_level(const Sampler& sampler, const vec2<R>& uv, std::type_identity_t<R> lod) const;

 private:
  static constexpr auto kMaxLevels = static_cast<std::size_t>(detail::kMaxLevels);

  template <class R>
  using LevelChoice = detail::LevelChoice<R>;
  // The properties of a level that a lookup needs.
  template <class R>
  struct Level {
    IntOf<R> width, height, offset, pitch;
    R columns, rows;  // width and height as floats
  };
  template <class Texel>
  void add_chain(const Image<Texel>& base, const Workers* workers);
  template <class Texel>
  void add_levels(std::span<const Image<Texel>> levels);
  template <class Texel>
  void add_level(const Image<Texel>& image, const Workers* workers);
  void add_alphas(const Workers* workers);
  std::size_t index_of(int level, int x, int row) const;

  /// Returns whether CommonLookup supports this sampler.
  bool is_common(const Sampler& sampler) const {
    const bool has_four_channels = format_ != TexelFormat::r8 && format_ != TexelFormat::r16;
    return has_four_channels && is_common(sampler.wrap_s) && is_common(sampler.wrap_t) && is_common(sampler.mag) &&
           is_common(sampler.min) && sampler.lod == LodControl{};
  }
  static bool is_common(Wrap wrap) { return wrap <= Wrap::clamp; }
  static bool is_common(Filter filter) { return filter == Filter::bilinear || filter == Filter::trilinear; }
  static bool has_border(const Sampler& sampler) { return sampler.wrap_s == Wrap::border || sampler.wrap_t == Wrap::border; }
  // Implementations of sample and sample_level for every format and sampler, in texture.cpp, for all Number types. They are pure, so that a
  // call does not keep the compiler from dropping unused values of the shader.
  template <class R>
  __attribute__((pure)) vec4<R> sample_any(const Sampler& sampler, const vec2<R>& uv, const vec2<R>& duv_dx, const vec2<R>& duv_dy) const;
  template <class R>
  __attribute__((pure)) vec4<R> sample_level_any(const Sampler& sampler, const vec2<R>& uv, const R& lod) const;
  // A lookup in a format with four channels, for common samplers. Value selects the channels: vec4, vec3 (no alpha) or, if alphas_ is not
  // empty, R (only alpha).
  template <class Value, TexelFormat texel_format, class R>
  struct CommonLookup;
  template <class R, class Function>
  vec4<R> with_lookup(const Sampler& sampler, const Function& function) const;
  template <class R>
  vec4<R> sample_levels(const Sampler& sampler, const vec2<R>& uv, const LevelChoice<R>& levels) const;

  template <class Value, class R>
  Value sample_channels(const Sampler& sampler, const vec2<R>& uv, const vec2<R>& duv_dx, const vec2<R>& duv_dy) const;
  /// Selects the levels for derivatives, for samplers without special levels (level_choice.h).
  template <class R>
  LevelChoice<R> levels_of(const Sampler& sampler, const vec2<R>& duv_dx, const vec2<R>& duv_dy) const;
  template <class R>
  Level<R> level(IntOf<R> index) const;

  TexelFormat format_;
  int levels_ = 0;
  std::array<int32_t, kMaxLevels> width_{}, height_{}, offset_{}, pitch_{};  // offset: index of texel (0, 0) of a level
  std::array<int32_t, kMaxLevels> columns_{}, rows_{};                       // width and height as bits of floats
  detail::TextureTable table_;                                               // the same levels, for lookups that are not common
  // All levels, in the formats of core/texel_format.h, where srgb8a8 and rgba8 are words. Each level has a border of one texel that repeats
  // the opposite edge, so that neighbors are adjacent in memory even across the seams. The last texels are followed by a few words that
  // gather_row may read.
  std::vector<int32_t, CacheLineAllocator<int32_t>> texels_;
  // Only for 8-bit formats with four channels whose alpha is not the same everywhere: the alpha of each texel in the low byte, and of the
  // texel above it in the high byte. sample_alpha finds all it needs with one load.
  std::vector<uint16_t, CacheLineAllocator<uint16_t>> alphas_;
};

/// Computes all coarser mip levels of base, finest first. base is not included; the last level is 1 x 1.
///
/// An even size is halved by averaging pairs. An odd size 2n + 1 becomes n: texel i is the area average over [i, i + 1]·(2n + 1)/n, i.e.
/// three texels with weights n − i, n, i + 1 divided by 2n + 1. This keeps the levels centered and gives every texel the same total weight.
/// srgb8a8 is averaged in linear light. Each level is computed from the unrounded previous one, in float (8-bit formats) or double (all
/// others), and only the results are rounded to texels. Channels are averaged separately, as in OpenGL, so alpha does not weight color. If
/// workers are given they share the work; the result is bit-identical. Texel is u8vec4 (rgba8, srgb8a8), uint8_t (r8), uint16_t (r16) or
/// vec4 (rgba16f, rgba32f).
template <class Texel>
std::vector<Image<Texel>> mip_chain(const Image<Texel>& base, TexelFormat format, const Workers* workers = nullptr);

// ---- the lookup, inlined into shaders ---------------------------------------------------------------------------

template <class R>
HS_INLINE Texture2D::Level<R> Texture2D::level(IntOf<R> index) const {
  if constexpr (kIsLanes<R>) {  // most packets read the same level in all lanes
    const auto i = static_cast<std::size_t>(lane(index, 0));
    if (all(index == IntOf<R>(lane(index, 0)))) {
      const auto real = [i](const auto& table) { return R(std::bit_cast<float>(table[i])); };
      return {width_[i], height_[i], offset_[i], pitch_[i], real(columns_), real(rows_)};
    }
  }
  return {look_up(width_, index),
          look_up(height_, index),
          look_up(offset_, index),
          look_up(pitch_, index),
          R(as_real(look_up(columns_, index))),
          R(as_real(look_up(rows_, index)))};
}

template <class Value, TexelFormat texel_format, class R>
struct Texture2D::CommonLookup {
  const Texture2D& texture;
  const Sampler& sampler;

  /// With clamping and mirroring, positions beyond the center of the outermost texel use only that texel.
  using Axis = detail::Axis<R>;

  HS_INLINE static Axis clamped(const Axis& a, IntOf<R> size, Wrap wrap) {
    if (wrap == Wrap::repeat) return a;
    const MaskOf<R> between = a.i >= 0 && a.i < size - 1;
    return {max(a.i, IntOf<R>(0)), select(between, a.fraction, R(0.0f)), select(between, a.steps, IntOf<R>(0))};
  }

  /// Filters one level, in filtering units. st must be in [0, 1].
  HS_INLINE Value filter(const vec2<R>& st, IntOf<R> level_index) const {
    const Level<R> l = texture.level<R>(level_index);
    const Axis x = clamped(detail::axis(st.x, l.columns), l.width, sampler.wrap_s),
               y = clamped(detail::axis(st.y, l.rows), l.height, sampler.wrap_t);
    const IntOf<R> row = y.i * l.pitch + (l.offset + x.i);  // adds the product last, because it has the longest latency
    if constexpr (std::is_same_v<Value, R>) {
      return detail::filtered_alpha(detail::AlphaSquare<R>{texture.alphas_.data(), row, x.fraction, y.fraction});
    } else {
      return detail::filtered<Value, texel_format>(
          detail::TexelSquare<R>{texture.texels_.data(), row, row + l.pitch, x.fraction, y.fraction, x.steps});
    }
  }

  /// Filters one or two levels, in filtering units.
  HS_INLINE Value operator()(const vec2<R>& uv, const LevelChoice<R>& levels) const {
    const vec2<R> st(detail::wrapped(uv.x, sampler.wrap_s), detail::wrapped(uv.y, sampler.wrap_t));
    const Value c = filter(st, levels.index);
    if (!any(levels.between)) return c;
    return detail::lerp(c, filter(st, min(levels.index + 1, IntOf<R>(texture.levels_ - 1))), levels.fraction);
  }

  HS_INLINE Value finish(const Value& v) const {
    if constexpr (texel_format == TexelFormat::rgba16f || texel_format == TexelFormat::rgba32f)
      return v;
    else
      return detail::rgba8_to_linear<texel_format>(v);
  }
};

namespace detail {

/// Coefficients of log2(1 + f)/f for log2_of_normal. Levels of detail are accurate to 2^-16, so results change by less than 1/65536 of the
/// difference between the levels.
inline constexpr float kLevelLog2[] = {1.44264627f, -0.720555007f, 0.485306472f, -0.390892416f, 0.254752129f};

}  // namespace detail

/// The integer part of the level is half the exponent of ρ², so texels can be fetched before the logarithm is known.
template <class R>
HS_INLINE detail::LevelChoice<R> Texture2D::levels_of(const Sampler& sampler, const vec2<R>& duv_dx, const vec2<R>& duv_dy) const {
  const bool same_filter = (sampler.min == Filter::nearest) == (sampler.mag == Filter::nearest);
  if (same_filter && (sampler.min != Filter::trilinear || levels_ == 1))
    return detail::choose_common_level(sampler, levels_, R(0.0f), IntOf<R>(0));
  const R rho2 = max(squared_scale_factor(width(), height(), duv_dx, duv_dy), R(0x1p-126f));  // NaN gives level 0, too
  if constexpr (std::is_same_v<R, double>) {
    return detail::choose_common_level(sampler, levels_, detail::kMaxLevels, 0.5 * log2(rho2));
  } else {
    constexpr float kSnapFactor = 1.0f + 2 * 0.693147181f * detail::kLevelSnap<R>;
    const IntOf<R> exponent = (as_int(rho2 * R(kSnapFactor)) >> 23) - 127;
    return detail::choose_common_level(sampler, levels_, R(0.5f) * detail::log2_of_normal(rho2, detail::kLevelLog2), exponent >> 1);
  }
}

template <Number R>
vec4<R> Texture2D::sample_level(const Sampler& sampler, const vec2<R>& uv, std::type_identity_t<R> lod) const {
  if (format_ != TexelFormat::rgba8 || !is_common(sampler)) return sample_level_any<R>(sampler, uv, lod);
  const CommonLookup<vec4<R>, TexelFormat::rgba8, R> lookup{*this, sampler};
  return lookup.finish(lookup(uv, detail::choose_common_level(sampler, levels_, detail::kMaxLevels, lod)));
}

template <class Value, class R>
HS_INLINE Value Texture2D::sample_channels(const Sampler& sampler, const vec2<R>& uv, const vec2<R>& duv_dx, const vec2<R>& duv_dy) const {
  if (format_ != TexelFormat::rgba8 || !is_common(sampler) || sampler.anisotropy > 1) {
    return Value(sample_any<R>(sampler, uv, duv_dx, duv_dy));
  }
  const CommonLookup<Value, TexelFormat::rgba8, R> lookup{*this, sampler};
  return lookup.finish(lookup(uv, levels_of(sampler, duv_dx, duv_dy)));
}

// These functions are always inlined. Otherwise, g++ calls them in large shaders and passes all lanes through memory.
template <Number R>
HS_INLINE vec4<R> Texture2D::sample(const Sampler& sampler, const vec2<R>& uv, const vec2<R>& duv_dx, const vec2<R>& duv_dy) const {
  return sample_channels<vec4<R>, R>(sampler, uv, duv_dx, duv_dy);
}
template <Number R>
HS_INLINE vec3<R> Texture2D::sample_rgb(const Sampler& sampler, const vec2<R>& uv, const vec2<R>& duv_dx, const vec2<R>& duv_dy) const {
  return sample_channels<vec3<R>, R>(sampler, uv, duv_dx, duv_dy);
}
template <Number R>
HS_INLINE R Texture2D::sample_alpha(const Sampler& sampler, const vec2<R>& uv, const vec2<R>& duv_dx, const vec2<R>& duv_dy) const {
  if constexpr (!std::is_same_v<R, double>) {
    if (format_ == TexelFormat::rgba8 || format_ == TexelFormat::srgb8a8) {
      const CommonLookup<R, TexelFormat::rgba8, R> lookup{*this, sampler};
      if (alphas_.empty() && !has_border(sampler)) return lookup.finish(R(static_cast<float>(static_cast<uint32_t>(texels_[0]) >> 24)));
      if (is_common(sampler) && sampler.anisotropy <= 1) return lookup.finish(lookup(uv, levels_of(sampler, duv_dx, duv_dy)));
    }
  }
  return sample_any<R>(sampler, uv, duv_dx, duv_dy).w;
}

}  // namespace halfspace::HS_LANES
