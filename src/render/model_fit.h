// SPDX-License-Identifier: Apache-2.0
//
// Finds the view that shows a whole model.
#pragma once

#include <filesystem>
#include <glm/glm.hpp>

#include "halfspace/model/pose.h"
#include "halfspace/render/model_scene.h"

namespace halfspace::inline HS_LANES_NAMESPACE {

/// Bounds of a posed model in world space. `radius` is that of the bounding sphere of the box, or 1 if the model is a single point.
struct ModelBounds {
  glm::dvec3 center, half;
  double radius;
};

/// Throws InputError if the model has no vertices.
ModelBounds bounds_of(const PosedModel& posed, const std::filesystem::path& file);

/// Returns the unit vector from the model to the eye for the yaw and pitch of a view.
glm::dvec3 eye_direction(const ModelView& view);

/// Position of the eye and the point at the center of the image, in world space.
struct FittedView {
  glm::dvec3 eye, target;
};

/// Returns the nearest view with the direction, angle and aspect ratio of `view` that shows all vertices with a margin, divided by its
/// zoom. If the camera goes around the model, the view shows all vertices from every side.
FittedView fitted_view(const Model& model, const PosedModel& posed, const ModelBounds& b, const ModelView& view);

}  // namespace halfspace::inline HS_LANES_NAMESPACE
