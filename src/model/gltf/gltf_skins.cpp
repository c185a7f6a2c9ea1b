// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "halfspace/model/gltf/gltf_nodes.h"

namespace halfspace::HS_LANES {

namespace {

glm::dmat4 matrix_of(const float* values) {
  glm::dmat4 m(1.0);
  for (glm::length_t column = 0; column < 4; ++column) {
    for (glm::length_t row = 0; row < 3; ++row) m[column][row] = static_cast<double>(values[4 * column + row]);  // the last row is 0 0 0 1
  }
  return m;
}

ModelSkin skin_of(GltfAccessors& accessors, const GltfValue& json) {
  GltfDocument& document = accessors.document();
  ModelSkin skin;
  skin.joints = document.indices(json, "joints", document.list("nodes").size());
  if (skin.joints.empty()) document.fail(json, "joints", "is empty; expected at least one joint");
  document.take_memory(json, skin.joints.size(), sizeof(glm::dmat4) + sizeof(int));
  skin.joint_from_mesh.assign(skin.joints.size(), glm::dmat4(1.0));
  if (document.find(json, "inverseBindMatrices") == nullptr) return skin;
  const GltfAccessor accessor = accessors.find(json, "inverseBindMatrices");
  accessors.check_width(accessor, 16);
  if (accessor.component != GltfComponent::float32) document.fail(*accessor.json, "componentType", "is not a float; expected 5126");
  if (accessor.count < skin.joints.size()) {
    document.fail(*accessor.json, "count", fmt::format("{}; expected a matrix for each of {} joints", accessor.count, skin.joints.size()));
  }
  const std::vector<float> values = accessors.read_floats(accessor);
  for (const float x : values) {
    if (!(std::abs(x) <= 1e18f))
      document.fail(*accessor.json, "a matrix has values that are not finite or exceed 1e18; expected smaller finite values");
  }
  for (std::size_t i = 0; i < skin.joints.size(); ++i) skin.joint_from_mesh[i] = matrix_of(values.data() + 16 * i);
  return skin;
}

}  // namespace

void read_gltf_skins(GltfAccessors& accessors, Model& model) {
  for (const GltfValue& json : accessors.document().list("skins")) model.skins.push_back(skin_of(accessors, json));
}

}  // namespace halfspace::HS_LANES
