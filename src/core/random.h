// SPDX-License-Identifier: Apache-2.0
//
// Random numbers that are identical on every machine. The distributions of the standard library are not, because their algorithms are
// implementation-defined.
#pragma once

#include <concepts>
#include <cstdint>

#include "halfspace/core/namespace.h"

namespace halfspace::HS_LANES {

/// SplitMix64 (Steele, Lea and Flood, "Fast splittable pseudorandom number generators", OOPSLA 2014). Draw only one number per statement or
/// use braces, because the evaluation order of function arguments is unspecified. Committed hashes depend on the numbers.
class SplitMix64 {
 public:
  explicit SplitMix64(uint64_t seed) : state_(seed) {}

  /// Returns 64 random bits.
  uint64_t next() {
    uint64_t z = (state_ += 0x9e3779b97f4a7c15u);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
  }
  /// Returns a number in [low, high), in steps of 2^-24 of the interval.
  float real(float low, float high) { return low + (high - low) * (static_cast<float>(next() >> 40) * 0x1p-24f); }
  /// Returns a number in [low, high), in steps of 2^-53 of the interval.
  template <std::same_as<double> T>
  T real(T low, T high) {
    return low + (high - low) * static_cast<double>(next() >> 11) * 0x1p-53;
  }

 private:
  uint64_t state_;
};

}  // namespace halfspace::HS_LANES
