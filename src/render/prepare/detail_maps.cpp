// SPDX-License-Identifier: Apache-2.0
#include "halfspace/render/prepare/detail_maps.h"

#include <algorithm>
#include <bit>

#include "halfspace/core/check.h"
#include "halfspace/geometry/displaced_sphere.h"
#include "halfspace/geometry/height_slopes.h"

namespace halfspace::HS_LANES {

// Returns the slopes of a displaced sphere for per-pixel normals. The map is null if the mesh has the final normals.
DetailMap DetailMaps::slopes_of(const Relief& relief, const ObjectDescription& o) {
  DetailMap d;
  if (relief.field == nullptr || o.shape != Shape::uv_sphere || o.normals != NormalSource::pixel) return d;
  const int width = std::min(maps_.width_for(o), relief.field->width());
  const auto map = used_.asset<Texture2D>(recipe("slopes", relief.recipe, width, o.radius), [&] {
    const HeightField filtered = relief.field->filtered(width, workers_);
    return Texture2D(slope_map(filtered, width, std::max(1, width / 2), o.radius, o.height_scale, o.height_zero, workers_),
                     TexelFormat::rgba16f, &workers_);
  });
  d.map = map.get();
  const int texels = o.mesh_error > 0.0 ? 1 : std::max(1, width / o.longitudes);  // per triangle; adaptive triangles show the finest slopes
  d.mesh_level = static_cast<uint8_t>(std::bit_width(static_cast<unsigned>(texels)) - 1);
  d.sampler = make_sampler(maps_.use_of(o.height, o).texture);
  d.sampler.wrap_t = Wrap::clamp;
  return d;
}

DetailMap DetailMaps::normal_map(const ObjectDescription& o, const std::string& where) {
  const MapUse use = maps_.use_of(o.surface.normal_map, o);
  DetailMap d;
  d.map = maps_.data_texture(use, TextureRole::normals, where).get();
  d.sampler = make_sampler(use.texture);
  d.strength = static_cast<float>(o.surface.normal_strength);
  d.flip_green = o.surface.normal_flip_green;
  return d;
}

DetailMap DetailMaps::bump_map(const ObjectDescription& o, const std::string& where) {
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

NormalDetail DetailMaps::add_detail(LitSurface& s, const ObjectDescription& o, const Relief& relief, const std::string& path) {
  const SurfaceDescription& d = o.surface;
  if (d.shading != ShadingRate::phong) return NormalDetail::none;
  const bool automatic = d.normal == DetailChoice::automatic;
  if (d.normal == DetailChoice::map || (automatic && is_map(d.normal_map))) {
    if (!is_map(d.normal_map))
      throw InputError(path + ".normal: is map, but there is no normal_map; expected a texture or an image file as normal_map");
    s.detail = normal_map(o, path + ".normal_map");
    return NormalDetail::map;
  }
  if (d.normal == DetailChoice::bump || (automatic && is_map(d.bump_map))) {
    if (!is_map(d.bump_map))
      throw InputError(path + ".normal: is bump, but there is no bump_map; expected a texture or an image file as bump_map");
    s.detail = bump_map(o, path + ".bump_map");
    return NormalDetail::bump;
  }
  s.detail = slopes_of(relief, o);
  return s.detail.map != nullptr ? NormalDetail::slopes : NormalDetail::none;
}

}  // namespace halfspace::HS_LANES
