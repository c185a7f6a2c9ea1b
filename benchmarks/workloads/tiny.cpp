// SPDX-License-Identifier: Apache-2.0
//
// tiny_1m: a million triangles with an area of one pixel each. Measures the cost of a triangle.
#include "workloads/families.h"
#include "workloads/workload_canvas.h"
#include "workloads/workload_constant.h"
#include "workloads/workload_geometry.h"

namespace halfspace {

std::unique_ptr<Workload> prepare_tiny_1m(WorkloadSize size, WorkloadAssets&) {
  auto corners = std::make_shared<const std::vector<glm::vec3>>(tiny_triangles(size, 1'000'000));
  return std::make_unique<SingleDraw<ConstantShader>>(size, ConstantShader{kTinyColor}, make_vertex_view(stream(*corners)),
                                                      Indices::sequential(corners->size()), DrawState{}, corners);
}

}  // namespace halfspace
