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

#include "core/using_namespace_functions.inc"

}  // namespace program

namespace program_with_std {

using namespace std;
using namespace halfspace;

#include "core/using_namespace_functions.inc"

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
