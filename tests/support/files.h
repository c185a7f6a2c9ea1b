// SPDX-License-Identifier: Apache-2.0
//
// Functions for whole files and for data that is not part of the repository.
#pragma once

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <string_view>

namespace halfspace {

/// Returns the contents of a file; empty if it cannot be read.
inline std::string read_bytes(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

inline void write_bytes(const std::filesystem::path& path, std::string_view bytes) {
  std::ofstream(path, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

/// Returns the path of a file or folder in ../shared/data, relative to the root of the source tree, where tests run. It may not exist.
/// Tests that need it begin with `if (!exists(path)) GTEST_SKIP() << absent(path);`.
inline std::filesystem::path shared_data(const std::filesystem::path& name) { return "../shared/data" / name; }

inline std::string absent(const std::filesystem::path& path) { return path.string() + " does not exist; it is not part of the repository"; }

}  // namespace halfspace
