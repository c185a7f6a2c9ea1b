// SPDX-License-Identifier: Apache-2.0
#include "halfspace/raster/visibility/tests/depth_stencil_test.h"

#include <cmath>

#include "halfspace/core/lane_bytes.h"

namespace halfspace::HS_LANES {

namespace {

Int load_values(const Tile& tile, int packet) { return load_u8<Int>(&tile.stencil[static_cast<std::size_t>(packet) * kLanes]); }

Int apply(StencilOp op, Int value, Int reference) {
  const Int max_value(0xff);
  switch (op) {
    case StencilOp::keep: return value;
    case StencilOp::zero: return Int(0);
    case StencilOp::replace: return reference;
    case StencilOp::increment_clamp: return min(value + Int(1), max_value);
    case StencilOp::decrement_clamp: return max(value - Int(1), Int(0));
    case StencilOp::invert: return value ^ max_value;
    case StencilOp::increment_wrap: return (value + Int(1)) & max_value;
    case StencilOp::decrement_wrap: return (value - Int(1)) & max_value;
  }
  return value;
}

// Applies the stencil operations of `face`. The three masks are disjoint: lanes that failed the stencil test, lanes that passed it but
// failed the depth test, and lanes that passed both tests.
void update_stencil(const StencilFace& face, Tile& tile, int packet, Mask failed, Mask depth_failed, Mask passed) {
  const Int old = load_values(tile, packet), reference(face.reference), write(face.write_mask);
  Int value = select(failed, apply(face.fail, old, reference), old);
  value = select(depth_failed, apply(face.depth_fail, old, reference), value);
  value = select(passed, apply(face.pass, old, reference), value);
  value = (value & write) | (old & ~write);
  store_u8(&tile.stencil[static_cast<std::size_t>(packet) * kLanes], value);
}

}  // namespace

Mask stencil_test(const StencilFace& face, const Tile& tile, int packet, Mask mask) {
  const Int read(face.read_mask);
  const Real reference = to_real<Real>(Int(face.reference) & read);  // integers up to 255 are exact in float
  return mask & compare(face.compare, reference, to_real<Real>(load_values(tile, packet) & read));
}

Mask stored_depth_test(const StoredDepthRange& range, const Tile& tile, int packet, Mask mask) {
  const Real stored = load<Real>(&tile.depth[static_cast<std::size_t>(packet) * kLanes]);
  if (tile.depth_format == DepthFormat::d32f) return mask & (stored >= Real(range.low)) & (stored <= Real(range.high));
  // Codes from 0 to `one`. The products are exact in double, and the limits are integers that a float holds.
  const double one = tile.depth_format == DepthFormat::d16 ? 65535.0 : 16777215.0;
  const auto low = static_cast<float>(std::ceil(static_cast<double>(range.low) * one));
  const auto high = static_cast<float>(std::floor(static_cast<double>(range.high) * one));
  return mask & (stored >= Real(low)) & (stored <= Real(high));
}

Mask test_and_update_stencil(const StencilFace& face, Tile& tile, int packet, Mask mask, bool with_depth, CompareOp op, Real z) {
  const Mask stencil_passed = stencil_test(face, tile, packet, mask);
  Mask passed = stencil_passed;
  if (with_depth) passed = passed & compare(op, z, load<Real>(&tile.depth[static_cast<std::size_t>(packet) * kLanes]));
  update_stencil(face, tile, packet, mask & !stencil_passed, stencil_passed & !passed, passed);
  return passed;
}

bool updates_stencil(const DrawState& state) {
  const auto updates = [](const StencilFace& f) {
    return f.write_mask != 0 && (f.fail != StencilOp::keep || f.depth_fail != StencilOp::keep || f.pass != StencilOp::keep);
  };
  return updates(state.stencil->front) || updates(state.stencil->back);
}

}  // namespace halfspace::HS_LANES
