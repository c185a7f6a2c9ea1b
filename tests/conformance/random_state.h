// SPDX-License-Identifier: Apache-2.0
//
// Random states by number: a picture of a few draws with random state. A failing state is shrunk by applying simplifications as long as it
// still fails. Each simplification has a bit number, so a seed and a set of bits identify the result.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "conformance/picture.h"

namespace halfspace::conformance {

/// Has the form "1234" or, if shrunk, "1234:8f03".
struct RandomState {
  uint64_t seed = 0;
  uint64_t simplified = 0;  ///< bits of the applied simplifications

  std::string text() const;
  /// Returns false if the text is not a valid state.
  static bool parse(const std::string& text, RandomState& state);
};

/// Returns the picture of a state, which is identical on every machine.
Picture random_picture(const RandomState& state);
/// Applies simplifications as long as the state keeps failing.
RandomState shrink(RandomState state, const std::function<bool(const Picture&)>& fails);

inline constexpr uint64_t kRandomSets = 64, kStatesPerSet = 80;

}  // namespace halfspace::conformance
