// SPDX-License-Identifier: Apache-2.0
//
// Random numbers for tests, identical on every machine (core/random.h).
#pragma once

#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <random>

#include <glm/glm.hpp>

#include "halfspace/core/random.h"

namespace halfspace {

/// SplitMix64 with the distributions that tests need.
class Random : public SplitMix64 {
 public:
  using SplitMix64::SplitMix64;

  uint32_t bits() { return static_cast<uint32_t>(next() >> 32); }
  /// Returns an integer in [0, n).
  int below(int n) { return static_cast<int>((uint64_t{bits()} * static_cast<uint64_t>(n)) >> 32); }
  /// Returns an integer in [low, high].
  int between(int low, int high) { return low + below(high - low + 1); }
  /// Returns an integer in [low, high], the remainder of a 64-bit random number. The sequence differs from the sequence of between().
  int integer(int low, int high) {
    return static_cast<int>(low + static_cast<int64_t>(next() % static_cast<uint64_t>(int64_t{high} - low + 1)));
  }
  /// Returns a number in [low, high) whose logarithm is uniformly distributed.
  double magnitude(double low, double high) { return low * std::pow(high / low, real(0.0, 1.0)); }
  bool coin() { return (next() & 1) != 0; }
  /// Returns true with a probability of 1/n.
  bool once_in(int n) { return below(n) == 0; }
  template <class T>
  T pick(std::initializer_list<T> from) {
    return from.begin()[below(static_cast<int>(from.size()))];
  }
};

/// Returns numbers that neither change the following ones of `random` nor depend on them in a simple way.
inline Random other_numbers(const Random& random) {
  Random copy(random);
  return Random(uint64_t{copy.bits()} * 0x9e3779b97f4a7c15u);
}

/// Returns a vector of random direction and length.
inline glm::dvec3 random_vector(std::mt19937& random) {
  std::normal_distribution<double> normal;
  const double x = normal(random), y = normal(random), z = normal(random);
  return {x, y, z};
}

}  // namespace halfspace
