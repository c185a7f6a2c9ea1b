// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "halfspace/core/lanes.h"
#include "halfspace/raster/draw_state.h"

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

}  // namespace halfspace
