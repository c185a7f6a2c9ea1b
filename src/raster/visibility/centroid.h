// SPDX-License-Identifier: Apache-2.0
//
// Where centroid varyings are looked up: at the pixel's centre if the primitive covers all samples of the pixel, else at the first
// sample that it covers (OpenGL 4.6, section 14.3.1, leaves the choice free). What else is drawn there makes no difference.
#pragma once

#include "halfspace/raster/pipeline/pass_context.h"
#include "halfspace/raster/tile/tile.h"

namespace halfspace {

/// Fills a row of W positions for a packet whose lowest pixel is (x, y): of lane i for triangle ids[i], or for `uniform` where
/// ids is null. Lanes that show no triangle get the centre.
void find_centroids(const PassContext& context, int x, int y, const TriangleId* ids, TriangleId uniform, SamplePosition* out);

}  // namespace halfspace
