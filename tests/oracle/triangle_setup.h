// SPDX-License-Identifier: Apache-2.0
//
// Triangle setup. Input: the corners of a primitive in the window. Output: triangles with facing, vertex order and depth, or the reason why
// one is not drawn.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "halfspace/raster/draw_state.h"
#include "halfspace/raster/target.h"
#include "oracle/window.h"

namespace halfspace::oracle {

/// Returns twice the area of a triangle; positive if it is counter-clockwise.
int64_t orient2d(const Corner& a, const Corner& b, const Corner& c);

/// Splits a clipped polygon into a fan. The apex is the first vertex for which all triangles have the same orientation. If there is none,
/// the apex is the last vertex, and triangles with the opposite orientation are dropped.
std::vector<std::array<Corner, 3>> fan(const std::vector<Corner>& polygon);

bool culls_face(CullMode mode, bool front);

enum class Fate { drawn, degenerate, wrong_face, no_sample };

/// Determines the facing, vertex order and depth of a triangle. Its vertices are given in submission order.
std::pair<Fate, WindowTriangle> make_window_triangle(const DrawState& state, const Box& allowed, DepthFormat format, int samples,
                                                     const std::array<Corner, 3>& submitted, std::size_t provoking,
                                                     std::optional<bool> faces_front = {});

/// Returns the polygon offset of a triangle of a polygon that is drawn as an outline or as corners.
float outline_offset(const DepthOffset& offset, DepthFormat format, const std::array<Corner, 3>& corners);

}  // namespace halfspace::oracle
