// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "halfspace/model/model.h"

namespace halfspace::HS_LANES {

/// Appends the contents of a model, except for its lights, scenes and variants, to another model, with `copies` copies of its nodes. A
/// scene that draws the model has lights of its own. The copies share meshes. Only the first copy is animated and keeps its cameras.
/// variant: index in from.variants, or −1. Returns the roots of scene `scene` in each copy, as indices in to.nodes.
std::vector<std::vector<int>> append_model(Model& to, const Model& from, int scene, int variant, std::size_t copies);

}  // namespace halfspace::HS_LANES
