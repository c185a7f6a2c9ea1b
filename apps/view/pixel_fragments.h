// SPDX-License-Identifier: Apache-2.0
//
// What was drawn at one pixel of a frame.
#pragma once

#include <string>
#include <vector>

#include "halfspace/render/prepared_scene.h"

namespace halfspace {

/// The nearest fragment that one draw has at the center of the pixel.
struct PixelFragment {
  std::size_t draw;    ///< index in PreparedScene::draws
  std::string object;  ///< name in the scene, or "particles"
  uint32_t instance, triangle;
  float depth;  ///< along the view axis, in scene units
  bool visible;
  glm::vec3 normal_ws, albedo;
};

/// The fragments at one pixel in the order of the draws. Blended surfaces and the background are not included.
struct PixelFragments {
  glm::ivec2 pixel{0};   ///< from the upper left corner
  glm::u8vec4 color{0};  ///< of the picture
  std::vector<PixelFragment> fragments;

  /// Returns the object of the scene that is visible, or an empty string.
  std::string visible_object() const;
};

/// Finds the fragments by rendering the values of the pixel once for each draw. The scene is unchanged afterwards. `pixel` must be in the
/// picture, which the scene was rendered to.
PixelFragments pixel_fragments(PreparedScene& scene, const SceneDescription& description, const Image<glm::u8vec4>& picture,
                               const glm::ivec2& pixel, const Workers& workers);

/// Formats the fragments as lines of text.
std::vector<std::string> lines_of(const PixelFragments& fragments);

}  // namespace halfspace
