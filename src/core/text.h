// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <exception>
#include <span>
#include <string>
#include <string_view>

#include "halfspace/core/namespace.h"

namespace halfspace::HS_LANES {

/// Returns true if the text, words separated by single spaces, contains the word.
bool has_word(std::string_view text, std::string_view word);

/// Returns the minimum number of insertions, deletions, substitutions and swaps of adjacent letters that turn a into b.
int edit_distance(std::string_view a, std::string_view b);

/// Returns the known name with the smallest edit distance to `wrong`; the first one wins ties. Returns an empty view if no name
/// is close, i.e. if all distances are greater than 2 and greater than a third of the length of `wrong`.
std::string_view nearest_name(std::string_view wrong, std::span<const std::string_view> names);

/// Returns "; did you mean 'NAME'?" or, if no name is close, "; expected one of A, B, C". Returns "; expected none, because
/// none is defined" if there are no names. Meant to be appended to an error line.
std::string suggestion(std::string_view wrong, std::span<const std::string_view> names);

/// Returns the text with every byte of a control character, and every byte that is not part of valid UTF-8, replaced by `prefix` and two
/// hexadecimal digits. Texts from files and file names can contain both.
std::string escaped(std::string_view text, std::string_view prefix);

/// The same with the prefix \x.
std::string printable(std::string_view text);

/// Returns "LINE:COLUMN" of a 1-based byte position in a text.
std::string line_and_column(std::string_view text, std::size_t byte);

/// Searches a text for the part of a message that is in single quotes, or for the last such part. Returns its 1-based byte position, or 0
/// if there is none.
std::size_t position_of_quoted(std::string_view text, std::string_view message);

/// Returns the reason in the message of an exception of nlohmann_json, without error number and position, on one line.
std::string json_problem(const std::exception& e);

}  // namespace halfspace::HS_LANES
