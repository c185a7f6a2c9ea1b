// SPDX-License-Identifier: Apache-2.0
//
// Files appear whole or not at all: written aside in the same directory, then renamed.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>

namespace halfspace {

/// Writes the bytes to path, replacing what is there (an existing file keeps its permissions; a symbolic link keeps
/// pointing at the file, which is replaced). Missing directories are made. Standard output under any name, and something
/// that is no regular file, is written to in place; a pipe that no one reads is an error. Throws OutputError; then path
/// is untouched and nothing else is left behind but directories. Thread-safe.
void write_file(const std::filesystem::path& path, std::span<const std::byte> bytes);

/// Throws the OutputError that write_file would meet at once (a parent that is a file, no right to write), so that a
/// program can say so before it computes what it cannot keep. Makes nothing.
void check_writable(const std::filesystem::path& path);

/// Is that the file, pipe or terminal that standard output goes to, such as /dev/stdout?
bool is_standard_output(const std::filesystem::path& path);

/// Makes the directory, and those above it, where they are absent. Throws OutputError.
void make_directory(const std::filesystem::path& path);

/// Removes the file that is being written aside, if there is one. For signal handlers: async-signal-safe.
void remove_unfinished_output() noexcept;

}  // namespace halfspace
