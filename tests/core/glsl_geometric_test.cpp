// SPDX-License-Identifier: Apache-2.0
//
// Tests the geometric, relational and trigonometric functions of vectors and the swizzles of the shading language against the formulas of
// GLSL, and that lanes return the bits of scalars.
#include "halfspace/core/glsl_geometric.h"

#include "core/glsl_lanes.h"

namespace halfspace {
namespace {

TEST(GlslGeometric, FunctionsFollowTheFormulasOfGlsl) {
  const vec3<float> i(0.6f, -0.8f, 0.0f), n(0, 1, 0);
  EXPECT_EQ(distance(vec2<float>(1, 2), vec2<float>(4, 6)), 5.0f);
  EXPECT_EQ(distance(vec2<float>(1, 2), glm::vec2(4, 6)), 5.0f);
  EXPECT_EQ(distance(3.0f, 5.0f), 2.0f);
  EXPECT_TRUE(faceforward(n, i, n) == n);
  EXPECT_TRUE(faceforward(n, -i, n) == -n);
  EXPECT_EQ(faceforward(1.0f, 1.0f, 1.0f), -1.0f);
  EXPECT_EQ(length(-3.0f), 3.0f);
  EXPECT_EQ(dot(2.0f, -3.0f), -6.0f);
  EXPECT_EQ(normalize(-3.0f), -1.0f);
  EXPECT_TRUE(std::isnan(normalize(0.0f)));
  EXPECT_EQ(reflect(2.0f, 1.0f), -2.0f);
  EXPECT_EQ(refract(-1.0f, 1.0f, 0.5f), -1.0f);
  // Snell's law: the sine of the angle grows by eta. The results are near 1, so a few roundings are below 4e-7.
  const vec3<float> r = refract(i, n, 0.75f);
  EXPECT_NEAR(r.x, 0.6f * 0.75f, 4e-7f);
  EXPECT_NEAR(length(r), 1.0f, 4e-7f);
  EXPECT_LT(r.y, 0.0f);
  EXPECT_TRUE(refract(i, n, 1.7f) == vec3<float>(0.0f));  // total reflection
  EXPECT_TRUE(refract(glm::vec3(0.6f, -0.8f, 0), n, 1.7) == vec3<float>(0.0f));
}

TEST(GlslRelational, ComparisonsCombineComponents) {
  const vec4<float> a(1, 2, 3, kNaN), b(2, 2, 1, kNaN);
  using B = bvec4<float>;
  EXPECT_TRUE(lessThan(a, b) == B(true, false, false, false));
  EXPECT_TRUE(lessThanEqual(a, b) == B(true, true, false, false));
  EXPECT_TRUE(greaterThan(a, b) == B(false, false, true, false));
  EXPECT_TRUE(greaterThanEqual(a, b) == B(false, true, true, false));
  EXPECT_TRUE(equal(a, b) == B(false, true, false, false));
  EXPECT_TRUE(notEqual(a, b) == B(true, false, true, true));
  EXPECT_TRUE((not(equal(a, b))) == notEqual(a, b));
  EXPECT_TRUE(any(lessThan(a, b)) && !all(lessThan(a, b)) && !any(lessThan(a, -10.0f)));
  EXPECT_TRUE(all(greaterThan(vec2<float>(3, 4), 2)) && all(lessThan(ivec2<float>(1, 2), 3)));
  EXPECT_TRUE(equal(B(true, false, true, false), B(true, true, false, false)) == B(true, false, false, true));
  EXPECT_TRUE(notEqual(B(true, false, true, false), B(true, true, false, false)) == B(false, true, true, false));
}

TEST(Swizzle, ReadsAndWritesNamedComponents) {
  vec4<float> v(1, 2, 3, 4);
  EXPECT_TRUE(swizzle<"zyx">(v) == vec3<float>(3, 2, 1));
  EXPECT_TRUE(swizzle<"rrgg">(v) == vec4<float>(1, 1, 2, 2));
  EXPECT_TRUE(swizzle<"qp">(v) == vec2<float>(4, 3));
  EXPECT_EQ(swizzle<"a">(v), 4.0f);
  static_assert(std::is_same_v<decltype(swizzle<"a">(v)), float> && std::is_same_v<decltype(swizzle<"xx">(v)), vec2<float>>);
  swizzle_ref<"wx">(v) = vec2<float>(7, 8);
  EXPECT_TRUE(v == vec4<float>(8, 2, 3, 7));
  swizzle_ref<"xyzw">(v) = swizzle<"wzyx">(v);
  EXPECT_TRUE(v == vec4<float>(7, 3, 2, 8));
  swizzle_ref<"xz">(v) *= 2.0f;
  swizzle_ref<"g">(v) += 1.0f;
  swizzle_ref<"ab">(v) -= vec2<float>(1, 2);
  swizzle_ref<"st">(v) /= 2.0f;
  EXPECT_TRUE(v == vec4<float>(7, 2, 2, 7));
  swizzle_ref<"xy">(v) = glm::vec2(5, 6);
  EXPECT_TRUE(v == vec4<float>(5, 6, 2, 7));
  uvec3<float> u(1, 2, 3);
  swizzle_ref<"zx">(u) += swizzle<"yy">(u);
  EXPECT_TRUE(u == uvec3<float>(3, 2, 5));
  EXPECT_TRUE(swizzle<"yx">(bvec2<float>(true, false)) == bvec2<float>(false, true));
}

TEST(Swizzle, AssignsTheVectorItself) {
  vec2<float> v(1, 2);
  swizzle_ref<"yx">(v) = v;
  EXPECT_TRUE(v == vec2<float>(2, 1));
  vec4<float> w(1, 2, 3, 4);
  swizzle_ref<"wzyx">(w) = w;
  EXPECT_TRUE(w == vec4<float>(4, 3, 2, 1));
  swizzle_ref<"yzwx">(w) = w;
  EXPECT_TRUE(w == vec4<float>(1, 4, 3, 2));
}

TEST(GlslTrigonometric, ConversionsOfAnglesAndInverseSquareRootsAreWithinTheirErrorBounds) {
  constexpr long double kPiLong = std::numbers::pi_v<long double>;
  // Measured on every 61st float; the rounding of the constant adds to that of the product.
  EXPECT_LE(largest_glsl_error([](float x) { return radians(x); }, [](long double x) { return x * (kPiLong / 180); }, 0x1p-119f, 0x1p127f),
            0.63);
  EXPECT_LE(largest_glsl_error([](float x) { return degrees(x); }, [](long double x) { return x * (180 / kPiLong); }, 0.0f, 0x1p127f), 0.7);
  EXPECT_LE(largest_glsl_error([](float x) { return inversesqrt(x); }, [](long double x) { return 1 / std::sqrt(x); }, 0x1p-149f, 0x1p127f),
            1.5);
  EXPECT_EQ(inversesqrt(0.0f), kInf);
  EXPECT_EQ(inversesqrt(-0.0f), -kInf);
  EXPECT_EQ(inversesqrt(kInf), 0.0f);
  EXPECT_EQ(atan(-1.0f, -1.0f), atan2(-1.0f, -1.0f));
}

TEST(GlslTrigonometric, VectorsMatchScalarsAndLanesMatchScalarBits) {
  expect_glsl_lanes_match_scalars([](const auto& a, auto& out) {
    const auto v = a.v3(0), w = a.v3(3);
    for (const auto& y : {sin(v), cos(v), tan(v), asin(v), acos(v), atan(v), sinh(v), cosh(v), tanh(v), asinh(v), acosh(v), atanh(v)})
      out.add(y);
    for (const auto& y : {exp(v), exp2(v), log(v), log2(v), sqrt(v), inversesqrt(v), radians(v), degrees(v), pow(v, w), atan(v, w)})
      out.add(y);
    out.add(pow(v, a.x[6])), out.add(pow(2.0f, v)), out.add(atan(a.x[0], a.x[1])), out.add(radians(a.x[0])), out.add(inversesqrt(a.x[2]));
  });
  const vec2<float> v(0.3f, 0.7f);
  const auto check = [&](const char* what, auto f) { EXPECT_TRUE(f(v) == vec2<float>(f(v.x), f(v.y))) << what; };
  check("sin", [](auto x) { return sin(x); });
  check("cos", [](auto x) { return cos(x); });
  check("tan", [](auto x) { return tan(x); });
  check("asin", [](auto x) { return asin(x); });
  check("acos", [](auto x) { return acos(x); });
  check("atan", [](auto x) { return atan(x); });
  check("sinh", [](auto x) { return sinh(x); });
  check("cosh", [](auto x) { return cosh(x); });
  check("tanh", [](auto x) { return tanh(x); });
  check("asinh", [](auto x) { return asinh(x); });
  check("acosh", [](auto x) { return acosh(x + 1.0f); });
  check("atanh", [](auto x) { return atanh(x); });
  check("exp", [](auto x) { return exp(x); });
  check("exp2", [](auto x) { return exp2(x); });
  check("log", [](auto x) { return log(x); });
  check("log2", [](auto x) { return log2(x); });
  check("sqrt", [](auto x) { return sqrt(x); });
  check("pow", [](auto x) { return pow(x, 2.5f); });
}

TEST(GlslGeometric, LanesMatchScalarBits) {
  expect_glsl_lanes_match_scalars([](const auto& a, auto& out) {
    const auto v = a.v3(0), w = a.v3(3), t = a.v3(6);
    const auto x = a.x[9], y = a.x[10], z = a.x[11];
    out.add(distance(v, w)), out.add(distance(a.v2(0), a.v2(2))), out.add(distance(x, y)), out.add(faceforward(v, w, t));
    out.add(faceforward(x, y, z)), out.add(refract(v, w, x)), out.add(refract(x, y, z)), out.add(length(x)), out.add(normalize(x));
    out.add(dot(x, y)), out.add(reflect(x, y)), out.add(lessThan(v, w)), out.add(lessThanEqual(v, x)), out.add(greaterThan(v, w));
    out.add(greaterThanEqual(v, w)), out.add(equal(v, w)), out.add(notEqual(v, w)), out.add(any(lessThan(v, w))),
        out.add(all(lessThan(v, w)));
    out.add(not(lessThan(v, w))), out.add(lessThan(a.i3(0), a.i3(3))), out.add(greaterThan(a.u3(0), 7u));
    out.add(equal(lessThan(v, w), lessThan(w, t))), out.add(notEqual(lessThan(v, w), lessThan(w, t)));
    auto s = a.v4(12);
    swizzle_ref<"zxy">(s) = v;
    swizzle_ref<"wz">(s) *= x;
    out.add(s), out.add(swizzle<"wzyx">(s)), out.add(swizzle<"r">(s)), out.add(swizzle<"zx">(a.u3(0)));
  });
}

}  // namespace
}  // namespace halfspace
