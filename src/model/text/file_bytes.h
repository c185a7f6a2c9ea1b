// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <vector>

#include "halfspace/core/namespace.h"

namespace halfspace::HS_LANES {

/// Reads a whole file. Throws InputError if it is missing, a directory, unreadable or not a regular file, and LimitError if it is larger
/// than `max_bytes`.
std::vector<std::byte> file_bytes(const std::filesystem::path& file, std::size_t max_bytes);

/// Returns the bytes after the byte order mark of UTF-8, which some editors write at the start of text files, or all bytes if there is no
/// such mark.
std::span<const std::byte> without_byte_order_mark(std::span<const std::byte> bytes);

}  // namespace halfspace::HS_LANES
