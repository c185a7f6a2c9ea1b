// SPDX-License-Identifier: Apache-2.0
//
// Textures of procedural patterns, generated at the resolution that the view needs.
#include "halfspace/render/prepare/scene_maps.h"

namespace halfspace::HS_LANES {

namespace {

// Returns the pattern that the source belongs to.
Pattern pattern_of(TextureSource source) {
  switch (source) {
    case TextureSource::checkerboard: return Pattern::checkerboard;
    case TextureSource::grass_color: return Pattern::grass;
    case TextureSource::bark_color:
    case TextureSource::bark_height: return Pattern::bark;
    case TextureSource::bricks_color:
    case TextureSource::bricks_height: return Pattern::bricks;
    case TextureSource::facade_color:
    case TextureSource::facade_specular:
    case TextureSource::facade_emissive: return Pattern::facade;
    case TextureSource::rock_color:
    case TextureSource::rock_height: return Pattern::rock;
    default: return Pattern::hills;
  }
}

}  // namespace

bool is_pattern_height(TextureSource source) {
  return source == TextureSource::bark_height || source == TextureSource::bricks_height || source == TextureSource::rock_height ||
         source == TextureSource::hills_height;
}

std::shared_ptr<const PatternMaps> SceneMaps::pattern_maps(const MapUse& use) {
  const Pattern pattern = pattern_of(use.texture.source);
  return used_.asset<PatternMaps>(recipe("pattern", static_cast<int>(pattern), use.width),
                                  [&] { return procedural_pattern(pattern, use.width, workers_); });
}

// Color maps are decoded from sRGB; factors are not.
std::shared_ptr<const Texture2D> SceneMaps::pattern_texture(const MapUse& use) {
  const TextureSource source = use.texture.source;
  return used_.asset<Texture2D>(recipe("pattern texture", static_cast<int>(source), use.width), [&] {
    const std::shared_ptr<const PatternMaps> maps = pattern_maps(use);
    if (source == TextureSource::facade_specular) return Texture2D(maps->specular, TexelFormat::rgba8);
    return Texture2D(source == TextureSource::facade_emissive ? maps->emissive : maps->color, TexelFormat::srgb8a8);
  });
}

}  // namespace halfspace::HS_LANES
