// SPDX-License-Identifier: Apache-2.0
//
// Renders a scene with the naive pipeline (raster/naive.h), to show that the tile-based pipeline draws the same bits.
#pragma once

#include <string>

#include "halfspace/render/prepared_scene.h"

namespace halfspace {

/// Returns why the naive pipeline cannot draw the scene, in one line that begins with the path of the object or key, or an empty string if
/// it can. It draws opaque triangles with one sample per pixel. `description` must be what the scene was prepared from.
std::string naive_obstacle(const PreparedScene& scene, const SceneDescription& description);

/// Renders the scene as linear light before exposure and tone curve, like render() into an Image<glm::vec4>, but with the naive pipeline in
/// float. naive_obstacle() must have returned an empty string. `light` sets the size.
void render_naive(const PreparedScene& scene, Image<glm::vec4>& light);

}  // namespace halfspace
