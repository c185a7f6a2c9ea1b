// SPDX-License-Identifier: Apache-2.0
#include "halfspace/scene/object_keys.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "halfspace/scene/scene_paths.h"

namespace halfspace::HS_LANES {

bool is_uniformly_scaled(const Placement& p) { return glm::abs(p.scale) == glm::dvec3(std::fabs(p.scale.x)); }

std::string_view mesh_only_key(const ObjectDescription& o) {
  const SurfaceDescription& s = o.surface;
  if (is_map(o.height)) return "height";
  if (const std::string_view map = first_map(s); !map.empty()) return map;
  if (s.reflection.linear != glm::dvec3(0.0)) return "reflection";
  if (s.opacity != 1.0) return "opacity";
  if (s.shading != ShadingRate::phong) return "shading";
  if (s.two_sided) return "two_sided";
  if (o.normal_lines != 0.0) return "normal_lines";
  if (!is_uniformly_scaled(o.placement)) return "scale";
  return std::ranges::all_of(o.instances, is_uniformly_scaled) ? "" : kInstances;
}

bool has_own_materials(const ObjectDescription& o) { return o.shape == Shape::file && o.material.empty(); }

bool offers_shading(const ObjectDescription& o, ShadingRate rate) {
  return !has_own_materials(o) || rate == ShadingRate::none || rate == ShadingRate::phong;
}

std::string lack_of_effect(const ObjectDescription& o, std::string_view key) {
  if (o.shape != Shape::file) return {};
  static const std::vector<std::string_view> surface_keys = [] {
    SurfaceDescription surface;
    std::vector<std::string_view> names;
    for (const Field& field : fields_of(section_of(surface))) names.emplace_back(field.key->name);
    return names;
  }();
  if (key == "height" || key.starts_with("height_")) return "has no effect on a model; expected another shape, or no such key";
  if (!has_own_materials(o) || std::ranges::find(surface_keys, key) == surface_keys.end()) return {};
  if (key == "textured" || key == "normal" || key == "shading") return {};
  return "has no effect on a model with its own materials; expected the key material as well, or no such key";
}

bool has_uniformly_scaled_ancestors(const SceneDescription& scene, const ObjectDescription& o) {
  if (o.parent.empty()) return true;
  const ObjectDescription* parent = find_named(scene.objects, o.parent);
  return is_uniformly_scaled(parent->placement) && has_uniformly_scaled_ancestors(scene, *parent);
}

}  // namespace halfspace::HS_LANES
