// SPDX-License-Identifier: Apache-2.0
#include "view/enclosing_object.h"

#include <algorithm>

#include "halfspace/render/prepare/scene_places.h"
#include "halfspace/scene/shapes.h"

namespace halfspace {

namespace {

// Returns true if the shape contains a point in the coordinates of the object.
bool contains(const ObjectDescription& o, const glm::dvec3& point_os) {
  if (o.shape == Shape::sphere || kind_of(o.shape).is_sphere_mesh) return glm::length(point_os) < o.radius;
  const glm::dvec3 outwards = glm::abs(point_os);
  return o.shape == Shape::cube && std::max({outwards.x, outwards.y, outwards.z}) < 0.5 * o.size;
}

}  // namespace

std::string enclosing_object(const SceneDescription& scene, const glm::dvec3& point) {
  for (const auto& [name, object] : scene.objects) {
    if (!object.visible || object.shadow_only) continue;
    const bool inside = std::ranges::any_of(places_of(scene, object), [&point, &shape = object](const glm::dmat4& world_from_object) {
      return contains(shape, glm::dvec3(glm::inverse(world_from_object) * glm::dvec4(point, 1.0)));
    });
    if (inside) return name;
  }
  return {};
}

}  // namespace halfspace
