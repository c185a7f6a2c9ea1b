// SPDX-License-Identifier: Apache-2.0
//
// Writes small PLY files in all encodings.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "halfspace/model/ply/read_ply.h"

namespace halfspace {

inline constexpr const char* kPlyEncodings[] = {"ascii", "binary_little_endian", "binary_big_endian"};

/// Appends values to the data of a PLY file.
struct PlyData {
  std::string encoding, bytes;

  template <class T>
  PlyData& add(T value) {
    if (encoding == "ascii") {
      bytes += fmt::format("{} ", value);
      return *this;
    }
    std::string value_bytes(sizeof(T), '\0');
    std::copy_n(reinterpret_cast<const char*>(&value), sizeof(T), value_bytes.data());
    if (encoding == "binary_big_endian") std::ranges::reverse(value_bytes);
    bytes += value_bytes;
    return *this;
  }
  template <class T>
  PlyData& add_list(const std::vector<T>& values) {
    add(static_cast<uint8_t>(values.size()));
    for (const T value : values) add(value);
    return *this;
  }
  std::string with_header(const std::string& elements) const {
    return "ply\nformat " + encoding + " 1.0\n" + elements + "end_header\n" + bytes;
  }
};

inline Model ply_model(const std::string& contents, const ReadModelOptions& options = {}) {
  return read_ply("a.ply", std::as_bytes(std::span(contents)), options);
}

}  // namespace halfspace
