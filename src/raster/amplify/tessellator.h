// SPDX-License-Identifier: Apache-2.0
//
// The fixed-function tessellator (OpenGL 4.6, section 11.2.2). Input: the tessellation levels of a patch. Output: the vertices that divide
// the domain of the patch, as coordinates for the evaluation shader, and the primitives between them.
//
// All coordinates are multiples of 2^-24, computed as integers. Everything that the rules of section A.4 demand of the coordinates follows:
// they are the same on every machine, 1 − x is exact, and u + v + w is exactly 1. The triangles of a domain cover it exactly once, and
// their areas, in exact arithmetic, are positive.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "halfspace/core/namespace.h"
#include "halfspace/shading/tessellation_types.h"

namespace halfspace::HS_LANES {

/// The input layout of an evaluation shader, with the defaults of GLSL.
struct TessellatorOptions {
  TessellationDomain domain = TessellationDomain::triangles;
  TessellationSpacing spacing = TessellationSpacing::equal;
  bool clockwise = false;   ///< winding of the triangles in the (u, v) plane with u to the right and v up; isolines ignore it
  bool point_mode = false;  ///< draw a point per vertex instead of triangles or lines
};

/// A divided domain. All vertices are distinct and used.
struct Tessellation {
  std::vector<glm::vec3> coordinates;  ///< (u, v, w) of each vertex, in [0, 1]; w is 0 for quads and isolines
  std::vector<uint32_t> indices;       ///< three per triangle, two per line (isolines), or one per point (point mode)
};

/// Divides the domain of a patch. The content of `out` is replaced, but its memory is kept. It stays empty if the patch is discarded.
///
/// Where OpenGL leaves a choice, the rules are:
/// - A fractional level f that is rounded up to n segments gives n − 2 segments of length 1/f, and two of length (f − n + 2) / (2f) at the
///   ends of the edge. No segment is shorter than 3·2^-24. An inner level of 1 that is treated as 1 + ε results in this length.
/// - The first inner level of quads divides u, and the second divides v, as in figure 11.1.
void tessellate(const TessellatorOptions& options, const TessellationLevels<float>& levels, Tessellation& out);

}  // namespace halfspace::HS_LANES
