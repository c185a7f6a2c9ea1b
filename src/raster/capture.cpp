// SPDX-License-Identifier: Apache-2.0
#include "halfspace/raster/capture.h"

#include <memory_resource>

#include "halfspace/core/float_mode.h"
#include "halfspace/raster/amplify/emit_primitives.h"
#include "halfspace/raster/primitives/primitive_assembly.h"

namespace halfspace::HS_LANES::detail {

EmittedPrimitives capture_primitives(const ShaderKernels& kernels, KeptShader shader, const VertexView& vertices,
                                     std::shared_ptr<const Indices> indices, const DrawState& state, const Workers& workers) {
  const FloatMode float_mode;
  check_vertices(vertices, *indices, state);
  check_instances(vertices, state);
  check_topology(kernels, state);
  std::pmr::monotonic_buffer_resource memory;
  Draw draw(kernels, std::move(shader), std::move(indices), keep_streams(vertices, state.base_instance, memory), state, {});
  draw.vertex_count = draw.indices->used_count() * state.instances;
  count_primitives(draw);
  PassStatistics statistics;
  return kernels.emitting != nullptr ? emit_primitives(draw, workers, statistics)
                                     : assemble_primitives(draw, kernels.vertex, kernels.varying_count, workers);
}

}  // namespace halfspace::HS_LANES::detail
