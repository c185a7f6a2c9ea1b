// SPDX-License-Identifier: Apache-2.0
//
// Which views a light needs for what a picture shows. In: a camera's view, placed meshes and spheres, a light. Out: its views, none where
// nothing in the picture receives its shadow.
#pragma once

#include <vector>

#include "halfspace/render/prepared_scene.h"
#include "halfspace/render/shadow/shadow_views.h"
#include "halfspace/render/view.h"

namespace halfspace {

/// size: texels of a view; margin: texels round it that a filter needs. Of a directional light as many as there are cascades
/// that show anything, of a spot one, of a point light or a spot wider than 60 degrees from its axis those of six that show a receiver and
/// a caster.
std::vector<LightView> fitted_views(const View& view, const std::vector<PlacedMesh>& meshes, const std::vector<PlacedSpheres>& spheres,
                                    const LightDescription& light, const ShadowDescription& shadow, int size, double margin);

}  // namespace halfspace
