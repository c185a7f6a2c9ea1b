// SPDX-License-Identifier: Apache-2.0
//
// The header of a PLY file (G. Turk, "The PLY polygon file format", 1994): the elements and the types of their properties.
#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "halfspace/core/namespace.h"

namespace halfspace::HS_LANES {

enum class PlyEncoding : uint8_t { ascii, little_endian, big_endian };

enum class PlyType : uint8_t { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

/// Returns the number of bytes of a value in a binary file.
constexpr std::size_t size_of(PlyType type) {
  constexpr std::size_t kSizes[] = {1, 1, 2, 2, 4, 4, 4, 8};
  return kSizes[static_cast<std::size_t>(type)];
}

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::float32;    ///< type of the value, or of the items of a list
  std::optional<PlyType> count_type;  ///< type of the length of a list; nullopt if the property is a single value
};

struct PlyElement {
  std::string name;
  uint64_t count = 0;
  std::vector<PlyProperty> properties;

  /// Return the index of the first single value, or list, that has one of these names; -1 if there is none.
  int find_value(std::initializer_list<std::string_view> names) const;
  int find_list(std::initializer_list<std::string_view> names) const;
};

struct PlyHeader {
  PlyEncoding encoding = PlyEncoding::ascii;
  std::vector<PlyElement> elements;
  std::vector<std::string> texture_files;  ///< from "comment TextureFile NAME" (MeshLab)
  std::size_t size = 0;                    ///< bytes up to the data
};

/// Parses the header at the beginning of a file. Throws InputError "FILE: line N: problem; expected ..." if it is not valid, or if it
/// declares more rows than the file can have. `file` is for messages.
PlyHeader parse_ply_header(std::string_view contents, const std::string& file);

}  // namespace halfspace::HS_LANES
