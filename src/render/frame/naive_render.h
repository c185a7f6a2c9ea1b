// SPDX-License-Identifier: Apache-2.0
//
// Renders a scene with the naive pipeline (raster/naive.h), to show that the results of the tile-based pipeline are bit-identical.
#pragma once

#include <string>

#include "halfspace/render/prepared_scene.h"

namespace halfspace::HS_LANES {

/// Returns the reason why the naive pipeline cannot draw the scene, as one line that begins with the path of the object or key, or an empty
/// string if it can. It draws opaque triangles with one sample per pixel. The scene must have been prepared from `description`.
std::string naive_obstacle(const PreparedScene& scene, const SceneDescription& description);

/// Renders the scene with the naive pipeline in float, to linear light before exposure and tone curve, like render() into an
/// Image<glm::vec4>. naive_obstacle() must have returned an empty string. The size of `light` determines the size of the image.
void render_naive(const PreparedScene& scene, Image<glm::vec4>& light);

}  // namespace halfspace::HS_LANES
