// SPDX-License-Identifier: Apache-2.0
//
// Pictures of real colors and integers in attachments of any format.
#pragma once

#include <vector>

#include "conformance/picture.h"
#include "support/random.h"

namespace halfspace::conformance {

/// Rectangles of kOutputSize x kOutputSize px with random values, at the lower left of each cell of kOutputCell x kOutputCell px. The
/// integers are in the range of all formats.
inline constexpr int kOutputCell = 8, kOutputSize = 7;

/// The integers in Vertex::extra with which `outputs` draws what formats can store: from low to high, in units of `factor`.
struct IntegerRange {
  float factor = 1.0f;  ///< Drawing::value: 1/16 of the range of the smallest format
  int low = 0, high = 0;
  bool has_alpha = true;  ///< otherwise, the alpha of a format is too small for multiples of the factor
};
IntegerRange integer_range(const std::vector<ColorFormat>& formats);
glm::vec4 random_integers(const IntegerRange& range, Random& random);

/// Returns outputs of one type.
constexpr OutputTypes all_of_type(ColorType type) { return {type, type, type, type}; }

/// Draws into attachments of these formats, whose types must be the first ones of `types`. The quads are in the order of columns, each from
/// the bottom up.
Picture with_outputs(const std::vector<ColorFormat>& formats, const OutputTypes& types, uint64_t seed);

}  // namespace halfspace::conformance
