// SPDX-License-Identifier: Apache-2.0
//
// The elements of a PLY file that can be drawn.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <string_view>
#include <vector>

#include "halfspace/model/ply/ply_colors.h"
#include "halfspace/model/ply/ply_header.h"

namespace halfspace::HS_LANES {

struct PlyContents {
  // One entry per vertex, or empty if the file has no such values. All values may be infinite or NaN.
  std::vector<glm::dvec3> positions;
  std::vector<glm::dvec3> normals;  ///< not normalized
  std::vector<glm::vec2> uvs;       ///< v = 0 is the top row
  PlyColors colors;
  // Faces are stored as one list of corners. Triangle strips are stored as triangles.
  std::vector<uint32_t> lengths;      ///< corners of each face
  std::vector<uint32_t> corners;      ///< vertices, in range
  std::vector<glm::vec2> corner_uvs;  ///< one per corner, or empty
  PlyColors face_colors;              ///< one per face, or empty
  std::vector<uint32_t> edges;        ///< pairs of vertices, in range
};

/// Reads the data after the header. Unknown elements and properties are skipped. Throws InputError "FILE: element 'NAME', row N: problem;
/// expected ..." if the data is invalid.
PlyContents read_ply_contents(const PlyHeader& header, std::string_view data, const std::string& file);

}  // namespace halfspace::HS_LANES
