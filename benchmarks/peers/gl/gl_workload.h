// SPDX-License-Identifier: Apache-2.0
//
// What the OpenGL programs of all workloads share.
#pragma once

#include <string_view>

#include "gl_objects.h"
#include "workload.h"
#include "workload_assets.h"
#include "workload_canvas.h"

namespace halfspace {

/// A workload drawn by OpenGL. The truth is that of the workload of the same name.
class GlWorkload : public Workload {
 public:
  GlWorkload(std::string_view name, WorkloadSize size, WorkloadAssets& assets, bool has_depth = true)
      : name_(name), size_(size), assets_(assets), target_(size, GL_RGBA8, has_depth) {}

  /// Draws, and waits until all pixels are in memory: glFinish.
  void frame(const Workers& workers) final;
  WorkloadPicture picture() const final;
  WorkloadTruth truth() const final;

 protected:
  virtual void draw() = 0;

  /// Draws go into the picture, which is cleared.
  void begin() const {
    target_.bind();
    target_.clear(kBackground);
  }
  const GlTarget& target() const { return target_; }
  WorkloadSize size() const { return size_; }
  WorkloadAssets& assets() const { return assets_; }

 private:
  std::string_view name_;
  WorkloadSize size_;
  WorkloadAssets& assets_;
  GlTarget target_;
  mutable Image<glm::u8vec4> color_;  // as last read
  mutable Image<float> depth_;
};

/// The workloads of workloads(), drawn by the current context. Same names, same order.
std::span<const WorkloadKind> gl_workloads();

}  // namespace halfspace
