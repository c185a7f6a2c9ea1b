// SPDX-License-Identifier: Apache-2.0
//
// The transforms of objects, and the camera of a scene.
#pragma once

#include <vector>

#include "halfspace/render/view.h"
#include "halfspace/scene/description.h"
#include "halfspace/shading/surface/surface_uniforms.h"

namespace halfspace::HS_LANES {

/// Returns the camera that the scene selects.
const CameraDescription& camera_of(const SceneDescription& scene);

/// Returns the world-from-object transform of each copy of an object, which includes the placements of its ancestors.
std::vector<glm::dmat4> places_of(const SceneDescription& scene, const ObjectDescription& o);

/// Sets the transforms of a surface.
void place_surface(SurfaceUniforms& s, const View& view, glm::dmat4 world_from_object);

}  // namespace halfspace::HS_LANES
