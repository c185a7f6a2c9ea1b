// SPDX-License-Identifier: Apache-2.0
//
// What is seen where no object is.
#include "scene/preparation.h"

namespace halfspace {

void ScenePreparation::add_stars() {
  StarSky sky;
  sky.forward_ws = glm::vec3(view_.forward_ws);
  sky.right_ws = glm::vec3(view_.right_ws * view_.tan_x);
  sky.up_ws = glm::vec3(view_.up_ws * view_.tan_y);
  sky.color = glm::vec3(scene_.background.color.linear);
  sky.brightness = static_cast<float>(scene_.background.brightness);
  sky.density = static_cast<float>(scene_.background.density);
  sky.pixel = static_cast<float>(2.0 * view_.tan_y / view_.height_px);
  DrawState state;
  state.depth.clip = ClipDepth::zero_to_one;
  state.depth.compare = CompareOp::greater_equal;  // where nothing is nearer than the farthest
  state.depth.write = false;
  static const std::vector<glm::vec2> corners(StarSky::kCorners.begin(), StarSky::kCorners.end());
  out_.draws.push_back({sky, vertices(stream(corners)), std::make_shared<const Indices>(Indices::sequential(3)), state});
}

}  // namespace halfspace
