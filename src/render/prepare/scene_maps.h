// SPDX-License-Identifier: Apache-2.0
//
// The maps of a scene: colors, heights and other data. They are read from files, or generated at the resolution that the view needs.
#pragma once

#include <map>
#include <memory>
#include <string>

#include "halfspace/core/image.h"
#include "halfspace/geometry/height_field.h"
#include "halfspace/geometry/relief_detail.h"
#include "halfspace/procedural/earth.h"
#include "halfspace/procedural/moon.h"
#include "halfspace/procedural/patterns.h"
#include "halfspace/render/assets/texture_image.h"
#include "halfspace/render/assets/used_assets.h"
#include "halfspace/render/view.h"
#include "halfspace/scene/description.h"
#include "halfspace/shading/texture/texture.h"

namespace halfspace::HS_LANES {

// A texture as used by one object.
struct MapUse {
  TextureDescription texture;
  int width;  // width of a generated map, otherwise 0
};

/// Returns true if the source is the height map of a pattern.
bool is_pattern_height(TextureSource source);

/// Returns the sampler for a texture.
Sampler make_sampler(const TextureDescription& t);

/// Returns the maximum distance by which the height map displaces the shape, in object space.
double relief_height(const ObjectDescription& o);

class SceneMaps {
 public:
  // min_widths: minimum widths of generated maps, by object name. Keeps references to all arguments.
  SceneMaps(const SceneDescription& scene, const View& view, const std::map<std::string, int>& min_widths, UsedAssets& used,
            const Workers& workers)
      : scene_(scene), view_(view), min_widths_(min_widths), used_(used), workers_(workers) {}

  // Returns the width of a generated map, in texels along u, that the object needs.
  int width_for(const ObjectDescription& o) const;
  const TextureDescription& texture_named(const std::string& name) const;
  MapUse use_of(const MapValue& map, const ObjectDescription& o) const;

  // where: the path of the key, for error messages.
  std::shared_ptr<const Texture2D> color_texture(const MapUse& use, const std::string& where);
  std::shared_ptr<const Texture2D> data_texture(const MapUse& use, TextureRole role, const std::string& where);
  std::shared_ptr<const Image<float>> heights(const MapUse& use, const std::string& where);
  std::shared_ptr<const HeightField> height_field(const MapUse& use, const ObjectDescription& o, const std::string& where);
  // Returns what the height map of an object loses on coarser meshes, or null if there is no map.
  std::shared_ptr<const ReliefDetail> relief_detail(const ObjectDescription& o, const std::string& where);
  std::shared_ptr<const MoonMaps> moon_maps(int width);

 private:
  std::shared_ptr<const EarthMaps> earth_maps(int width);
  // Returns true if the scene has a texture with this source.
  bool has_texture(TextureSource source) const;

  // scene_patterns.cpp
  std::shared_ptr<const PatternMaps> pattern_maps(const MapUse& use);
  std::shared_ptr<const Texture2D> pattern_texture(const MapUse& use);

  const SceneDescription& scene_;
  const View& view_;
  const std::map<std::string, int>& min_widths_;
  UsedAssets& used_;
  const Workers& workers_;
};

}  // namespace halfspace::HS_LANES
