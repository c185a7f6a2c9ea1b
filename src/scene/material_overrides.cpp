// SPDX-License-Identifier: Apache-2.0
#include "halfspace/scene/material_overrides.h"

#include <algorithm>

#include "halfspace/core/check.h"
#include "halfspace/core/text.h"
#include "halfspace/scene/scene_paths.h"

namespace halfspace::HS_LANES {

namespace {

std::string_view trimmed(std::string_view text) {
  while (text.starts_with(' ')) text.remove_prefix(1);
  while (text.ends_with(' ')) text.remove_suffix(1);
  return text;
}

// Calls visit(name in the file, material of the scene) for each entry. An entry without '=' has an empty material. Names may contain '=',
// materials cannot.
template <class F>
void for_each_override(std::string_view list, F visit) {
  while (!list.empty()) {
    const std::size_t end = std::min(list.find(','), list.size());
    const std::string_view entry = list.substr(0, end);
    const std::size_t equals = entry.rfind('=');
    if (equals == std::string_view::npos) {
      visit(trimmed(entry), std::string_view());
    } else {
      visit(trimmed(entry.substr(0, equals)), trimmed(entry.substr(equals + 1)));
    }
    list.remove_prefix(std::min(end + 1, list.size()));
  }
}

}  // namespace

std::string no_material(const SceneDescription& scene, std::string_view name) {
  const std::string problem = "no material '" + std::string(name) + "'";
  if (!scene.materials.empty()) return problem + suggestion(name, names_of(scene.materials));
  return problem +
         R"(, because the scene has none; expected one that the scene file defines, for example "materials": {"red": {"color": "#c02020"}})";
}

const SurfaceDescription* override_of(const SceneDescription& scene, const ObjectDescription& o, std::string_view name) {
  const SurfaceDescription* found = nullptr;
  for_each_override(o.model_materials, [&](std::string_view of, std::string_view material) {
    if (of == name) found = find_named(scene.materials, material);
  });
  return found != nullptr || o.material.empty() ? found : &o.surface;
}

void check_material_overrides(const SceneDescription& scene, const ObjectDescription& o, const std::string& where) {
  for_each_override(o.model_materials, [&](std::string_view of, std::string_view material) {
    if (of.empty() || material.empty())
      throw InputError(where + ".model_materials: '" + o.model_materials +
                       "'; expected NAME=MATERIAL[, NAME=MATERIAL...], where each NAME is a material of the model");
    if (find_named(scene.materials, material) == nullptr) throw InputError(where + ".model_materials: " + no_material(scene, material));
  });
}

}  // namespace halfspace::HS_LANES
