// SPDX-License-Identifier: Apache-2.0
//
// A model at one point in time: the node hierarchy is resolved, and animations, skins and morph targets are applied.
#pragma once

#include <limits>

#include "halfspace/model/model.h"

namespace halfspace::HS_LANES {

struct PoseOptions {
  int scene = -1;      ///< index in Model::scenes; -1: the default scene
  int animation = -1;  ///< index in Model::animations; -1: none is applied
  double time = 0.0;   ///< seconds; clamped to the range of each channel
  int variant = -1;    ///< index in Model::variants; -1: the default materials
  bool bounds = true;  ///< whether to compute the bounds, which visits each vertex
};

/// One mesh at one place.
struct PosedMesh {
  int mesh = 0;                               ///< index in Model::meshes
  std::shared_ptr<const ModelMesh> deformed;  ///< the mesh with skin and morph targets applied; null: as stored
  glm::dmat4 world_from_mesh{1.0};            ///< includes the origin of the mesh, so that it applies to positions[i]
  int material = -1;
};

struct PosedCamera {
  int camera = 0;
  int node = 0;
  glm::dmat4 world_from_camera{1.0};  ///< without scale
};

struct PosedLight {
  int light = 0;
  glm::dmat4 world_from_light{1.0};  ///< without scale
};

struct PosedModel {
  std::vector<PosedMesh> meshes;
  std::vector<PosedCamera> cameras;
  std::vector<PosedLight> lights;
  /// Bounds of all positions in world space; low > high if there are none or PoseOptions::bounds is false.
  glm::dvec3 low{std::numeric_limits<double>::infinity()}, high{-std::numeric_limits<double>::infinity()};
};

/// Returns the model in world space, y up: a model with z up is turned by −90° around x. All options must be valid indices.
PosedModel pose(const Model& model, const PoseOptions& options);

}  // namespace halfspace::HS_LANES
