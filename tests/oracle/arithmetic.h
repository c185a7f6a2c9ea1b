// SPDX-License-Identifier: Apache-2.0
//
// Arithmetic that several stages of the oracle need.
#pragma once

#include <cmath>
#include <cstdint>

namespace halfspace::oracle {

/// Returns x limited to [low, high]; low if x is a NaN.
inline float clamped(float x, float low, float high) {
  const float raised = x > low ? x : low;
  return raised < high ? raised : high;
}

/// Returns ax·by − ay·bx.
inline int64_t cross(int64_t ax, int64_t ay, int64_t bx, int64_t by) { return ax * by - ay * bx; }

/// Returns a·b − c·d by Kahan's method.
inline float determinant(float a, float b, float c, float d) {
  const float product = c * d;
  const float lost = std::fma(-c, d, product);
  return std::fma(a, b, -product) + lost;
}

}  // namespace halfspace::oracle
