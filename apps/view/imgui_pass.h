// SPDX-License-Identifier: Apache-2.0
//
// Draws the user interface of Dear ImGui with a pass.
#pragma once

#include "halfspace/core/image.h"
#include "halfspace/core/parallel.h"
#include "halfspace/raster/pass.h"
#include "halfspace/shading/texture.h"

struct ImDrawData;
struct ImDrawList;
struct ImFontAtlas;

namespace halfspace {

/// Renders the triangles of ImGui: blended, with scissor rectangles and one texture, which contains the fonts.
class ImGuiPass {
 public:
  /// Builds the atlas. All fonts must have been added.
  explicit ImGuiPass(ImFontAtlas& fonts);

  /// Draws over the frame, whose size must be the display size. Blends the codes of colors, as ImGui expects.
  void draw(const ImDrawData& data, Image<glm::u8vec4>& frame, const Workers& workers);

 private:
  struct Vertex {
    glm::vec2 position, uv;
    glm::vec4 color;
  };

  void add_list(Pass& pass, const ImDrawList& list, const ImDrawData& data, std::span<const Vertex> vertices, int height) const;

  Texture2D fonts_;
  std::vector<Vertex> vertices_;  // of all lists of a frame
};

}  // namespace halfspace
