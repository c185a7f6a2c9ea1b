// SPDX-License-Identifier: Apache-2.0
//
// Shared by all OpenGL workloads.
#pragma once

#include "peers/gl/gl_objects.h"
#include "workloads/sweeps.h"
#include "workloads/workload.h"
#include "workloads/workload_assets.h"
#include "workloads/workload_canvas.h"

namespace halfspace {

/// The inputs of an OpenGL workload.
struct GlInput {
  const WorkloadKind& twin;  ///< Halfspace's workload that draws the same image; must outlive the OpenGL workload
  WorkloadSize size;
  WorkloadAssets& assets;  ///< must outlive the workload
};

/// A workload drawn by OpenGL. It has the same reference image as Halfspace's workload.
class GlWorkload : public Workload {
 public:
  explicit GlWorkload(const GlInput& in, bool has_depth = true) : in_(in), target_(in.size, GL_RGBA8, has_depth) {}

  /// Draws a frame and waits with glFinish until it is complete.
  void frame(const Workers& workers) final;
  WorkloadPicture picture() const final;
  WorkloadTruth truth() const final { return make_twin()->truth(); }

 protected:
  virtual void draw() = 0;

  /// Binds and clears the target.
  void begin() const {
    target_.bind();
    target_.clear(kBackground);
  }
  const GlTarget& target() const { return target_; }
  std::unique_ptr<Workload> make_twin() const { return in_.twin.prepare(in_.size, in_.assets); }

 private:
  GlInput in_;
  GlTarget target_;
  mutable Image<glm::u8vec4> color_;  // the images last read by picture()
  mutable Image<float> depth_;
};

/// The workloads of workloads() and the series of sweeps(), with the same names and order, drawn by the current OpenGL context.
std::span<const WorkloadKind> gl_workloads();
std::span<const Sweep> gl_sweeps();

}  // namespace halfspace
