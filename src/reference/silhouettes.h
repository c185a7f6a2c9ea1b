// SPDX-License-Identifier: Apache-2.0
//
// How far the outlines of a scene's objects lie from those by another model of it.
#pragma once

#include "halfspace/core/image.h"
#include "halfspace/core/parallel.h"
#include "halfspace/reference/edge_distance.h"
#include "halfspace/render/prepared_scene.h"

namespace halfspace {

/// What seen_objects says of particles.
inline constexpr int kParticlesSeen = -1;

/// Which object each pixel's centre shows: 1 + its place among the scene's, kParticlesSeen, or 0. Top row first; several times as fine as
/// the scene's own picture with `finer` > 1.
Image<int> seen_objects(const PreparedScene& scene, int finer, const Workers& workers);

/// How far the outlines of `picture` lie off those of `truth` (wrong_band_width). Both by seen_objects with the same `finer`; in pixels of
/// the scenes' own picture.
EdgeDistance silhouette_distance(const Image<int>& picture, const Image<int>& truth, int finer);

}  // namespace halfspace
