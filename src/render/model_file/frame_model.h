// SPDX-License-Identifier: Apache-2.0
//
// Finds the view that shows a whole model.
#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <vector>

#include "halfspace/model/pose/pose.h"
#include "halfspace/render/model_file/model_view.h"

namespace halfspace::HS_LANES {

/// Bounds of a posed model in world space. `radius` is that of the bounding sphere of the box, or 1 if the model is a single point.
struct ModelBounds {
  glm::dvec3 center, half;
  double radius;
};

/// A model at several times.
class ModelPoses {
 public:
  /// `model` must outlive this object. options.time is ignored. There must be at least one time. Poses that are far apart are enough for a
  /// view, so at most 64 times are used: the first, the last, and evenly spaced times between them.
  ModelPoses(const Model& model, const PoseOptions& options, const std::vector<double>& times);

  const Model& model() const { return model_; }
  int scene() const { return options_.scene; }  ///< as in PoseOptions
  const PosedModel& first() const { return first_; }

  /// Calls f(pose) for each time. Only one pose is in memory at a time, in addition to the first.
  template <class F>
  void for_each(const F& f) const {
    f(first_);
    for (std::size_t i = 1; i < times_.size(); ++i) f(at(times_[i]));
  }

 private:
  PosedModel at(double time) const;

  const Model& model_;
  PoseOptions options_;
  std::vector<double> times_;
  PosedModel first_;
};

/// Returns the bounds of all poses. Throws InputError with the reason if the scene has no vertices.
ModelBounds bounds_of(const ModelPoses& poses, const std::filesystem::path& file);

/// Returns the unit vector from the model to the eye for the yaw and pitch of a view.
glm::dvec3 eye_direction(const ModelView& view);

/// Position of the eye and the point at the center of the image, in world space.
struct FramedView {
  glm::dvec3 eye, target;
};

/// Returns the nearest view with the direction, angle and aspect ratio of `view` that shows all vertices of all poses with a margin,
/// divided by its zoom. If the camera goes around the model, the view shows all vertices from every side.
FramedView frame_model(const ModelPoses& poses, const ModelBounds& b, const ModelView& view);

}  // namespace halfspace::HS_LANES
