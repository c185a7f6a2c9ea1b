// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace halfspace {

/// The fewest insertions, deletions, replacements and swaps of neighbouring letters that turn a into b.
int edit_distance(std::string_view a, std::string_view b);

/// The name nearest to a wrong one, or empty where none is near (more than a third of its letters are wrong, and more
/// than two). The first of equally near names wins.
std::string_view nearest_name(std::string_view wrong, std::span<const std::string_view> names);

/// "; did you mean 'NAME'?" or, where no name is near, "; expected one of A, B, C" (for a tail of an error line).
std::string suggestion(std::string_view wrong, std::span<const std::string_view> names);

}  // namespace halfspace
