// SPDX-License-Identifier: Apache-2.0
#include "halfspace/render/prepare/scene_surfaces.h"

#include <algorithm>

#include "halfspace/image/image_io.h"

namespace halfspace::HS_LANES {

// The map is omitted if the factor is zero or the shading rate does not read it.
void SceneSurfaces::add_factor(LitSurface& s, MaterialFactor factor, const glm::dvec3& constant, const MapValue& map,
                               const ObjectDescription& o, const std::string& where) {
  Factor& f = s.factors[factor];
  f.constant = glm::vec3(constant);
  if (const auto* color = std::get_if<Color>(&map)) f.constant = glm::vec3(constant * color->linear);
  const bool unread = o.surface.shading == ShadingRate::none && factor != kColor && factor != kEmissive;
  if (!is_map(map) || unread || f.constant == glm::vec3(0.0f) || (!o.surface.textured && factor != kShininess)) return;
  const MapUse use = maps_.use_of(map, o);
  f.map = (factor == kShininess ? maps_.data_texture(use, TextureRole::data, where) : maps_.color_texture(use, where)).get();
  f.sampler = make_sampler(use.texture);
}

// Reports maps that are multiplied by zero. Their files are opened but not decoded, so that a wrong name is an error.
void SceneSurfaces::report_unused_maps(const ObjectDescription& o, const std::string& path) {
  const SurfaceDescription& d = o.surface;
  const struct {
    const char* key;
    const MapValue& map;
    const char* factor;
    const Color& constant;
  } maps[] = {{"color", d.color, "tint", d.tint},
              {"ambient_map", d.ambient_map, "ambient", d.ambient},
              {"diffuse_map", d.diffuse_map, "diffuse", d.diffuse},
              {"specular_map", d.specular_map, "specular", d.specular},
              {"shininess_map", d.shininess_map, "specular", d.specular},
              {"emissive_map", d.emissive_map, "emissive", d.emissive}};
  if (!d.textured) return;
  for (const auto& m : maps) {
    if (!is_map(m.map) || m.constant.linear != glm::dvec3(0.0)) continue;
    const MapUse use = maps_.use_of(m.map, o);
    const std::string where = path + "." + m.key;
    if (use.texture.source == TextureSource::file) read_for(where, [&] { return holds_linear_numbers(use.texture.file.path); });
    // At other times, an animation can make the factor positive.
    const bool is_animated = std::ranges::any_of(
        scene_.animations, [&](const auto& entry) { return entry.second.target.ends_with(std::string(".") + m.factor); });
    if (!is_animated) warnings_.warn_once(where + ": has no effect, because " + m.factor + " is 0; expected " + m.factor + " above 0");
  }
}

glm::dvec3 SceneSurfaces::ambient(const Color& factor) {
  if (factor.linear == glm::dvec3(0.0)) return glm::dvec3(0.0);
  return factor.linear * (lights_.ambient() + environments_.mean_light());
}

LitSurface SceneSurfaces::surface_of(const ObjectDescription& o, const std::string& path) {
  const SurfaceDescription& d = o.surface;
  LitSurface s;
  s.to_eye_ws = glm::vec3(view_.to_eye_ws);
  s.lights = lights_.of_surface(o.receives_shadow);
  s.shadowed = lights_.have_shadow(o.receives_shadow);
  s.two_sided = d.two_sided || o.shape == Shape::plane;
  s.opacity = static_cast<float>(d.opacity);
  report_unused_maps(o, path);
  add_factor(s, kColor, d.tint.linear, d.color, o, path + ".color");
  const glm::dvec3 around = d.shading == ShadingRate::none ? glm::dvec3(0.0) : ambient(d.ambient);
  add_factor(s, kAmbient, around, d.ambient_map, o, path + ".ambient_map");
  add_factor(s, kDiffuse, d.diffuse.linear, d.diffuse_map, o, path + ".diffuse_map");
  add_factor(s, kSpecular, d.specular.linear, d.specular_map, o, path + ".specular_map");
  add_factor(s, kEmissive, d.emissive.linear, d.emissive_map, o, path + ".emissive_map");
  if (d.reflection.linear != glm::dvec3(0.0) && d.shading == ShadingRate::phong) {
    s.reflected_environment = environments_.reflected_environment();
    s.reflection = glm::vec3(d.reflection.linear);
  }
  s.model = s.factors[kSpecular].constant == glm::vec3(0.0f) ? LightModel::lambert : d.model;
  if (s.model == LightModel::lambert) return s;
  add_factor(s, kShininess, glm::dvec3(d.shininess), d.shininess_map, o, path + ".shininess_map");
  Factor& shininess = s.factors[kShininess];
  if (d.shading != ShadingRate::phong && shininess.map != nullptr) {  // per-vertex and per-triangle lighting use the mean of the map
    shininess.constant *= shininess.map->value(shininess.map->levels() - 1, 0, 0).x;
    shininess.map = nullptr;
  }
  return s;
}

}  // namespace halfspace::HS_LANES
