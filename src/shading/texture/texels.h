// SPDX-License-Identifier: Apache-2.0
//
// The layout of each texel format in the 32-bit words of a texture, and how it is read. There is one struct per format, with
//
//   Value               the type that is filtered: R (one channel) or vec4<R>
//   operator()(i)       loads texel i in the units that are filtered: integers or linear values
//   to_linear(value)    converts such a value, filtered or not, to a linear value
//
// rgba8, srgb8a8: one word per texel, red in the low byte. r8, r16: four or two texels per word, the first in the low bits.
// rgba16f: two words per texel, red in the low half of the first. rgba32f: four words per texel.
#pragma once

#include "halfspace/core/parallel.h"
#include "halfspace/shading/texture/texture.h"

namespace halfspace::HS_LANES::detail {

template <TexelFormat format, class R>
struct Rgba8Texels {
  using Value = vec4<R>;
  const int32_t* words;

  HS_INLINE Value operator()(IntOf<R> i) const { return decode_rgba8<Value, format, R>(gather(words, i)); }
  HS_INLINE Value to_linear(const Value& v) const { return rgba8_to_linear<format>(v); }
};

template <class R>
struct R8Texels {
  using Value = R;
  const int32_t* words;

  HS_INLINE Value operator()(IntOf<R> i) const {
    const IntOf<R> four = gather(words, i >> 2);
    const IntOf<R> two = select((i & 2) != 0, four >> 16, four);
    return to_real<R>(select((i & 1) != 0, two >> 8, two) & 0xff);
  }
  HS_INLINE Value to_linear(Value v) const { return unorm8_to_linear(v); }
};

template <class R>
struct R16Texels {
  using Value = R;
  const int32_t* words;

  HS_INLINE Value operator()(IntOf<R> i) const {
    const IntOf<R> two = gather(words, i >> 1);
    return to_real<R>(select((i & 1) != 0, two >> 16, two) & 0xffff);
  }
  HS_INLINE Value to_linear(Value v) const { return unorm16_to_linear(v); }
};

template <class R>
struct Rgba16fTexels {
  using Value = vec4<R>;
  const int32_t* words;

  HS_INLINE Value operator()(IntOf<R> i) const {
    const auto [rg, ba] = gather_row<2>(words, IntOf<R>(i << 1));
    return decode_rgba16f<R>(rg, ba);
  }
  HS_INLINE Value to_linear(const Value& v) const { return v; }
};

template <class R>
struct Rgba32fTexels {
  using Value = vec4<R>;
  const int32_t* words;

  HS_INLINE Value operator()(IntOf<R> i) const {
    const auto texel = gather_row<4>(words, IntOf<R>(i << 2));
    const auto channel = [&](std::size_t k) { return R(as_real(texel[k])); };
    return {channel(0), channel(1), channel(2), channel(3)};
  }
  HS_INLINE Value to_linear(const Value& v) const { return v; }
};

// ---- uniform linear values, and filtered values, by number of channels ------------------------------------------------

template <class Value>
HS_INLINE Value uniform_value(const glm::vec4& v) {
  if constexpr (Number<Value>) {
    return Value(v.x);
  } else {
    using R = typename Value::value_type;
    return {R(v.x), R(v.y), R(v.z), R(v.w)};
  }
}

template <Number R>
HS_INLINE vec4<R> to_rgba(R red) {
  return {red, R(0.0f), R(0.0f), R(1.0f)};
}
template <class R>
HS_INLINE vec4<R> to_rgba(const vec4<R>& v) {
  return v;
}

/// Four channels, processed at once.
using Channels = RealN<4>;

/// Clamps a linear value to the range of rgba32f texels.
inline Channels clamped_texel(const glm::vec4& v) {
  const auto x = load<Channels>(&v.x);
  return select(x == x, clamp(x, Channels(-kMaxTexel), Channels(kMaxTexel)), Channels(0.0f));
}

/// Returns the channels of an rgba16f texel.
inline IntN<4> half_channels(const glm::vec4& v) { return float_to_finite_half(clamped_texel(v)); }

/// Returns the width or height of the next level.
constexpr int half_size(int size) { return size <= 2 ? 1 : size / 2; }

/// Calls f(row) for every row, using the workers if there are any.
template <class F>
void for_each_row(const Workers* workers, int rows, const F& f) {
  if (workers != nullptr && rows > 1) return workers->for_each(rows, f);
  for (int row = 0; row < rows; ++row) f(row);
}

}  // namespace halfspace::HS_LANES::detail
