// SPDX-License-Identifier: Apache-2.0
//
// The particle systems of a scene, each drawn with a single draw call of points.
#include "halfspace/render/particles.h"
#include "halfspace/render/preparation.h"
#include "halfspace/render/scene_particles.h"

namespace halfspace::inline HS_LANES_NAMESPACE {

void ScenePreparation::add_particles(int object, const ParticlesDescription& p, const std::string& path) {
  const std::shared_ptr<const Particles> particles = scene_particles(p, path, used_);
  if (particles == nullptr) return;
  const bool exact = p.sprite == ParticleSprite::exact;
  SphereImpostors s = sphere_impostors(exact && p.receives_shadow);
  s.point_scale = p.point_scale > 0.0 ? static_cast<float>(p.point_scale) : static_cast<float>(view_.width_px);
  s.ambient = glm::vec3(p.ambient.linear * lights_.ambient());
  s.diffuse = glm::vec3(p.diffuse.linear);
  s.specular = glm::vec3(p.specular.linear);
  s.shininess = static_cast<float>(p.shininess);
  if (s.specular == glm::vec3(0.0f)) s.model = LightModel::lambert;
  if (exact) {
    out_.spheres.push_back({particles, p.casts_shadow, p.receives_shadow});
    draw_spheres(object, *particles, p.color.linear, SphereImpostor<true>{s});
  } else {
    draw_spheres(object, *particles, p.color.linear, SphereImpostor<false>{s});
  }
}

}  // namespace halfspace::inline HS_LANES_NAMESPACE
