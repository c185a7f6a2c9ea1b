// SPDX-License-Identifier: Apache-2.0
//
// Finds the shadow map views of a light that are needed for an image. There are none if nothing visible receives its shadow.
#pragma once

#include <vector>

#include "halfspace/render/prepared_scene.h"
#include "halfspace/render/shadow/shadow_views.h"
#include "halfspace/render/view.h"

namespace halfspace::inline HS_LANES_NAMESPACE {

/// Returns the views for maps of size² texels, with `margin` texels around each view for filtering. A directional light has
/// one view per cascade that shows a receiver. A spot light has one view. A point light, or a spot light with an outer angle above
/// 60 degrees, has one view per cube face that contains a receiver and a caster.
std::vector<LightView> fitted_views(const View& view, const std::vector<PlacedMesh>& meshes, const std::vector<PlacedSpheres>& spheres,
                                    const LightDescription& light, const ShadowDescription& shadow, int size, double margin);

}  // namespace halfspace::inline HS_LANES_NAMESPACE
