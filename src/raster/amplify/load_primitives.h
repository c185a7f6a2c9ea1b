// SPDX-License-Identifier: Apache-2.0
//
// Loads the vertices of W primitives or patches, or the values of W patches, into lanes.
#pragma once

#include <algorithm>
#include <array>

#include "halfspace/raster/amplify/emitting_stages.h"
#include "halfspace/shading/varyings.h"

namespace halfspace::HS_LANES::detail {

/// Loads N values per lane. Those of lane i start at from(i).
template <std::size_t N, class From>
HS_INLINE std::array<Real, N> load_lanes(const From& from) {
  constexpr auto lanes = static_cast<std::size_t>(kLanes);
  if constexpr (N == 0) {
    return {};
  } else {
    alignas(64) std::array<float, N * lanes> by_lane;
    for (std::size_t i = 0; i < lanes; ++i) {
      const float* const values = from(static_cast<int>(i));
      for (std::size_t c = 0; c < N; ++c) by_lane[c * lanes + i] = values[c];
    }
    return load<std::array<Real, N>>(by_lane.data());
  }
}

/// Sets the positions and varyings of W primitives with N vertices each. number(i): number of the primitive of lane i.
template <std::size_t N, class In, class Number>
HS_INLINE void load_vertices(const PrimitiveRows& from, const Number& number, In& in) {
  using V = typename decltype(in.varyings)::value_type;
  for (std::size_t v = 0; v < N; ++v) {
    const auto slot = [&](int i) { return std::size_t{from.slots[static_cast<std::size_t>(number(i)) * N + v]}; };
    const std::array<Real, 4> p = load_lanes<4>([&](int i) { return from.vertices.position(slot(i)); });
    in.position[v] = {p[0], p[1], p[2], p[3]};
    in.varyings[v] = from_components<V, Real>(load_lanes<kComponents<V>>([&](int i) { return from.vertices.varying(slot(i)); }));
  }
}

/// Returns values[number(i)] in lane i.
template <class Number>
HS_INLINE Int load_numbers(const int32_t* values, const Number& number) {
  Int out(0);
  for (int i = 0; i < kLanes; ++i) set_lane(out, i, values[number(i)]);
  return out;
}

}  // namespace halfspace::HS_LANES::detail
