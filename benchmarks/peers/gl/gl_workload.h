// SPDX-License-Identifier: Apache-2.0
//
// What the OpenGL programs of all workloads share.
#pragma once

#include "peers/gl/gl_objects.h"
#include "sweeps.h"
#include "workload.h"
#include "workload_assets.h"
#include "workload_canvas.h"

namespace halfspace {

/// What an OpenGL workload is made from.
struct GlInput {
  const WorkloadKind& twin;  ///< Halfspace's workload of the same picture; outlives the OpenGL one
  WorkloadSize size;
  WorkloadAssets& assets;  ///< outlive the workload
};

/// A workload drawn by OpenGL. The truth is that of its twin.
class GlWorkload : public Workload {
 public:
  explicit GlWorkload(const GlInput& in, bool has_depth = true) : in_(in), target_(in.size, GL_RGBA8, has_depth) {}

  /// Draws, and waits until all pixels are in memory: glFinish.
  void frame(const Workers& workers) final;
  WorkloadPicture picture() const final;
  WorkloadTruth truth() const final { return in_.twin.prepare(in_.size, in_.assets)->truth(); }

 protected:
  virtual void draw() = 0;

  /// Draws go into the picture, which is cleared.
  void begin() const {
    target_.bind();
    target_.clear(kBackground);
  }
  const GlTarget& target() const { return target_; }

 private:
  GlInput in_;
  GlTarget target_;
  mutable Image<glm::u8vec4> color_;  // as last read
  mutable Image<float> depth_;
};

/// The workloads of workloads() and the series of sweeps(), drawn by the current context. Same names, same order.
std::span<const WorkloadKind> gl_workloads();
std::span<const Sweep> gl_sweeps();

}  // namespace halfspace
