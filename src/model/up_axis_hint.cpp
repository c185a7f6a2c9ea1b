// SPDX-License-Identifier: Apache-2.0
#include "halfspace/model/up_axis_hint.h"

#include <algorithm>
#include <limits>

namespace halfspace::HS_LANES {

namespace {

struct ModelBox {
  glm::dvec3 low{std::numeric_limits<double>::infinity()}, high{-std::numeric_limits<double>::infinity()};
};

// OBJ and PLY models have one node without a transform.
ModelBox box_of(const Model& model) {
  ModelBox box;
  for (const ModelMesh& mesh : model.meshes) {
    for (const glm::vec3& p : mesh.positions) {
      box.low = glm::min(box.low, mesh.origin + glm::dvec3(p));
      box.high = glm::max(box.high, mesh.origin + glm::dvec3(p));
    }
  }
  return box;
}

bool stands_on_zero_z(const ModelBox& box) {
  constexpr double kBase = 0.1, kSide = 0.2, kFlat = 0.02;
  const glm::dvec3 size = box.high - box.low;
  const bool is_solid = size.x > 0.0 && size.y > 0.0 && size.z >= kFlat * std::max(size.x, size.y);
  return is_solid && std::abs(box.low.z) <= kBase * size.z && box.low.y <= -kSide * size.y && box.high.y >= kSide * size.y;
}

bool has_map_coordinates(const ModelBox& box) {
  constexpr double kFar = 1e4, kSizes = 10.0;
  const glm::dvec3 center = glm::abs(0.5 * (box.low + box.high)), size = box.high - box.low;
  const double across = std::min(center.x, center.y);
  return across > std::max(kFar, kSizes * std::max({size.x, size.y, size.z})) && center.z < 0.1 * across;
}

}  // namespace

std::string up_axis_hint(const Model& model) {
  if (model.up != UpAxis::y || (model.format != "OBJ" && model.format != "PLY")) return {};
  const ModelBox box = box_of(model);
  if (!(box.low.x <= box.high.x) || !(stands_on_zero_z(box) || has_map_coordinates(box))) return {};
  return "z probably points up, according to the bounds, but y is drawn as up; try --up-axis z (or confirm with --up-axis y)";
}

}  // namespace halfspace::HS_LANES
