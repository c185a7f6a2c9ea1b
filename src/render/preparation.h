// SPDX-License-Identifier: Apache-2.0
//
// The implementation of SceneAssets::prepare, in the files prepare_*.cpp. This header is private to these files and
// prepared_scene.cpp.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "halfspace/model/pose.h"
#include "halfspace/render/detail_maps.h"
#include "halfspace/render/model_asset.h"
#include "halfspace/render/model_materials.h"
#include "halfspace/render/prepared_scene.h"
#include "halfspace/render/scene_background.h"
#include "halfspace/render/scene_environments.h"
#include "halfspace/render/scene_lights.h"
#include "halfspace/render/scene_maps.h"
#include "halfspace/render/scene_meshes.h"
#include "halfspace/render/scene_places.h"
#include "halfspace/render/scene_surfaces.h"
#include "halfspace/render/shadow/shadow_renderer.h"
#include "halfspace/render/surface_draw.h"
#include "halfspace/render/used_assets.h"
#include "halfspace/render/view.h"

namespace halfspace::inline HS_LANES_NAMESPACE {

// Returns the cache key of a model file.
inline std::string model_recipe(const std::filesystem::path& file, bool allow_outside) {
  return recipe("model", file.string(), allow_outside ? "with outside files" : "");
}

// Reports the warnings of the reader of a model file.
void warn_of(const std::filesystem::path& file, const Model& model, const Warnings& warnings);

class ScenePreparation {
 public:
  // Keeps references to all arguments.
  ScenePreparation(const SceneDescription& scene, int width, int height, const MinimumSizes& minimum, AssetCache& cache, Warnings& warnings,
                   const Workers& workers);
  PreparedScene prepare();

 private:
  // object: index in the scene's objects.
  void add_object(int object);
  // Renders the shadow maps, after all objects have been placed.
  void add_shadows();

  // prepare_model_files.cpp
  void add_model(int object, const std::string& path, const ObjectDescription& o);
  void add_part(int object, const ObjectDescription& o, const std::string& path, const std::shared_ptr<const ModelAsset>& model,
                const PosedMesh& part, const glm::dmat4& world);
  void add_replaced_part(int object, const ObjectDescription& o, const std::string& path, const SurfaceStreams& streams,
                         const std::shared_ptr<const Indices>& indices, const glm::dmat4& world);
  void add_shadow_catcher(const ObjectDescription& o, const MeshAsset& mesh, const std::shared_ptr<const Indices>& indices, int object);
  void add_blended();
  std::shared_ptr<const ModelAsset> model_asset(const ObjectDescription& o, const std::string& where);

  // prepare_spheres.cpp
  SphereImpostors sphere_impostors(bool receives_shadow) const;
  void draw_spheres(int object, const Particles& spheres, const glm::dvec3& color, const SceneShader& shader);
  void add_exact_spheres(int object, const std::string& path, const ObjectDescription& o);

  // prepare_particles.cpp
  // object: index for DrawSource::object.
  void add_particles(int object, const ParticlesDescription& p, const std::string& path);

  const SceneDescription& scene_;
  Warnings& warnings_;
  const Workers& workers_;
  View view_;
  std::vector<PreparedDraw> blended_;
  bool needs_light_ = false;  // whether a surface has been added that is black without light
  PreparedScene out_;
  UsedAssets used_;
  // These refer to the members above.
  SceneLights lights_;
  SceneMaps maps_;
  SceneEnvironments environments_;
  SceneSurfaces surfaces_;
  SceneMeshes meshes_;
  DetailMaps details_;
  ModelMaterials materials_;
};

}  // namespace halfspace::inline HS_LANES_NAMESPACE
