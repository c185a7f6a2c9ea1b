// SPDX-License-Identifier: Apache-2.0
//
// The stages between the vertex function and clipping that emit primitives, for the draws whose shaders have them. What they emit replaces
// the vertices and indices of the draw before the pass is planned, so no later stage knows of them.
//
//   vertex function → patches → control function, tessellator, evaluation function → primitives
//   vertex function or evaluation function → primitives with their neighbors → geometry function → primitives
#pragma once

#include <array>

#include "halfspace/raster/amplify/emitted_primitives.h"
#include "halfspace/raster/pipeline/pass_context.h"
#include "halfspace/raster/primitives/vertex_stage.h"

namespace halfspace::HS_LANES {

/// Runs the vertex function of a draw, and tessellation, the geometry function or both. Adds to the counters of these two.
EmittedPrimitives emit_primitives(const Draw& draw, const Workers& workers, PassStatistics& statistics);

/// Runs a vertex kernel for a draw, and assembles its primitives. A row has a position and the values of the kernel. Vertices that several
/// primitives share remain shared.
EmittedPrimitives assemble_primitives(const Draw& draw, VertexKernel kernel, int values, const Workers& workers);

/// Returns the streams of emitted vertices for copy_emitted_vertices() (emitting_stages.h): positions, other values and varyings. The rows
/// must stay valid.
std::array<VertexStream, 3> streams_of(const EmittedPrimitives& primitives, const ShaderKernels& kernels);

/// Checks that the topology of a draw is what the first emitting stage receives, and that patches are only drawn with tessellation.
void check_topology(const ShaderKernels& kernels, const DrawState& state);

}  // namespace halfspace::HS_LANES
