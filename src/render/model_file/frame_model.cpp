// SPDX-License-Identifier: Apache-2.0
#include "halfspace/render/model_file/frame_model.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "halfspace/core/check.h"
#include "halfspace/core/float_mode.h"
#include "halfspace/core/trig_double.h"
#include "halfspace/core/units.h"

namespace halfspace::HS_LANES {

namespace {

constexpr std::size_t kMaxPoses = 64;

// Returns at most kMaxPoses of the times, including the first and the last.
std::vector<double> some_of(const std::vector<double>& times) {
  if (times.size() <= kMaxPoses) return times;
  std::vector<double> some;
  for (std::size_t i = 0; i < kMaxPoses; ++i) some.push_back(times[i * (times.size() - 1) / (kMaxPoses - 1)]);
  return some;
}

// Returns the reason why a scene of a model has nothing to draw.
std::string why_empty(const Model& model, int index) {
  if (model.meshes.empty()) {
    const auto is_skipped = [](const std::string& warning) { return warning.starts_with("meshes[") && warning.ends_with("it is skipped"); };
    const auto skipped = std::ranges::find_if(model.warnings, is_skipped);
    if (skipped == model.warnings.end()) return "has no meshes; expected at least one";
    return "has nothing to draw: " + *skipped + "; expected a mesh that can be drawn";
  }
  if (model.nodes.empty()) return "has meshes, but no nodes; expected a node that draws a mesh";
  const std::size_t scene = static_cast<std::size_t>(index < 0 ? model.scene : index);
  if (model.scenes[scene].roots.empty()) return fmt::format("scenes[{}] has no nodes; expected a node that draws a mesh", scene);
  // The reader adds a scene to files without one.
  const std::string place = model.scenes.size() > 1 ? fmt::format("scenes[{}] ", scene) : "";
  return place + "draws no mesh; expected a node that draws one";
}

}  // namespace

ModelPoses::ModelPoses(const Model& model, const PoseOptions& options, const std::vector<double>& times)
    : model_(model), options_(options), times_(some_of(times)), first_(at(times_.at(0))) {
  if (options.animation < 0) times_.resize(1);
}

PosedModel ModelPoses::at(double time) const {
  const FloatMode float_mode;
  PoseOptions options = options_;
  options.time = time;
  return pose(model_, options);
}

ModelBounds bounds_of(const ModelPoses& poses, const std::filesystem::path& file) {
  const FloatMode float_mode;
  glm::dvec3 low = poses.first().low, high = poses.first().high;
  poses.for_each([&](const PosedModel& posed) {
    low = glm::min(low, posed.low);
    high = glm::max(high, posed.high);
  });
  if (!(low.x <= high.x)) throw InputError(fmt::format("{}: {}", file.string(), why_empty(poses.model(), poses.scene())));
  ModelBounds b{0.5 * (low + high), 0.5 * (high - low), 0.0};
  b.radius = glm::length(b.half);
  if (b.radius == 0.0) b.radius = 1.0;
  return b;
}

glm::dvec3 eye_direction(const ModelView& view) {
  const SinCosDouble yaw = sincos_radians(view.yaw * kRadiansPerDegree), pitch = sincos_radians(view.pitch * kRadiansPerDegree);
  return {pitch.cos * yaw.sin, pitch.sin, pitch.cos * yaw.cos};
}

namespace {

constexpr double kMargin = 1.12;  // factor for the size of the view

double tangent(double degrees) {
  const SinCosDouble a = sincos_radians(degrees * kRadiansPerDegree);
  return a.sin / a.cos;
}

// Calls f(p) for every vertex of all poses, in world space.
template <class F>
void for_each_vertex(const ModelPoses& poses, const F& f) {
  poses.for_each([&](const PosedModel& posed) {
    for (const PosedMesh& part : posed.meshes) {
      const ModelMesh& mesh = part.deformed != nullptr ? *part.deformed : poses.model().meshes[static_cast<std::size_t>(part.mesh)];
      for (const glm::vec3& p : mesh.positions) f(glm::dvec3(part.world_from_mesh * glm::dvec4(glm::dvec3(p), 1.0)));
    }
  });
}

// A view along −back that shows all vertices with a margin. A vertex at (x, y, z) along the axes of the camera is in view if
// |x − eye.x| ≤ (eye.z − z)·tan, so the side planes of the view touch the model. The horizontal and the vertical pair of planes meet at
// different distances, and the eye is at the farther one.
FramedView framed(const ModelPoses& poses, const ModelBounds& b, const glm::dvec3& back, const ModelView& view) {
  const glm::dvec3 right = glm::normalize(glm::cross(glm::dvec3(0, 1, 0), back)), up = glm::cross(back, right);
  const double tan_y = tangent(0.5 * view.fov) / kMargin, tan_x = tan_y * view.aspect;
  glm::dvec2 low(1e300), high(-1e300);  // of x + z·tan and x − z·tan, whose planes touch the model on either side
  double nearest = -1e300;
  for_each_vertex(poses, [&](const glm::dvec3& p) {
    const glm::dvec3 q(glm::dot(p - b.center, right), glm::dot(p - b.center, up), glm::dot(p - b.center, back));
    const glm::dvec2 slope(tan_x, tan_y), side(q);
    high = glm::max(high, side + slope * q.z);
    low = glm::min(low, side - slope * q.z);
    nearest = std::max(nearest, q.z);
  });
  const glm::dvec2 middle = 0.5 * (low + high);
  const double distance = std::max({0.5 * (high.x - low.x) / tan_x, 0.5 * (high.y - low.y) / tan_y, nearest + 0.05 * b.radius});
  const glm::dvec3 target = b.center + right * middle.x + up * middle.y;
  return {target + back * (distance / view.zoom), target};
}

// A view of the center in which all vertices stay visible while the camera goes around the model.
FramedView framed_for_turntable(const ModelPoses& poses, const ModelBounds& b, const ModelView& view) {
  constexpr int kDirections = 24;
  const double tan_y = tangent(0.5 * view.fov) / kMargin, tan_x = tan_y * view.aspect;
  double distance = 0.0;
  for (int i = 0; i < kDirections; ++i) {
    ModelView turned = view;
    turned.yaw += 360.0 * i / kDirections;
    const glm::dvec3 back = eye_direction(turned), right = glm::normalize(glm::cross(glm::dvec3(0, 1, 0), back)),
                     up = glm::cross(back, right);
    for_each_vertex(poses, [&](const glm::dvec3& p) {
      const glm::dvec3 from_center = p - b.center;
      const double along = glm::dot(from_center, back);
      distance = std::max(
          {distance, along + std::fabs(glm::dot(from_center, right)) / tan_x, along + std::fabs(glm::dot(from_center, up)) / tan_y});
    });
  }
  return {b.center + eye_direction(view) * (distance / view.zoom), b.center};
}

}  // namespace

FramedView frame_model(const ModelPoses& poses, const ModelBounds& b, const ModelView& view) {
  const FloatMode float_mode;
  return view.turn_seconds > 0.0 ? framed_for_turntable(poses, b, view) : framed(poses, b, eye_direction(view), view);
}

}  // namespace halfspace::HS_LANES
