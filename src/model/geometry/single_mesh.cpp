// SPDX-License-Identifier: Apache-2.0
#include "halfspace/model/geometry/single_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "halfspace/core/check.h"
#include "halfspace/model/text/text_lines.h"

namespace halfspace::HS_LANES {

bool is_finite(const glm::dvec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

void set_positions(ModelMesh& mesh, std::span<const glm::dvec3> positions) {
  glm::dvec3 low(std::numeric_limits<double>::infinity()), high = -low;
  for (const glm::dvec3& p : positions) {
    if (!is_finite(p)) continue;
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  if (!(low.x <= high.x)) throw InputError("no vertex has finite coordinates; expected at least one");
  for (int i = 0; i < 3; ++i) {
    if (std::max(-low[i], high[i]) > kMaxModelNumber) {
      throw InputError(fmt::format("coordinates from {} to {}; expected at most {} in magnitude", low[i], high[i], kMaxModelNumber));
    }
  }
  mesh.origin = low + (high - low) * 0.5;
  mesh.positions.resize(positions.size());
  for (std::size_t i = 0; i < positions.size(); ++i) {
    mesh.positions[i] = is_finite(positions[i]) ? glm::vec3(positions[i] - mesh.origin) : glm::vec3(0.0f);
  }
}

ModelMaterial default_model_material(bool vertex_colors) {
  ModelMaterial material;
  material.name = "default";
  material.is_default = true;
  material.base_color = glm::vec4(glm::vec3(vertex_colors ? 1.0f : kDefaultModelGray), 1.0f);
  material.roughness = kDefaultModelRoughness;
  material.double_sided = true;
  return material;
}

Model single_mesh_model(std::string format, const std::filesystem::path& file, ModelMesh mesh) {
  Model model;
  model.format = std::move(format);
  ModelMaterial material = default_model_material(!mesh.colors.empty());
  if (std::ranges::any_of(mesh.colors, [](const glm::vec4& color) { return color.w < 1.0f; })) material.alpha_mode = AlphaMode::blend;
  model.materials.push_back(std::move(material));
  mesh.material = 0;
  mesh.name = file.stem().string();
  model.meshes.push_back(std::move(mesh));
  ModelNode& node = model.nodes.emplace_back();
  node.name = file.stem().string();
  node.meshes = {0};
  model.scenes.push_back({"", {0}});
  return model;
}

void check_memory(std::size_t bytes, const ReadModelOptions& options) {
  if (bytes > options.memory_left()) throw InputError(memory_problem(bytes, options.memory_in_use, options.max_memory));
}

}  // namespace halfspace::HS_LANES
