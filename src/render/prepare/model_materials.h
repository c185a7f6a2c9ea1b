// SPDX-License-Identifier: Apache-2.0
//
// Materials of model files: their images, and the uniforms of the shader.
#pragma once

#include <filesystem>

#include "halfspace/model/model.h"
#include "halfspace/model/pose/pose.h"
#include "halfspace/render/assets/texture_image.h"
#include "halfspace/render/assets/used_assets.h"
#include "halfspace/render/assets/warnings.h"
#include "halfspace/render/prepare/scene_environments.h"
#include "halfspace/render/prepare/scene_lights.h"
#include "halfspace/render/view.h"
#include "halfspace/shading/surface/metallic_surface.h"

namespace halfspace::HS_LANES {

// In all functions, `o` is an object of shape `file` that draws `model`.

// Returns whether light affects a material of a model that keeps its own.
inline bool is_lit(const ObjectDescription& o, const ModelMaterial& m) { return !m.unlit && o.surface.shading != ShadingRate::none; }

class ModelMaterials {
 public:
  // Keeps references to all arguments.
  ModelMaterials(const View& view, const SceneLights& lights, SceneEnvironments& environments, UsedAssets& used, Warnings& warnings,
                 const Workers& workers)
      : view_(view), lights_(lights), environments_(environments), used_(used), warnings_(warnings), workers_(workers) {}

  // Decodes the images of the materials of a posed model in parallel, unless they are already loaded. lit: whether the materials will need
  // the filtered environment.
  void load_images(const ObjectDescription& o, const Model& model, const PosedModel& posed, bool lit);
  // Returns the time that load_images has taken.
  double images_ms() const { return images_ms_; }
  // Returns the surface of a mesh with a material, without its transforms. Its images must have been loaded. mesh: index in the meshes of
  // the model.
  MetallicMaterial surface_of(const ObjectDescription& o, const Model& model, int mesh, const ModelMaterial& m, bool has_uvs);

 private:
  const Texture2D* model_texture(const std::filesystem::path& file, int image, TextureRole role);
  bool is_soft_mask(const ObjectDescription& o, const Model& model, const ModelMaterial& m);
  MetallicMaterial metallic_material(const ObjectDescription& o, const Model& model, const ModelMaterial& m, bool has_uvs);

  const View& view_;
  const SceneLights& lights_;
  SceneEnvironments& environments_;
  UsedAssets& used_;
  Warnings& warnings_;
  const Workers& workers_;
  double images_ms_ = 0.0;
};

}  // namespace halfspace::HS_LANES
