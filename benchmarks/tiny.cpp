// SPDX-License-Identifier: Apache-2.0
//
// tiny_1m: a million triangles of one square pixel each; what a triangle costs.
#include <cmath>
#include <numbers>

#include "families.h"
#include "workload_canvas.h"
#include "workload_constant.h"

namespace halfspace {

namespace {

// Right triangles of area 1 px² on a grid over the picture, layer before layer, each nearer than the one before.
std::vector<glm::vec3> tiny_triangles(WorkloadSize size, int count) {
  const double side = std::numbers::sqrt2, width = size.width, height = size.height;
  const int columns = std::max(static_cast<int>(std::floor(width / side)), 1);
  const int rows = std::max(static_cast<int>(std::floor(height / side)), 1);
  std::vector<glm::vec3> corners;
  corners.reserve(3 * static_cast<std::size_t>(count));
  for (int t = 0; t < count; ++t) {
    const int layer = t / (columns * rows), q = t % (columns * rows);
    const double x0 = q % columns * side, y0 = q / columns * side, z = 0.9 - 0.1 * layer;
    const auto corner = [&](double x, double y) { corners.emplace_back(glm::dvec3(2 * x / width - 1, 2 * y / height - 1, z)); };
    corner(x0, y0);
    corner(x0 + side, y0);
    corner(x0, y0 + side);
  }
  return corners;
}

}  // namespace

std::unique_ptr<Workload> prepare_tiny_1m(WorkloadSize size, WorkloadAssets&) {
  auto corners = std::make_shared<const std::vector<glm::vec3>>(tiny_triangles(size, 1'000'000));
  return std::make_unique<SingleDraw<ConstantShader>>(size, ConstantShader{{0.9f, 0.6f, 0.1f, 1.0f}}, vertices(stream(*corners)),
                                                      Indices::sequential(corners->size()), DrawState{}, corners);
}

}  // namespace halfspace
