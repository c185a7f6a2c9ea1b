// SPDX-License-Identifier: Apache-2.0
//
// Shared by most workloads: color and depth images that are cleared, drawn to and stored.
#pragma once

#include <utility>

#include "halfspace/geometry/camera.h"
#include "halfspace/raster/pass.h"
#include "workloads/workload.h"

namespace halfspace {

/// Tangent of 22.5°, half the vertical field of view of every camera.
inline constexpr double kTanHalfAngle = 0.41421356237309503;  // sqrt(2) − 1

inline constexpr glm::vec4 kBackground{0.10f, 0.20f, 0.30f, 1.0f};

/// Returns a projection with a vertical field of view of 45° for an image of the given size.
glm::dmat4 workload_projection(WorkloadSize size, double near, double far);

/// The default draw state of the workloads: back-face culling and depth test `less`.
DrawState workload_state();

/// An 8-bit color image and a float depth image.
class Canvas {
 public:
  explicit Canvas(WorkloadSize size) : color_(size.width, size.height), depth_(size.width, size.height) {}

  /// Returns a pass that clears both images and stores both.
  Pass pass();
  /// Returns a pass that draws over what a pass before it has stored.
  Pass pass_over();
  DepthTarget depth_target() { return d32f_target(depth_); }
  WorkloadPicture picture() const { return {&color_, &depth_}; }
  WorkloadTruth truth() const { return {color_.width(), color_.height(), vec4<double>(glm::dvec4(kBackground)), 1.0}; }

 private:
  Image<glm::u8vec4> color_;
  Image<float> depth_;
};

/// A workload that clears the image and issues one draw call.
template <class S>
class SingleDraw final : public Workload {
 public:
  /// `owner` keeps alive the vertices, the indices, and everything the shader points to.
  SingleDraw(WorkloadSize size, const S& shader, const VertexView& vertices, Indices indices, const DrawState& state,
             std::shared_ptr<const void> owner)
      : canvas_(size), shader_(shader), vertices_(vertices), indices_(std::move(indices)), state_(state), owner_(std::move(owner)) {}

  void frame(const Workers& workers) override {
    Pass pass = canvas_.pass();
    pass.draw(shader_, vertices_, indices_, state_);
    pass.run(workers);
  }
  WorkloadPicture picture() const override { return canvas_.picture(); }
  WorkloadTruth truth() const override {
    WorkloadTruth target = canvas_.truth();
    draw_naive(target, shader_, vertices_, indices_, state_);
    return target;
  }

 private:
  Canvas canvas_;
  S shader_;
  VertexView vertices_;
  Indices indices_;
  DrawState state_;
  std::shared_ptr<const void> owner_;
};

}  // namespace halfspace
