// SPDX-License-Identifier: Apache-2.0
//
// Triangle and line topologies with their names.
#pragma once

#include "halfspace/raster/draw_state.h"

namespace halfspace::conformance {

struct Named {
  const char* name;
  Topology topology;
  float width = 1.0f;  ///< line width
};
inline constexpr Named kTriangles[] = {
    {"triangles", Topology::triangles}, {"triangle_strip", Topology::triangle_strip}, {"triangle_fan", Topology::triangle_fan}};
inline constexpr Named kLines[] = {{"lines", Topology::lines}, {"line_strip", Topology::line_strip}, {"line_loop", Topology::line_loop}};
inline constexpr Named kWideLines[] = {
    {"lines_wide", Topology::lines, 5.0f}, {"line_strip_wide", Topology::line_strip, 5.0f}, {"line_loop_wide", Topology::line_loop, 5.0f}};

}  // namespace halfspace::conformance
