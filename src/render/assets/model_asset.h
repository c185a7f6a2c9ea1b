// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "halfspace/model/model.h"
#include "halfspace/model/pose/pose.h"
#include "halfspace/raster/pass.h"
#include "halfspace/scene/description.h"

namespace halfspace::HS_LANES {

/// A model file with validated indices and with tangents where its materials need them. Movable.
struct ModelAsset {
  explicit ModelAsset(Model m, bool outside_allowed = false);

  Model model;
  bool allow_outside;            ///< whether files outside of the folder of the model were allowed when it was read
  std::vector<Indices> indices;  ///< one per mesh of the model; refers to the indices of the mesh
};

/// What the user calls the choices of a pose, and the file, in messages.
struct PosePlaces {
  std::string scene, animation, variant;
  std::string file = "the file";
};

/// The places of an object of a scene: `path`.model_scene, `path`.model_animation and `path`.model_variant.
PosePlaces pose_places(const std::string& path);

/// Returns the pose that an object of shape `file` specifies. Scenes, animations and variants are selected by name or, if none has that
/// name, by index. If the file has no such item, throws an InputError that begins with its place.
PoseOptions pose_options(const Model& model, const ObjectDescription& o, const PosePlaces& places);

}  // namespace halfspace::HS_LANES
