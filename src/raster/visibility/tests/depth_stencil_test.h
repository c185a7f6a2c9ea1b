// SPDX-License-Identifier: Apache-2.0
//
// Depth comparison and stencil test. Input: the samples of a packet. Output: the samples that pass the stencil test, and the updated
// stencil values of the tile (OpenGL 4.6, section 17.3.3).
#pragma once

#include "halfspace/core/compare.h"
#include "halfspace/raster/tile/tile.h"

namespace halfspace::HS_LANES {

/// Returns the lanes of mask that pass the stencil test.
Mask stencil_test(const StencilFace& face, const Tile& tile, int packet, Mask mask);

/// Runs the stencil test and, if with_depth is set, the depth test for the lanes in mask, and updates the stencil values. Returns the lanes
/// that pass. z: depth of the fragments, represented as in Tile::depth.
Mask test_and_update_stencil(const StencilFace& face, Tile& tile, int packet, Mask mask, bool with_depth, CompareOp op, Real z);

/// Returns true if a draw has a depth test in this tile.
inline bool tests_depth(const DepthState& state, const Tile& tile) { return state.test && tile.depth_format != DepthFormat::none; }

/// Returns true if a draw has a stencil test in this tile.
inline bool tests_stencil(const DrawState& state, const Tile& tile) { return state.stencil && tile.has_stencil; }

/// Returns true if a draw tests the stored depth in this tile (DrawState::depth_bounds).
inline bool tests_stored_depth(const DrawState& state, const Tile& tile) {
  return state.depth_bounds && tile.depth_format != DepthFormat::none;
}
/// Returns the lanes of mask that pass this test.
Mask stored_depth_test(const StoredDepthRange& range, const Tile& tile, int packet, Mask mask);

/// Returns true if the stencil test of a draw may change stencil values. The state must have a stencil test.
bool updates_stencil(const DrawState& state);

/// Returns the stencil state of a face, or null if the draw has no stencil test in this tile.
inline const StencilFace* stencil_face(const DrawState& state, const Tile& tile, bool front_facing) {
  if (!tests_stencil(state, tile)) return nullptr;
  return front_facing ? &state.stencil->front : &state.stencil->back;
}

}  // namespace halfspace::HS_LANES
