// SPDX-License-Identifier: Apache-2.0
//
// Values of options, checked: what is wrong with one is told in the option's words.
#pragma once

#include <filesystem>
#include <string_view>

namespace halfspace {

struct PictureSize {
  int width, height;
};

/// A whole decimal number; something negative where it is none.
int parse_number(std::string_view text);

/// "1920x1080", each 1 … 16384. Throws UsageError.
PictureSize parse_size(std::string_view text);

/// 1 … 1024; empty: one a core. Throws UsageError.
int parse_threads(std::string_view text);

/// A finite number in [low, high]. `option` and `example` are for the message. Throws UsageError.
double parse_real(std::string_view option, std::string_view text, double low, double high, std::string_view example);

/// Is there something of that name that is written to as a stream: standard output, a pipe, a device?
bool is_stream(const std::filesystem::path& path);

}  // namespace halfspace
