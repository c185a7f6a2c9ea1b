// SPDX-License-Identifier: Apache-2.0
//
// Draws the user interface of Dear ImGui with a pass.
#pragma once

#include "halfspace/core/image.h"
#include "halfspace/core/parallel.h"
#include "halfspace/raster/pass.h"
#include "halfspace/shading/texture/texture.h"

struct ImDrawData;
struct ImDrawList;
struct ImFontAtlas;

namespace halfspace {

/// Renders ImGui's triangles with blending, scissor rectangles and one texture, the font atlas.
class ImGuiPass {
 public:
  /// Builds the font atlas. All fonts must have been added.
  explicit ImGuiPass(ImFontAtlas& fonts);

  /// Draws over the frame, which must have the display size. Blends sRGB values instead of linear colors, as ImGui expects.
  void draw(const ImDrawData& data, Image<glm::u8vec4>& frame, const Workers& workers);

 private:
  struct Vertex {
    glm::vec2 position, uv;
    glm::vec4 color;
  };

  // Transform from pixels to NDC.
  struct Placement {
    glm::vec2 scale, offset;
  };

  void add_command(Pass& pass, std::span<const Vertex> vertices, std::span<const uint16_t> indices, const Placement& placement,
                   const DrawState& state) const;
  void add_list(Pass& pass, const ImDrawList& list, const ImDrawData& data, std::span<const Vertex> vertices, int height) const;

  Texture2D fonts_;
  glm::vec2 white_uv_;            // texture coordinates of a white texel, for triangles without text
  std::vector<Vertex> vertices_;  // vertices of all draw lists of a frame
};

}  // namespace halfspace
