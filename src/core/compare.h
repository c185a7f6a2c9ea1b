// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "halfspace/core/compare_op.h"
#include "halfspace/core/lanes.h"

namespace halfspace::HS_LANES {

/// Compares z with the stored value in each lane (OpenGL 4.6, sections 8.23.1 and 17.3.4). NaN only passes not_equal and always.
template <Number R>
HS_INLINE MaskOf<R> compare(CompareOp op, R z, R stored) {
  switch (op) {
    case CompareOp::never: return MaskOf<R>(false);
    case CompareOp::less: return z < stored;
    case CompareOp::equal: return z == stored;
    case CompareOp::less_equal: return z <= stored;
    case CompareOp::greater: return z > stored;
    case CompareOp::not_equal: return z != stored;
    case CompareOp::greater_equal: return z >= stored;
    case CompareOp::always: return MaskOf<R>(true);
  }
  return MaskOf<R>(false);
}

}  // namespace halfspace::HS_LANES
