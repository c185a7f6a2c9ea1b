// SPDX-License-Identifier: Apache-2.0
//
// Matrices that vary per pixel: mat2<R>, mat3<R>, mat4<R>, and mat2x3<R> … mat4x3<R>, which have 2 … 4 columns of 3 … rows, with the
// operators and the matrix functions of GLSL 3.30 (sections 5.9 and 8.5). They are also members of Attributes and Varyings.
//
// A matrix is stored and indexed by columns: m[1] is the second column, m[1].x its first row. glm::mat4 and the other matrices of GLM
// convert implicitly, so uniforms mix with varying matrices as they do with vectors (vec.h). Every sum and product has a fixed order.
//
// The results of determinant and inverse are not exact. Their errors are relative to the sizes of the products that they are made of, which
// may cancel; the bounds are multiples of u = 2^-24, and were measured on random matrices by tests/core/glsl_matrix_test.cpp.
#pragma once

#include "halfspace/core/component_wise.h"

namespace halfspace::HS_LANES {

/// C columns with L rows each.
template <int C, int L, Number R>
struct MatN {
  using value_type = R;
  using Column = VecN<L, R>;
  Column columns[C];

  MatN() = default;
  /// s on the diagonal and 0 elsewhere.
  HS_INLINE explicit MatN(R s) {
    for (int i = 0; i < C; ++i) {
      for (int k = 0; k < L; ++k) columns[i][k] = i == k ? s : R(0);
    }
  }
  /// From columns.
  template <std::convertible_to<Column>... V>
  requires(sizeof...(V) == C) HS_INLINE MatN(const V&... v) : columns{Column(v)...} {}
  /// From numbers, column by column.
  template <class... S>
  requires(sizeof...(S) == C * L && (std::convertible_to<S, R> && ...)) HS_INLINE MatN(const S&... s) {
    const R numbers[] = {detail::cast<R>(s)...};
    for (int i = 0; i < C * L; ++i) columns[i / L][i % L] = numbers[i];
  }
  /// From a matrix of another size: cut off, or extended by the identity matrix.
  template <int C2, int L2>
  requires(C2 != C || L2 != L) HS_INLINE explicit MatN(const MatN<C2, L2, R>& m) : MatN(R(1)) {
    for (int i = 0; i < std::min(C, C2); ++i) {
      for (int k = 0; k < std::min(L, L2); ++k) columns[i][k] = m[i][k];
    }
  }
  template <CastsTo<R> S>
  HS_INLINE explicit(!WidensTo<S, R>) MatN(const MatN<C, L, S>& m) {
    for (int i = 0; i < C; ++i) columns[i] = Column(m[i]);
  }
  template <CastsTo<R> S>
  HS_INLINE explicit(!WidensTo<S, R>) MatN(const glm::mat<C, L, S>& m) {
    for (int i = 0; i < C; ++i) columns[i] = Column(m[i]);
  }
  template <std::same_as<R> S>
  requires(!kIsLanes<S>) HS_INLINE operator glm::mat<C, L, S>() const {
    glm::mat<C, L, S> m;
    for (int i = 0; i < C; ++i) m[i] = columns[i];
    return m;
  }

  HS_INLINE Column& operator[](int i) { return columns[i]; }
  HS_INLINE const Column& operator[](int i) const { return columns[i]; }

  friend HS_INLINE MatN operator-(const MatN& a) {
    return a.each([](const Column& v) { return -v; });
  }
  friend HS_INLINE MatN operator+(const MatN& a, const MatN& b) {
    return a.each([](const Column& v, const Column& w) { return v + w; }, b);
  }
  friend HS_INLINE MatN operator-(const MatN& a, const MatN& b) {
    return a.each([](const Column& v, const Column& w) { return v - w; }, b);
  }
  friend HS_INLINE MatN operator/(const MatN& a, const MatN& b) {
    return a.each([](const Column& v, const Column& w) { return v / w; }, b);
  }
  friend HS_INLINE MatN operator+(const MatN& a, R s) {
    return a.each([s](const Column& v) { return v + s; });
  }
  friend HS_INLINE MatN operator+(R s, const MatN& a) { return a + s; }
  friend HS_INLINE MatN operator-(const MatN& a, R s) {
    return a.each([s](const Column& v) { return v - s; });
  }
  friend HS_INLINE MatN operator-(R s, const MatN& a) {
    return a.each([s](const Column& v) { return s - v; });
  }
  friend HS_INLINE MatN operator*(const MatN& a, R s) {
    return a.each([s](const Column& v) { return v * s; });
  }
  friend HS_INLINE MatN operator*(R s, const MatN& a) { return a * s; }
  friend HS_INLINE MatN operator/(const MatN& a, R s) {
    return a.each([s](const Column& v) { return v / s; });
  }
  friend HS_INLINE MatN operator/(R s, const MatN& a) {
    return a.each([s](const Column& v) { return s / v; });
  }
  HS_INLINE MatN& operator+=(const MatN& b) { return *this = *this + b; }
  HS_INLINE MatN& operator-=(const MatN& b) { return *this = *this - b; }
  HS_INLINE MatN& operator/=(const MatN& b) { return *this = *this / b; }
  HS_INLINE MatN& operator*=(const MatN<C, C, R>& b) { return *this = *this * b; }
  HS_INLINE MatN& operator+=(R s) { return *this = *this + s; }
  HS_INLINE MatN& operator-=(R s) { return *this = *this - s; }
  HS_INLINE MatN& operator*=(R s) { return *this = *this * s; }
  HS_INLINE MatN& operator/=(R s) { return *this = *this / s; }
  friend HS_INLINE MaskOf<R> operator==(const MatN& a, const MatN& b) {
    MaskOf<R> r = a[0] == b[0];
    for (int i = 1; i < C; ++i) r = r && a[i] == b[i];
    return r;
  }
  friend HS_INLINE MaskOf<R> operator!=(const MatN& a, const MatN& b) { return !(a == b); }

