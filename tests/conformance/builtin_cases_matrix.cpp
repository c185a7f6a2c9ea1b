// SPDX-License-Identifier: Apache-2.0
//
// The operators of matrices (GLSL 4.60, section 5.10).
#include "conformance/builtin_calls.h"

namespace halfspace::conformance::builtins {

namespace {

/// a op b component by component, where A or B may be a scalar.
template <class M, class A, class B>
void add_operators(Cases& cases) {
  const Bounds correct{rounded(), rounded()}, quotient{rounded(), ulps(2.5)};
  const auto add = [&](const char* name, const char* glsl, auto f, const Bounds& bounds) {
    add_by_component(cases, Types<M>(), Types<A, B>(), {name, glsl, {moderate(), moderate()}}, f, f, bounds);
  };
  add(
      "add", "r = a + b;", [](const auto& a, const auto& b) { return a + b; }, correct);
  add(
      "subtract", "r = a - b;", [](const auto& a, const auto& b) { return a - b; }, correct);
  add(
      "divide", "r = a / b;", [](const auto& a, const auto& b) { return a / b; }, quotient);
  // The product of two matrices is not one of components.
  if constexpr (!std::is_same_v<A, B>)
    add(
        "multiply", "r = a * b;", [](const auto& a, const auto& b) { return a * b; }, correct);
}

/// A sum of products, each of which may be rounded, as may each sum: an error of one rounding of each term for each of them.
Expected sum_of_products(const std::vector<double>& a, const std::vector<double>& b) {
  Expected sum;
  double size = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k) {
    sum.value += a[k] * b[k];
    size += std::fabs(a[k] * b[k]);
  }
  sum.allowed = sum.allowed_by_glsl = (static_cast<double>(a.size()) + 0x1p-10) * kRounding * size;
  return sum;
}
/// A row of a matrix with `rows` rows.
std::vector<double> row_of(const std::vector<double>& m, std::size_t rows, std::size_t row) {
  std::vector<double> numbers;
  for (std::size_t k = row; k < m.size(); k += rows) numbers.push_back(m[k]);
  return numbers;
}
std::vector<double> column_of(const std::vector<double>& m, std::size_t rows, std::size_t column) {
  const auto first = m.begin() + static_cast<std::ptrdiff_t>(rows * column);
  return {first, first + static_cast<std::ptrdiff_t>(rows)};
}
/// The product of a matrix with `rows` rows and one with `inner` rows.
std::vector<Expected> product_of(const std::vector<double>& a, std::size_t rows, const std::vector<double>& b, std::size_t inner) {
  std::vector<Expected> results;
  for (std::size_t column = 0; column < b.size() / inner; ++column) {
    for (std::size_t row = 0; row < rows; ++row) results.push_back(sum_of_products(row_of(a, rows, row), column_of(b, inner, column)));
  }
  return results;
}

template <int C, int L>
void add_linear_products(Cases& cases) {
  using M = Matrix<C, L>;
  const auto multiply = [](const auto& a, const auto& b) { return a * b; };
  const Description d{"multiply", "r = a * b;", {moderate(), moderate()}};
  add_case(cases, Types<Float<L>>(), Types<M, Float<C>>(), d, multiply, [](const Operands& x) { return product_of(x[0], L, x[1], C); });
  add_case(cases, Types<Float<C>>(), Types<Float<L>, M>(), d, multiply, [](const Operands& x) { return product_of(x[0], 1, x[1], L); });
  for_vectors([&]<int C2>() {
    add_case(cases, Types<Matrix<C2, L>>(), Types<M, Matrix<C2, C>>(), d, multiply,
             [](const Operands& x) { return product_of(x[0], L, x[1], C); });
  });
}

template <int C, int L>
void add_others(Cases& cases) {
  using M = Matrix<C, L>;
  add_by_component(
      cases, Types<M>(), Types<M>(), {"negate", "r = -a;"}, [](const auto& a) { return -a; }, [](double a) { return -a; });
  add_by_component(
      cases, Types<M>(), Types<Bool<1>, M, M>(), {"select", "r = a ? b : c;"},
      [](const auto& m, const auto& a, const auto& b) { return select(m, a, b); }, [](bool m, double a, double b) { return m ? a : b; });
}

}  // namespace

Cases matrix_operator_cases() {
  Cases cases;
  for_matrices([&]<int C, int L>() {
    using M = Matrix<C, L>;
    add_operators<M, M, M>(cases);
    add_operators<M, M, Float<1>>(cases);
    add_operators<M, Float<1>, M>(cases);
    add_linear_products<C, L>(cases);
    add_others<C, L>(cases);
  });
  return cases;
}

}  // namespace halfspace::conformance::builtins
