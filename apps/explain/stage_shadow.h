// SPDX-License-Identifier: Apache-2.0
//
// The shadow map of a light, and the shadow lookup of one point.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "halfspace/core/image.h"
#include "halfspace/render/prepared_scene.h"

namespace halfspace {

/// Number of texels in each direction around a point that a lookup shows.
inline constexpr int kShadowReach = 6;
inline constexpr int kShadowSide = 2 * kShadowReach + 1;

struct ShadowLookup {
  int view = -1;  ///< index of the view that contains the point; −1 if no view contains it, so that it is lit
  glm::vec3 position_rws{0.0f}, normal_ws{0.0f}, to_light_ws{0.0f};
  float x = 0, y = 0;                                     ///< position in texels from the lower left corner of the map
  float depth = 0;                                        ///< reversed window depth of the point, without bias
  float biased = 0;                                       ///< depth with bias
  float depth_dx = 0, depth_dy = 0;                       ///< slope per texel of the plane that texels are compared with
  float factor = 1;                                       ///< fraction of the light that reaches the point: filtered · terminator
  float filtered = 1;                                     ///< result of the filter
  float terminator = 1;                                   ///< terminator_fraction (shading/shadow/terminator.h)
  int i = 0, j = 0;                                       ///< texel that contains the point
  std::array<float, kShadowSide * kShadowSide> texels{};  ///< depths around (i, j), lowest row first
  std::array<float, kShadowSide * kShadowSide> lit{};     ///< 1 if the texel does not occlude the point
  /// Weights of these texels: `filtered` is the sum of weight times lit, except for rounding. Empty if the filter is not such a sum, or
  /// reads texels that are farther away.
  std::vector<float> weights;
};

/// The members of ShadowReceiver that describe the smooth surface.
struct SmoothSurface {
  glm::vec3 normal_ws{0.0f};
  float height = 0.0f;
};

/// Looks up a surface point in the shadow of a light, with the functions that shaders call.
/// smooth: the surface that the vertex normals describe.
ShadowLookup shadow_lookup(const Light& light, const glm::vec3& position_rws, const glm::vec3& face_ws, const glm::vec3& normal_ws,
                           const glm::vec2& window, const SmoothSurface& smooth = {});

/// Returns the map of a view as a gray picture, at most `size` texels wide. Empty texels are 0; nearer to the light is brighter. The range
/// of depths is scaled to the range of gray values.
Image<glm::u8vec4> shadow_map_picture(const ShadowView& view, int size);

}  // namespace halfspace
