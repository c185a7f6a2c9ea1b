// SPDX-License-Identifier: Apache-2.0
//
// Conversion from linear light to display values: exposure, tone mapping, display encoding and dithering.
//
//   SceneLight ── tone_map ──→ DisplayLight ── encode_srgb, encode_gamma ──→ Encoded
//   linear, unbounded           linear, [0, 1]                                 [0, 1], in 8 bits value/255
//
// These are separate types, so that nothing can be encoded twice or displayed without a tone curve.
//
// The curves are functions of x >= 0, the light times the exposure. After clamping to 1 they are monotonic, map 0 to 0,
// and reach or approach 1:
//   none               x
//   reinhard           x / (1 + x)                              Reinhard, Stark, Shirley and Ferwerda, "Photographic Tone
//   reinhard_extended  x (1 + x/w²) / (1 + x), 1 at x = w         Reproduction for Digital Images", 2002, equations 3 and 4
//   exponential        1 − e^(−x): with exposure k, 1 − e^(−k·light)
//   aces               x (2.51 x + 0.03) / (x (2.43 x + 0.59) + 0.14): Narkowicz, "ACES Filmic Tone Mapping Curve", 2015; it
//                      peaks at 1.033 and is clamped to 1
//
// NaN and negative light count as 0. Infinite light gives the limit of the curve, clamped to 1, or 0 if the exposure is 0.
#pragma once

#include <array>

#include "halfspace/core/lane_math.h"
#include "halfspace/core/srgb_curve.h"
#include "halfspace/core/vec.h"
#include "halfspace/shading/values/tone_types.h"

namespace halfspace::HS_LANES {

template <class R>
struct SceneLight {
  vec3<R> rgb;  ///< linear, unbounded
};
template <class R>
struct DisplayLight {
  vec3<R> rgb;  ///< linear, in [0, 1]
};
template <class R>
struct Encoded {
  vec3<R> rgb;  ///< in [0, 1]
};

/// Upper limit of light: large enough for every curve to reach its limit, small enough for its square to be a float.
inline constexpr float kMaxLight = 1e15f;

/// Returns the Rec. 709 luminance of linear light (ITU-R BT.709-6, section 3).
template <Number R>
HS_INLINE R luminance(const vec3<R>& rgb) {
  return fma(R(0.2126f), rgb.x, fma(R(0.7152f), rgb.y, R(0.0722f) * rgb.z));
}

/// Clamps a channel to [0, kMaxLight]. NaN becomes 0.
template <Number R>
HS_INLINE R clamp_light(R x) {
  return clamp(x, 0.0f, kMaxLight);
}

/// Returns the value of the curve at 0 <= x <= kMaxLight, not clamped to 1.
template <Number R>
HS_INLINE R tone_curve(ToneCurve curve, R x, float white) {
  const R one(1.0f);
  switch (curve) {
    case ToneCurve::none: return x;
    case ToneCurve::reinhard: return x / (one + x);
    case ToneCurve::reinhard_extended: return x * (one + x / R(white * white)) / (one + x);
    case ToneCurve::exponential: {
      // Uses the series where 1 − e^(−x) would suffer from cancellation; the truncation error is below a relative 2e-9.
      const R series = x * (one - x * (R(1.0f / 2) - x * (R(1.0f / 6) - x * (R(1.0f / 24) - x * R(1.0f / 120)))));
      return select(x < R(0.0625f), series, one - exp(-x));
    }
    case ToneCurve::aces: return x * fma(R(2.51f), x, R(0.03f)) / fma(x, fma(R(2.43f), x, R(0.59f)), R(0.14f));
  }
  return x;
}

/// Applies exposure and the tone curve, either to each channel or to the luminance. In the latter case all channels are scaled by
/// the same factor, which preserves the hue except where a channel is clamped to 1.
template <Number R>
HS_INLINE DisplayLight<R> tone_map(const SceneLight<R>& light, const ToneMapping& tone) {
  vec3<R> c;
  for (int k = 0; k < 3; ++k) c[k] = min(clamp_light(light.rgb[k]) * R(tone.exposure), R(kMaxLight));
  if (tone.on == ToneOn::luminance) {
    const R y = luminance(c);
    const R factor = tone_curve(tone.curve, y, tone.white) / max(y, R(1e-30f));
    c = c * factor;
  } else {
    for (int k = 0; k < 3; ++k) c[k] = tone_curve(tone.curve, c[k], tone.white);
  }
  for (int k = 0; k < 3; ++k) c[k] = clamp(c[k], 0.0f, 1.0f);
  return {c};
}

/// Applies the sRGB transfer function to each channel (core/srgb_curve.h).
template <Number R>
HS_INLINE Encoded<R> encode_srgb(const DisplayLight<R>& light) {
  vec3<R> e;
  for (int k = 0; k < 3; ++k) e[k] = srgb_curve(light.rgb[k]);
  return {e};
}

/// Encodes each channel as x^(1/gamma). gamma must be positive.
template <Number R>
HS_INLINE Encoded<R> encode_gamma(const DisplayLight<R>& light, float gamma) {
  vec3<R> e;
  for (int k = 0; k < 3; ++k) e[k] = min(pow(light.rgb[k], R(1.0f / gamma)), R(1.0f));
  return {e};
}

/// Returns the threshold at pixel (x, y) of the 8x8 matrix of ordered dithering (Bayer, "An optimum method for two-level rendition of
/// continuous-tone pictures", 1973). Each value (k + 1/2)/64, k = 0 … 63, occurs once in every aligned 8x8 block.
template <Number R>
HS_INLINE R dither_threshold(IntOf<R> x, IntOf<R> y) {
  const IntOf<R> a = x ^ y;
  const auto bit = [](IntOf<R> v, int from, int to) { return ((v >> from) & 1) << to; };
  const IntOf<R> rank = bit(a, 0, 5) | bit(y, 0, 4) | bit(a, 1, 3) | bit(y, 1, 2) | bit(a, 2, 1) | bit(y, 2, 0);
  return (to_real<R>(rank) + R(0.5f)) * R(1.0f / 64.0f);
}

/// Rounds each channel down or up to a multiple of 1/255, depending on the threshold. Over an aligned 8x8 block of equal values the mean is
/// within 1/128 LSB of that value. 0 and 1 are unchanged.
template <Number R>
HS_INLINE Encoded<R> dithered(const Encoded<R>& e, R threshold) {
  vec3<R> codes;
  for (int k = 0; k < 3; ++k) codes[k] = floor(fma(e.rgb[k], R(255.0f), threshold)) * R(1.0f / 255.0f);
  return {codes};
}

}  // namespace halfspace::HS_LANES
