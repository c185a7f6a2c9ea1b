// SPDX-License-Identifier: Apache-2.0
//
// The implementation of SceneAssets::prepare, with one file per topic: prepare_*.cpp. This header is private to these files and
// prepared_scene.cpp. Maps and environments have their own classes: scene_maps.h, scene_environments.h.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "halfspace/geometry/height_field.h"
#include "halfspace/geometry/mesh.h"
#include "halfspace/geometry/relief_detail.h"
#include "halfspace/model/pose.h"
#include "halfspace/render/model_asset.h"
#include "halfspace/render/prepared_scene.h"
#include "halfspace/render/scene_environments.h"
#include "halfspace/render/scene_maps.h"
#include "halfspace/render/shadow/shadow_views.h"
#include "halfspace/render/used_assets.h"
#include "halfspace/render/view.h"

namespace halfspace::inline HS_LANES_NAMESPACE {

// A mesh and its validated indices.
struct MeshAsset {
  explicit MeshAsset(Mesh m) : mesh(std::move(m)), indices(mesh.indices, mesh.positions.size()) {}
  Mesh mesh;
  Indices indices;
};

// The vertex streams of a mesh that surface shaders can read. Not owned.
struct SurfaceStreams {
  std::span<const glm::vec3> positions, normals;
  std::span<const glm::vec4> tangents;
  std::span<const glm::vec2> uvs;
};

// Returns the cache key of a model file.
inline std::string model_recipe(const std::filesystem::path& file, bool allow_outside) {
  return recipe("model", file.string(), allow_outside ? "with outside files" : "");
}

// Reports the warnings of the reader of a model file.
void warn_of(const std::filesystem::path& file, const Model& model, const Warnings& warnings);

/// Returns how a map continues beyond its edges on a shape.
MapEdges edges_of(Shape shape);

/// Returns the world-from-object transform of each copy of an object, which includes the placements of its ancestors.
std::vector<glm::dmat4> places_of(const SceneDescription& scene, const ObjectDescription& o);

/// Returns the camera that the scene selects.
const CameraDescription& camera_of(const SceneDescription& scene);

/// Returns the draw of a lit surface with the shader variant that has the minimum features it needs.
PreparedDraw surface_draw(const LitSurface& s, ShadingRate rate, NormalDetail detail, const SurfaceStreams& mesh,
                          const std::shared_ptr<const Indices>& indices);

class ScenePreparation {
 public:
  // Keeps references to all arguments.
  ScenePreparation(const SceneDescription& scene, int width, int height, const MinimumSizes& minimum, AssetCache& cache, Warnings& warnings,
                   const Workers& workers);
  PreparedScene prepare();
  FittedScene fit(const AllowedError& allowed);

 private:
  // The displacement of an object.
  struct Relief {
    std::shared_ptr<const HeightField> field;  // null: not displaced
    std::string recipe;
  };

  // prepare_surface.cpp
  void add_factor(LitSurface& s, MaterialFactor factor, const glm::dvec3& constant, const MapValue& map, const ObjectDescription& o,
                  const std::string& where);
  LitSurface surface_of(const ObjectDescription& o, const std::string& path);
  DetailMap normal_map(const ObjectDescription& o, const std::string& where);
  DetailMap bump_map(const ObjectDescription& o, const std::string& where);

  // prepare_meshes.cpp
  std::shared_ptr<const MeshAsset> mesh_of(const ObjectDescription& o, const Relief& relief);
  std::shared_ptr<const MeshAsset> sphere_of(const ObjectDescription& o, const Relief& relief);

  // prepare_objects.cpp
  // object: index in the scene's objects.
  void add_object(int object);
  Relief relief_of(const ObjectDescription& o, const std::string& path);
  DetailMap slopes_of(const Relief& relief, const ObjectDescription& o);
  NormalDetail add_detail(LitSurface& s, const ObjectDescription& o, const Relief& relief, const std::string& path);
  void place(PlacedSurface& s, glm::dmat4 world) const;

  // prepare_model_files.cpp
  void add_model(int object, const std::string& path, const ObjectDescription& o);
  void add_part(int object, const ObjectDescription& o, const std::string& path, const std::shared_ptr<const ModelAsset>& model,
                const PosedMesh& part, const glm::dmat4& world);
  void add_replaced_part(int object, const ObjectDescription& o, const std::string& path, const SurfaceStreams& streams,
                         const std::shared_ptr<const Indices>& indices, const glm::dmat4& world);
  void add_shadow_catcher(const ObjectDescription& o, const MeshAsset& mesh, const std::shared_ptr<const Indices>& indices, int object);
  void add_blended();
  std::shared_ptr<const ModelAsset> model_asset(const ObjectDescription& o, const std::string& where);

  // prepare_model_bumps.cpp
  void add_bumps(MetallicMaterial& surface, const ObjectDescription& o, const Model& model, int mesh, const ModelMaterial& material);

  // prepare_model_materials.cpp
  std::vector<std::pair<int, bool>> wanted_images(const ObjectDescription& o, const Model& model, const PosedModel& posed);
  void load_images(const ObjectDescription& o, const Model& model, const std::vector<std::pair<int, bool>>& list, bool lit);
  const Texture2D* model_texture(const std::filesystem::path& file, int image, bool color);
  bool is_soft_mask(const ObjectDescription& o, const Model& model, const ModelMaterial& m);
  MetallicMaterial metallic_material(const ObjectDescription& o, const Model& model, const ModelMaterial& m, bool has_uvs);

  // prepare_shadows.cpp: renders the shadow maps, after all objects have been placed
  void add_shadows();
  std::vector<LightView> shadow_views(const LightDescription& light, const ShadowSettings& settings, int size) const;
  int shadow_resolution(const LightDescription& light, const ShadowSettings& settings) const;

  // prepare_models.cpp
  ObjectDescription fitted(const ObjectDescription& authored, const std::string& path, double edge_px, std::optional<double> color,
                           std::vector<ModelChoice>& choices);
  std::shared_ptr<const ReliefDetail> relief_detail(const ObjectDescription& o, const std::string& path);

  // prepare_spheres.cpp
  SphereImpostors sphere_impostors(bool receives_shadow) const;
  void draw_spheres(int object, const Particles& spheres, const glm::dvec3& color, const SceneShader& shader);
  void add_exact_spheres(int object, const std::string& path, const ObjectDescription& o);

  // prepare_particles.cpp
  // object: index for DrawSource::object.
  void add_particles(int object, const ParticlesDescription& p, const std::string& path);
  std::shared_ptr<const Particles> particles(const ParticlesDescription& p, const std::string& path);  // null: none

  // prepare_background.cpp
  void add_background();
  StarSky star_sky(double density, double brightness) const;
  EnvironmentSky environment_sky();

  const SceneDescription& scene_;
  Warnings& warnings_;
  const Workers& workers_;
  View view_;
  std::span<Shadow> shadows_;  // parallel to out_.lights
  std::span<const Light> lights_;
  std::span<const Light> shadowless_lights_;  // used by objects that do not receive shadows
  glm::dvec3 ambient_;
  std::vector<PreparedDraw> blended_;
  bool needs_light_ = false;  // whether a surface has been added that is black without light
  PreparedScene out_;
  UsedAssets used_;
  // These refer to the members above.
  SceneMaps maps_;
  SceneEnvironments environments_;
};

}  // namespace halfspace::inline HS_LANES_NAMESPACE
