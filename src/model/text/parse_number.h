// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string_view>

#include "halfspace/core/namespace.h"

namespace halfspace::HS_LANES {

/// Returns the value of a decimal number such as "-1.5e3", or nullopt if the word is not a number. Unlike number_in, it also returns values
/// that are not finite: "nan", "inf" and "infinity" in any case, "nan(ind)", those of Microsoft's printf ("1.#QNAN", "-1.#IND00",
/// "1.#INF"), and infinity for numbers that are too large for a double. Readers skip or replace what has such values.
std::optional<double> parse_number(std::string_view word);

}  // namespace halfspace::HS_LANES
