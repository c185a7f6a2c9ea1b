// SPDX-License-Identifier: Apache-2.0
//
// Maps of a scene's objects: read from files, or generated as fine as the view needs.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/check.h"
#include "scene/displaced_sphere.h"
#include "scene/image_io.h"
#include "scene/preparation.h"
#include "scene/procedural_earth.h"

namespace halfspace {

Sampler make_sampler(const TextureDescription& t) {
  Sampler s;
  s.mag = t.filter == Filter::nearest ? Filter::nearest : Filter::bilinear;
  s.min = t.filter;
  s.wrap_s = t.wrap_s;
  s.wrap_t = t.wrap_t;
  s.anisotropy = t.anisotropy;
  return s;
}

// How many texels round the object are worth having: at its middle one spans two pixels.
int ScenePreparation::width_for(const ObjectDescription& o) const {
  double circumference_px = 0.0;
  for (const glm::dmat4& world : places_of(o)) {
    const double scale = std::max({glm::length(world[0]), glm::length(world[1]), glm::length(world[2])});
    const double radius = (o.shape == Shape::uv_sphere ? o.radius : o.size) * scale;
    const double distance = std::max(glm::distance(glm::dvec3(world[3]), view_.eye_ws) - radius, view_.near);
    const double height = camera().type == Projection::orthographic ? camera().height : 2.0 * view_.tan_y * distance;
    circumference_px = std::max(circumference_px, 2.0 * std::numbers::pi * radius / height * view_.height_px);
  }
  int width = 256;
  while (width < 4096 && 2 * width < circumference_px) width *= 2;
  return width;
}

MapUse ScenePreparation::use_of(const MapValue& map, const ObjectDescription& o) const {
  TextureDescription t;
  if (const auto* file = std::get_if<FilePath>(&map)) {
    t.file = *file;
    if (o.shape == Shape::uv_sphere) t.wrap_t = Wrap::clamp;  // nothing lies beyond the poles
  } else {
    const std::string& name = std::get<TextureName>(map).name;
    t = std::ranges::find_if(scene_.textures, [&](const auto& entry) { return entry.first == name; })->second;
    if (t.source == TextureSource::file && t.file.path.empty())
      throw InputError("textures." + name + ".file: missing; expected an image file");
  }
  if (t.source == TextureSource::file) return {t, 0};
  return {t, t.width != 0 ? t.width : width_for(o)};
}

std::shared_ptr<const MoonMaps> ScenePreparation::moon_maps(int width) {
  return asset<MoonMaps>(recipe("moon", width), [&] { return procedural_moon(width, assets_.workers_); });
}

namespace {

[[noreturn]] void fail_not(const std::string& where, const TextureDescription& t, const char* expected) {
  const char* is = t.source == TextureSource::earth_normal                                           ? "a normal map"
                   : t.source == TextureSource::earth_color || t.source == TextureSource::moon_color ? "a map of colours"
                                                                                                     : "a map of heights";
  throw InputError(where + ": is " + is + "; expected " + expected);
}

Image<float> unit_numbers(const Image<uint16_t>& codes) {
  Image<float> map(codes.width(), codes.height());
  std::ranges::transform(codes.texels(), map.data(), [](uint16_t code) { return static_cast<float>(code) / 65535.0f; });
  return map;
}

// Normals of the sphere of radius 1 that the heights raise by kEarthRelief, coded for a normal map.
constexpr double kEarthRelief = 0.02;

Image<glm::vec4> normals_of(const HeightField& field, int width, const Workers& workers) {
  Image<glm::vec4> map = slope_map(field, width, width / 2, 1.0, kEarthRelief, 0.0, workers);
  for (int y = 0; y < map.height(); ++y) {
    for (glm::vec4& t : map.row(y)) {
      const glm::vec3 n(-t.x, -t.y, t.z);
      t = glm::vec4(n / std::sqrt(n.x * n.x + n.y * n.y + n.z * n.z) * 0.5f + 0.5f, 1.0f);
    }
  }
  return map;
}

}  // namespace

std::shared_ptr<const Texture2D> ScenePreparation::color_texture(const MapUse& use, const std::string& where) {
  switch (use.texture.source) {
    case TextureSource::file:
      return asset<Texture2D>(recipe("color", use.texture.file.path.string()),
                              [&] { return Texture2D(read_image(use.texture.file.path), TexelFormat::srgb8a8); });
    case TextureSource::earth_color:
      return asset<Texture2D>(recipe("earth_color", use.width), [&] {
        return Texture2D(procedural_earth(use.width, use.width / 2, assets_.workers_), TexelFormat::srgb8a8);
      });
    case TextureSource::moon_color:
      return asset<Texture2D>(recipe("moon_color", use.width),
                              [&] { return Texture2D(moon_maps(use.width)->color, TexelFormat::srgb8a8); });
    default: fail_not(where, use.texture, "a map of colours");
  }
}

// Numbers as they stand in the file: normals, exponents.
std::shared_ptr<const Texture2D> ScenePreparation::data_texture(const MapUse& use, const std::string& where) {
  switch (use.texture.source) {
    case TextureSource::file:
      return asset<Texture2D>(recipe("data", use.texture.file.path.string()),
                              [&] { return Texture2D(read_image(use.texture.file.path), TexelFormat::rgba8); });
    case TextureSource::earth_normal:
      return asset<Texture2D>(recipe("earth_normal", use.width), [&] {
        MapUse relief = use;
        relief.texture.source = TextureSource::earth_height;
        const HeightField field(*heights(relief, where), 1.0, assets_.workers_);
        return Texture2D(normals_of(field, use.width, assets_.workers_), TexelFormat::rgba16f);
      });
    default: fail_not(where, use.texture, "a map of numbers");
  }
}

std::shared_ptr<const Image<float>> ScenePreparation::heights(const MapUse& use, const std::string& where) {
  switch (use.texture.source) {
    case TextureSource::file:
      return asset<Image<float>>(recipe("numbers", use.texture.file.path.string()), [&] { return read_gray(use.texture.file.path); });
    case TextureSource::earth_height:
      return asset<Image<float>>(recipe("earth_height", use.width),
                                 [&] { return procedural_earth_heights(use.width, use.width / 2, assets_.workers_); });
    case TextureSource::moon_height:
      return asset<Image<float>>(recipe("moon_height", use.width), [&] { return unit_numbers(moon_maps(use.width)->height); });
    default: fail_not(where, use.texture, "a map of heights");
  }
}

// The map of heights, smoothed, as a function on the sphere.
std::shared_ptr<const HeightField> ScenePreparation::height_field(const MapUse& use, double smoothing, const std::string& where) {
  const std::shared_ptr<const Image<float>> map = heights(use, where);
  if (map->width() < 2) throw InputError(use.texture.file.path.string() + ": is one texel wide; expected a map of heights round a sphere");
  return asset<HeightField>(recipe("field", static_cast<int>(use.texture.source), use.texture.file.path.string(), use.width, smoothing),
                            [&] { return HeightField(*map, smoothing, assets_.workers_); });
}

}  // namespace halfspace
