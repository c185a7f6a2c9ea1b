// SPDX-License-Identifier: Apache-2.0
//
// Random numbers that are identical on every machine. The distributions of the standard library are not, because their algorithms are
// implementation-defined.
#pragma once

#include <cmath>
#include <concepts>
#include <cstdint>
#include <initializer_list>
#include <random>

#include <glm/glm.hpp>

namespace halfspace {

/// SplitMix64 (Steele, Lea and Flood, "Fast splittable pseudorandom number generators", OOPSLA 2014). Draw only one number per statement or
/// use braces, because the evaluation order of function arguments is unspecified. Committed hashes depend on the numbers.
class Random {
 public:
  explicit Random(uint64_t seed) : state_(seed) {}

  uint32_t bits() { return static_cast<uint32_t>(next() >> 32); }
  /// Returns an integer in [0, n).
  int below(int n) { return static_cast<int>((uint64_t{bits()} * static_cast<uint64_t>(n)) >> 32); }
  /// Returns an integer in [low, high].
  int between(int low, int high) { return low + below(high - low + 1); }
  /// Returns an integer in [low, high], the remainder of a 64-bit random number. The sequence differs from the sequence of between().
  int integer(int low, int high) {
    return static_cast<int>(low + static_cast<int64_t>(next() % static_cast<uint64_t>(int64_t{high} - low + 1)));
  }
  /// Returns a number in [low, high), in steps of 2^-24 of the interval.
  float real(float low, float high) { return low + (high - low) * (static_cast<float>(bits() >> 8) * 0x1p-24f); }
  /// Returns a number in [low, high), in steps of 2^-53 of the interval.
  template <std::same_as<double> T>
  T real(T low, T high) {
    return low + (high - low) * static_cast<double>(next() >> 11) * 0x1p-53;
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

 private:
  uint64_t next() {
    uint64_t z = (state_ += 0x9e3779b97f4a7c15u);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
  }

  uint64_t state_;
};

/// Returns a vector of random direction and length.
inline glm::dvec3 random_vector(std::mt19937& random) {
  std::normal_distribution<double> normal;
  const double x = normal(random), y = normal(random), z = normal(random);
  return {x, y, z};
}

}  // namespace halfspace
