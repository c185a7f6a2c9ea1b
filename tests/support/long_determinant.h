// SPDX-License-Identifier: Apache-2.0
//
// Determinants and cofactors of small matrices in long double, by expansion.
#pragma once

#include <array>
#include <cmath>

#include <glm/glm.hpp>

namespace halfspace {

using LongMatrix = std::array<std::array<long double, 4>, 4>;

/// Expands along the first column. With `sizes`, returns the sum of the products without their signs.
inline long double long_determinant(const LongMatrix& m, int n, bool sizes) {
  if (n == 1) return sizes ? std::fabs(m[0][0]) : m[0][0];
  long double sum = 0;
  for (int row = 0; row < n; ++row) {
    LongMatrix minor{};
    for (int i = 1; i < n; ++i) {
      for (int k = 0, to = 0; k < n; ++k) {
        if (k != row)
          minor[static_cast<std::size_t>(i - 1)][static_cast<std::size_t>(to++)] =
              m[static_cast<std::size_t>(i)][static_cast<std::size_t>(k)];
      }
    }
    const long double x = m[0][static_cast<std::size_t>(row)], part = long_determinant(minor, n - 1, sizes);
    sum += sizes ? std::fabs(x) * part : row % 2 == 0 ? x * part : -x * part;
  }
  return sum;
}
template <int N>
LongMatrix to_long(const glm::mat<N, N, float>& m) {
  LongMatrix r{};
  for (int i = 0; i < N; ++i) {
    for (int k = 0; k < N; ++k) r[static_cast<std::size_t>(i)][static_cast<std::size_t>(k)] = static_cast<long double>(m[i][k]);
  }
  return r;
}
/// The cofactor of row k of column i.
template <int N>
long double long_cofactor(const glm::mat<N, N, float>& m, int i, int k, bool sizes) {
  LongMatrix minor{};
  for (int a = 0, to = 0; a < N; ++a) {
    if (a == i) continue;
    for (int b = 0, to_row = 0; b < N; ++b) {
      if (b != k) minor[static_cast<std::size_t>(to)][static_cast<std::size_t>(to_row++)] = static_cast<long double>(m[a][b]);
    }
    ++to;
  }
  const long double d = long_determinant(minor, N - 1, sizes);
  return sizes || (i + k) % 2 == 0 ? d : -d;
}

}  // namespace halfspace
