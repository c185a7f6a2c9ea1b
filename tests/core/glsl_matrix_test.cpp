// SPDX-License-Identifier: Apache-2.0
//
// Tests varying matrices against GLM and against long double, in varyings, and that lanes return the bits of scalars.
#include "halfspace/core/glsl_matrix.h"

#include <cstdlib>
#include <iostream>

#include "core/glsl_lanes.h"
#include "support/long_determinant.h"

namespace halfspace {
namespace {

template <int C, int L>
glm::mat<C, L, float> random_glsl_matrix(std::mt19937& random) {
  glm::mat<C, L, float> m;
  for (int i = 0; i < C; ++i) {
    for (int k = 0; k < L; ++k)
      m[i][k] = std::ldexp(std::uniform_real_distribution<float>(-1, 1)(random), static_cast<int>(random() % 9) - 4);
  }
  return m;
}

template <int C, int L>
bool equal_matrices(const MatN<C, L, float>& a, const glm::mat<C, L, float>& b) {
  return static_cast<glm::mat<C, L, float>>(a) == b;
}

TEST(GlslMatrix, OperatorsMatchGlm) {
  std::mt19937 random(12);
  for (int i = 0; i < 300; ++i) {
    const glm::mat3 a = random_glsl_matrix<3, 3>(random), b = random_glsl_matrix<3, 3>(random);
    const glm::mat4x3 w = random_glsl_matrix<4, 3>(random);
    const mat3<float> m = a, n = b;
    const glm::vec3 v = a[1] * 0.7f;
    EXPECT_TRUE(equal_matrices(m + n, a + b) && equal_matrices(m - n, a - b) && equal_matrices(-m, -a));
    EXPECT_TRUE(equal_matrices(m * 0.7f, a * 0.7f) && equal_matrices(0.7f * m, 0.7f * a) && equal_matrices(m / 0.7f, a / 0.7f));
    EXPECT_TRUE(equal_matrices(0.7f / m, 0.7f / a) && equal_matrices(m + 0.7f, a + 0.7f) && equal_matrices(0.7f - m, 0.7f - a));
    EXPECT_TRUE(equal_matrices(matrixCompMult(m, n), glm::matrixCompMult(a, b)) && equal_matrices(transpose(m), glm::transpose(a)));
    EXPECT_TRUE(equal_matrices(m * n, a * b) && equal_matrices(m * b, a * b) && equal_matrices(a * n, a * b));
    EXPECT_TRUE(equal_matrices(m * mat4x3<float>(w), a * w) && equal_matrices(transpose(mat4x3<float>(w)), glm::transpose(w)));
    EXPECT_TRUE((m * vec3<float>(v) == vec3<float>(a * v)));
    const vec3<float> row = vec3<float>(v) * m;
    for (int k = 0; k < 3; ++k) EXPECT_EQ(row[k], dot(vec3<float>(v), m[k]));
    EXPECT_TRUE(equal_matrices(outerProduct(vec3<float>(v), vec2<float>(2, 3)), glm::outerProduct(v, glm::vec2(2, 3))));
    EXPECT_TRUE(m == m && m != n && !(m == n));
    mat3<float> c = m;
    c *= n, c += m, c -= 0.5f, c /= 0.3f, c *= 2.0f, c -= n, c += 1.0f, c /= m;
    EXPECT_TRUE(c == (((((m * n + m) - 0.5f) / 0.3f) * 2.0f - n) + 1.0f) / m);
    EXPECT_TRUE(equal_matrices(mat4<float>(m), glm::mat4(a)) && equal_matrices(mat2<float>(m), glm::mat2(a)));
  }
  EXPECT_TRUE(equal_matrices(mat3<float>(2.0f), glm::mat3(2.0f)));
  EXPECT_TRUE(equal_matrices(mat2x3<float>(1, 2, 3, 4.0f, 5.0, 6), glm::mat2x3(1, 2, 3, 4, 5, 6)));
  EXPECT_TRUE(equal_matrices(mat2<float>(glm::vec2(1, 2), vec2<float>(3, 4)), glm::mat2(1, 2, 3, 4)));
}

/// The largest errors of the determinant, in 2^-24 of the sum of its products without signs, and of inverse·determinant, in 2^-24 of the
/// same sum for each cofactor plus the error of the determinant.
struct MatrixErrors {
  double determinant = 0, inverse = 0;
};
template <int N>
MatrixErrors errors_of_random_matrices(int count) {
  std::mt19937 random(N);
  MatrixErrors worst;
  for (int n = 0; n < count; ++n) {
    const glm::mat<N, N, float> m = random_glsl_matrix<N, N>(random);
    const long double want = long_determinant(to_long(m), N, false), sizes = long_determinant(to_long(m), N, true);
    const auto got = static_cast<long double>(determinant(MatN<N, N, float>(m)));
    worst.determinant = std::max(worst.determinant, static_cast<double>(std::fabs(got - want) / sizes * 0x1p24L));
    const MatN<N, N, float> inverted = inverse(MatN<N, N, float>(m));
    for (int i = 0; i < N; ++i) {
      for (int k = 0; k < N; ++k) {
        // Times the computed determinant, a component is a cofactor with the roundings of the cofactor and of the division.
        const long double error = static_cast<long double>(inverted[i][k]) * got - long_cofactor(m, k, i, false);
        worst.inverse = std::max(worst.inverse, static_cast<double>(std::fabs(error) / long_cofactor(m, k, i, true) * 0x1p24L));
      }
    }
  }
  if (std::getenv("HALFSPACE_PRINT_ULPS") != nullptr) std::cout << N << ": " << worst.determinant << ' ' << worst.inverse << '\n';
  return worst;
}

TEST(GlslMatrix, DeterminantsAndInversesAreWithinTheirErrorBounds) {
  // The bounds leave at least a tenth above the largest errors found: 1.89, 2.96 and 3.63 for the determinant, and 1.00 (one
  // division), 2.67 and 3.98 for the inverse. The matrices are the same on every machine.
  const MatrixErrors two = errors_of_random_matrices<2>(200000), three = errors_of_random_matrices<3>(100000);
  const MatrixErrors four = errors_of_random_matrices<4>(30000);
  EXPECT_LE(two.determinant, 2);
  EXPECT_LE(three.determinant, 3.5);
  EXPECT_LE(four.determinant, 4.5);
  EXPECT_LE(two.inverse, 1);
  EXPECT_LE(three.inverse, 3);
  EXPECT_LE(four.inverse, 4.5);
  double worst = 0;
  std::mt19937 random(13);
  for (int i = 0; i < 200000; ++i) {
    glm::mat2 m = random_glsl_matrix<2, 2>(random);
    if (i % 2 == 0) m[1] = m[0] * 1.0001f;  // the products nearly cancel
    worst = std::max(worst, glsl_ulps(determinant(mat2<float>(m)), long_determinant(to_long(m), 2, false)));
  }
  EXPECT_LE(worst, 1.5);  // Jeannerod, Louvet and Muller (lanes.h)
}

TEST(GlslMatrix, InverseOfASingularMatrixIsNotFinite) {
  EXPECT_FALSE(std::isfinite(inverse(mat2<float>(1, 2, 2, 4))[0].x));
  EXPECT_FALSE(std::isfinite(inverse(mat3<float>(0.0f))[0].x));
  EXPECT_FALSE(std::isfinite(inverse(mat4<float>(0.0f))[0].x));
  EXPECT_TRUE(inverse(mat4<float>(2.0f)) == mat4<float>(0.5f));
  EXPECT_TRUE(inverse(mat3<float>(2.0f)) == mat3<float>(0.5f));
}

TEST(GlslMatrix, LanesMatchScalarBits) {
  expect_glsl_lanes_match_scalars([](const auto& a, auto& out) {
    using R = std::decay_t<decltype(a.x[0])>;
    const glm::mat3 uniform(1, 2, 3, 4, 5, 6, 7, 8, 10);
    const mat2<R> two(a.v2(0), a.v2(2));
    const mat3<R> three(a.v3(0), a.v3(3), a.v3(6));
    const mat4<R> four(a.v4(0), a.v4(4), a.v4(8), a.v4(12));
    out.add(determinant(two)), out.add(determinant(three)), out.add(determinant(four));
    out.add(inverse(two)), out.add(inverse(three)), out.add(inverse(four)), out.add(transpose(four));
    out.add(three * three), out.add(uniform * three), out.add(three * uniform), out.add(four * four), out.add(four * a.v4(3)),
        out.add(a.v4(3) * four);
    out.add(three * a.v3(5)), out.add(two * a.v2(5)), out.add(outerProduct(a.v3(0), a.v4(4))), out.add(matrixCompMult(three, uniform));
    out.add(three + three), out.add(three - uniform), out.add(three / uniform), out.add(-three), out.add(a.x[0] / three),
        out.add(three * a.x[1]);
    out.add(three == mat3<R>(uniform)), out.add(select(a.x[0] < a.x[1], three, uniform)), out.add(mat4<R>(three)), out.add(mat2<R>(four));
    out.add(mat2x3<R>(a.v3(0), a.v3(3)) * a.v2(6)), out.add(a.v3(0) * mat4x3<R>(a.v3(0), a.v3(1), a.v3(2), a.v3(3)));
  });
}

}  // namespace
}  // namespace halfspace
