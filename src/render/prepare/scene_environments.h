// SPDX-License-Identifier: Apache-2.0
//
// The environments of a scene: those shown as the background, and those that light and are reflected by surfaces.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "halfspace/render/assets/minimum_sizes.h"
#include "halfspace/render/prepare/scene_maps.h"
#include "halfspace/shading/environment/environment_light.h"

namespace halfspace::HS_LANES {

class SceneEnvironments {
 public:
  // Keeps references to all arguments except the sizes.
  SceneEnvironments(const SceneDescription& scene, const View& view, const EnvironmentSizes& minimum, SceneMaps& maps, UsedAssets& used,
                    const Workers& workers)
      : scene_(scene), view_(view), minimum_(minimum), maps_(maps), used_(used), workers_(workers) {}

  // Returns the sizes that the view needs, at least the minimum.
  EnvironmentSizes sizes() const { return {panorama_width(), face_size()}; }

  // Returns the first environment if the name is empty.
  const std::pair<std::string, EnvironmentDescription>& named(const std::string& name) const;
  // Prepares the two environments of the background, or only one if the other is not visible.
  EnvironmentBlend background();
  // Returns the environment that surfaces reflect, or null if reflections are off.
  const EnvironmentBlend* reflected_environment();
  // Returns the filtered environment that lights metallic-roughness surfaces, or null if reflections are off.
  const EnvironmentLightBlend* light();
  // Returns the mean light of the environment that `reflections.environment` names, over all directions. 0 if none is named or reflections
  // are off.
  glm::dvec3 mean_light();

 private:
  // How to make the map of an environment.
  struct MapSource {
    std::string recipe;
    std::function<EnvironmentMap()> make;
    bool is_shared = false;  // by all scenes of the process
  };
  // An environment without its map.
  struct Placed {
    MapSource source;
    glm::mat3 map_from_world;
    float brightness;
  };
  struct PlacedBlend {
    std::optional<Placed> first, second;
    float weight = 0.0f;
  };

  PlacedBlend placed_background();
  PlacedBlend placed_reflection();
  Placed placed(const std::string& name, const EnvironmentDescription& e);
  MapSource source_of(const std::string& path, const EnvironmentDescription& e);
  MapSource panorama(const std::string& path, const EnvironmentDescription& e);
  MapSource generated_sky(const EnvironmentDescription& e) const;
  const EnvironmentMap* map_of(const MapSource& source);
  const FilteredEnvironment* filtered(const MapSource& source);
  EnvironmentBlend blend_of(const PlacedBlend& placed);
  int panorama_width() const;
  int face_size() const;

  const SceneDescription& scene_;
  const View& view_;
  EnvironmentSizes minimum_;
  SceneMaps& maps_;
  UsedAssets& used_;
  const Workers& workers_;
  std::shared_ptr<const EnvironmentBlend> reflected_environment_;  // null: not needed yet
  std::shared_ptr<const EnvironmentLightBlend> light_;             // null: not needed yet
};

}  // namespace halfspace::HS_LANES
