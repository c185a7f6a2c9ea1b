// SPDX-License-Identifier: Apache-2.0
//
// Attributes in memory, in all formats that vertex streams can have, and the numbers that they mean (OpenGL 4.6, sections 2.3.5 and 10.3),
// computed in double precision and without the functions of the library.
#pragma once

#include <array>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "conformance/picture.h"
#include "halfspace/shading/varyings.h"

namespace halfspace::conformance {

/// How an attribute is stored. The shader always receives four numbers.
struct AttributeFormat {
  ComponentType type = ComponentType::float32;
  ReadAs read_as = ReadAs::floats;
  int components = 4;  ///< in memory; 4 if they are packed
  bool bgra = false;
};

/// Returns an array with the coordinates x, y, 0 and 1, of which the format contains the first ones. It must not be normalized.
AttributeArray position_array(const AttributeFormat& format, std::span<const glm::ivec2> positions);
/// Returns an array of random numbers: any codes of integers, and finite floats.
AttributeArray random_array(const AttributeFormat& format, std::size_t count, uint64_t seed);
/// Returns the arrays in one buffer, which starts with `offset` unused bytes, with `gap` unused bytes after each attribute. All arrays must
/// have the same number of rows.
std::vector<AttributeArray> interleaved(std::span<const AttributeArray> arrays, int offset, int gap);

/// Returns what a shader receives for a row: integers are the bits of floats.
std::array<float, 4> numbers_of(const VertexStream& stream, std::size_t row);

/// Returns row i of all arrays that have it. The other attributes are 0.
template <class Row>
Row row_of(std::span<const AttributeArray> arrays, std::size_t i) {
  std::array<float, kComponents<Row>> all{};
  for (std::size_t a = 0; a < arrays.size(); ++a) {
    if (i >= arrays[a].stream.count) continue;
    const std::array<float, 4> numbers = numbers_of(arrays[a].stream, i);
    for (std::size_t k = 0; k < 4; ++k) all[4 * a + k] = numbers[k];
  }
  return from_components<Row, float>(all);
}

}  // namespace halfspace::conformance
