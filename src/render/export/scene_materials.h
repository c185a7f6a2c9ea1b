// SPDX-License-Identifier: Apache-2.0
//
// Materials of exported scenes.
#pragma once

#include <map>
#include <string>
#include <utility>

#include "halfspace/model/model.h"
#include "halfspace/render/assets/texture_image.h"
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
/// Adds a warning if an image has numbers outside of [0, 1], which encode_png clamps.
void warn_if_clamped(Model& model, const TextureImage& image);

/// Converts materials and adds them to a model, with their textures.
class SceneMaterials {
 public:
  /// The model must outlive this object.
  explicit SceneMaterials(Model& model) : model_(model) {}

  /// Adds the material of a draw, which must have a surface. Returns its index in the model.
  int add(const std::string& name, const DrawnMesh& drawn);

 private:
  TextureUse texture_use(const Texture2D* texture, const Sampler& sampler, TextureRole role, bool flips_green);

  Model& model_;
  std::map<std::pair<const Texture2D*, bool>, int> images_;  // image index by texture and whether green is flipped
};

}  // namespace halfspace::HS_LANES
