// SPDX-License-Identifier: Apache-2.0
//
// The triangles of STL files.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "halfspace/core/namespace.h"

namespace halfspace::inline HS_LANES_NAMESPACE {

struct StlTriangles {
  std::vector<glm::dvec3> corners;   ///< three per triangle
  std::vector<uint16_t> attributes;  ///< one per triangle of a binary file
};

/// Reads the triangles of a binary file. Throws InputError if the file is shorter than it declares.
StlTriangles binary_stl_triangles(std::span<const std::byte> bytes, const std::string& file);

/// Reads the triangles of all solids of a text file. Keywords may be in upper case. Throws InputError "FILE: line N: problem; expected ..."
/// if the text is not valid.
StlTriangles text_stl_triangles(std::string_view text, const std::string& file);

}  // namespace halfspace::inline HS_LANES_NAMESPACE
