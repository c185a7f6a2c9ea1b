// SPDX-License-Identifier: Apache-2.0
//
// Pictures of real colors and integers in attachments of any format.
#pragma once

#include <vector>

#include "conformance/picture.h"

namespace halfspace::conformance {

/// Rectangles of kOutputSize x kOutputSize px with random values, at the lower left of each cell of kOutputCell x kOutputCell px. The
/// integers are in the range of all formats.
inline constexpr int kOutputCell = 8, kOutputSize = 7;

/// Draws into attachments of these formats, whose types must be the first ones of `types`. The quads are in the order of columns, each from
/// the bottom up.
Picture with_outputs(const std::vector<ColorFormat>& formats, const OutputTypes& types, uint64_t seed);

}  // namespace halfspace::conformance
