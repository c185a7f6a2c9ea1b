// SPDX-License-Identifier: Apache-2.0
//
// Depth and stencil tests. Input: a value and the stored one. Output: whether the test passes, and the new stencil value.
#pragma once

#include <cstdint>

#include "halfspace/raster/draw_state.h"

namespace halfspace::oracle {

/// Returns the result of a depth or stencil test: a is the value of the fragment, b the stored one.
template <class T>
bool compares(CompareOp op, T a, T b) {
  switch (op) {
    case CompareOp::never: return false;
    case CompareOp::less: return a < b;
    case CompareOp::equal: return a == b;
    case CompareOp::less_equal: return a <= b;
    case CompareOp::greater: return a > b;
    case CompareOp::not_equal: return a != b;
    case CompareOp::greater_equal: return a >= b;
    case CompareOp::always: return true;
  }
  return false;
}

/// Returns the stencil value after an operation.
uint8_t stencil_result(const StencilFace& f, StencilOp op, uint8_t stored);

}  // namespace halfspace::oracle
