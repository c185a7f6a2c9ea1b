// SPDX-License-Identifier: Apache-2.0
//
// Parsing and validation of option values. Error messages name the option.
#pragma once

#include <filesystem>
#include <string_view>

namespace halfspace {

struct PictureSize {
  int width, height;
};

/// Parses a decimal integer. Returns a negative number if the text is not an integer.
int parse_number(std::string_view text);

/// Parses a size such as "1920x1080", with each edge in 1 … 16384. Throws UsageError.
PictureSize parse_size(std::string_view text);

/// Parses a thread count in 1 … 1024. An empty text means one thread per core. Throws UsageError.
int parse_threads(std::string_view text);

/// Parses a finite number in [low, high]. `option` and `example` are used in the error message. Throws UsageError.
double parse_real(std::string_view option, std::string_view text, double low, double high, std::string_view example);

/// Returns true if the path is standard output or an existing file that is not a regular file, such as a pipe or a device.
bool is_stream(const std::filesystem::path& path);

}  // namespace halfspace