  /// The sum of the columns, weighted by the components of v. Of four, the first and the last two are added first, as in vec.h.
  friend HS_INLINE Column operator*(const MatN& m, const VecN<C, R>& v) {
    if constexpr (C == 2) {
      return m[0] * v.x + m[1] * v.y;
    } else if constexpr (C == 3) {
      return m[0] * v.x + m[1] * v.y + m[2] * v.z;
    } else {
      return (m[0] * v.x + m[1] * v.y) + (m[2] * v.z + m[3] * v.w);
    }
  }
  /// The dot products of v with the columns.
  friend HS_INLINE VecN<C, R> operator*(const Column& v, const MatN& m) {
    VecN<C, R> r;
    for (int i = 0; i < C; ++i) r[i] = dot(v, m[i]);
    return r;
  }

  /// Product component by component. GLSL 8.5.
  friend HS_INLINE MatN matrixCompMult(const MatN& a, const MatN& b) {
    return a.each([](const Column& v, const Column& w) { return v * w; }, b);
  }
  /// Selects a where m is true and b elsewhere, lane by lane.
  friend HS_INLINE MatN select(const MaskOf<R>& m, const MatN& a, const MatN& b) {
    return a.each([&m](const Column& v, const Column& w) { return select(m, v, w); }, b);
  }

