// SPDX-License-Identifier: Apache-2.0
//
// Measures the distance between the outlines of objects in two models of the same scene.
#pragma once

#include "halfspace/core/image.h"
#include "halfspace/core/parallel.h"
#include "halfspace/reference/edge_distance.h"
#include "halfspace/render/prepared_scene.h"

namespace halfspace::HS_LANES {

/// The value of seen_objects for particles.
inline constexpr int kParticlesSeen = -1;

/// Returns which object is visible at each pixel center: 1 + the index of the object in the scene, kParticlesSeen, or 0 for the
/// background. Top row first. `finer` multiplies the resolution of the scene's view.
Image<int> seen_objects(const PreparedScene& scene, int finer, const Workers& workers);

/// Returns how far the outlines in `picture` are from those in the reference `truth`; see wrong_band_width. Both images come from
/// seen_objects with the same `finer`; the result is in pixels of the scene's view.
EdgeDistance silhouette_distance(const Image<int>& picture, const Image<int>& truth, int finer);

}  // namespace halfspace::HS_LANES
