// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "halfspace/core/namespace.h"

namespace halfspace::HS_LANES {

/// Returns whether a URI contains its data ("data:...").
bool is_data_uri(std::string_view uri);

/// Returns the data of a data URI (RFC 2397), which is Base64-encoded or percent-encoded, or nothing if it is invalid. The result is not
/// longer than the URI.
std::optional<std::vector<std::byte>> data_of_uri(std::string_view uri);

/// Replaces percent-encoded characters. Percent signs that are not followed by two hexadecimal digits are kept.
std::string percent_decoded(std::string_view text);

}  // namespace halfspace::HS_LANES
