// SPDX-License-Identifier: Apache-2.0
#include "halfspace/render/shadow/kept_shadow_maps.h"

#include <algorithm>
#include <span>

namespace halfspace::HS_LANES {

namespace {

template <class T>
bool same_array(std::span<const T> a, std::span<const T> b) {
  return a.data() == b.data() && a.size() == b.size();
}

bool has_maps(const PlacedMesh& m) {
  return m.opacity && std::ranges::any_of(m.opacity->maps, [](const MaterialMap& map) { return map.map != nullptr; });
}

// The indices keep the arrays of a mesh alive, unless it is deformed.
bool casts_same_shadow(const PlacedMesh& a, const PlacedMesh& b) {
  return !a.deformed && !b.deformed && same_array(a.positions, b.positions) && a.indices == b.indices &&
         a.world_from_object == b.world_from_object && a.two_sided == b.two_sided && a.opacity == b.opacity && same_array(a.uvs, b.uvs) &&
         same_array(a.colors, b.colors);
}

bool casts_same_shadow(const std::shared_ptr<const Particles>& a, const std::shared_ptr<const Particles>& b) {
  return a == b || (a->centers_ws == b->centers_ws && a->radii == b->radii);
}

template <class T>
bool cast_same_shadows(const std::vector<T>& a, const std::vector<T>& b) {
  return std::ranges::equal(a, b, [](const T& x, const T& y) { return casts_same_shadow(x, y); });
}

}  // namespace

ShadowCasters casters_of(const ShadowScene& scene, const std::vector<std::shared_ptr<const void>>& assets) {
  ShadowCasters casters;
  bool have_maps = false;
  for (const ShadowExtent& e : scene.objects) {
    if (!e.casts_shadow) continue;
    if (e.mesh != nullptr) casters.meshes.push_back(*e.mesh);
    if (e.spheres != nullptr) casters.spheres.push_back(e.spheres->particles);
    have_maps = have_maps || (e.mesh != nullptr && has_maps(*e.mesh));
  }
  if (have_maps) casters.assets = assets;
  return casters;
}

bool have_same_maps(const ShadowMapSource& a, const ShadowMapSource& b) {
  if (a.views != b.views || a.size != b.size || a.mean_radius != b.mean_radius || a.faces != b.faces || a.filter != b.filter) return false;
  return cast_same_shadows(a.casters->meshes, b.casters->meshes) && cast_same_shadows(a.casters->spheres, b.casters->spheres);
}

}  // namespace halfspace::HS_LANES
