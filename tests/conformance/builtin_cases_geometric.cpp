// SPDX-License-Identifier: Apache-2.0
//
// The geometric functions and those of matrices (GLSL 4.60, sections 8.5 and 8.6). Other implementations may use the definitions of GLSL
// with a rounding for every operation, and their errors are limited to twice those, or 2.5 ulp for each quotient or root.
#include "conformance/builtin_calls.h"
#include "support/long_determinant.h"

namespace halfspace::conformance::builtins {

namespace {

using Numbers = std::vector<double>;

/// A sum of products, and the sum of the products without their signs.
struct SumOfProducts {
  double value = 0.0, size = 0.0;
};
SumOfProducts dot_of(const Numbers& a, const Numbers& b) {
  SumOfProducts d;
  for (std::size_t k = 0; k < a.size(); ++k) {
    d.value += a[k] * b[k];
    d.size += std::fabs(a[k] * b[k]);
  }
  return d;
}
double length_of(const Numbers& a) { return std::sqrt(dot_of(a, a).value); }

template <int L>
void add_lengths(Cases& cases) {
  using T = Float<L>;
  add_case(
      cases, Types<Float<1>>(), Types<T>(), {"length", "r = length(a);", {moderate()}}, [](const auto& v) { return length(v); },
      [](const Operands& x) -> std::vector<Expected> {
        const double value = length_of(x[0]), ulp = ulp_of(value);
        return {{value, 1.6 * ulp, 5.0 * ulp}};
      });
  add_case(
      cases, Types<Float<1>>(), Types<T, T>(), {"distance", "r = distance(a, b);", {moderate(), moderate()}},
      [](const auto& a, const auto& b) { return distance(a, b); },
      [](const Operands& x) -> std::vector<Expected> {
        Numbers between = x[0];
        for (std::size_t k = 0; k < between.size(); ++k) between[k] -= x[1][k];
        const double value = length_of(between), ulp = ulp_of(value);
        return {{value, 2.0 * ulp, 6.0 * ulp}};
      });
  add_case(
      cases, Types<Float<1>>(), Types<T, T>(), {"dot", "r = dot(a, b);", {moderate(), moderate()}},
      [](const auto& a, const auto& b) { return dot(a, b); },
      [](const Operands& x) -> std::vector<Expected> {
        const SumOfProducts d = dot_of(x[0], x[1]);
        return {{d.value, 3.1 * kRounding * d.size, 6.2 * kRounding * d.size}};
      });
  add_case(
      cases, Types<T>(), Types<T>(), {"normalize", "r = normalize(a);", {moderate()}}, [](const auto& v) { return normalize(v); },
      [](const Operands& x) {
        std::vector<Expected> results;
        for (const double component : x[0]) {
          const double value = component / length_of(x[0]), ulp = ulp_of(value);
          results.push_back({value, 3.1 * ulp, 6.2 * ulp});
        }
        return results;
      });
}

/// The number under the root of refract().
double under_root(const Operands& x) {
  const double d = dot_of(x[1], x[0]).value;
  return 1.0 - x[2][0] * x[2][0] * (1.0 - d * d);
}

template <int L>
void add_reflections(Cases& cases) {
  using T = Float<L>;
  add_case(
      cases, Types<T>(), Types<T, T, T>(), {"faceforward", "r = faceforward(a, b, c);", {moderate(), moderate(), moderate()}},
      [](const auto& n, const auto& incident, const auto& reference) { return faceforward(n, incident, reference); },
      [](const Operands& x) {
        const SumOfProducts d = dot_of(x[2], x[1]);
        const bool rounded_sign = std::fabs(d.value) <= 3.1 * kRounding * d.size;
        std::vector<Expected> results;
        for (const double n : x[0]) {
          const double allowed = rounded_sign ? 2.0 * std::fabs(n) : 0.0;
          results.push_back({d.value < 0.0 ? n : -n, allowed, allowed});
        }
        return results;
      });
  add_case(
      cases, Types<T>(), Types<T, T>(), {"reflect", "r = reflect(a, b);", {moderate(), unit_vectors()}},
      [](const auto& v, const auto& n) { return reflect(v, n); },
      [](const Operands& x) {
        const SumOfProducts d = dot_of(x[0], x[1]);
        std::vector<Expected> results;
        for (std::size_t k = 0; k < x[0].size(); ++k) {
          const double n = x[1][k], size = kRounding * (std::fabs(x[0][k]) + 2.0 * d.size * std::fabs(n));
          results.push_back({x[0][k] - 2.0 * d.value * n, 4.0 * size, 8.0 * size});
        }
        return results;
      });
  add_case(
      cases, Types<T>(), Types<T, T, Float<1>>(),
      {"refract", "r = refract(a, b, c);", {unit_vectors(), unit_vectors(), between(0.5, 1.5, {0.5f, 1.0f, 1.5f})}, {[](const Operands& x) {
         return std::fabs(under_root(x)) >= 0.01;
       }}},
      [](const auto& incident, const auto& n, const auto& eta) { return refract(incident, n, eta); },
      [=](const Operands& x) {
        const double eta = x[2][0], d = dot_of(x[1], x[0]).value, k = under_root(x);
        std::vector<Expected> results;
        for (std::size_t i = 0; i < x[0].size(); ++i) {
          const double value = k < 0.0 ? 0.0 : eta * x[0][i] - (eta * d + std::sqrt(k)) * x[1][i];
          results.push_back({value, k < 0.0 ? 0.0 : 21.0 * kRounding, k < 0.0 ? 0.0 : 42.0 * kRounding});
        }
        return results;
      });
}

void add_cross(Cases& cases) {
  add_case(
      cases, Types<Float<3>>(), Types<Float<3>, Float<3>>(), {"cross", "r = cross(a, b);", {moderate(), moderate()}},
      [](const auto& a, const auto& b) { return cross(a, b); },
      [](const Operands& x) {
        std::vector<Expected> results;
        for (std::size_t k = 0; k < 3; ++k) {
          const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
          const double first = x[0][i] * x[1][j], second = x[0][j] * x[1][i], size = kRounding * (std::fabs(first) + std::fabs(second));
          results.push_back({first - second, 2.0 * size, 4.0 * size});
        }
        return results;
      });
}

// ---- matrices ------------------------------------------------------------------------------------------------------

template <int C, int L>
void add_products(Cases& cases) {
  using M = Matrix<C, L>;
  add_by_component(
      cases, Types<M>(), Types<M, M>(), {"matrixCompMult", "r = matrixCompMult(a, b);"},
      [](const auto& a, const auto& b) { return matrixCompMult(a, b); }, [](double a, double b) { return a * b; }, {rounded(), rounded()});
  add_case(
      cases, Types<M>(), Types<Float<L>, Float<C>>(), {"outerProduct", "r = outerProduct(a, b);", {moderate(), moderate()}},
      [](const auto& column, const auto& row) { return outerProduct(column, row); },
      [](const Operands& x) {
        std::vector<Expected> results;
        for (const double row : x[1]) {
          for (const double column : x[0]) {
            const double value = column * row;
            results.push_back({value, rounded()(value, {}), rounded()(value, {})});
          }
        }
        return results;
      });
  add_case(
      cases, Types<Matrix<L, C>>(), Types<M>(), {"transpose", "r = transpose(a);"}, [](const auto& m) { return transpose(m); },
      [](const Operands& x) {
        std::vector<Expected> results;
        for (std::size_t row = 0; row < L; ++row) {
          for (std::size_t column = 0; column < C; ++column) results.push_back({x[0][column * L + row], 0.0, 0.0});
        }
        return results;
      });
}

template <int N>
glm::mat<N, N, float> matrix_of(const Numbers& numbers) {
  glm::mat<N, N, float> m;
  for (int i = 0; i < N * N; ++i) m[i / N][i % N] = static_cast<float>(numbers[static_cast<std::size_t>(i)]);
  return m;
}

/// The determinant, and the sum of its products without their signs.
template <int N>
SumOfProducts determinant_of(const Operands& x) {
  const LongMatrix m = to_long(matrix_of<N>(x[0]));
  return {static_cast<double>(long_determinant(m, N, false)), static_cast<double>(long_determinant(m, N, true))};
}

/// `determinant_rounding` and `inverse_rounding` are the bounds of the documentation, relative to the sums of products without signs.
template <int N>
void add_determinants(Cases& cases, double determinant_rounding, double inverse_rounding) {
  using M = Matrix<N, N>;
  constexpr double kOthers = 24.0;  // the largest number of products, each of which may be rounded
  add_case(
      cases, Types<Float<1>>(), Types<M>(), {"determinant", "r = determinant(a);"}, [](const auto& m) { return determinant(m); },
      [=](const Operands& x) -> std::vector<Expected> {
        const SumOfProducts d = determinant_of<N>(x);
        return {{d.value, determinant_rounding * kRounding * d.size, kOthers * kRounding * d.size}};
      });
  add_case(
      cases, Types<M>(), Types<M>(), {"inverse", "r = inverse(a);", {moderate()}, {[](const Operands& x) {
                                        return std::fabs(determinant_of<N>(x).value) > 0.05 * determinant_of<N>(x).size;
                                      }}},
      [](const auto& m) { return inverse(m); },
      [=](const Operands& x) {
        const SumOfProducts d = determinant_of<N>(x);
        const glm::mat<N, N, float> m = matrix_of<N>(x[0]);
        std::vector<Expected> results;
        for (int i = 0; i < N; ++i) {
          for (int k = 0; k < N; ++k) {
            const auto cofactor = static_cast<double>(long_cofactor(m, k, i, false)),
                       size = static_cast<double>(long_cofactor(m, k, i, true));
            // The error of the cofactor, and that of the determinant by which it is divided.
            const auto error = [&](double of_cofactor, double of_determinant) {
              const double relative = of_determinant * kRounding * d.size / std::fabs(d.value);
              return (of_cofactor * kRounding * size + std::fabs(cofactor) * relative) / (std::fabs(d.value) * (1.0 - relative));
            };
            results.push_back({cofactor / d.value, error(inverse_rounding, determinant_rounding), error(kOthers, kOthers)});
          }
        }
        return results;
      });
}

}  // namespace

Cases geometric_cases() {
  Cases cases;
  for_lengths([&]<int L>() {
    add_lengths<L>(cases);
    add_reflections<L>(cases);
  });
  add_cross(cases);
  for_matrices([&]<int C, int L>() { add_products<C, L>(cases); });
  add_determinants<2>(cases, 2.0, 1.0);
  add_determinants<3>(cases, 3.5, 3.0);
  add_determinants<4>(cases, 4.5, 4.5);
  return cases;
}

}  // namespace halfspace::conformance::builtins
