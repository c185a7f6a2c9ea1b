// SPDX-License-Identifier: Apache-2.0
//
// Parses a Wavefront OBJ file ("Object Files (.obj)", Advanced Visualizer manual, appendix B1) into lists that correspond to the statements
// of the file.
//
// This parser is used instead of tinyobjloader, which accepts damaged files: it reads invalid numbers as 0, passes on indices that are out
// of range, does not round decimal fractions correctly, does not join continued lines, opens material libraries in any folder while
// parsing, and reports most errors without a line number.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "halfspace/model/model.h"

namespace halfspace::HS_LANES {

/// Marks a corner without texture coordinate or normal.
inline constexpr uint32_t kNoIndex = 0xffffffffu;

/// Indices into the lists of ObjText. Indices of uvs and normals that are out of range are equivalent to kNoIndex.
struct ObjCorner {
  uint32_t position, uv, normal;
};

/// The statements that apply to an element.
struct ObjState {
  MeshTopology topology;
  int material;        ///< index in ObjText::materials; -1: none
  uint32_t smoothing;  ///< smoothing group; 0: none
  std::string name;    ///< name of the object or group
};

/// A polygon, a polyline or a set of points. Its corners end where the corners of the next element begin.
struct ObjElement {
  uint32_t first_corner;
  uint32_t state;  ///< index in ObjText::states
};

struct ObjText {
  std::vector<glm::dvec3> positions;  ///< may be infinite or NaN where no corner uses them
  std::vector<glm::vec3> colors;      ///< empty, or one per position, as written in the file; negative if it has none
  std::vector<glm::vec2> uvs;         ///< v = 0 is the bottom of the image
  std::vector<glm::vec3> normals;     ///< unit length; 0 if the value in the file is not usable
  std::vector<ObjCorner> corners;
  std::vector<ObjElement> elements;
  std::vector<ObjState> states;
  std::vector<std::string> materials;  ///< names, in the order of their first use
  std::vector<std::string> libraries;  ///< arguments of mtllib statements
  bool has_smoothing = false;          ///< the file has `s` statements

  /// Returns the end of the corners of an element.
  std::size_t end_corner(std::size_t element) const {
    return element + 1 < elements.size() ? elements[element + 1].first_corner : corners.size();
  }
};

/// Parses an OBJ file. Polygons have at least 3 corners, polylines have at least 2, neighboring corners have different positions, and all
/// position indices are in range. Faces, lines and points with coordinates that are not finite are skipped, with one warning. `file` is
/// only used in messages. Throws InputError "FILE:LINE: problem; expected ..." for coordinates that cannot be read and for position indices
/// out of range. Other invalid statements are ignored, with one warning for each kind. The text must be smaller than 4 GiB.
ObjText parse_obj(const std::filesystem::path& file, std::string_view text, std::vector<std::string>& warnings);

}  // namespace halfspace::HS_LANES
