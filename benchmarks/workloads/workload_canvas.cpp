// SPDX-License-Identifier: Apache-2.0
#include "workloads/workload_canvas.h"

#include <numbers>

namespace halfspace {

glm::dmat4 workload_projection(WorkloadSize size, double near, double far) {
  return perspective_gl(std::numbers::pi / 4, static_cast<double>(size.width) / size.height, near, far);
}

DrawState workload_state() {
  DrawState state;
  state.cull = CullMode::back;
  return state;
}

Pass Canvas::pass() {
  ColorTarget color = rgba8_target(color_);
  color.clear_value = kBackground;
  return {color_.width(), color_.height(), color, d32f_target(depth_)};
}

Pass Canvas::pass_over() {
  ColorTarget color = rgba8_target(color_);
  DepthTarget depth = d32f_target(depth_);
  color.load = depth.load = LoadOp::load;
  return {color_.width(), color_.height(), color, depth};
}

}  // namespace halfspace
