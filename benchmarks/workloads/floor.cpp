// SPDX-License-Identifier: Apache-2.0
//
// aniso_floor: a textured plane that reaches almost to the horizon, with anisotropic filtering.
#include "workloads/families.h"
#include "workloads/workload_canvas.h"
#include "workloads/workload_floor.h"
#include "workloads/workload_geometry.h"

namespace halfspace {

std::unique_ptr<Workload> prepare_aniso_floor(WorkloadSize size, WorkloadAssets& assets) {
  const std::shared_ptr<const Texture2D> texture = assets.checker();
  const FloorShader shader{floor_camera(size), texture.get()};
  return std::make_unique<SingleDraw<FloorShader>>(size, shader, make_vertex_view(stream(std::span<const glm::vec3>(kFloor))),
                                                   Indices(std::span<const uint32_t>(kRoundTriangles), kFloor.size()), workload_state(),
                                                   texture);
}

}  // namespace halfspace
