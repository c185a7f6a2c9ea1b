// SPDX-License-Identifier: Apache-2.0
//
// Atomic file output: data is written to a temporary file in the target directory, which is then renamed.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>

#include "halfspace/core/namespace.h"

namespace halfspace::HS_LANES {

/// Writes the bytes to path, replacing an existing file, and creates missing directories. An existing file keeps its permissions; if path
/// is a symbolic link, its target is replaced. Standard output (under any name) and other files that are not regular files are written in
/// place; a pipe without a reader is an error. Throws OutputError on failure. A regular file at path is then unchanged, and nothing is left
/// behind except created directories. Thread-safe.
void write_file(const std::filesystem::path& path, std::span<const std::byte> bytes);

/// Throws the OutputError that write_file would throw immediately, for example if a parent is a file or permission is missing. Programs
/// call this before they compute a result, in case it could not be saved. Creates nothing.
void check_writable(const std::filesystem::path& path);

/// Returns whether path is the file, pipe or terminal that standard output is connected to, such as /dev/stdout.
bool is_standard_output(const std::filesystem::path& path);

/// Writes the bytes to standard output. Throws OutputError on failure.
void write_standard_output(std::span<const std::byte> bytes);

/// Removes temporary files that processes left behind in a directory, because they were killed while they wrote. Files of running processes
/// are locked and stay. Errors are ignored.
void remove_abandoned_output(const std::filesystem::path& directory);

/// Creates the directory and its missing parents. Throws OutputError.
void make_directory(const std::filesystem::path& path);

/// Removes the temporary file that is being written, if any. Async-signal-safe, for use in signal handlers.
void remove_unfinished_output() noexcept;

}  // namespace halfspace::HS_LANES
