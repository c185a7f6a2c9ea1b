// SPDX-License-Identifier: Apache-2.0
#include "oracle/depth_stencil.h"

#include <algorithm>

namespace halfspace::oracle {

uint8_t stencil_result(const StencilFace& f, StencilOp op, uint8_t stored) {
  int v = stored;
  switch (op) {
    case StencilOp::keep: break;
    case StencilOp::zero: v = 0; break;
    case StencilOp::replace: v = f.reference; break;
    case StencilOp::increment_clamp: v = std::min(stored + 1, 255); break;
    case StencilOp::decrement_clamp: v = std::max(stored - 1, 0); break;
    case StencilOp::invert: v = 255 - stored; break;
    case StencilOp::increment_wrap: v = (stored + 1) % 256; break;
    case StencilOp::decrement_wrap: v = (stored + 255) % 256; break;
  }
  return static_cast<uint8_t>((stored & ~f.write_mask) | (v & f.write_mask));
}

}  // namespace halfspace::oracle
