// SPDX-License-Identifier: Apache-2.0
//
// Measures the errors of the geometric functions and of mix() against long double, for the table of docs/reference/shading_language.md.
#include <algorithm>
#include <cstdlib>
#include <iostream>

#include "core/glsl_lanes.h"

namespace halfspace {
namespace {

using Real = long double;

template <int N>
VecN<N, float> random_vector(std::mt19937& random, int exponents) {
  VecN<N, float> v;
  for (int k = 0; k < N; ++k) {
    const float x = std::uniform_real_distribution<float>(-1, 1)(random);
    v[k] = std::ldexp(x, static_cast<int>(random() % static_cast<unsigned>(exponents)) - exponents / 2);
  }
  return v;
}

// The dot product in long double, and with `sizes` the sum of its products without their signs.
template <int N>
Real long_dot(const VecN<N, float>& a, const VecN<N, float>& b, bool sizes = false) {
  Real sum = 0;
  for (int k = 0; k < N; ++k) {
    const Real product = Real{a[k]} * Real{b[k]};
    sum += sizes ? std::fabs(product) : product;
  }
  return sum;
}

// Errors in 2^-24 of a size that the caller gives.
double units(float got, Real want, Real size) { return static_cast<double>(std::fabs(Real{got} - want) / size * 0x1p24L); }

// The largest errors that were found: of length, distance and normalize in ulp, of all others in u = 2^-24 of a size.
struct GeometricErrors {
  double length = 0, distance = 0, normalize = 0, dot = 0, reflect = 0, refract = 0, mix = 0;

  void print(int n) const {
    if (std::getenv("HALFSPACE_PRINT_ULPS") != nullptr)
      std::cout << n << ": length " << length << " distance " << distance << " normalize " << normalize << " dot " << dot << " reflect "
                << reflect << " refract " << refract << " mix " << mix << '\n';
  }
};

void keep(double& largest, double error) { largest = std::max(largest, error); }

template <int N>
GeometricErrors errors_of_random_vectors(int count) {
  std::mt19937 random(N);
  GeometricErrors e;
  for (int n = 0; n < count; ++n) {
    const VecN<N, float> a = random_vector<N>(random, 9), b = random_vector<N>(random, 9);
    const Real length_a = std::sqrt(long_dot(a, a));
    keep(e.length, glsl_ulps(length(a), length_a));
    Real squares = 0;
    for (int k = 0; k < N; ++k) squares += (Real{a[k]} - Real{b[k]}) * (Real{a[k]} - Real{b[k]});
    keep(e.distance, glsl_ulps(distance(a, b), std::sqrt(squares)));
    keep(e.dot, units(dot(a, b), long_dot(a, b), long_dot(a, b, true)));
    const VecN<N, float> unit = normalize(a), normal = normalize(b), reflected = reflect(a, normal);
    const float weight = std::uniform_real_distribution<float>(0, 1)(random), eta = 0.5f + weight;
    const VecN<N, float> mixed = mix(a, b, weight), refracted = refract(unit, normal, eta);
    const Real cosine = long_dot(normal, unit), k2 = 1 - Real{eta} * Real{eta} * (1 - cosine * cosine);
    for (int k = 0; k < N; ++k) {
      keep(e.normalize, glsl_ulps(unit[k], Real{a[k]} / length_a));
      const Real part = 2 * long_dot(normal, a) * Real{normal[k]}, size = 2 * long_dot(normal, a, true) * std::fabs(Real{normal[k]});
      keep(e.reflect, units(reflected[k], Real{a[k]} - part, std::fabs(Real{a[k]}) + size));
      const Real from = Real{a[k]} * (1 - Real{weight}), to = Real{b[k]} * Real{weight};
      keep(e.mix, units(mixed[k], from + to, std::fabs(from) + std::fabs(to)));
      // Where k2 is small, its square root enlarges the rounding errors of the terms before it.
      if (k2 > 0.01L)
        keep(e.refract, units(refracted[k], Real{eta} * Real{unit[k]} - (Real{eta} * cosine + std::sqrt(k2)) * Real{normal[k]}, 1));
    }
  }
  e.print(N);
  return e;
}

TEST(GlslAccuracy, FunctionsAreWithinTheirErrorBounds) {
  // The bounds leave at least a tenth above the largest errors found for 2, 3 and 4 components: 1.38, 1.77, 2.76, 2.73, 3.61 and 18.4. The
  // vectors are the same with the same standard library. The bound of mix(), of which 2.71 was found, follows from three roundings per
  // term.
  constexpr int kVectors = 200000;
  const GeometricErrors two = errors_of_random_vectors<2>(kVectors), three = errors_of_random_vectors<3>(kVectors);
  const GeometricErrors four = errors_of_random_vectors<4>(kVectors);
  for (const GeometricErrors* e : {&two, &three, &four}) {
    EXPECT_LE(e->length, 1.6);
    EXPECT_LE(e->distance, 2);
    EXPECT_LE(e->normalize, 3.1);
    EXPECT_LE(e->dot, 3.1);
    EXPECT_LE(e->reflect, 4);
    EXPECT_LE(e->refract, 21);
    EXPECT_LE(e->mix, 3);
  }
}

TEST(GlslAccuracy, CrossProductsAreWithinTheirErrorBound) {
  std::mt19937 random(5);
  double worst = 0;
  for (int n = 0; n < 300000; ++n) {
    const vec3<float> a = random_vector<3>(random, 9);
    vec3<float> b = random_vector<3>(random, 9);
    if (n % 2 == 0) b = a * 1.0001f + b * 0x1p-12f;  // the products nearly cancel
    const vec3<float> product = cross(a, b);
    for (int k = 0; k < 3; ++k) {
      const int i = (k + 1) % 3, j = (k + 2) % 3;
      const Real first = Real{a[i]} * Real{b[j]}, second = Real{a[j]} * Real{b[i]};
      keep(worst, units(product[k], first - second, std::fabs(first) + std::fabs(second)));
    }
  }
  if (std::getenv("HALFSPACE_PRINT_ULPS") != nullptr) std::cout << "cross " << worst << '\n';
  EXPECT_LE(worst, 2) << "each product and the difference are rounded once";
}

}  // namespace
}  // namespace halfspace
