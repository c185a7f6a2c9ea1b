// SPDX-License-Identifier: Apache-2.0
//
// Compares functions of the shading language on lanes with the same functions on scalars, bit by bit. A NaN only has to be a NaN.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "halfspace/core/glsl.h"
#include "support/constants.h"

namespace halfspace {

/// Arguments of a function under test: numbers and integers.
template <class R>
struct GlslArguments {
  std::array<R, 16> x;
  std::array<IntOf<R>, 8> i;

  vec2<R> v2(std::size_t k) const { return {x[k], x[k + 1]}; }
  vec3<R> v3(std::size_t k) const { return {x[k], x[k + 1], x[k + 2]}; }
  vec4<R> v4(std::size_t k) const { return {x[k], x[k + 1], x[k + 2], x[k + 3]}; }
  ivec3<R> i3(std::size_t k) const { return {i[k], i[k + 1], i[k + 2]}; }
  uvec3<R> u3(std::size_t k) const { return uvec3<R>(i3(k)); }
  UintOf<R> u(std::size_t k) const { return UintOf<R>(i[k]); }
};

/// The bits of results, lane by lane.
template <int W>
struct GlslResults {
  std::array<std::vector<uint32_t>, W> bits;

  template <class T>
  void add(const T& value) {
    if constexpr (detail::kIsVaryingMatrix<T>) {
      for (const auto& column : value.columns) add(column);
    } else if constexpr (detail::kLengthOf<T> != 0) {
      for (int k = 0; k < detail::kLengthOf<T>; ++k) add(value[k]);
    } else {
      for (int k = 0; k < W; ++k) bits[static_cast<std::size_t>(k)].push_back(bits_of(lane(value, k)));
    }
  }

 private:
  static uint32_t bits_of(float x) { return std::isnan(x) ? 0x7fc00000u : static_cast<uint32_t>(as_int(x)); }
  static uint32_t bits_of(int32_t x) { return static_cast<uint32_t>(x); }
  static uint32_t bits_of(uint32_t x) { return x; }
  static uint32_t bits_of(bool x) { return x ? 1 : 0; }
};

/// Half of the numbers are ordinary. The others are special values and arbitrary bits.
inline float glsl_number(std::mt19937& random) {
  static constexpr std::array<float, 20> kSpecial = {
      0.0f, -0.0f, 0.5f,      -0.5f,      1.0f,      -1.0f,  1.5f,       2.5f,          -2.5f,           0.49999997f,
      kInf, -kInf, 0x1p-149f, -0x1p-140f, 0x1p-126f, 255.0f, 8388609.0f, 4294967040.0f, 0x1.fffffep127f, kNaN};
  switch (random() % 4) {
    case 0: return kSpecial[random() % kSpecial.size()];
    case 1: return as_real(static_cast<int32_t>(random()));
    default: return std::uniform_real_distribution<float>(-4, 4)(random);
  }
}
inline int32_t glsl_integer(std::mt19937& random) {
  static constexpr std::array<int32_t, 10> kSpecial = {0, 1, -1, 2, 7, 31, 32, 65536, 0x7fffffff, -0x7fffffff - 1};
  switch (random() % 3) {
    case 0: return kSpecial[random() % kSpecial.size()];
    case 1: return static_cast<int32_t>(random());
    default: return static_cast<int32_t>(random() % 64) - 16;
  }
}

template <class R, class F>
void expect_glsl_lanes_match(F f) {
  constexpr int W = kWidthOf<R>;
  std::mt19937 random(W);
  for (int round = 0; round < 400; ++round) {
    GlslArguments<R> lanes{};
    std::array<GlslArguments<float>, W> scalars;
    for (int k = 0; k < W; ++k) {
      GlslArguments<float>& scalar = scalars[static_cast<std::size_t>(k)];
      for (std::size_t n = 0; n < lanes.x.size(); ++n) set_lane(lanes.x[n], k, scalar.x[n] = glsl_number(random));
      for (std::size_t n = 0; n < lanes.i.size(); ++n) set_lane(lanes.i[n], k, scalar.i[n] = glsl_integer(random));
    }
    GlslResults<W> got;
    f(lanes, got);
    for (std::size_t k = 0; k < W; ++k) {
      GlslResults<1> want;
      f(scalars[k], want);
      ASSERT_EQ(got.bits[k], want.bits[0]) << "lane " << k << " of " << W << ", arguments " << testing::PrintToString(scalars[k].x) << ' '
                                           << testing::PrintToString(scalars[k].i);
    }
  }
}
/// Calls f(arguments, results) for lanes of all widths and for scalars.
template <class F>
void expect_glsl_lanes_match_scalars(F f) {
  expect_glsl_lanes_match<RealN<4>>(f);
  expect_glsl_lanes_match<RealN<8>>(f);
  expect_glsl_lanes_match<RealN<16>>(f);
  expect_glsl_lanes_match<RealPair<float>>(f);
  expect_glsl_lanes_match<RealPair<RealN<8>>>(f);
}

/// The error of got in ulps of the exact result, which must not be NaN or infinite unless got is.
inline double glsl_ulps(float got, long double want) {
  if (std::isnan(want)) return std::isnan(got) ? 0 : 1e30;
  if (std::fabs(want) >= 0x1.ffffffp127L) return std::isinf(got) && (got > 0) == (want > 0) ? 0 : 1e30;
  if (!std::isfinite(got)) return 1e30;
  const int exponent = want == 0 ? -200 : std::ilogb(want);
  return static_cast<double>(std::fabs(static_cast<long double>(got) - want) / std::ldexp(1.0L, std::max(exponent, -126) - 23));
}

/// Returns the largest error of f over about `count` floats of every exponent in [low, high] and their negatives, where low >= 0.
template <class F, class G>
double largest_glsl_error(F f, G reference, float low, float high, int64_t count = 1 << 18) {
  double worst = 0;
  const int64_t first = as_int(low), last = as_int(high), step = std::max<int64_t>(1, (last - first) / count) | 1;
  for (int64_t bits = first; bits <= last; bits += step) {
    const float x = as_real(static_cast<int32_t>(bits));
    worst = std::max(
        {worst, glsl_ulps(f(x), reference(static_cast<long double>(x))), glsl_ulps(f(-x), reference(-static_cast<long double>(x)))});
  }
  return worst;
}

inline bool same_bits(float a, float b) { return (std::isnan(a) && std::isnan(b)) || as_int(a) == as_int(b); }

}  // namespace halfspace
