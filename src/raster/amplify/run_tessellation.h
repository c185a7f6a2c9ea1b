// SPDX-License-Identifier: Apache-2.0
//
// Runs the tessellation stages: the control function, the tessellator and the evaluation function. Input: patches. Output: the primitives
// that they are divided into.
#pragma once

#include "halfspace/raster/amplify/emitted_primitives.h"
#include "halfspace/raster/amplify/emitting_stages.h"

namespace halfspace::HS_LANES {

/// Divides some patches. The output has the numbers and instances of the patches.
EmittedPrimitives run_tessellation(const TessellationStage& stage, const void* shader, const PrimitiveRows& patches);

/// Returns the kind of primitives that patches are divided into.
Topology topology_of(const TessellatorOptions& options);

}  // namespace halfspace::HS_LANES
