// SPDX-License-Identifier: Apache-2.0
//
// Maps of a scene's objects: read from files, or generated as fine as the view needs.
#include <algorithm>
#include <numbers>

#include "core/check.h"
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

const TextureDescription& ScenePreparation::texture_named(const std::string& name) const {
  const TextureDescription& t = std::ranges::find_if(scene_.textures, [&](const auto& entry) { return entry.first == name; })->second;
  if (t.source == TextureSource::file && t.file.path.empty())
    throw InputError("textures." + name + ".file: missing; expected an image file");
  return t;
}

MapUse ScenePreparation::use_of(const MapValue& map, const ObjectDescription& o) const {
  TextureDescription t;
  if (const auto* file = std::get_if<FilePath>(&map)) {
    t.file = *file;
    if (o.shape == Shape::uv_sphere) t.wrap_t = Wrap::clamp;  // nothing lies beyond the poles
  } else {
    t = texture_named(std::get<TextureName>(map).name);
  }
  if (t.source == TextureSource::file) return {t, 0};
  return {t, t.width != 0 ? t.width : width_for(o)};
}

std::shared_ptr<const MoonMaps> ScenePreparation::moon_maps(int width) {
  return asset<MoonMaps>(recipe("moon", width), [&] { return procedural_moon(width, assets_.workers_); });
}

std::shared_ptr<const Texture2D> ScenePreparation::color_texture(const MapUse& use, const std::string& path) {
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
    case TextureSource::moon_height: break;
  }
  throw InputError(path + ".color: moon_height is a map of heights; expected a map of colours");
}

// The map of heights, smoothed, as a function on the sphere.
std::shared_ptr<const HeightField> ScenePreparation::height_field(const MapUse& use, const ObjectDescription& o, const std::string& path) {
  const std::string words = recipe("heights", use.texture.file.path.string(), use.width, o.height_smoothing);
  switch (use.texture.source) {
    case TextureSource::file:
      return asset<HeightField>(words, [&] {
        const Image<float> map = read_gray(use.texture.file.path);
        if (map.width() < 2)
          throw InputError(use.texture.file.path.string() + ": is one texel wide; expected a map of heights round a sphere");
        return HeightField(map, o.height_smoothing, assets_.workers_);
      });
    case TextureSource::moon_height:
      return asset<HeightField>(words, [&] {
        const Image<uint16_t>& codes = moon_maps(use.width)->height;
        Image<float> map(codes.width(), codes.height());
        std::ranges::transform(codes.texels(), map.data(), [](uint16_t code) { return static_cast<float>(code) / 65535.0f; });
        return HeightField(map, o.height_smoothing, assets_.workers_);
      });
    default: throw InputError(path + ".height: is a map of colours; expected a map of heights");
  }
}

}  // namespace halfspace
