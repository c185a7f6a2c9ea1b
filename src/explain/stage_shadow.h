// SPDX-License-Identifier: Apache-2.0
//
// The shadow map of a light, and the look-up of one point in it.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "halfspace/core/image.h"
#include "halfspace/render/prepared_scene.h"

namespace halfspace {

/// Texels around a point that a look-up shows, in each direction.
inline constexpr int kShadowReach = 6;
inline constexpr int kShadowSide = 2 * kShadowReach + 1;

struct ShadowLookup {
  int view = -1;  ///< index of the view that contains the point; −1: none, the point is lit
  glm::vec3 position_rws{0.0f}, normal_ws{0.0f}, to_light_ws{0.0f};
  float x = 0, y = 0;                                     ///< in texels from the lower left corner of the map
  float depth = 0;                                        ///< reversed window depth of the point, without bias
  float biased = 0;                                       ///< the same with bias
  float depth_dx = 0, depth_dy = 0;                       ///< slope of the plane that texels are compared with, per texel
  float factor = 1;                                       ///< fraction of the light that arrives
  int i = 0, j = 0;                                       ///< texel that contains the point
  std::array<float, kShadowSide * kShadowSide> texels{};  ///< depths around (i, j), lowest row first
  std::array<float, kShadowSide * kShadowSide> lit{};     ///< 1: the texel does not occlude the point
};

/// Looks up a surface point in the shadow of a light, with the functions that shaders call.
ShadowLookup shadow_lookup(const Light& light, const glm::vec3& position_rws, const glm::vec3& face_ws, const glm::vec3& normal_ws,
                           const glm::vec2& window);

/// Returns the map of a view as gray codes, at most `size` texels wide: 0 where it is empty, brighter nearer to the light. The range of
/// depths is stretched to the codes.
Image<glm::u8vec4> shadow_map_picture(const ShadowView& view, int size);

}  // namespace halfspace
