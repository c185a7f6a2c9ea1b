// SPDX-License-Identifier: Apache-2.0
//
// The particles of a scene: one draw of points for all of them.
#include "scene/particles.h"
#include "scene/preparation.h"

namespace halfspace {

namespace {

// What the sprites' vertices are made from, one row a sphere.
struct SphereRows {
  std::vector<glm::vec3> centers_cs;
  std::vector<float> radii;
  std::vector<glm::vec3> colors;
};

SphereRows rows_of(const Particles& particles, const View& view, const glm::dvec3& color) {
  SphereRows rows;
  rows.radii = particles.radii;
  rows.centers_cs.reserve(particles.centers_ws.size());
  rows.colors.reserve(particles.colors.size());
  for (const glm::dvec3& center_ws : particles.centers_ws) {
    const glm::dvec3 from_eye = center_ws - view.eye_ws;
    rows.centers_cs.emplace_back(glm::dot(from_eye, view.right_ws), glm::dot(from_eye, view.up_ws), glm::dot(from_eye, view.forward_ws));
  }
  for (const glm::vec3& c : particles.colors) rows.colors.emplace_back(glm::dvec3(c) * color);
  return rows;
}

SphereLens lens_of(const CameraDescription& c, const View& view) {
  const bool perspective = c.type == Projection::perspective;
  const double half_height = 0.5 * c.height, aspect = static_cast<double>(view.width_px) / view.height_px;
  const glm::dvec2 half = perspective ? glm::dvec2(view.tan_x, view.tan_y) : glm::dvec2(half_height * aspect, half_height);
  return {perspective, half, c.near, c.far, {view.width_px, view.height_px}};
}

}  // namespace

SphereSprites ScenePreparation::sphere_sprites() const {
  const ParticlesDescription& p = scene_.particles;
  SphereSprites s;
  s.lens = lens_of(camera(), view_);
  s.world_from_camera = glm::mat3(glm::dmat3(view_.right_ws, view_.up_ws, view_.forward_ws));
  s.to_eye_ws = glm::vec3(view_.to_eye_ws);
  s.point_scale = p.point_scale > 0.0 ? static_cast<float>(p.point_scale) : static_cast<float>(view_.width_px);
  s.ambient = glm::vec3(p.ambient.linear * ambient_);
  s.diffuse = glm::vec3(p.diffuse.linear);
  s.specular = glm::vec3(p.specular.linear);
  s.shininess = static_cast<float>(p.shininess);
  s.lights = p.sprite == ParticleSprite::exact && p.receives_shadow ? lights_ : shadowless_lights_;
  return s;
}

std::shared_ptr<const Particles> ScenePreparation::particles() {
  const ParticlesDescription& p = scene_.particles;
  if (!p.file.path.empty()) {
    return asset<Particles>(recipe("particles", p.file.path.string(), p.radius, p.orbit_radius),
                            [&] { return read_for("particles.file", [&] { return read_particles(p.file.path, p); }); });
  }
  return p.count == 0 ? nullptr : std::make_shared<const Particles>(make_particles(p));
}

void ScenePreparation::add_particles() {
  const ParticlesDescription& p = scene_.particles;
  const std::shared_ptr<const Particles> particles = this->particles();
  if (particles == nullptr) return;
  if (p.sprite == ParticleSprite::exact) out_.spheres = {particles, p.casts_shadow, p.receives_shadow};
  const auto rows = std::make_shared<const SphereRows>(rows_of(*particles, view_, p.color.linear));
  out_.assets.push_back(rows);
  DrawState state;
  state.topology = Topology::points;
  state.depth.clip = ClipDepth::zero_to_one;
  state.depth.compare = CompareOp::greater;
  const SphereSprites sprites = sphere_sprites();
  SceneShader shader = SphereSprite<false>{sprites};
  if (p.sprite == ParticleSprite::exact) shader = SphereSprite<true>{sprites};
  out_.draws.push_back({shader, vertices(stream(rows->centers_cs), stream(rows->radii), stream(rows->colors)),
                        std::make_shared<const Indices>(Indices::sequential(rows->radii.size())), state});
}

}  // namespace halfspace
