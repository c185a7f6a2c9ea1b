// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "halfspace/render/frame/frame.h"
#include "view/overlay.h"

namespace halfspace {

namespace {

// The values that select the mip level of a draw's color map.
struct ColorMap {
  glm::vec2 size{0.0f};  // texels; 0 if there is no map
  int levels = 0;
  float anisotropy = 1.0f;
  glm::mat2 uv_transform{1.0f};
};

ColorMap map_of(const Texture2D* map, const Sampler& sampler, const glm::mat2& transform) {
  if (map == nullptr) return {};
  return {{map->width(), map->height()}, map->levels(), static_cast<float>(sampler.anisotropy), transform};
}

ColorMap color_map_of(const PreparedDraw& draw) {
  return std::visit(
      []<class S>(const S& shader) -> ColorMap {
        if constexpr (std::derived_from<S, LitSurface>) {
          return map_of(shader.factors[kColor].map, shader.factors[kColor].sampler, glm::mat2(1.0f));
        } else if constexpr (std::derived_from<S, MetallicMaterial>) {
          const MaterialMap& m = shader.maps[kBaseColorMap];
          return map_of(m.map, m.sampler, glm::mat2(m.uv_transform[0], m.uv_transform[1]));
        } else {
          return {};
        }
      },
      draw.shader);
}

// Returns the rounded mip level for the derivatives of the texel coordinates in x and y. The formula is that of
// shading/texture/footprint.h.
int level_of(const ColorMap& map, const glm::vec2& dx, const glm::vec2& dy) {
  const float a = glm::length(map.uv_transform * dx * map.size), b = glm::length(map.uv_transform * dy * map.size);
  const float longer = std::max(a, b), shorter = std::max(std::min(a, b), 1e-6f);
  const float probes = std::min(std::ceil(longer / shorter), map.anisotropy);
  const float lod = std::log2(std::max(longer / probes, 1e-6f));
  return std::clamp(static_cast<int>(std::lround(lod)), 0, map.levels - 1);
}

glm::u8vec4 level_color(int level) {
  static constexpr std::array<glm::u8vec3, 8> kColors{glm::u8vec3{220, 50, 47}, {230, 130, 30}, {220, 200, 40}, {90, 180, 60},
                                                      {40, 170, 170},           {50, 110, 220}, {130, 80, 200}, {200, 80, 170}};
  return {kColors[static_cast<std::size_t>(level) % kColors.size()], 255};
}

// Images of the values that identify the surface at each pixel.
struct SurfaceImages {
  Image<uint32_t> object, instance;
  Image<glm::vec2> uv;

  SurfaceImages(int width, int height) : object(width, height), instance(width, height), uv(width, height) {}

  bool same_surface(int x, int y, int x2, int y2) const {
    return object.at(x, y) == object.at(x2, y2) && instance.at(x, y) == instance.at(x2, y2);
  }
  // Returns the change of uv to a neighboring pixel, or nullopt if it belongs to a different surface or the change crosses the seam of a
  // texture.
  std::optional<glm::vec2> step(int x, int y, int x2, int y2) const {
    if (x2 >= uv.width() || y2 >= uv.height() || !same_surface(x, y, x2, y2)) return std::nullopt;
    const glm::vec2 change = uv.at(x2, y2) - uv.at(x, y);
    return std::max(std::fabs(change.x), std::fabs(change.y)) < 0.5f ? std::optional(change) : std::nullopt;
  }
};

using SurfaceId = std::pair<uint32_t, uint32_t>;

std::map<SurfaceId, ColorMap> color_maps_of(const PreparedScene& scene) {
  std::map<SurfaceId, ColorMap> maps;
  for (const PreparedDraw& draw : scene.draws) {
    if (draw.source.object >= 0)
      maps.try_emplace({static_cast<uint32_t>(draw.source.object), static_cast<uint32_t>(draw.source.instance)}, color_map_of(draw));
  }
  return maps;
}

}  // namespace

std::string draw_mip_level_overlay(OverlayFrame frame) {
  const int width = frame.picture.width(), height = frame.picture.height();
  SurfaceImages images(width, height);
  render_frame(frame.scene, {.uv = &images.uv, .object = &images.object, .instance = &images.instance}, frame.workers);
  const std::map<SurfaceId, ColorMap> maps = color_maps_of(frame.scene);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const auto found = maps.find({images.object.at(x, y), images.instance.at(x, y)});
      const std::optional<glm::vec2> dx = images.step(x, y, x + 1, y), dy = images.step(x, y, x, y + 1);
      glm::u8vec4& pixel = frame.picture.at(x, y);
      const int light = (pixel.x + 2 * pixel.y + pixel.z) / 4;
      pixel = glm::u8vec4(glm::u8vec3(static_cast<uint8_t>(light / 3)), 255);
      if (found == maps.end() || found->second.levels == 0 || !dx || !dy) continue;
      const glm::ivec3 color(level_color(level_of(found->second, *dx, *dy)));
      pixel = glm::u8vec4(glm::u8vec3(color * (128 + light) / 383), 255);
    }
  }
  return "mip level of the color map: red 0, orange 1, yellow 2, green 3, cyan 4, blue 5, purple 6, pink 7; gray: no color map";
}

std::string draw_normals_overlay(OverlayFrame frame) {
  const int width = frame.picture.width(), height = frame.picture.height();
  Image<glm::vec3> normals(width, height);
  render_frame(frame.scene, {.normal = &normals}, frame.workers);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const glm::vec3& n = normals.at(x, y);
      if (n != glm::vec3(0.0f)) frame.picture.at(x, y) = glm::u8vec4(glm::u8vec3(n * 127.5f + 128.0f), 255);
    }
  }
  return "normals in world space: red x, green y, blue z";
}

}  // namespace halfspace
