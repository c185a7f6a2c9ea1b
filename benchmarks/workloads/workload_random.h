// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace halfspace {

/// Numbers from a linear congruential generator with the constants of Numerical Recipes.
class WorkloadRandom {
 public:
  explicit WorkloadRandom(uint32_t seed = 12345) : state_(seed) {}

  uint32_t bits() { return (state_ = state_ * 1664525u + 1013904223u) >> 8; }
  float unit() { return static_cast<float>(bits()) / 16777216.0f; }  ///< in [0, 1)
  uint32_t below(uint32_t n) { return static_cast<uint32_t>((uint64_t{bits()} * n) >> 24); }
  double between(double low, double high) { return low + (high - low) * static_cast<double>(unit()); }

 private:
  uint32_t state_;
};

}  // namespace halfspace
