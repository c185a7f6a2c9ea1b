// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

namespace halfspace {

/// Reads a whole file. Throws InputError if it is missing, a directory, unreadable or not a regular file, and LimitError if it is larger
/// than `max_bytes`.
std::vector<std::byte> file_bytes(const std::filesystem::path& file, std::size_t max_bytes);

}  // namespace halfspace
