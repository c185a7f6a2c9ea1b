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

namespace {

// What the map spans from left to right on the object, and the radius of the ball that holds the object; units.
struct Extent {
  double map_width, radius;
};

Extent extent_of(const ObjectDescription& o) {
  const auto round = [](double radius) { return 2.0 * std::numbers::pi * radius; };
  switch (o.shape) {
    case Shape::uv_sphere:
    case Shape::icosphere: return {round(o.radius), o.radius};
    case Shape::plane: return {o.size, o.size * std::numbers::sqrt2 / 2.0};
    case Shape::cube: return {o.size, o.size * std::numbers::sqrt3 / 2.0};
    case Shape::torus: return {round(o.radius + o.tube), o.radius + o.tube};
    case Shape::cylinder:
    case Shape::cone: break;
  }
  return {round(o.radius), glm::length(glm::dvec2(o.radius, 0.5 * o.length))};
}

Image<float> unit_numbers(const Image<uint16_t>& codes) {
  Image<float> map(codes.width(), codes.height());
  std::ranges::transform(codes.texels(), map.data(), [](uint16_t code) { return static_cast<float>(code) / 65535.0f; });
  return map;
}

}  // namespace

// How many texels along u are worth having: where the object is nearest one spans two pixels.
int ScenePreparation::width_for(const ObjectDescription& o) const {
  const Extent extent = extent_of(o);
  double most_px = 0.0;
  for (const glm::dmat4& world : places_of(o)) {
    const double scale = std::max({glm::length(world[0]), glm::length(world[1]), glm::length(world[2])});
    const double distance = std::max(glm::distance(glm::dvec3(world[3]), view_.eye_ws) - extent.radius * scale, view_.near);
    const double height = camera().type == Projection::orthographic ? camera().height : 2.0 * view_.tan_y * distance;
    most_px = std::max(most_px, extent.map_width * scale / height * view_.height_px);
  }
  const auto is_this = [&](const auto& entry) { return &entry.second == &o; };
  const auto expected = assets_.widths_.find(std::ranges::find_if(scene_.objects, is_this)->first);
  int width = expected == assets_.widths_.end() ? 256 : expected->second;
  while (width < 4096 && 2 * width < most_px) width *= 2;
  return width;
}

MapUse ScenePreparation::use_of(const MapValue& map, const ObjectDescription& o) const {
  TextureDescription t;
  if (const auto* file = std::get_if<FilePath>(&map)) {
    t.file = *file;
    if (edges_of(o.shape) == MapEdges::sphere) t.wrap_t = Wrap::clamp;  // nothing lies beyond the poles
  } else {
    const std::string& name = std::get<TextureName>(map).name;
    t = std::ranges::find_if(scene_.textures, [&](const auto& entry) { return entry.first == name; })->second;
    if (t.source == TextureSource::file && t.file.path.empty())
      throw InputError("textures." + name + ".file: missing; expected an image file");
  }
  if (t.source == TextureSource::file) return {t, 0};
  if (t.width != 0) return {t, t.width};
  return {t, is_pattern(t.source) ? std::clamp(width_for(o) / o.tiles_u, kLeastPattern, kMostPattern) : width_for(o)};
}

std::shared_ptr<const MoonMaps> ScenePreparation::moon_maps(int width) {
  return asset<MoonMaps>(recipe("moon", width), [&] { return procedural_moon(width, assets_.workers_); });
}

std::shared_ptr<const Texture2D> ScenePreparation::color_texture(const MapUse& use, const std::string& path) {
  if (is_pattern(use.texture.source) && !is_pattern_height(use.texture.source)) return pattern_texture(use);
  switch (use.texture.source) {
    case TextureSource::file:
      return asset<Texture2D>(recipe("color", use.texture.file.path.string()), [&] {
        return Texture2D(read_for(path + ".color", [&] { return read_image(use.texture.file.path); }), TexelFormat::srgb8a8);
      });
    case TextureSource::earth_color:
      return asset<Texture2D>(recipe("earth_color", use.width), [&] {
        return Texture2D(procedural_earth(use.width, use.width / 2, assets_.workers_), TexelFormat::srgb8a8);
      });
    case TextureSource::moon_color:
      return asset<Texture2D>(recipe("moon_color", use.width),
                              [&] { return Texture2D(moon_maps(use.width)->color, TexelFormat::srgb8a8); });
    default: break;
  }
  throw InputError(path + ".color: is a map of heights; expected a map of colours");
}

// The map of heights, smoothed, as a function on the object's surface.
std::shared_ptr<const HeightField> ScenePreparation::height_field(const MapUse& use, const ObjectDescription& o, const std::string& path) {
  const std::string words = recipe("heights", use.texture.file.path.string(), use.width, o.height_smoothing,
                                   static_cast<int>(use.texture.source), static_cast<int>(edges_of(o.shape)));
  const auto field = [&](const Image<float>& map) { return HeightField(map, o.height_smoothing, assets_.workers_, edges_of(o.shape)); };
  if (is_pattern_height(use.texture.source))
    return asset<HeightField>(words, [&] { return field(unit_numbers(pattern_maps(use)->height)); });
  switch (use.texture.source) {
    case TextureSource::file:
      return asset<HeightField>(words, [&] {
        const Image<float> map = read_for(path + ".height", [&] { return read_gray(use.texture.file.path); });
        if (map.width() < 2)
          throw InputError(path + ".height: " + use.texture.file.path.string() + ": is one texel wide; expected a map of heights");
        return field(map);
      });
    case TextureSource::moon_height: return asset<HeightField>(words, [&] { return field(unit_numbers(moon_maps(use.width)->height)); });
    default: throw InputError(path + ".height: is a map of colours; expected a map of heights");
  }
}

}  // namespace halfspace
