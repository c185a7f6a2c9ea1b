// SPDX-License-Identifier: Apache-2.0
//
// Random numbers that are the same everywhere: the standard library leaves its distributions to each implementation.
#pragma once

#include <array>
#include <cstdint>
#include <initializer_list>

namespace halfspace {

/// SplitMix64 (Steele, Lea and Flood, "Fast splittable pseudorandom number generators", OOPSLA 2014). Draw one number a
/// statement, or within braces: the order of evaluation of function arguments is not defined.
class Random {
 public:
  explicit Random(uint64_t seed) : state_(seed) {}

  uint32_t bits() {
    uint64_t z = (state_ += 0x9e3779b97f4a7c15u);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return static_cast<uint32_t>((z ^ (z >> 31)) >> 32);
  }
  /// 0 … n − 1.
  int below(int n) { return static_cast<int>((uint64_t{bits()} * static_cast<uint64_t>(n)) >> 32); }
  /// low … high, both included.
  int between(int low, int high) { return low + below(high - low + 1); }
  /// In [low, high).
  float real(float low, float high) { return low + (high - low) * (static_cast<float>(bits() >> 8) * 0x1p-24f); }
  /// True once in n times.
  bool once_in(int n) { return below(n) == 0; }
  template <class T>
  T pick(std::initializer_list<T> from) {
    return from.begin()[below(static_cast<int>(from.size()))];
  }

 private:
  uint64_t state_;
};

}  // namespace halfspace
