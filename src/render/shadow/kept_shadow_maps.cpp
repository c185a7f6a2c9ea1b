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

bool casts_same_shadow(const PlacedMesh& a, const PlacedMesh& b) {
  return same_array(a.positions, b.positions) && a.indices == b.indices && a.world_from_object == b.world_from_object &&
         a.two_sided == b.two_sided && a.opacity == b.opacity && same_array(a.uvs, b.uvs) && same_array(a.colors, b.colors);
}

bool casts_same_shadow(const std::shared_ptr<const Particles>& a, const std::shared_ptr<const Particles>& b) {
  return a == b || (a->centers_ws == b->centers_ws && a->radii == b->radii);
}

template <class T>
bool cast_same_shadows(const std::vector<T>& a, const std::vector<T>& b) {
  return std::ranges::equal(a, b, [](const T& x, const T& y) { return casts_same_shadow(x, y); });
}

}  // namespace

void add_casters(const ShadowScene& scene, ShadowMapSource& source) {
  for (const ShadowExtent& e : scene.objects) {
    if (!e.casts_shadow) continue;
    if (e.mesh != nullptr) source.meshes.push_back(*e.mesh);
    if (e.spheres != nullptr) source.spheres.push_back(e.spheres->particles);
  }
}

bool have_same_maps(const ShadowMapSource& a, const ShadowMapSource& b) {
  return a.views == b.views && a.size == b.size && a.mean_radius == b.mean_radius && a.faces == b.faces && a.filter == b.filter &&
         cast_same_shadows(a.meshes, b.meshes) && cast_same_shadows(a.spheres, b.spheres);
}

}  // namespace halfspace::HS_LANES
