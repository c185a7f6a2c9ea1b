// SPDX-License-Identifier: Apache-2.0
//
// The primitives that the geometry functions of a frame receive and emit, computed by the pipeline's own functions.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "halfspace/raster/amplify/emitted_primitives.h"
#include "halfspace/render/prepared_scene.h"

namespace halfspace {

/// A draw with a geometry function. A row of its vertices has a clip-space position, which the varyings follow.
struct StageEmission {
  uint32_t draw;  ///< in PreparedScene::draws
  EmittedPrimitives received, emitted;
};
std::vector<StageEmission> stage_emissions(const PreparedScene& scene, const Workers& workers);

/// Returns the clip-space position and the window coordinates (from the lower left, in pixels) of a vertex. v: index in `indices`.
glm::vec4 clip_position(const EmittedPrimitives& primitives, std::size_t v);
glm::dvec2 window_position(const EmittedPrimitives& primitives, std::size_t v, glm::ivec2 size);

/// Returns the primitives that were emitted for a received one.
std::vector<std::size_t> emitted_for(const StageEmission& emission, std::size_t received);

/// Returns the front-facing received triangle that is largest in the window, among those that do not leave the window, and for which
/// nothing is emitted that does; nullopt if there is none. mirrored: whether the transform of the draw inverts the winding.
std::optional<std::size_t> emission_example(const StageEmission& emission, bool mirrored, glm::ivec2 size);

}  // namespace halfspace
