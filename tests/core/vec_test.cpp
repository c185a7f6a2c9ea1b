// SPDX-License-Identifier: Apache-2.0
//
// Compares vectors of float, double and lanes with the GLM functions and with the order of operations that vec.h specifies.
#include "halfspace/core/vec.h"

#include <gtest/gtest.h>

#include <array>
#include <random>

#include "core/glm_results.h"
#include "halfspace/core/lane_pairs.h"

namespace halfspace {
namespace {

// Returns numbers of widely varying magnitude, so that every order of operations rounds differently.
template <class T>
T random_number(std::mt19937& random) {
  return std::ldexp(std::uniform_real_distribution<T>(-1, 1)(random), std::uniform_int_distribution<int>(-6, 6)(random));
}
template <int L, class T>
glm::vec<L, T> random_vector(std::mt19937& random) {
  glm::vec<L, T> v;
  for (int i = 0; i < L; ++i) v[i] = random_number<T>(random);
  return v;
}

TEST(Vec, DoesNotChangeGlmFunctions) {
  std::mt19937 random(1);
  for (int i = 0; i < 1000; ++i) {
    const glm::vec3 a = random_vector<3, float>(random), b = random_vector<3, float>(random);
    ASSERT_EQ(glm_results(a, b), results_without_our_headers(a, b)) << "GLM results differ when the library's headers are included";
  }
}

// ---- conversions -----------------------------------------------------------------------------------------------

template <class From, class To>
constexpr bool kByItself = std::is_convertible_v<From, To>;
template <class From, class To>
constexpr bool kWhenAsked = std::is_constructible_v<To, From> && !std::is_convertible_v<From, To>;

static_assert(kByItself<glm::vec3, vec3<float>> && kByItself<glm::vec3, vec3<double>> && kByItself<glm::vec3, vec3<RealN<8>>>);
static_assert(kByItself<glm::dvec3, vec3<double>> && kWhenAsked<glm::dvec3, vec3<float>>);
static_assert(!std::is_constructible_v<vec3<RealN<8>>, glm::dvec3>);
static_assert(kByItself<vec2<float>, vec2<double>> && kByItself<vec4<float>, vec4<RealPair<RealN<4>>>>);
static_assert(kWhenAsked<vec2<double>, vec2<float>>);
static_assert(kByItself<vec3<float>, glm::vec3> && kByItself<vec4<double>, glm::dvec4>);
static_assert(kWhenAsked<vec3<double>, glm::vec3> && kWhenAsked<vec3<float>, glm::dvec3>);
static_assert(!std::is_constructible_v<glm::vec3, vec3<RealN<8>>>);
static_assert(kWhenAsked<vec4<float>, vec3<float>> && kWhenAsked<vec3<float>, vec2<float>> && kWhenAsked<float, vec3<float>>);

// ---- order of operations ---------------------------------------------------------------------------------------

// The three-component float dot product is Halfspace's own; all other functions use GLM's order of operations.
template <int L, class T>
void check_against_glm(std::mt19937& random) {
  for (int i = 0; i < 1000; ++i) {
    const glm::vec<L, T> a = random_vector<L, T>(random), b = random_vector<L, T>(random);
    const VecN<L, T> u = a, v = b;
    const T t = random_number<T>(random);
    ASSERT_EQ(glm::mix(a, b, t), mix(u, v, t));
    ASSERT_EQ(a + b, u + v);
    ASSERT_EQ(a - b, u - v);
    ASSERT_EQ(a * b, u * v);
    ASSERT_EQ(a / b, u / v);
    ASSERT_EQ(a * t, u * t);
    ASSERT_EQ(t * a, t * u);
    ASSERT_EQ(a / t, u / t);
    ASSERT_EQ(-a, -u);
    for (int k = 0; k < L; ++k) ASSERT_EQ(a[k], u[k]);
    if constexpr (L == 3) {
      ASSERT_EQ(glm::cross(a, b), cross(u, v));
    }
    if constexpr (L == 3 && std::same_as<T, float>) {
      ASSERT_EQ(dot(u, v), std::fma(a.z, b.z, std::fma(a.y, b.y, a.x * b.x)));
      ASSERT_EQ(length(u), std::sqrt(dot(u, u)));
      ASSERT_EQ(normalize(u), a * (1 / std::sqrt(dot(u, u))));
      ASSERT_EQ(reflect(u, v), a - b * dot(v, u) * 2.0f);
    } else {
      ASSERT_EQ(glm::dot(a, b), dot(u, v));
      ASSERT_EQ(glm::length(a), length(u));
      ASSERT_EQ(glm::normalize(a), normalize(u));
      ASSERT_EQ(glm::reflect(a, b), reflect(u, v));
    }
  }
}

TEST(Vec, ComputesInTheOrderOfGlm) {
  std::mt19937 random(2);
  check_against_glm<2, float>(random);
  check_against_glm<3, float>(random);
  check_against_glm<4, float>(random);
  check_against_glm<2, double>(random);
  check_against_glm<3, double>(random);
  check_against_glm<4, double>(random);
}

template <class T>
void check_matrices(std::mt19937& random) {
  for (int i = 0; i < 1000; ++i) {
    glm::mat<4, 4, T> m;
    for (int k = 0; k < 4; ++k) m[k] = random_vector<4, T>(random);
    const glm::mat<3, 3, T> m3(m);
    const glm::vec<4, T> v = random_vector<4, T>(random);
    ASSERT_EQ(m * v, m * vec4<T>(v));
    ASSERT_EQ((m3 * glm::vec<3, T>(v)), m3 * vec3<T>(vec4<T>(v)));
  }
}

TEST(Vec, TransformsInTheOrderOfGlm) {
  std::mt19937 random(3);
  check_matrices<float>(random);
  check_matrices<double>(random);
}

// ---- lanes -----------------------------------------------------------------------------------------------------

template <class R>
class VecOfLanes : public testing::Test {};
using Lanes = testing::Types<RealN<4>, RealN<8>, RealN<16>, RealPair<float>, RealPair<RealN<8>>>;
TYPED_TEST_SUITE(VecOfLanes, Lanes);

// Combines uniform and varying operands in every way and adds up the results, so that each one affects the sum.
template <class R>
R mixed_results(const glm::mat3& m3, const glm::mat4& m4, const glm::vec3& uniform, const vec3<R>& a, const vec3<R>& b, R t) {
  const vec3<R> scaled = uniform * t, scaled_too = t * uniform, between = mix(uniform, uniform * 2.0f, t);
  vec3<R> sum = (uniform + a) * (b - uniform) / (uniform * a) + mix(uniform, a, t) + mix(a, b, t) + cross(uniform, a) + reflect(uniform, a);
  sum += uniform;
  sum -= scaled;
  sum *= uniform;
  sum *= 0.5f;
  sum /= 3.0f;
  sum += m3 * a + vec3<R>(m4 * vec4<R>(b, R(1))) + scaled_too + between + normalize(a) * 3.0f + 2.0f * b / 7.0f;
  const vec2<R> two(sum);
  const vec4<R> four(two, sum.z, t);
  const vec3<R> chosen = select(a.x < b.x, a, b);
  return dot(sum, uniform) + dot(uniform, a) + length(b) + dot(four, four) + length(two) +
         dot(normalize(four), normalize(vec4<R>(two, two))) + dot(chosen, a) + select(a == b, R(1), R(0));
}

TYPED_TEST(VecOfLanes, MatchScalarBits) {
  using R = TypeParam;
  std::mt19937 random(4);
  for (int round = 0; round < 200; ++round) {
    const glm::vec3 uniform = random_vector<3, float>(random);
    glm::mat4 m4;
    for (int k = 0; k < 4; ++k) m4[k] = random_vector<4, float>(random);
    const glm::mat3 m3(m4);
    std::array<std::array<float, 7>, kWidthOf<R>> numbers;
    vec3<R> a(R(0)), b(R(0));
    R t(0);
    for (int i = 0; i < kWidthOf<R>; ++i) {
      auto& n = numbers[static_cast<std::size_t>(i)];
      for (float& x : n) x = random_number<float>(random);
      if (i == 0) n = {n[0], n[1], n[2], n[0], n[1], n[2], n[6]};  // a == b
      for (int k = 0; k < 3; ++k) {
        set_lane(a[k], i, n[static_cast<std::size_t>(k)]);
        set_lane(b[k], i, n[static_cast<std::size_t>(k + 3)]);
      }
      set_lane(t, i, n[6]);
    }
    const R result = mixed_results(m3, m4, uniform, a, b, t);
    for (int i = 0; i < kWidthOf<R>; ++i) {
      const auto& n = numbers[static_cast<std::size_t>(i)];
      ASSERT_EQ(lane(result, i), mixed_results<float>(m3, m4, uniform, {n[0], n[1], n[2]}, {n[3], n[4], n[5]}, n[6]));
    }
  }
}

}  // namespace
}  // namespace halfspace
