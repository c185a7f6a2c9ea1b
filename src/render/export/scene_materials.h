// SPDX-License-Identifier: Apache-2.0
//
// Materials of exported scenes.
#pragma once

#include <map>
#include <string>
#include <utility>

#include "halfspace/image/image_io.h"
#include "halfspace/model/model.h"
#include "halfspace/render/prepared_scene.h"

namespace halfspace::HS_LANES {

/// The vertex streams of a prepared draw that a model stores.
struct DrawnMesh {
  const LitSurface* surface = nullptr;  ///< null: not a mesh of the scene file
  VertexStream tangents{}, uvs{};       ///< without data if the draw does not have them
  bool flat = false, unlit = false, has_normal_map = false, has_other_detail = false;
};

/// Adds a warning to the model unless the model already has it.
void warn_once(Model& model, const std::string& text);

/// Converts materials and adds them to a model, with their textures.
class SceneMaterials {
 public:
  /// The model must outlive this object.
  explicit SceneMaterials(Model& model) : model_(model) {}

  /// Adds the material of a draw, which must have a surface. Returns its index in the model.
  int add(const std::string& name, const DrawnMesh& drawn);

 private:
  TextureUse texture_use(const Texture2D* texture, const Sampler& sampler, ImageUse image_use, bool flip_green);

  Model& model_;
  std::map<std::pair<const Texture2D*, bool>, int> images_;  // image index by texture and whether green is flipped
};

}  // namespace halfspace::HS_LANES
