// SPDX-License-Identifier: Apache-2.0
//
// Attributes of the property tests in other formats than aligned floats. The numbers of a row are first rounded to the format, so that the
// oracle, which reads the rows, and a pass, which reads the format, have the same attributes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "halfspace/raster/vertex_input.h"

namespace halfspace {

/// Format of the components after the position. In all but the first, integer attributes are streams of integers, nothing is aligned, and
/// strides are odd.
enum class StreamFormat { in_place, floats, halves, doubles, unorm8, snorm16, scaled8 };

/// Returns the nearest number of the format. Computed from its definition, not with the functions of the library.
float rounded_to(StreamFormat format, float x);

/// Rows of `components` floats. Bit i of integer_components: component i is an integer with these bits.
struct FormattedRows {
  const float* data;
  std::size_t count;
  int components;
  uint64_t integer_components;
};

/// Adds streams of the components [begin, end) of the rows.
void add_formatted(const FormattedRows& rows, int begin, int end, StreamFormat format, uint32_t divisor,
                   std::vector<std::vector<std::byte>>& memory, std::vector<VertexStream>& streams);

}  // namespace halfspace
