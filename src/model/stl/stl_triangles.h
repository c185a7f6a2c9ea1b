// SPDX-License-Identifier: Apache-2.0
//
// The triangles of STL files.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "halfspace/core/namespace.h"

namespace halfspace::HS_LANES {

struct StlTriangles {
  std::vector<glm::dvec3> corners;   ///< three per triangle
  std::vector<uint16_t> attributes;  ///< one per triangle of a binary file; empty if they are the lengths of data that follows
  std::optional<glm::u8vec4> color;  ///< sRGB and opacity: the color of the part in the header (Materialise Magics)
  std::vector<std::string> warnings;
};

/// Returns whether the contents are an STL text: they begin with "solid" or "facet", in any case and possibly after blanks, and either the
/// first facet follows, or there are no zero bytes as in the header of a binary file.
bool is_text_stl(std::string_view contents);

/// Reads the triangles of a binary file. The attribute of a triangle is the number of bytes that follow it if the file has its size only
/// in this way. If the number of triangles is 0, or larger than the file can hold, all that are there are read. Warns about this and about
/// bytes that are left over. Throws InputError if the file is shorter than its header, or a text that declares more than it can hold.
StlTriangles binary_stl_triangles(std::span<const std::byte> bytes, const std::string& file);

/// Reads the triangles of all solids of a text file. Keywords may be in upper case. "endloop" and "endfacet" may be missing, and loops may
/// have more than three vertices. Warns about an incomplete facet at the end and about text after the last solid. Throws InputError
/// "FILE: line N: problem; expected ..." if the text is not valid.
StlTriangles text_stl_triangles(std::string_view text, const std::string& file);

}  // namespace halfspace::HS_LANES
