// SPDX-License-Identifier: Apache-2.0
//
// Runs a geometry stage. Input: primitives with their neighbors. Output: the primitives of the strips that it emits.
#pragma once

#include "halfspace/raster/amplify/emitted_primitives.h"
#include "halfspace/raster/amplify/emitting_stages.h"

namespace halfspace::HS_LANES {

/// Runs the geometry function for some primitives. first_provokes: see ProvokingVertex; it determines the order of vertices in strips.
EmittedPrimitives run_geometry(const GeometryStage& stage, const void* shader, const PrimitiveRows& primitives, bool first_provokes);

/// Returns the kind of primitives that a stage emits.
Topology topology_of(GeometryOutputPrimitive output);

/// Returns true if primitives of a topology are what a geometry function with this input receives.
bool accepts(GeometryInputPrimitive input, Topology topology);

}  // namespace halfspace::HS_LANES
