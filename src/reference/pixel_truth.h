// SPDX-License-Identifier: Apache-2.0
//
// What a picture's pixels see, by rasterizer and by rays, and how much of a light reaches them, by map and by rays.
#pragma once

#include <optional>
#include <vector>

#include "halfspace/core/image.h"
#include "halfspace/core/parallel.h"
#include "halfspace/reference/ray_scene.h"
#include "halfspace/render/view.h"

namespace halfspace {

/// A light as a prepared scene has it (PreparedScene::lights[index]).
struct LightChoice {
  const PreparedScene* scene;
  std::size_t index;
};

/// The picture of one light's shadow (reference/shadow_mask.h), top row first.
struct ShadowPicture {
  Image<glm::vec4> mask;  ///< (share that arrives, n·l, 1 + mesh or 0, triangle)
  Image<float> depth;     ///< reversed window depth
  double draw_ms;         ///< of the picture
};

/// Draws it; with `with_shadow` false as if the light had no map.
ShadowPicture draw_shadow_picture(const LightChoice& light, const View& view, int width, int height, bool with_shadow,
                                  const Workers& workers);

/// The ray of a point of the picture: x, y in pixels from the top left corner, pixel centres at + 0.5.
struct PictureRay {
  glm::vec3 origin_rws, direction_ws;  ///< direction: not of unit length
};
PictureRay picture_ray(const View& view, int width, int height, double x, double y);

/// What each pixel's centre sees by rays, top row first.
Image<std::optional<RayHit>> primary_hits(const RayScene& rays, const View& view, int width, int height, const Workers& workers);

/// How the rasterizer's visible triangles compare with the rays'.
struct VisibilityScore {
  int64_t pixels = 0;     ///< covered by either
  int64_t same = 0;       ///< the same triangle, or none in both
  int64_t near_edge = 0;  ///< another one, that a ray within 1/256 px sees
  int64_t depth_tie = 0;  ///< another one, nearer or farther by less than the surface's depth changes over 1/256 px
  int64_t unexplained = 0;
};
VisibilityScore compare_visibility(const ShadowPicture& picture, const Image<std::optional<RayHit>>& hits, const RayScene& rays,
                                   const View& view, const Workers& workers);

/// The share of a light that arrives at a surface, by rays.
struct LightTruth {
  float share;           ///< 0 … 1
  float standard_error;  ///< of share; 0 for a light without size
};

/// A light for rays. Rays start on the geometric normal's side, off the surface by `offset` of the coordinates' size: floats
/// round the origin and Embree the hit to a few 2^-24 of it.
struct RayLight {
  Light light;
  double size;  ///< radius in units; directional: tangent of half the angle
  int rays;     ///< 1, or a square number of strata for a light with size
};
LightTruth light_truth(const RayScene& casters, const RayLight& light, const glm::dvec3& position_rws, const glm::dvec3& face_normal_ws,
                       uint32_t seed);

}  // namespace halfspace
