// SPDX-License-Identifier: Apache-2.0
//
// Random states by number: a picture of a few draws whose every state is drawn by lot. A state that fails is shrunk: simplifications,
// numbered by bits, are applied as long as it still fails, so a seed and a row of bits stand for what is left.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "conformance/picture.h"

namespace halfspace::conformance {

/// "1234" or, shrunk, "1234:8f03".
struct RandomState {
  uint64_t seed = 0;
  uint64_t simplified = 0;  ///< bits of the simplifications that are applied

  std::string text() const;
  /// False if the text is no state.
  static bool parse(const std::string& text, RandomState& state);
};

/// The same on every machine.
Picture random_picture(const RandomState& state);
/// Applies every simplification that leaves the state failing, until none does.
RandomState shrink(RandomState state, const std::function<bool(const Picture&)>& fails);

inline constexpr uint64_t kRandomSets = 64, kStatesPerSet = 80;

}  // namespace halfspace::conformance
