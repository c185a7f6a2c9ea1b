// SPDX-License-Identifier: Apache-2.0
//
// Matrices as members of Attributes and Varyings.
#include <gtest/gtest.h>

#include "halfspace/core/glsl_matrix.h"
#include "halfspace/shading/varyings.h"

namespace halfspace {
namespace {

template <class R>
struct MatrixVaryings {
  vec2<R> uv;
  mat3<R> tangent_space;
  Flat<mat2x3<R>> flat;
};

TEST(MatrixVaryings, ConsistOfTheirColumns) {
  static_assert(kComponents<MatrixVaryings<Real>> == 2 + 9 + 6);
  static_assert(kInterpolations<MatrixVaryings<float>>[10] == Interpolation::smooth);
  static_assert(kInterpolations<MatrixVaryings<float>>[11] == Interpolation::flat);
  MatrixVaryings<float> v{vec2<float>(1, 2), mat3<float>(3, 4, 5, 6, 7, 8, 9, 10, 11), {mat2x3<float>(12, 13, 14, 15, 16, 17)}};
  const auto components = to_components<float>(v);
  for (std::size_t i = 0; i < components.size(); ++i) EXPECT_EQ(components[i], static_cast<float>(i + 1));
  const auto again = from_components<MatrixVaryings<float>>(components);
  EXPECT_TRUE(again.tangent_space == v.tangent_space && again.flat.value == v.flat.value);
}

}  // namespace
}  // namespace halfspace
