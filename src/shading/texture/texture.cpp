// SPDX-License-Identifier: Apache-2.0
//
// The lookup of Texture2D for every format, wrap mode, filter and anisotropy. Common lookups of rgba8 without anisotropy are inlined from
// texture.h.
#include "halfspace/shading/texture/texture.h"

#include "halfspace/shading/texture/texture_lookup.h"

namespace halfspace::HS_LANES {

namespace {

/// A texture that is not common: its memory and its levels.
struct AnyTexture {
  const std::byte* base;
  const detail::TextureTable& table;
};

/// A lookup for any sampler.
template <class R, class Texels>
struct AnyLookup {
  const detail::TextureLookup<R, Texels, detail::OnlyTwoD>& lookup;

  HS_INLINE vec4<R> operator()(const vec2<R>& uv, const detail::LevelChoice<R>& levels) const { return lookup(place(uv), levels); }
  HS_INLINE vec4<R> finish(const vec4<R>& v) const { return lookup.finish(v); }
  /// Returns the color of the nearest texel of level 0.
  HS_INLINE vec4<R> nearest(const vec2<R>& uv) const { return finish(lookup.nearest_texel(lookup.table.level[0], place(uv))); }

 private:
  HS_INLINE static detail::LevelPlace<R> place(const vec2<R>& uv) { return {vec3<R>(uv, R(0.0f)), IntOf<R>(0)}; }
};

/// Returns whether a sampler always reads the nearest texel of level 0.
bool reads_one_texel(const Sampler& sampler) {
  return sampler.mag == Filter::nearest && sampler.min == Filter::nearest && sampler.anisotropy <= 1 &&
         !detail::has_special_levels(sampler);
}

/// Not inlined, so that common lookups do not pay for its variables.
template <class R, class Texels, class Function>
__attribute__((noinline)) vec4<R> call_with_lookup(const AnyTexture& texture, const Sampler& sampler, const Function& function) {
  const Texels texels;
  const detail::TextureLookup<R, Texels, detail::OnlyTwoD> lookup{texture.base, texture.table, sampler, texels};
  return function(AnyLookup<R, Texels>{lookup});
}

/// Calls function with an AnyLookup of the texture.
template <class R, class Function>
HS_INLINE vec4<R> with_any_lookup(const AnyTexture& texture, const Sampler& sampler, const Function& function) {
  switch (texture.table.format) {
    case TexelFormat::rgba8: return call_with_lookup<R, detail::FourBytes<R, TexelFormat::rgba8>>(texture, sampler, function);
    case TexelFormat::srgb8a8: return call_with_lookup<R, detail::FourBytes<R, TexelFormat::srgb8a8>>(texture, sampler, function);
    default: return call_with_lookup<R, detail::AllChannels<R>>(texture, sampler, function);
  }
}

}  // namespace

/// Calls function with a lookup that supports this texture and the sampler: lookup(uv, levels) returns a value to blend, which
/// lookup.finish(value) converts to a color.
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
  return with_any_lookup<R>(AnyTexture{reinterpret_cast<const std::byte*>(texels_.data()), table_}, sampler, function);
}

template <class R>
vec4<R> Texture2D::sample_levels(const Sampler& sampler, const vec2<R>& uv, const LevelChoice<R>& levels) const {
  return with_lookup<R>(sampler, [&](const auto& lookup) { return lookup.finish(lookup(uv, levels)); });
}

template <class R>
vec4<R> Texture2D::sample_level_any(const Sampler& sampler, const vec2<R>& uv, const R& lod) const {
  return sample_levels(sampler, uv, detail::choose_level(sampler, levels_, detail::kMaxLevels, lod));
}

template <class R>
vec4<R> Texture2D::sample_any(const Sampler& sampler, const vec2<R>& uv, const vec2<R>& duv_dx, const vec2<R>& duv_dy) const {
  if (reads_one_texel(sampler))
    return with_any_lookup<R>(AnyTexture{reinterpret_cast<const std::byte*>(texels_.data()), table_}, sampler,
                              [&](const auto& lookup) { return lookup.nearest(uv); });
  if (sampler.anisotropy <= 1) {
    if (detail::has_special_levels(sampler)) return sample_level_any(sampler, uv, level_of_detail(width(), height(), duv_dx, duv_dy));
    return sample_levels(sampler, uv, levels_of(sampler, duv_dx, duv_dy));
  }
  const Footprint<R> area = footprint(width(), height(), duv_dx, duv_dy, std::min(sampler.anisotropy, kMaxAnisotropy));
  const LevelChoice<R> levels = detail::choose_level(sampler, levels_, detail::kMaxLevels, area.lod);
  return with_lookup<R>(sampler, [&](const auto& lookup) {
    return lookup.finish(detail::mean_of_probes<R>(
        area, [&](R along) __attribute__((always_inline)) {
          return lookup(vec2<R>(fma(area.span.x, along, uv.x), fma(area.span.y, along, uv.y)), levels);
        }));
  });
}

glm::vec4 Texture2D::value(int level, int x, int row) const {
  index_of(level, x, row);  // checks the arguments
  const detail::TextureLevel& l = table_.level[static_cast<std::size_t>(level)];
  const int stride = texel_info(format_).bytes / detail::texel_unit(format_);
  const detail::TexelReader<float> texels{format_, reinterpret_cast<const std::byte*>(texels_.data()) + l.offset};
  return texels.to_linear(texels(row * l.row_pitch + x * stride));
}

template vec4<float> Texture2D::sample_any(const Sampler&, const vec2<float>&, const vec2<float>&, const vec2<float>&) const;
template vec4<double> Texture2D::sample_any(const Sampler&, const vec2<double>&, const vec2<double>&, const vec2<double>&) const;
template vec4<RealN<4>> Texture2D::sample_any(const Sampler&, const vec2<RealN<4>>&, const vec2<RealN<4>>&, const vec2<RealN<4>>&) const;
template vec4<RealN<8>> Texture2D::sample_any(const Sampler&, const vec2<RealN<8>>&, const vec2<RealN<8>>&, const vec2<RealN<8>>&) const;
template vec4<FragmentReal> Texture2D::sample_any(const Sampler&, const vec2<FragmentReal>&, const vec2<FragmentReal>&,
                                                  const vec2<FragmentReal>&) const;
template vec4<float> Texture2D::sample_level_any(const Sampler&, const vec2<float>&, const float&) const;
template vec4<double> Texture2D::sample_level_any(const Sampler&, const vec2<double>&, const double&) const;
template vec4<RealN<4>> Texture2D::sample_level_any(const Sampler&, const vec2<RealN<4>>&, const RealN<4>&) const;
template vec4<RealN<8>> Texture2D::sample_level_any(const Sampler&, const vec2<RealN<8>>&, const RealN<8>&) const;
template vec4<FragmentReal> Texture2D::sample_level_any(const Sampler&, const vec2<FragmentReal>&, const FragmentReal&) const;
// On builds with 8 lanes, GCC 12 would need 70 s for these two, which nothing there uses.
#if HALFSPACE_LANES == 16
template vec4<RealN<16>> Texture2D::sample_any(const Sampler&, const vec2<RealN<16>>&, const vec2<RealN<16>>&,
                                               const vec2<RealN<16>>&) const;
template vec4<RealN<16>> Texture2D::sample_level_any(const Sampler&, const vec2<RealN<16>>&, const RealN<16>&) const;
#endif

}  // namespace halfspace::HS_LANES
