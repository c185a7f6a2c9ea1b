// SPDX-License-Identifier: Apache-2.0
//
// Hash of results computed at a given SIMD width: elementary functions, interpolation, encoding. Header-only, so that a single-file program
// can be compiled for a different instruction set (isa_hash.cpp).
#pragma once

#include <cstring>
#include <vector>

#include "halfspace/core/lane_math.h"
#include "halfspace/core/srgb.h"
#include "halfspace/shading/pixel.h"
#include "support/hash.h"

namespace halfspace::stability {

/// Returns 4,096 floats from 2^-20 to 2^7, generated in integer arithmetic.
inline std::vector<float> hash_inputs() {
  std::vector<float> in;
  uint32_t state = 1;
  for (int i = 0; i < 4096; ++i) {
    state = state * 1664525u + 1013904223u;
    in.push_back(as_real(static_cast<int32_t>(0x35800000u + state % 0x0d800000u)));
  }
  return in;
}

/// Returns the hash of the bytes of all results, lane by lane.
template <class R>
uint64_t lane_hash(const std::vector<float>& in) {
  constexpr std::size_t width = sizeof(R) / sizeof(float);
  std::vector<std::vector<float>> results(8, std::vector<float>(in.size()));
  for (std::size_t i = 0; i < in.size(); i += width) {
    const R x = load<R>(&in[i]);
    const R other = load<R>(&in[(i + 2048) % in.size()]);
    const TriangleLanes<R> t{R(100), R(200),   R(5000), R(37), R(-1234), R(4321), R(5000.0f * 4321.0f + 37.0f * 1234.0f),
                             R(1),   x + R(1), R(1.5f), R(1)};
    const Weights<R> w = weights_at(t, x, other);
    const R values[8] = {exp2(x), log2(x), pow(x, other), sin(x), atan2(x, other), w.p1, w.denominator, to_real<R>(linear_to_srgb(x))};
    for (std::size_t k = 0; k < 8; ++k) store(&results[k][i], values[k]);
  }
  Hash hash;
  for (const std::vector<float>& row : results) {
    for (const float r : row) {
      const auto bits = static_cast<uint32_t>(as_int(r));
      for (int k = 0; k < 32; k += 8) hash.add((bits >> k) & 255u);
    }
  }
  return hash.value();
}

}  // namespace halfspace::stability