 private:
  template <class F, class... M>
  HS_INLINE MatN each(F f, const M&... more) const {
    MatN r;
    for (int i = 0; i < C; ++i) r[i] = f(columns[i], more[i]...);
    return r;
  }
};

template <class R>
using mat2 = MatN<2, 2, R>;
template <class R>
using mat3 = MatN<3, 3, R>;
template <class R>
using mat4 = MatN<4, 4, R>;
template <class R>
using mat2x3 = MatN<2, 3, R>;
template <class R>
using mat2x4 = MatN<2, 4, R>;
template <class R>
using mat3x2 = MatN<3, 2, R>;
template <class R>
using mat3x4 = MatN<3, 4, R>;
template <class R>
using mat4x2 = MatN<4, 2, R>;
template <class R>
using mat4x3 = MatN<4, 3, R>;

namespace detail {
template <class M>
inline constexpr bool kIsVaryingMatrix = false;
template <int C, int L, Number R>
inline constexpr bool kIsVaryingMatrix<MatN<C, L, R>> = true;

/// The matrix of Halfspace with the shape of M, which is one or a matrix of GLM, and components of type R.
template <class M, class R>
struct MatrixOfT;
template <int C, int L, Number S, class R>
struct MatrixOfT<MatN<C, L, S>, R> : std::type_identity<MatN<C, L, R>> {};
template <int C, int L, class S, class R>
struct MatrixOfT<glm::mat<C, L, S>, R> : std::type_identity<MatN<C, L, R>> {};
template <class M, class R>
using MatrixOf = typename MatrixOfT<M, R>::type;

template <int C, int L, int C2, Number R>
HS_INLINE MatN<C2, L, R> product(const MatN<C, L, R>& a, const MatN<C2, C, R>& b) {
  MatN<C2, L, R> r;
  for (int i = 0; i < C2; ++i) r[i] = a * b[i];
  return r;
}
}  // namespace detail

/// Linear-algebraic product: a times each column of b.
template <int C, int L, int C2, Number R>
HS_INLINE MatN<C2, L, R> operator*(const MatN<C, L, R>& a, const MatN<C2, C, R>& b) {
  return detail::product(a, b);
}
template <int C, int L, int C2, Number R, WidensTo<R> S>
HS_INLINE MatN<C2, L, R> operator*(const glm::mat<C, L, S>& a, const MatN<C2, C, R>& b) {
  return detail::product(MatN<C, L, R>(a), b);
}
template <int C, int L, int C2, Number R, WidensTo<R> S>
HS_INLINE MatN<C2, L, R> operator*(const MatN<C, L, R>& a, const glm::mat<C2, C, S>& b) {
  return detail::product(a, MatN<C2, C, R>(b));
}

/// The matrix c·rᵀ: column i is c·r[i]. Correctly rounded. GLSL 8.5.
template <int L, int C, Number R>
HS_INLINE MatN<C, L, R> outerProduct(const VecN<L, R>& c, const VecN<C, R>& r) {
  MatN<C, L, R> m;
  for (int i = 0; i < C; ++i) m[i] = c * r[i];
  return m;
}
/// Exchanges rows and columns, exact. GLSL 8.5.
template <int C, int L, Number R>
HS_INLINE MatN<L, C, R> transpose(const MatN<C, L, R>& m) {
  MatN<L, C, R> r;
  for (int i = 0; i < L; ++i) {
    for (int k = 0; k < C; ++k) r[i][k] = m[k][i];
  }
  return r;
}

namespace detail {

/// cross(a, b) with an error of at most 1.5 ulp per component.
template <class R>
HS_INLINE vec3<R> accurate_cross(const vec3<R>& a, const vec3<R>& b) {
  return {difference_of_products(a.y, b.z, a.z, b.y), difference_of_products(a.z, b.x, a.x, b.z),
          difference_of_products(a.x, b.y, a.y, b.x)};
}

/// The determinants of the 2x2 matrices that rows i and k of the columns a and b contain, for the six pairs i < k in the order 01, 02, 03,
/// 12, 13, 23.
template <class R>
HS_INLINE std::array<R, 6> minors(const vec4<R>& a, const vec4<R>& b) {
  return {difference_of_products(a.x, b.y, a.y, b.x), difference_of_products(a.x, b.z, a.z, b.x),
          difference_of_products(a.x, b.w, a.w, b.x), difference_of_products(a.y, b.z, a.z, b.y),
          difference_of_products(a.y, b.w, a.w, b.y), difference_of_products(a.z, b.w, a.w, b.z)};
}
template <class R>
HS_INLINE R determinant_of_minors(const std::array<R, 6>& s, const std::array<R, 6>& t) {
  return (difference_of_products(s[0], t[5], s[1], t[4]) + difference_of_products(s[5], t[0], s[4], t[1])) + fma(s[2], t[3], s[3] * t[2]);
}
/// a·p − b·q + c·r.
template <class R>
HS_INLINE R alternating_sum(R a, R p, R b, R q, R c, R r) {
  return fma(c, r, difference_of_products(a, p, b, q));
}

}  // namespace detail

/// The determinant. The error is at most 1.5 ulp. GLSL 8.5.
template <Number R>
HS_INLINE R determinant(const mat2<R>& m) {
  return difference_of_products(m[0].x, m[1].y, m[1].x, m[0].y);
}
/// The determinant. The error is at most 3.5 u times the sum of the six products without their signs. GLSL 8.5.
template <Number R>
HS_INLINE R determinant(const mat3<R>& m) {
  return dot(m[0], detail::accurate_cross(m[1], m[2]));
}
/// The determinant. The error is at most 4.5 u times the sum of the 24 products without their signs. GLSL 8.5.
template <Number R>
HS_INLINE R determinant(const mat4<R>& m) {
  return detail::determinant_of_minors(detail::minors(m[0], m[1]), detail::minors(m[2], m[3]));
}

/// The inverse: the adjugate, which consists of cofactors, divided by the determinant. A singular matrix gives infinities and NaN. Times
/// the determinant that is computed, a component differs from its cofactor by at most 1 u (mat2), 3 u (mat3) or 4.5 u (mat4) times the sum
/// of the products in the cofactor without their signs. GLSL 8.5.
template <Number R>
HS_INLINE mat2<R> inverse(const mat2<R>& m) {
  return mat2<R>(m[1].y, -m[0].y, -m[1].x, m[0].x) / determinant(m);
}
template <Number R>
HS_INLINE mat3<R> inverse(const mat3<R>& m) {
  const mat3<R> rows(detail::accurate_cross(m[1], m[2]), detail::accurate_cross(m[2], m[0]), detail::accurate_cross(m[0], m[1]));
  return transpose(rows) / dot(m[0], rows[0]);
}
template <Number R>
HS_INLINE mat4<R> inverse(const mat4<R>& m) {
  const auto s = detail::minors(m[0], m[1]), t = detail::minors(m[2], m[3]);
  // Row k of the adjugate consists of the cofactors of column k. Those of columns 0 and 1 contain the other of both, and t. Signs are
  // applied to arguments: g++ 12 turns the negative of an fma of scalars into an instruction that gives zeros the other sign.
  const auto cofactors = [](const vec4<R>& c, const std::array<R, 6>& n) {
    return vec4<R>(detail::alternating_sum(c.y, n[5], c.z, n[4], c.w, n[3]), detail::alternating_sum(-c.x, n[5], -c.z, n[2], -c.w, n[1]),
                   detail::alternating_sum(c.x, n[4], c.y, n[2], c.w, n[0]), detail::alternating_sum(-c.x, n[3], -c.y, n[1], -c.z, n[0]));
  };
  const mat4<R> rows(cofactors(m[1], t), cofactors(-m[0], t), cofactors(m[3], s), cofactors(-m[2], s));
  return transpose(rows) / detail::determinant_of_minors(s, t);
}

}  // namespace halfspace::HS_LANES
