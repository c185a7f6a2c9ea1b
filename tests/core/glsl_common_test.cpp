// SPDX-License-Identifier: Apache-2.0
//
// Tests the common functions of the shading language against their definitions in GLSL, evaluated in long double, with special values, and
// that lanes return the bits of scalars.
#include "halfspace/core/glsl_common.h"

#include "core/glsl_lanes.h"

namespace halfspace {
namespace {

const std::vector<float>& glsl_reals() {
  static const std::vector<float> values = [] {
    std::vector<float> v;
    std::mt19937 random(8);
    for (int i = 0; i < 4000; ++i) v.push_back(glsl_number(random));
    return v;
  }();
  return values;
}

TEST(GlslCommon, RoundingFunctionsAreThoseOfTheCLibrary) {
  const auto check = [](float x) {
    EXPECT_TRUE(same_bits(trunc(x), std::trunc(x))) << x;
    EXPECT_TRUE(same_bits(ceil(x), std::ceil(x))) << x;
    EXPECT_TRUE(same_bits(round(x), std::round(x))) << x;
    EXPECT_TRUE(same_bits(roundEven(x), std::nearbyint(x))) << x;
    EXPECT_TRUE(same_bits(fract(x), x - std::floor(x))) << x;
    EXPECT_EQ(sign(x), x > 0 ? 1.0f : x < 0 ? -1.0f : 0.0f) << x;
    EXPECT_EQ(isnan(x), std::isnan(x)) << x;
    EXPECT_EQ(isinf(x), std::isinf(x)) << x;
    float i = 0, want_i = 0;
    const float f = modf(x, i), want_f = std::modf(x, &want_i);
    EXPECT_TRUE(same_bits(f, want_f) && same_bits(i, want_i)) << x << ' ' << f << ' ' << i;
  };
  for (const float x : glsl_reals()) check(x);
  for (float x = 0.125f; x < 20; x += 0.125f) check(x), check(-x);
  for (float x = 8388600.0f; x < 8388620.0f; x = std::nextafter(x, kInf)) check(x), check(-x);
  EXPECT_TRUE(std::isnan(fract(kInf)));
  EXPECT_EQ(fract(-0x1p-30f), 1.0f);  // x − floor(x) rounds to 1
}

TEST(GlslCommon, ModfMaySetItsArgument) {
  float x = -2.75f;
  EXPECT_EQ(modf(x, x), -0.75f);
  EXPECT_EQ(x, -2.0f);
  vec2<float> v(1.5f, -3.25f);
  EXPECT_TRUE(modf(v, v) == vec2<float>(0.5f, -0.25f));
  EXPECT_TRUE(v == vec2<float>(1, -3));
}

TEST(GlslCommon, ModIsCorrectlyRoundedForQuotientsBelow2To22) {
  std::mt19937 random(9);
  std::uniform_real_distribution<double> unit(-1, 1);
  double worst = 0;
  for (int i = 0; i < 2000000; ++i) {
    const float y = static_cast<float>(unit(random) * std::exp2(20 * unit(random)));
    float x = static_cast<float>(static_cast<double>(y) * unit(random) * std::exp2(11 + 11 * unit(random)));
    if (i % 2 == 0) x = static_cast<float>(std::round(x / y) * static_cast<double>(y));  // close to a multiple of y
    if (y == 0 || std::fabs(x / y) >= 0x1p22f) continue;
    // fmod is exact. Its result has the sign of x, and that of GLSL the sign of y.
    const long double rest = std::fmod(static_cast<long double>(x), static_cast<long double>(y));
    const long double want = rest != 0 && (rest < 0) != (y < 0) ? rest + static_cast<long double>(y) : rest;
    const float got = mod(x, y);
    worst = std::max(worst, glsl_ulps(got, want));
    ASSERT_TRUE(got == 0 || (got < 0) == (y < 0)) << x << ' ' << y;
  }
  EXPECT_LE(worst, 0.5);   // correct rounding
  EXPECT_GT(worst, 0.49);  // some results are rounded
  EXPECT_EQ(mod(5.5f, 2.0), 1.5f);
  EXPECT_EQ(mod(-0.5f, 2.0f), 1.5f);
  EXPECT_EQ(mod(0.5f, -2.0f), -1.5f);
  EXPECT_EQ(mod(6.0f, 2.0f), 0.0f);
  for (const auto& [x, y] : {std::pair(1.0f, 0.0f), std::pair(kInf, 1.0f), std::pair(1.0f, kInf), std::pair(kNaN, 1.0f)}) {
    EXPECT_TRUE(std::isnan(mod(x, y))) << x << ' ' << y;
  }
}

TEST(GlslCommon, StepSmoothstepAndMixFollowTheirDefinition) {
  for (std::size_t i = 0; i + 2 < glsl_reals().size(); ++i) {
    const float x = glsl_reals()[i], y = glsl_reals()[i + 1], a = glsl_reals()[i + 2];
    EXPECT_EQ(step(y, x), x < y ? 0.0f : 1.0f);
    EXPECT_TRUE(same_bits(mix(x, y, a), x * (1 - a) + y * a));
    EXPECT_TRUE(same_bits(mix(x, y, true), y));
    EXPECT_TRUE(same_bits(mix(x, y, false), x));
    const float t = std::min(std::max(0.0f, (a - x) / (y - x)), 1.0f), smooth = smoothstep(x, y, a);
    EXPECT_TRUE(same_bits(smooth, t * t * (3 - 2 * t))) << x << ' ' << y << ' ' << a;
  }
  EXPECT_EQ(smoothstep(1.0f, 1.0f, 0.5f), 0.0f);
  EXPECT_EQ(smoothstep(1.0f, 1.0f, 1.5f), 1.0f);
  EXPECT_EQ(smoothstep(1.0f, 1.0f, 1.0f), 0.0f);
  EXPECT_EQ(smoothstep(0.0f, 1.0f, kNaN), 0.0f);
  // Four roundings of at most half an ulp each, one of which is of a sum of up to 3 next to a result of 1/2 or more; the rest are relative.
  const double error = largest_glsl_error([](float x) { return smoothstep(0.0f, 1.0f, x); },
                                          [](long double x) {
                                            const long double t = std::min(std::max(x, 0.0L), 1.0L);
                                            return t * t * (3 - 2 * t);
                                          },
                                          0.0f, 2.0f);
  EXPECT_LE(error, 2.5);
}

TEST(GlslCommon, FrexpAndLdexpAreExact) {
  const auto check = [](float x) {
    int32_t e = 7, want_e = 0;
    const float m = frexp(x, e), want_m = std::frexp(x, &want_e);
    EXPECT_TRUE(same_bits(m, want_m)) << x;
    EXPECT_EQ(e, std::isfinite(x) ? want_e : 0) << x;
    EXPECT_TRUE(same_bits(ldexp(m, e), x)) << x;
    for (const int32_t k : {0, 1, -1, 23, -24, 100, -100, 126, -126, 149, -149, 200, -200, 276, -276, 300, -300, 100000, -100000}) {
      EXPECT_TRUE(same_bits(ldexp(x, k), std::ldexp(x, k))) << x << ' ' << k;
    }
    EXPECT_TRUE(same_bits(ldexp(x, 0x7fffffff), std::ldexp(x, 0x7fffffff))) << x;
    EXPECT_TRUE(same_bits(ldexp(x, -0x7fffffff - 1), std::ldexp(x, -0x7fffffff - 1))) << x;
  };
  for (const float x : glsl_reals()) check(x);
  int32_t e = 0;
  EXPECT_EQ(frexp(6.0, e), 0.75);
  EXPECT_EQ(e, 3);
  EXPECT_EQ(ldexp(0.75, 3), 6.0);
}

TEST(GlslCommon, IntegerVersionsWrap) {
  using I3 = ivec3<float>;
  constexpr int32_t kMin = std::numeric_limits<int32_t>::min();
  EXPECT_TRUE(abs(I3(-5, kMin, 7)) == I3(5, kMin, 7));
  EXPECT_TRUE(sign(I3(-5, 0, 7)) == I3(-1, 0, 1));
  EXPECT_TRUE(min(I3(-5, 0, 7), 1) == I3(-5, 0, 1));
  EXPECT_TRUE(max(I3(-5, 0, 7), I3(0, 0, 8)) == I3(0, 0, 8));
  EXPECT_TRUE(clamp(I3(-5, 0, 7), -1, 6) == I3(-1, 0, 6));
  EXPECT_EQ(clamp(9, 0, 5), 5);
  EXPECT_EQ(clamp(9u, 0u, 5u), 5u);
  EXPECT_TRUE(max(uvec2<float>(1, 0xffffffff), 2u) == uvec2<float>(2, 0xffffffff));
}

TEST(GlslCommon, ScalarsStandForAllComponents) {
  const vec3<float> v(-1.5f, 0.25f, 7.5f);
  EXPECT_TRUE(min(v, 1.0) == vec3<float>(-1.5f, 0.25f, 1.0f));
  EXPECT_TRUE(max(1, v) == vec3<float>(1, 1, 7.5f));
  EXPECT_TRUE(clamp(v, 0.0f, 1.0f) == vec3<float>(0, 0.25f, 1));
  EXPECT_TRUE(max(v, glm::vec3(0, 1, 8)) == vec3<float>(0, 1, 8));
  EXPECT_TRUE(step(0.0f, v) == vec3<float>(0, 1, 1));
  EXPECT_TRUE(mod(v, 1.0f) == vec3<float>(0.5f, 0.25f, 0.5f));
  EXPECT_TRUE(v + 1.0f == vec3<float>(-0.5f, 1.25f, 8.5f) && 1.0f - v == vec3<float>(2.5f, 0.75f, -6.5f));
  EXPECT_TRUE(v - 1.0f == -(1.0f - v) && 2.0f + v == v + 2.0f && 3.0f / v == vec3<float>(3.0f) / v && v != v + 1.0f);
  vec3<float> w = v;
  w += 1.0f, w -= 0.5f, w /= v;
  EXPECT_TRUE(w == (v + 1.0f - 0.5f) / v);
  EXPECT_EQ(lane(mix(0.25f, 1.0f, RealN<4>(0.5f)), 3), 0.625f);  // uniform ends, varying weight
  static_assert(std::is_same_v<decltype(step(0.5f, RealN<4>(1))), RealN<4>>);
  static_assert(std::is_same_v<decltype(mod(vec2<double>(1), 2.0f)), vec2<double>>);
}

TEST(GlslCommon, LanesMatchScalarBits) {
  expect_glsl_lanes_match_scalars([](const auto& a, auto& out) {
    const auto v = a.v3(0), w = a.v3(3), t = a.v3(6);
    const auto x = a.x[9], y = a.x[10], z = a.x[11];
    out.add(abs(v)), out.add(sign(v)), out.add(floor(v)), out.add(trunc(v)), out.add(round(v)), out.add(roundEven(v)), out.add(ceil(v));
    out.add(fract(v)), out.add(mod(v, w)), out.add(mod(v, x)), out.add(min(v, w)), out.add(max(v, x)), out.add(clamp(v, w, t));
    out.add(clamp(v, x, y)), out.add(mix(v, w, t)), out.add(mix(v, w, x)), out.add(mix(v, w, isnan(t))), out.add(step(v, w));
    out.add(step(x, v)), out.add(smoothstep(v, w, t)), out.add(smoothstep(x, y, v)), out.add(isnan(v)), out.add(isinf(v)),
        out.add(fma(v, w, t));
    out.add(trunc(x)), out.add(round(x)), out.add(ceil(x)), out.add(fract(x)), out.add(sign(x)), out.add(mod(x, y)), out.add(mix(x, y, z));
    out.add(step(x, y)), out.add(smoothstep(x, y, z)), out.add(mix(x, y, x < z)), out.add(isinf(x));
    auto whole = v;
    out.add(modf(v, whole)), out.add(whole);
    auto exponent = a.i3(0);
    out.add(frexp(v, exponent)), out.add(exponent), out.add(ldexp(v, a.i3(3))), out.add(ldexp(w, a.i[6])), out.add(ldexp(x, a.i[7]));
    out.add(abs(a.i3(0))), out.add(sign(a.i3(0))), out.add(min(a.i3(0), a.i3(3))), out.add(max(a.u3(0), 9u)),
        out.add(clamp(a.i3(0), -5, 5));
    out.add(mix(a.i3(0), a.i3(3), isnan(v))), out.add(v + x), out.add(x - v), out.add(x / v), out.add(v != w);
  });
}

}  // namespace
}  // namespace halfspace
