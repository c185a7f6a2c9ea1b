// SPDX-License-Identifier: Apache-2.0
//
// Clipping. Input: a triangle or line in clip space. Output: the part of it inside w > 0, the near and far planes, the guard band and the
// clip distances, and its corners in the window. Uses doubles, one plane after the other.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "halfspace/raster/draw_state.h"
#include "oracle/shader_data.h"
#include "oracle/transform.h"
#include "oracle/window.h"

namespace halfspace::oracle {

/// A vertex of a clipped polygon: its position, its weights with respect to the vertices of the triangle, and the triangle's vertex that it
/// equals, if any.
struct ClipPoint {
  std::array<double, 4> p;
  std::array<double, 3> weight;
  int vertex = -1;
};
using Polygon = std::vector<ClipPoint>;

/// Returns the part of a triangle or line that is inside all planes; fewer than three or two points if there is none. For a line, the third
/// vertex is not used.
Polygon clip_primitive(const Transform& t, const DepthState& state, const std::array<const ShadedVertex*, 3>& v, bool is_line);

/// Returns a vertex of a polygon in the window. A vertex that is also one of the triangle is bit-identical to the result without clipping.
Corner clip_corner(const Transform& t, const ClipPoint& c, const std::array<const ShadedVertex*, 3>& v, const ShaderFacts& facts,
                   std::size_t provoking);

}  // namespace halfspace::oracle
