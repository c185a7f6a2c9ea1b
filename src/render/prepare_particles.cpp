// SPDX-License-Identifier: Apache-2.0
//
// The particle systems of a scene, each drawn with a single draw call of points.
#include "halfspace/render/particles.h"
#include "halfspace/render/preparation.h"

namespace halfspace::inline HS_LANES_NAMESPACE {

std::shared_ptr<const Particles> ScenePreparation::particles(const ParticlesDescription& p, const std::string& path) {
  if (!p.file.path.empty()) {
    return used_.asset<Particles>(recipe("particles", p.file.path.string(), p.radius, p.orbit_radius),
                                  [&] { return read_for(path + ".file", [&] { return read_particles(p.file.path, p); }); });
  }
  return p.count == 0 ? nullptr : std::make_shared<const Particles>(make_particles(p));
}

void ScenePreparation::add_particles(int object, const ParticlesDescription& p, const std::string& path) {
  const std::shared_ptr<const Particles> particles = this->particles(p, path);
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
