// SPDX-License-Identifier: Apache-2.0
//
// Prepares the appearance of an object's surface: its factors, and the maps for per-pixel normals.
#include "halfspace/geometry/height_slopes.h"
#include "halfspace/render/preparation.h"

namespace halfspace::inline HS_LANES_NAMESPACE {

// The map is omitted if the factor is zero or the shading rate does not read it.
void ScenePreparation::add_factor(LitSurface& s, MaterialFactor factor, const glm::dvec3& constant, const MapValue& map,
                                  const ObjectDescription& o, const std::string& where) {
  Factor& f = s.factors[factor];
  f.constant = glm::vec3(constant);
  if (const auto* color = std::get_if<Color>(&map)) f.constant = glm::vec3(constant * color->linear);
  const bool unread = o.surface.shading == ShadingRate::none && factor != kColor && factor != kEmissive;
  if (!is_map(map) || unread || f.constant == glm::vec3(0.0f) || (!o.surface.textured && factor != kShininess)) return;
  const MapUse use = maps_.use_of(map, o);
  f.map = (factor == kShininess ? maps_.data_texture(use, where) : maps_.color_texture(use, where)).get();
  f.sampler = make_sampler(use.texture);
}

LitSurface ScenePreparation::surface_of(const ObjectDescription& o, const std::string& path) {
  const SurfaceDescription& d = o.surface;
  LitSurface s;
  s.to_eye_ws = glm::vec3(view_.to_eye_ws);
  s.lights = o.receives_shadow ? lights_ : shadowless_lights_;
  s.shadowed = o.receives_shadow && std::ranges::any_of(lights_, [](const Light& l) { return l.shadow != nullptr; });
  s.two_sided = d.two_sided || o.shape == Shape::plane;
  add_factor(s, kColor, d.tint.linear, d.color, o, path + ".color");
  add_factor(s, kAmbient, d.ambient.linear * ambient_, d.ambient_map, o, path + ".ambient_map");
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

DetailMap ScenePreparation::normal_map(const ObjectDescription& o, const std::string& where) {
  const MapUse use = maps_.use_of(o.surface.normal_map, o);
  DetailMap d;
  d.map = maps_.data_texture(use, where).get();
  d.sampler = make_sampler(use.texture);
  d.strength = static_cast<float>(o.surface.normal_strength);
  d.flip_green = o.surface.normal_flip_green;
  return d;
}

DetailMap ScenePreparation::bump_map(const ObjectDescription& o, const std::string& where) {
  const MapUse use = maps_.use_of(o.surface.bump_map, o);
  DetailMap d;
  d.sampler = make_sampler(use.texture);
  d.strength = static_cast<float>(o.surface.bump_scale);
  d.difference = o.surface.bump_method == BumpMethod::difference;
  const auto words = [&](const char* what, auto... more) {
    return recipe(what, static_cast<int>(use.texture.source), use.texture.file.path.string(), use.width, more...);
  };
  const auto codes = [&] { return Texture2D(codes16(*maps_.heights(use, where))); };
  const Wrap s = d.sampler.wrap_s, t = d.sampler.wrap_t;
  const auto slopes = [&] { return Texture2D(height_slopes(*maps_.heights(use, where), s, t), TexelFormat::rgba16f, &workers_); };
  const auto map = d.difference ? used_.asset<Texture2D>(words("bumps"), codes)
                                : used_.asset<Texture2D>(words("bump_slopes", static_cast<int>(s), static_cast<int>(t)), slopes);
  d.map = map.get();
  return d;
}

}  // namespace halfspace::inline HS_LANES_NAMESPACE
