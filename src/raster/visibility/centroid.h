// SPDX-License-Identifier: Apache-2.0
//
// Positions of centroid varyings: the pixel center if the primitive covers all samples of the pixel, otherwise the first covered sample.
// OpenGL 4.6, section 14.3.1, allows any choice. The result does not depend on other primitives.
#pragma once

#include <span>

#include "halfspace/raster/pipeline/pass_context.h"
#include "halfspace/raster/visibility/packet_batch.h"

namespace halfspace {

/// Computes the W centroid positions of a packet whose lower left pixel is (x, y). Lane i shows triangle ids[i], or `uniform` if ids is
/// null. Lanes without a triangle get the pixel center.
void find_centroids(const PassContext& context, int x, int y, const TriangleId* ids, TriangleId uniform, SamplePosition* out);

/// Computes the centroid positions of a batch with packet_ids, and returns out.data().
const SamplePosition* find_centroids(const PacketBatch& batch, std::span<SamplePosition> out);

}  // namespace halfspace
