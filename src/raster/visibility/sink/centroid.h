// SPDX-License-Identifier: Apache-2.0
//
// Positions of centroid varyings: the pixel center if the primitive covers all samples of the pixel, otherwise the first covered sample.
// OpenGL 4.6, section 14.3.1, allows any choice. The result does not depend on other primitives.
#pragma once

#include <span>

#include "halfspace/raster/pipeline/pass_context.h"
#include "halfspace/raster/visibility/sink/packet_batch.h"

namespace halfspace::HS_LANES {

/// Returns true if a triangle or a point of a multisampled pass covers a position, in 1/256 px.
bool covers_sample(const Triangle& t, int64_t x, int64_t y);

/// Returns true if a draw has centroid varyings whose positions must be computed: if its shader runs once for several samples.
inline bool needs_centroids(const Draw& draw, int samples) { return draw.kernels.uses_centroid && samples > 1 && !draw.shades_samples; }

/// Computes the centroid positions of the packets of a batch, W for each, and returns out.data(). Pixels without a triangle get the pixel
/// center. The batch must not be packed.
const SamplePosition* find_centroids(const PacketBatch& batch, std::span<SamplePosition> out);

}  // namespace halfspace::HS_LANES
