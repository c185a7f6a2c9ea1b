// SPDX-License-Identifier: Apache-2.0
//
// Stencil. In: a packet's samples. Out: those that pass the stencil test, and the tile's stencil values after what became of
// each sample (OpenGL 4.6, section 17.3.3).
#pragma once

#include "halfspace/raster/tile/tile.h"

namespace halfspace {

/// z against the stored value, lane by lane (OpenGL 4.6, section 17.3.4). NaN passes not_equal and always only.
template <Number R>
HS_INLINE MaskOf<R> compare(CompareOp op, R z, R stored) {
  switch (op) {
    case CompareOp::never: return false;
    case CompareOp::less: return z < stored;
    case CompareOp::equal: return z == stored;
    case CompareOp::less_equal: return z <= stored;
    case CompareOp::greater: return z > stored;
    case CompareOp::not_equal: return z != stored;
    case CompareOp::greater_equal: return z >= stored;
    case CompareOp::always: return true;
  }
  return false;
}

/// Which lanes of mask pass the test.
Mask stencil_test(const StencilFace& face, const Tile& tile, int packet, Mask mask);

/// Changes the stencil values of the lanes that failed the stencil test, failed the depth test after it, or passed both.
void update_stencil(const StencilFace& face, Tile& tile, int packet, Mask failed, Mask depth_failed, Mask passed);

/// The face's state where a draw tests the stencil of this tile, else null.
inline const StencilFace* stencil_face(const DrawState& state, const Tile& tile, bool front_facing) {
  if (!state.stencil || !tile.has_stencil) return nullptr;
  return front_facing ? &state.stencil->front : &state.stencil->back;
}

}  // namespace halfspace
