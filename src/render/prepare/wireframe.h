// SPDX-License-Identifier: Apache-2.0
//
// Wireframes: the edges of triangles instead of surfaces.
#pragma once

#include "halfspace/render/prepared_scene.h"

namespace halfspace::HS_LANES {

/// Whether edges behind surfaces are visible.
enum class HiddenLines : uint8_t { shown, removed };

/// Returns black on a light background and white on a dark one. Colors are linear.
glm::vec4 line_color(const glm::vec4& background);

/// Returns the width of the lines of wireframes and normals in pixels.
float line_width(const View& view);

/// Replaces the draws of all meshes of a prepared scene with the edges of their triangles. The lines have the color line_color(), without
/// lighting or shadows. Shadow catchers are omitted. The background, points, lines (also those of normals) and exact spheres, which have no
/// triangles, are unchanged. Returns true if there are such spheres. description: the scene that was prepared.
bool make_wireframe(PreparedScene& scene, const SceneDescription& description, HiddenLines hidden);

}  // namespace halfspace::HS_LANES
