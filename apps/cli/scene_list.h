// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace halfspace {

/// Returns the given scenes, followed by those of a list: one name or file per line, where empty lines are skipped. list: name of a file,
/// "-" for standard input, or empty for none. Throws InputError if the list cannot be read or has no scenes.
std::vector<std::string> read_scenes(std::vector<std::string> given, const std::string& list);

}  // namespace halfspace
