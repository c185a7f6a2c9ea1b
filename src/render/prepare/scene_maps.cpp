// SPDX-License-Identifier: Apache-2.0
//
// Maps of objects. The patterns are in scene_patterns.cpp.
#include "halfspace/render/prepare/scene_maps.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "halfspace/core/check.h"
#include "halfspace/geometry/displaced_sphere.h"
#include "halfspace/image/image_io.h"
#include "halfspace/procedural/earth.h"
#include "halfspace/render/prepare/scene_places.h"
#include "halfspace/render/prepare/shape_mesh.h"
#include "halfspace/render/shadow/shadow_views.h"
#include "halfspace/scene/shapes.h"

namespace halfspace::HS_LANES {

Sampler make_sampler(const TextureDescription& t) {
  Sampler s;
  s.mag = reads_nearest_texel(t.filter) ? Filter::nearest : Filter::bilinear;
  s.min = t.filter;
  s.wrap_s = t.wrap_s;
  s.wrap_t = t.wrap_t;
  s.anisotropy = t.anisotropy;
  return s;
}

namespace {

Image<float> unit_numbers(const Image<uint16_t>& codes) {
  Image<float> map(codes.width(), codes.height());
  std::ranges::transform(codes.texels(), map.data(), [](uint16_t code) { return static_cast<float>(code) / 65535.0f; });
  return map;
}

}  // namespace

double relief_height(const ObjectDescription& o) {
  return is_map(o.height) ? std::fabs(o.height_scale) * std::max(o.height_zero, 1.0 - o.height_zero) : 0.0;
}

namespace {

// Returns the distance from the eye to the bounding sphere of the object, in world units.
double distance_of_ball(const ObjectDescription& o, const glm::dmat4& world_from_object, double scale, const View& view) {
  return glm::distance(glm::dvec3(world_from_object[3]), view.eye_ws) - kind_of(o).extent(o).radius * scale;
}

// Returns the depth of the nearest visible part of a plane, in world units, or infinity if no part is visible. The bounding sphere of a
// plane cannot be used here, because it often contains the eye.
double depth_of_plane(const ObjectDescription& o, const glm::dmat4& world_from_object, const View& view) {
  const glm::dvec3 corner(0.5 * o.size, relief_height(o), 0.5 * o.size);
  double nearest = std::numeric_limits<double>::infinity();
  const glm::dmat4 object_from_world = glm::inverse(world_from_object);
  std::array<glm::dvec3, 8> frustum = frustum_corners(view);
  for (glm::dvec3& p : frustum) p = glm::dvec3(object_from_world * glm::dvec4(p, 1.0));
  for (const glm::dvec3& p : common_corners(frustum, {-corner, corner})) {
    nearest = std::min(nearest, glm::dot(glm::dvec3(world_from_object * glm::dvec4(p, 1.0)) - view.eye_ws, view.forward_ws));
  }
  return nearest;
}

}  // namespace

// Width of generated maps on models. The size of a map on their surface is unknown.
constexpr int kModelMapWidth = 1024;

// Chosen so that at the point nearest to the eye, a texel spans at most two pixels, unless that would require a width above 4096.
int SceneMaps::width_for(const ObjectDescription& o) const {
  if (o.shape == Shape::file) return kModelMapWidth;
  // Displaced parts outside the view can cast shadows into it.
  const bool shades = is_map(o.height) && o.casts_shadow && scene_.shadow.method != ShadowMethod::none;
  const CameraDescription& camera = camera_of(scene_);
  double max_px = 0.0;
  for (const glm::dmat4& world : places_of(scene_, o)) {
    const double scale = std::max({glm::length(world[0]), glm::length(world[1]), glm::length(world[2])});
    const double nearest = o.shape == Shape::plane && !shades ? depth_of_plane(o, world, view_) : distance_of_ball(o, world, scale, view_);
    const double distance = std::max(nearest, view_.near);
    const double height = camera.type == Projection::orthographic ? camera.height : 2.0 * view_.tan_y * distance;
    max_px = std::max(max_px, kind_of(o).extent(o).map_width * scale / height * view_.height_px);
  }
  const auto is_this = [&](const auto& entry) { return &entry.second == &o; };
  const auto expected = min_widths_.find(std::ranges::find_if(scene_.objects, is_this)->first);
  int width = expected == min_widths_.end() ? 256 : expected->second;
  while (width < 4096 && 2 * width < max_px) width *= 2;
  return width;
}

const TextureDescription& SceneMaps::texture_named(const std::string& name) const {
  const TextureDescription& t = std::ranges::find_if(scene_.textures, [&](const auto& entry) { return entry.first == name; })->second;
  if (t.source == TextureSource::file && t.file.path.empty())
    throw InputError("textures." + name + ".file: missing; expected an image file");
  return t;
}

MapUse SceneMaps::use_of(const MapValue& map, const ObjectDescription& o) const {
  TextureDescription t;
  if (const auto* file = std::get_if<FilePath>(&map)) {
    t.file = *file;
    if (edges_of(o.shape) == MapEdges::sphere) t.wrap_t = Wrap::clamp;  // nothing is beyond the poles
  } else {
    t = texture_named(std::get<TextureName>(map).name);
  }
  if (t.source == TextureSource::file) return {t, 0};
  if (t.width != 0) return {t, t.width};
  return {t, is_pattern(t.source) ? std::clamp(width_for(o) / o.tiles_u, kMinPattern, kMaxPattern) : width_for(o)};
}

std::shared_ptr<const MoonMaps> SceneMaps::moon_maps(int width) {
  return used_.asset<MoonMaps>(recipe("moon", width), [&] { return procedural_moon(width, workers_); });
}

std::shared_ptr<const EarthMaps> SceneMaps::earth_maps(int width) {
  return used_.asset<EarthMaps>(recipe("earth", width), [&] { return procedural_earth_maps(width, width / 2, workers_); });
}

bool SceneMaps::has_texture(TextureSource source) const {
  return std::any_of(scene_.textures.begin(), scene_.textures.end(), [&](const auto& named) { return named.second.source == source; });
}

namespace {

Texture2D file_texture(const std::filesystem::path& file, TextureRole role, const Workers& workers, const std::string& where) {
  return read_for(where, [&] { return texture_of(texels_of(file, role), role, file.string(), &workers); });
}

[[noreturn]] void fail_not(const std::string& where, const TextureDescription& t, const char* expected) {
  const bool heights = t.source == TextureSource::earth_height || t.source == TextureSource::moon_height || is_pattern_height(t.source);
  const char* is = t.source == TextureSource::earth_normal ? "a normal map" : heights ? "a height map" : "a color map";
  throw InputError(where + ": is " + is + "; expected " + expected);
}

}  // namespace

std::shared_ptr<const Texture2D> SceneMaps::color_texture(const MapUse& use, const std::string& where) {
  if (is_pattern(use.texture.source) && !is_pattern_height(use.texture.source)) return pattern_texture(use);
  switch (use.texture.source) {
    case TextureSource::file:
      return used_.asset<Texture2D>(recipe("color", use.texture.file.path.string()),
                                    [&] { return file_texture(use.texture.file.path, TextureRole::colors, workers_, where); });
    case TextureSource::earth_color:
      return used_.asset<Texture2D>(recipe("earth_color", use.width), [&] {
        const bool has_relief = has_texture(TextureSource::earth_height) || has_texture(TextureSource::earth_normal);
        return Texture2D(has_relief ? earth_maps(use.width)->color : procedural_earth(use.width, use.width / 2, workers_),
                         TexelFormat::srgb8a8, &workers_);
      });
    case TextureSource::moon_color:
      return used_.asset<Texture2D>(recipe("moon_color", use.width),
                                    [&] { return Texture2D(moon_maps(use.width)->color, TexelFormat::srgb8a8, &workers_); });
    default: fail_not(where, use.texture, "a color map");
  }
}

// Textures that are not decoded from sRGB.
std::shared_ptr<const Texture2D> SceneMaps::data_texture(const MapUse& use, TextureRole role, const std::string& where) {
  switch (use.texture.source) {
    case TextureSource::file:
      return used_.asset<Texture2D>(recipe("data", use.texture.file.path.string(), static_cast<int>(role)),
                                    [&] { return file_texture(use.texture.file.path, role, workers_, where); });
    case TextureSource::earth_normal:
      return used_.asset<Texture2D>(recipe("earth_normal", use.width), [&] {
        MapUse relief = use;
        relief.texture.source = TextureSource::earth_height;
        return Texture2D(procedural_earth_normals(*heights(relief, where), workers_), TexelFormat::rgba16f, &workers_);
      });
    default: fail_not(where, use.texture, "a data map");
  }
}

std::shared_ptr<const Image<float>> SceneMaps::heights(const MapUse& use, const std::string& where) {
  if (is_pattern_height(use.texture.source)) {
    return used_.asset<Image<float>>(recipe("pattern heights", static_cast<int>(use.texture.source), use.width),
                                     [&] { return unit_numbers(pattern_maps(use)->height); });
  }
  switch (use.texture.source) {
    case TextureSource::file:
      return used_.asset<Image<float>>(recipe("numbers", use.texture.file.path.string()),
                                       [&] { return read_for(where, [&] { return read_gray(use.texture.file.path); }); });
    case TextureSource::earth_height:
      return used_.asset<Image<float>>(recipe("earth_height", use.width), [&] {
        if (has_texture(TextureSource::earth_color)) return earth_maps(use.width)->height;
        return procedural_earth_heights(use.width, use.width / 2, workers_);
      });
    case TextureSource::moon_height:
      return used_.asset<Image<float>>(recipe("moon_height", use.width), [&] { return unit_numbers(moon_maps(use.width)->height); });
    default: fail_not(where, use.texture, "a height map");
  }
}

// Returns the smoothed height map as a function on the object's surface.
std::shared_ptr<const HeightField> SceneMaps::height_field(const MapUse& use, const ObjectDescription& o, const std::string& where) {
  const std::shared_ptr<const Image<float>> map = heights(use, where);
  if (map->width() < 2) throw InputError(where + ": " + use.texture.file.path.string() + ": is one texel wide; expected a height map");
  const MapEdges edges = edges_of(o.shape);
  return used_.asset<HeightField>(recipe("field", static_cast<int>(use.texture.source), use.texture.file.path.string(), use.width,
                                         o.height_smoothing, static_cast<int>(edges)),
                                  [&] { return HeightField(*map, o.height_smoothing, workers_, edges); });
}

std::shared_ptr<const ReliefDetail> SceneMaps::relief_detail(const ObjectDescription& o, const std::string& where) {
  if (!is_map(o.height)) return nullptr;
  const MapUse use = use_of(o.height, o);
  return used_.asset<ReliefDetail>(
      recipe("detail", static_cast<int>(use.texture.source), use.texture.file.path.string(), use.width, o.height_smoothing),
      [&] { return ReliefDetail(*heights(use, where), o.height_smoothing, workers_); });
}

}  // namespace halfspace::HS_LANES
