// SPDX-License-Identifier: Apache-2.0
#include "halfspace/render/prepare/sphere_preparation.h"

#include "halfspace/render/prepare/scene_particles.h"
#include "halfspace/render/prepare/scene_places.h"

namespace halfspace::HS_LANES {

namespace {

// Vertex streams of the sprites, one element per sphere.
struct SphereRows {
  std::vector<glm::vec3> centers_cs;
  std::vector<float> radii;
  std::vector<glm::vec3> colors;
};

SphereRows rows_of(const Particles& spheres, const View& view, const glm::dvec3& color) {
  SphereRows rows;
  rows.radii = spheres.radii;
  rows.centers_cs.reserve(spheres.centers_ws.size());
  rows.colors.reserve(spheres.colors.size());
  for (const glm::dvec3& center_ws : spheres.centers_ws) {
    const glm::dvec3 from_eye = center_ws - view.eye_ws;
    rows.centers_cs.emplace_back(glm::dot(from_eye, view.right_ws), glm::dot(from_eye, view.up_ws), glm::dot(from_eye, view.forward_ws));
  }
  for (const glm::vec3& c : spheres.colors) rows.colors.emplace_back(glm::dvec3(c) * color);
  return rows;
}

SphereIntersection intersection_of(const CameraDescription& c, const View& view) {
  const bool perspective = c.type == Projection::perspective;
  const double half_height = 0.5 * c.height, aspect = static_cast<double>(view.width_px) / view.height_px;
  const glm::dvec2 half = perspective || c.matrices ? glm::dvec2(view.tan_x, view.tan_y) : glm::dvec2(half_height * aspect, half_height);
  return {perspective, half, view.near, view.far, {view.width_px, view.height_px}};
}

}  // namespace

SphereImpostors SpherePreparation::impostors(bool receives_shadow) const {
  if (!view_.symmetric)
    throw InputError("camera: exact spheres need a symmetric view; expected a camera without skew and with a centered view axis");
  SphereImpostors s;
  s.lens = intersection_of(camera_of(scene_), view_);
  s.world_from_camera = glm::mat3(glm::dmat3(view_.right_ws, view_.up_ws, view_.forward_ws));
  s.to_eye_ws = glm::vec3(view_.to_eye_ws);
  s.lights = lights_.of_surface(receives_shadow);
  return s;
}

void SpherePreparation::draw(int object, const Particles& spheres, const glm::dvec3& color, const SceneShader& shader) {
  const auto rows = std::make_shared<const SphereRows>(rows_of(spheres, view_, color));
  used_.keep(rows);
  draws_.opaque.push_back({shader,
                           make_vertex_view(stream(rows->centers_cs), stream(rows->radii), stream(rows->colors)),
                           std::make_shared<const Indices>(Indices::sequential(rows->radii.size())),
                           sprite_state(),
                           {.object = object}});
}

void SpherePreparation::add(int object, const std::string& path, const ObjectDescription& o) {
  const auto spheres = std::make_shared<Particles>();
  for (const glm::dmat4& world : places_of(scene_, o)) {
    spheres->centers_ws.emplace_back(world[3]);
    spheres->radii.push_back(static_cast<float>(o.radius * glm::length(glm::dvec3(world[0]))));
    spheres->colors.emplace_back(1.0f);
  }
  const LitSurface surface = surfaces_.surface_of(o, path);
  SphereImpostors s = impostors(o.receives_shadow);
  s.ambient = surface.factors[kAmbient].constant;
  s.diffuse = surface.factors[kDiffuse].constant;
  s.specular = surface.factors[kSpecular].constant;
  s.emissive = surface.factors[kEmissive].constant;
  s.shininess = surface.factors[kShininess].constant.x;
  s.model = surface.model;
  draw(object, *spheres, glm::dvec3(surface.factors[kColor].constant), SphereImpostor<true>{s});
  draws_.spheres.push_back({spheres, o.casts_shadow, o.receives_shadow, object});
}

void SpherePreparation::add_particles(int object, const std::string& path, const ParticlesDescription& p) {
  const std::shared_ptr<const Particles> particles = scene_particles(p, path, used_);
  if (particles == nullptr) return;
  const bool exact = p.sprite == ParticleSprite::exact;
  SphereImpostors s = impostors(exact && p.receives_shadow);
  s.point_scale = p.point_scale > 0.0 ? static_cast<float>(p.point_scale) : static_cast<float>(view_.width_px);
  s.ambient = glm::vec3(surfaces_.ambient(p.ambient));
  s.diffuse = glm::vec3(p.diffuse.linear);
  s.specular = glm::vec3(p.specular.linear);
  s.shininess = static_cast<float>(p.shininess);
  if (s.specular == glm::vec3(0.0f)) s.model = LightModel::lambert;
  if (exact) {
    draws_.spheres.push_back({particles, p.casts_shadow, p.receives_shadow});
    draw(object, *particles, p.color.linear, SphereImpostor<true>{s});
  } else {
    draw(object, *particles, p.color.linear, SphereImpostor<false>{s});
  }
}

}  // namespace halfspace::HS_LANES
