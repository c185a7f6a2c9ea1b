// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "halfspace/model/model.h"
#include "halfspace/model/pose.h"
#include "halfspace/raster/pass.h"
#include "halfspace/scene/description.h"

namespace halfspace::inline HS_LANES_NAMESPACE {

/// A model file with validated indices and with tangents where its materials need them. Movable.
struct ModelAsset {
  explicit ModelAsset(Model m, bool outside_allowed = false);

  Model model;
  bool allow_outside;            ///< whether files outside of the folder of the model were allowed when it was read
  std::vector<Indices> indices;  ///< one per mesh of the model; refers to the indices of the mesh
};

/// Returns the pose that an object of shape `file` specifies. Scenes, animations and variants are selected by name or, if none has that
/// name, by index. If the file has no such item, throws an InputError that begins with `path`.
PoseOptions pose_options(const Model& model, const ObjectDescription& o, const std::string& path);

}  // namespace halfspace::inline HS_LANES_NAMESPACE
