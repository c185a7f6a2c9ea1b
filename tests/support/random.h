// SPDX-License-Identifier: Apache-2.0
//
// Random numbers that are the same on every machine: the standard library leaves its distributions to each implementation.
#pragma once

#include <cmath>
#include <concepts>
#include <cstdint>
#include <initializer_list>
#include <random>

#include <glm/glm.hpp>

namespace halfspace {

/// SplitMix64 (Steele, Lea and Flood, "Fast splittable pseudorandom number generators", OOPSLA 2014). Draw one number per
/// statement, or within braces: the order of evaluation of function arguments is not defined. Committed hashes depend on the numbers.
class Random {
 public:
  explicit Random(uint64_t seed) : state_(seed) {}

  uint32_t bits() { return static_cast<uint32_t>(next() >> 32); }
  /// In [0, n).
  int below(int n) { return static_cast<int>((uint64_t{bits()} * static_cast<uint64_t>(n)) >> 32); }
  /// In [low, high].
  int between(int low, int high) { return low + below(high - low + 1); }
  /// In [low, high], as the remainder of 64 bits: other numbers than those of between().
  int integer(int low, int high) {
    return static_cast<int>(low + static_cast<int64_t>(next() % static_cast<uint64_t>(int64_t{high} - low + 1)));
  }
  /// In [low, high), in steps of 2^-24 of the interval.
  float real(float low, float high) { return low + (high - low) * (static_cast<float>(bits() >> 8) * 0x1p-24f); }
  /// In [low, high), in steps of 2^-53 of the interval.
  template <std::same_as<double> T>
  T real(T low, T high) {
    return low + (high - low) * static_cast<double>(next() >> 11) * 0x1p-53;
  }
  /// In [low, high), evenly distributed by logarithm.
  double magnitude(double low, double high) { return low * std::pow(high / low, real(0.0, 1.0)); }
  bool coin() { return (next() & 1) != 0; }
  /// True once in n times.
  bool once_in(int n) { return below(n) == 0; }
  template <class T>
  T pick(std::initializer_list<T> from) {
    return from.begin()[below(static_cast<int>(from.size()))];
  }

 private:
  uint64_t next() {
    uint64_t z = (state_ += 0x9e3779b97f4a7c15u);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
  }

  uint64_t state_;
};

/// A vector of random direction and length.
inline glm::dvec3 random_vector(std::mt19937& random) {
  std::normal_distribution<double> normal;
  const double x = normal(random), y = normal(random), z = normal(random);
  return {x, y, z};
}

}  // namespace halfspace
