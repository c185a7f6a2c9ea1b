// SPDX-License-Identifier: Apache-2.0
#include "halfspace/render/prepared_scene.h"

namespace halfspace::HS_LANES {

DrawState opaque_state(CullMode cull, bool mirrored) {
  DrawState state;
  state.cull = cull;
  if (mirrored) state.front = Winding::clockwise;
  state.depth.clip = ClipDepth::zero_to_one;
  state.depth.compare = CompareOp::greater;
  return state;
}

DrawState sprite_state() {
  DrawState state = opaque_state(CullMode::none, false);
  state.topology = Topology::points;
  return state;
}

}  // namespace halfspace::HS_LANES
