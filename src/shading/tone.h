// SPDX-License-Identifier: Apache-2.0
//
// From light to codes: exposure, tone curve, display encoding, dithering.
//
//   SceneLight ── tone_map ──→ DisplayLight ── encode_srgb, encode_gamma ──→ Encoded
//   any linear number           linear, [0, 1]                                 [0, 1], what a code over 255 means
//
// The three are types of their own, so that nothing is encoded twice or shown without its curve.
//
// Curves of x >= 0, light times exposure. All of them never fall (after being held to 1), give 0 for 0 and 1 at last:
//   none               x
//   reinhard           x / (1 + x)                              Reinhard, Stark, Shirley and Ferwerda, "Photographic Tone
//   reinhard_extended  x (1 + x/w²) / (1 + x), 1 at x = w         Reproduction for Digital Images", 2002, equations 3 and 4
//   exponential        1 − e^(−x): with exposure k, 1 − e^(−k·light)
//   aces               x (2.51 x + 0.03) / (x (2.43 x + 0.59) + 0.14): Narkowicz, "ACES Filmic Tone Mapping Curve", 2015; it
//                      peaks at 1.033 and is held to 1
//
// NaN and what is below 0 count as 0; infinite light gives the curve's limit, held to 1, and 0 at exposure 0.
#pragma once

#include <array>

#include "halfspace/core/lane_math.h"
#include "halfspace/core/srgb_curve.h"
#include "halfspace/core/vec.h"
#include "halfspace/shading/tone_types.h"

namespace halfspace {

template <class R>
struct SceneLight {
  vec3<R> rgb;  ///< linear, any number
};
template <class R>
struct DisplayLight {
  vec3<R> rgb;  ///< linear, in [0, 1]
};
template <class R>
struct Encoded {
  vec3<R> rgb;  ///< in [0, 1]
};

/// Light beyond it counts as this much: enough for every curve to end, little enough for their squares to be floats.
inline constexpr float kMaxLight = 1e15f;

/// Rec. 709 (ITU-R BT.709-6, section 3): the luminance of linear light.
template <Number R>
HS_INLINE R luminance(const vec3<R>& rgb) {
  return fma(R(0.2126f), rgb.x, fma(R(0.7152f), rgb.y, R(0.0722f) * rgb.z));
}

/// A channel without what no curve can take.
template <Number R>
HS_INLINE R sound_light(R x) {
  return clamp(x, 0.0f, kMaxLight);
}

/// The curve at 0 <= x <= kMaxLight, not held to 1.
template <Number R>
HS_INLINE R tone_curve(ToneCurve curve, R x, float white) {
  const R one(1.0f);
  switch (curve) {
    case ToneCurve::none: return x;
    case ToneCurve::reinhard: return x / (one + x);
    case ToneCurve::reinhard_extended: return x * (one + x / R(white * white)) / (one + x);
    case ToneCurve::exponential: {
      // Where 1 − e^(−x) would cancel, its series; what is left out is below 2e-9 of the value.
      const R series = x * (one - x * (R(1.0f / 2) - x * (R(1.0f / 6) - x * (R(1.0f / 24) - x * R(1.0f / 120)))));
      return select(x < R(0.0625f), series, one - exp(-x));
    }
    case ToneCurve::aces: return x * fma(R(2.51f), x, R(0.03f)) / fma(x, fma(R(2.43f), x, R(0.59f)), R(0.14f));
  }
  return x;
}

/// Exposes, and bends each channel, or all three by what their luminance is bent by (hues stay; channels end at 1).
template <Number R>
HS_INLINE DisplayLight<R> tone_map(const SceneLight<R>& light, const ToneMapping& tone) {
  vec3<R> c;
  for (int k = 0; k < 3; ++k) c[k] = min(sound_light(light.rgb[k]) * R(tone.exposure), R(kMaxLight));
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

/// The sRGB curve of each channel (core/srgb_curve.h).
template <Number R>
HS_INLINE Encoded<R> encode_srgb(const DisplayLight<R>& light) {
  vec3<R> e;
  for (int k = 0; k < 3; ++k) e[k] = srgb_curve(light.rgb[k]);
  return {e};
}

/// x^(1/gamma), gamma > 0.
template <Number R>
HS_INLINE Encoded<R> encode_gamma(const DisplayLight<R>& light, float gamma) {
  vec3<R> e;
  for (int k = 0; k < 3; ++k) e[k] = min(pow(light.rgb[k], R(1.0f / gamma)), R(1.0f));
  return {e};
}

/// The 8x8 matrix of ordered dithering (Bayer, "An optimum method for two-level rendition of continuous-tone pictures", 1973) at
/// pixel (x, y): each of (0 … 63 + 1/2)/64 once in every aligned block of 8x8.
template <Number R>
HS_INLINE R dither_threshold(IntOf<R> x, IntOf<R> y) {
  const IntOf<R> a = x ^ y;
  const auto bit = [](IntOf<R> v, int from, int to) { return ((v >> from) & 1) << to; };
  const IntOf<R> rank = bit(a, 0, 5) | bit(y, 0, 4) | bit(a, 1, 3) | bit(y, 1, 2) | bit(a, 2, 1) | bit(y, 2, 0);
  return (to_real<R>(rank) + R(0.5f)) * R(1.0f / 64.0f);
}

/// A whole code over 255 beside e, the upper one the more often the nearer it is: over an aligned block of 8x8 pixels of one
/// value the mean is within 1/128 of a code of it. 0 and 1 stay.
template <Number R>
HS_INLINE Encoded<R> dithered(const Encoded<R>& e, R threshold) {
  vec3<R> codes;
  for (int k = 0; k < 3; ++k) codes[k] = floor(fma(e.rgb[k], R(255.0f), threshold)) * R(1.0f / 255.0f);
  return {codes};
}

}  // namespace halfspace
