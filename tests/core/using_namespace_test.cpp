// SPDX-License-Identifier: Apache-2.0
//
// After `using namespace halfspace`, the names of mathematical functions are not ambiguous, whatever headers of the standard library a
// program includes and even if it also uses namespace std.
#include <math.h>    // NOLINT: declares the functions in the global namespace, also for float
#include <stdlib.h>  // NOLINT: the same for abs

#include <algorithm>
#include <cmath>
#include <type_traits>

#include <gtest/gtest.h>

#include "halfspace/core/lane_math.h"
#include "halfspace/core/vec.h"

namespace program {

using namespace halfspace;

template <class R>
R of_all_functions(R x) {
  const R exact = abs(x) + floor(x) + sqrt(x) + fma(x, x, x) + min(x, R(1)) + max(x, R(0)) + clamp(x, R(0), R(1)) + round_even(x);
  const R elementary = exp(x) + exp2(x) + log(x) + log2(x) + pow(x, x) + sin(x) + cos(x) + atan2(x, x) + atan(x) + asin(x) + acos(x);
  const halfspace::vec3<R> a(x), b(R(1));
  const R vectors = length(a) + dot(a, b) + mix(a, b, x).x + normalize(a).x + reflect(a, b).x + cross(a, b).x;
  return exact + elementary + vectors + select(x > R(0), x, R(1));
}

int of_integers(int x) { return abs(x) + min(x, 2) + max(x, 2); }

}  // namespace program

namespace program_with_std {

using namespace std;
using namespace halfspace;

template <class R>
R of_all_functions(R x) {
  const R exact = abs(x) + floor(x) + sqrt(x) + fma(x, x, x) + min(x, R(1)) + max(x, R(0)) + clamp(x, R(0), R(1)) + round_even(x);
  const R elementary = exp(x) + exp2(x) + log(x) + log2(x) + pow(x, x) + sin(x) + cos(x) + atan2(x, x) + atan(x) + asin(x) + acos(x);
  const halfspace::vec3<R> a(x), b(R(1));
  const R vectors = length(a) + dot(a, b) + mix(a, b, x).x + normalize(a).x + reflect(a, b).x + cross(a, b).x;
  return exact + elementary + vectors + select(x > R(0), x, R(1));
}

int of_integers(int x) { return abs(x) + min(x, 2) + max(x, 2); }

}  // namespace program_with_std

namespace {

TEST(UsingNamespace, NoFunctionIsAmbiguous) {
  // libm may round elementary functions differently: at most a few ulp of a sum below 20.
  EXPECT_NEAR(program::of_all_functions(0.5f), program::of_all_functions(0.5), 2e-5);
  EXPECT_NEAR(program_with_std::of_all_functions(0.5f), program::of_all_functions(0.5), 2e-5);
  EXPECT_EQ(program_with_std::of_all_functions(0.5), program::of_all_functions(0.5));
  EXPECT_NEAR(halfspace::lane(program::of_all_functions(halfspace::Real(0.5f)), 0), program::of_all_functions(0.5), 2e-5);
  EXPECT_NEAR(halfspace::lane(program_with_std::of_all_functions(halfspace::Real(0.5f)), 0), program::of_all_functions(0.5), 2e-5);
  EXPECT_EQ(program::of_integers(-3), 3 - 3 + 2);
  EXPECT_EQ(program_with_std::of_integers(-3), 3 - 3 + 2);
  static_assert(std::is_same_v<decltype(halfspace::abs(1.0f)), float> && std::is_same_v<decltype(halfspace::floor(1.0)), double>);
}

}  // namespace
