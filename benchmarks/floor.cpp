// SPDX-License-Identifier: Apache-2.0
//
// aniso_floor: a textured plane of 500 x 251 units, to just below the horizon, filtered along the footprint of each pixel.
#include <array>

#include "families.h"
#include "workload_canvas.h"
#include "workload_floor.h"

namespace halfspace {

namespace {

constexpr std::array<glm::vec3, 4> kFloor{{{-250, -1, 1}, {250, -1, 1}, {250, -1, -250}, {-250, -1, -250}}};
constexpr std::array<uint32_t, 6> kTriangles{0, 1, 2, 0, 2, 3};

}  // namespace

std::unique_ptr<Workload> prepare_aniso_floor(WorkloadSize size, WorkloadAssets& assets) {
  const std::shared_ptr<const Texture2D> texture = assets.checker();
  const FloorShader shader{glm::mat4(workload_projection(size, 0.1, 2000.0)), texture.get()};
  return std::make_unique<SingleDraw<FloorShader>>(size, shader, vertices(stream(std::span<const glm::vec3>(kFloor))),
                                                   Indices(std::span<const uint32_t>(kTriangles), kFloor.size()), workload_state(),
                                                   texture);
}

}  // namespace halfspace
