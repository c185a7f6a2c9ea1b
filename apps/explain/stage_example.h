// SPDX-License-Identifier: Apache-2.0
//
// One primitive in each stage of the pipeline: its vertices in every space, the clipped polygon, and the triangles after setup.
#pragma once

#include <optional>
#include <vector>

#include "explain/stage_geometry.h"
#include "halfspace/raster/primitives/clip.h"

namespace halfspace {

/// A vertex in every space. clip, window and outcode are the renderer's values; the other positions are computed in double, one transform
/// at a time.
struct StageVertex {
  uint32_t index = 0;                                               ///< in the mesh
  std::optional<glm::dvec3> position_os, position_ws, position_vs;  ///< empty for the background, which has no mesh
  glm::vec4 clip{0.0f};
  glm::vec3 ndc{0.0f};  ///< clip / w
  ScreenVertex window{};
  Outcode outcode = 0;
};

struct StageExample {
  StagePrimitive primitive{};
  int corners = 3;  ///< 3: triangle, 2: line, 1: point
  std::array<StageVertex, 3> vertices;
  std::vector<Triangle> triangles;  ///< after setup
  std::optional<PointSpriteRect> sprite;
};

/// Returns the values of a primitive.
StageExample stage_example(const PreparedScene& scene, const PassContext& context, const StageGeometry& geometry, uint32_t primitive);

/// The transforms from world to clip space.
struct StageTransforms {
  glm::dmat4 view_from_world, clip_from_view;
};
StageTransforms stage_transforms(const View& view);

/// A triangle before and after clipping.
struct StageClip {
  uint32_t primitive;
  std::array<glm::vec4, 3> clip;  ///< vertices in clip space
  ClipPolygon polygon;
  std::vector<glm::dvec2> window;  ///< vertices of the polygon in window coordinates, in pixels
};
StageClip stage_clip(const PassContext& context, const StageGeometry& geometry, uint32_t primitive);

}  // namespace halfspace
