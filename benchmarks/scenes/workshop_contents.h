// SPDX-License-Identifier: Apache-2.0
//
// The materials of the workshop, and the objects on and above its benches.
#pragma once

#include "scenes/workshop_parts.h"

namespace halfspace::workshop {

struct WorkshopMaterials {
  std::size_t brick, floor, board, bench, beam, roof, lawn, sky, bulb;
  std::size_t steel, brass, rust, dark, green, red, blue, yellow, cardboard, label;
  std::size_t mesh, pegs, plant, tree, bark;
  std::size_t glass, amber, emerald;
};

void add_benches(Scene& scene, const WorkshopMaterials& materials);
/// Tools on the wall above the benches, and a few on them.
void add_tools(Scene& scene, const WorkshopMaterials& materials);

}  // namespace halfspace::workshop
