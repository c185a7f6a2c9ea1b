// SPDX-License-Identifier: Apache-2.0
//
// Parses the text of a Wavefront OBJ file ("Object Files (.obj)", Advanced Visualizer manual, appendix B1) into lists that follow the
// statements of the file.
//
// This parser replaces tinyobjloader, which reads damaged files as if they were right: unreadable numbers become 0, indices out of range
// are passed on, decimal fractions are not correctly rounded, continued lines are not joined, material libraries are opened during parsing
// wherever they are, and most errors have no line number.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "halfspace/model/model.h"

namespace halfspace {

/// Marks a corner without texture coordinate or normal.
inline constexpr uint32_t kNoIndex = 0xffffffffu;

/// Indices into the lists of ObjText. Indices of uvs and normals may be kNoIndex or otherwise out of range, which means the same.
struct ObjCorner {
  uint32_t position, uv, normal;
};

/// The statements that apply to an element.
struct ObjState {
  MeshTopology topology;
  int material;        ///< index in ObjText::materials; -1: none
  uint32_t smoothing;  ///< smoothing group; 0: none
  std::string name;    ///< of the object or group
};

/// A polygon, a polyline or a set of points. Its corners end where those of the next element begin.
struct ObjElement {
  uint32_t first_corner;
  uint32_t state;  ///< index in ObjText::states
};

struct ObjText {
  std::vector<glm::dvec3> positions;
  std::vector<glm::vec3> colors;   ///< empty, or one per position, as written in the file
  std::vector<glm::vec2> uvs;      ///< v = 0 is the bottom of the image
  std::vector<glm::vec3> normals;  ///< unit length; 0 if the file has no usable value
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

/// Parses an OBJ file. Polygons have at least 3 corners, polylines 2, and all position indices are in range. `file` is only used in
/// messages. Throws InputError "FILE:LINE: problem; expected ..." for coordinates that cannot be read and for position indices out of
/// range. Other statements that cannot be used are left out with one warning per kind. The text must be smaller than 4 GiB.
ObjText parse_obj(const std::filesystem::path& file, std::string_view text, std::vector<std::string>& warnings);

}  // namespace halfspace
