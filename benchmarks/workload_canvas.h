// SPDX-License-Identifier: Apache-2.0
//
// What the frames of most workloads share: a colour and a depth picture that are cleared, drawn into and kept.
#pragma once

#include <utility>

#include "halfspace/geometry/camera.h"
#include "halfspace/raster/pass.h"
#include "workload.h"

namespace halfspace {

/// Tangent of 22.5°, half the vertical angle of every camera.
inline constexpr double kTanHalfAngle = 0.41421356237309503;  // sqrt(2) − 1

inline constexpr glm::vec4 kBackground{0.10f, 0.20f, 0.30f, 1.0f};

/// The projection of 45° and the given distances of near and far plane, for a picture of that size.
glm::dmat4 workload_projection(WorkloadSize size, double near, double far);

/// The state of a draw unless the workload says otherwise: back faces culled, depth test less.
DrawState workload_state();

/// A picture of 8-bit colour and float depth.
class Canvas {
 public:
  explicit Canvas(WorkloadSize size) : color_(size.width, size.height), depth_(size.width, size.height) {}

  /// A pass that clears both, and keeps both.
  Pass pass();
  WorkloadPicture picture() const { return {&color_, &depth_}; }
  WorkloadTruth truth() const { return {color_.width(), color_.height(), vec4<double>(glm::dvec4(kBackground)), 1.0}; }

 private:
  Image<glm::u8vec4> color_;
  Image<float> depth_;
};

/// A workload of one draw into a cleared picture.
template <class S>
class SingleDraw final : public Workload {
 public:
  /// owner holds the memory of vertices and indices, and what the shader points to.
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
