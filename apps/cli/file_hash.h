// SPDX-License-Identifier: Apache-2.0
//
// 128-bit hashes (XXH3) as 32 hexadecimal digits, for the fingerprints of pictures. They detect changes, not attacks.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace halfspace {

std::string hash_of(std::string_view text);

/// Returns the hash of a file's contents, or a text that is not a hash if it cannot be read. Each file is read once per run. Thread-safe.
std::string hash_of_file(const std::filesystem::path& file);

/// Returns a hash of the contents of all files.
std::string hash_of_files(std::span<const std::filesystem::path> files);

}  // namespace halfspace
