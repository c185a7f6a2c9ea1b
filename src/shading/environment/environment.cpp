// SPDX-License-Identifier: Apache-2.0
//
// The lookup of EnvironmentMap, compiled once for all shaders. Lanes are independent: if they need different images, the images
// are sampled one after the other, and each lane keeps the result from its own image.
#include "halfspace/shading/environment/environment.h"

#include <algorithm>
#include <bit>
#include <numbers>

#include "halfspace/core/lane_math.h"

namespace halfspace::HS_LANES {

namespace {

template <class R>
HS_INLINE R inverse_pi() {
  if constexpr (std::is_same_v<R, double>)
    return std::numbers::inv_pi;
  else
    return R(std::numbers::inv_pi_v<float>);
}

// EnvironmentMap selects the levels itself; the lookup within a level is bilinear.
constexpr Sampler kSampler{.mag = Filter::bilinear, .min = Filter::bilinear, .wrap_s = Wrap::repeat, .wrap_t = Wrap::clamp};

// Returns a power of two whose product with the components of d is about 1, so that fourth powers of them neither overflow nor underflow.
template <class R>
HS_INLINE R unit_scale(const vec3<R>& d) {
  if constexpr (std::is_same_v<R, double>) {
    return 1.0;
  } else {
    const IntOf<R> exponent = as_int(max(max(abs(d.x), abs(d.y)), abs(d.z))) & IntOf<R>(0x7f800000);
    return as_real(IntOf<R>(0x7f000000) - min(max(exponent, IntOf<R>(0x00800000)), IntOf<R>(0x7e800000)));
  }
}

}  // namespace

// A step of the direction rotates it by the angle |d × step| / |d|².
template <class R>
EnvironmentMap::Coordinates<R> EnvironmentMap::panorama_coordinates(const vec3<R>& d_ms, const vec3<R>& dx_ms, const vec3<R>& dy_ms) const {
  const R scale = unit_scale(d_ms);
  const vec3<R> d = d_ms * scale, dx = dx_ms * scale, dy = dy_ms * scale;
  const auto squared = [](const vec3<R>& v) { return dot(v, v); };
  const R turn2 = max(squared(cross(d, dx)), squared(cross(d, dy))) / (squared(d) * squared(d));
  const R texels = R(std::max(0.5f * static_cast<float>(width()), static_cast<float>(height()))) * inverse_pi<R>();  // texels per radian
  const R u = fma(atan2(d.x, d.z), R(0.5f) * inverse_pi<R>(), R(0.5f));
  const R v = atan2(sqrt(fma(d.x, d.x, d.z * d.z)), d.y) * inverse_pi<R>();
  return {IntOf<R>(0), vec2<R>(u, v), R(0.5f) * log2(turn2 * (texels * texels))};
}

template <class R>
EnvironmentMap::Coordinates<R> EnvironmentMap::coordinates(const vec3<R>& d, const vec3<R>& dx, const vec3<R>& dy) const {
  return layout_ == EnvironmentLayout::cube ? detail::cube_coordinates(width(), d, dx, dy) : panorama_coordinates(d, dx, dy);
}

template <class R>
vec4<R> EnvironmentMap::fetch(const Coordinates<R>& at, IntOf<R> level) const {
  const IntOf<R> index = level * IntOf<R>(faces()) + at.face;
  vec4<R> light(R(0.0f));
  for (uint32_t left = bits(MaskOf<R>(true)); left != 0;) {
    const int32_t first = lane(index, std::countr_zero(left));
    const MaskOf<R> here = index == IntOf<R>(first);
    const Texture2D& texture = images_[static_cast<std::size_t>(first)];
    const auto inside = [](R coordinate, int whole) {  // skips a border of one texel on both sides
      return fma(coordinate, R(static_cast<float>(whole - 2)), R(1.0f)) / R(static_cast<float>(whole));
    };
    const bool cube = layout_ == EnvironmentLayout::cube;
    const vec2<R> uv(cube ? inside(at.st.x, texture.width()) : at.st.x, inside(at.st.y, texture.height()));
    light = select(here, texture.sample_level<R>(kSampler, uv, R(0.0f)), light);
    left &= ~bits(here);
  }
  return light;
}

template <class R>
vec3<R> EnvironmentMap::fetch_between_levels(const Coordinates<R>& at) const {
  const R clamped = clamp(at.lod, 0.0f, R(static_cast<float>(levels_ - 1)));
  const R whole = floor(clamped), fraction = clamped - whole;
  const IntOf<R> level = truncate_to_int(whole);
  const vec4<R> light = fetch(at, level);
  if (none(fraction > R(0.0f))) return vec3<R>(light);
  return vec3<R>(detail::lerp(light, fetch(at, min(level + 1, IntOf<R>(levels_ - 1))), fraction));
}

template <Number R>
vec3<R> EnvironmentMap::sample(const vec3<R>& d_ms, const vec3<R>& dx_ms, const vec3<R>& dy_ms) const {
  return fetch_between_levels(coordinates(d_ms, dx_ms, dy_ms));
}

template <Number R>
vec3<R> EnvironmentMap::sample_level(const vec3<R>& d_ms, std::type_identity_t<R> lod) const {
  const vec3<R> still(R(0.0f));
  Coordinates<R> at = coordinates(d_ms, still, still);
  at.lod = lod;
  return fetch_between_levels(at);
}

template <Number R>
R EnvironmentMap::level_of_detail(const vec3<R>& d_ms, const vec3<R>& dx_ms, const vec3<R>& dy_ms) const {
  return coordinates(d_ms, dx_ms, dy_ms).lod;
}

template vec3<float> EnvironmentMap::sample(const vec3<float>&, const vec3<float>&, const vec3<float>&) const;
template vec3<double> EnvironmentMap::sample(const vec3<double>&, const vec3<double>&, const vec3<double>&) const;
template vec3<RealN<4>> EnvironmentMap::sample(const vec3<RealN<4>>&, const vec3<RealN<4>>&, const vec3<RealN<4>>&) const;
template vec3<RealN<8>> EnvironmentMap::sample(const vec3<RealN<8>>&, const vec3<RealN<8>>&, const vec3<RealN<8>>&) const;
template vec3<FragmentReal> EnvironmentMap::sample(const vec3<FragmentReal>&, const vec3<FragmentReal>&, const vec3<FragmentReal>&) const;
template vec3<float> EnvironmentMap::sample_level(const vec3<float>&, float) const;
template vec3<double> EnvironmentMap::sample_level(const vec3<double>&, double) const;
template vec3<RealN<4>> EnvironmentMap::sample_level(const vec3<RealN<4>>&, RealN<4>) const;
template vec3<RealN<8>> EnvironmentMap::sample_level(const vec3<RealN<8>>&, RealN<8>) const;
template vec3<FragmentReal> EnvironmentMap::sample_level(const vec3<FragmentReal>&, FragmentReal) const;
template float EnvironmentMap::level_of_detail(const vec3<float>&, const vec3<float>&, const vec3<float>&) const;
template double EnvironmentMap::level_of_detail(const vec3<double>&, const vec3<double>&, const vec3<double>&) const;
template RealN<4> EnvironmentMap::level_of_detail(const vec3<RealN<4>>&, const vec3<RealN<4>>&, const vec3<RealN<4>>&) const;
template RealN<8> EnvironmentMap::level_of_detail(const vec3<RealN<8>>&, const vec3<RealN<8>>&, const vec3<RealN<8>>&) const;
template FragmentReal EnvironmentMap::level_of_detail(const vec3<FragmentReal>&, const vec3<FragmentReal>&,
                                                      const vec3<FragmentReal>&) const;
#if HALFSPACE_LANES == 16  // as in texture.cpp
template vec3<RealN<16>> EnvironmentMap::sample(const vec3<RealN<16>>&, const vec3<RealN<16>>&, const vec3<RealN<16>>&) const;
template vec3<RealN<16>> EnvironmentMap::sample_level(const vec3<RealN<16>>&, RealN<16>) const;
template RealN<16> EnvironmentMap::level_of_detail(const vec3<RealN<16>>&, const vec3<RealN<16>>&, const vec3<RealN<16>>&) const;
#endif

}  // namespace halfspace::HS_LANES
