// SPDX-License-Identifier: Apache-2.0
//
// Compares the rasterizer with ray casting: the surface that each pixel shows, and the fraction of a light that reaches it according to the
// shadow map and according to rays.
#pragma once

#include <optional>
#include <vector>

#include "halfspace/core/image.h"
#include "halfspace/core/parallel.h"
#include "halfspace/reference/ray_scene.h"
#include "halfspace/render/view.h"

namespace halfspace::HS_LANES {

/// Selects PreparedScene::lights[index].
struct LightChoice {
  const PreparedScene* scene;
  std::size_t index;
};

/// One light's shadow as drawn by the rasterizer with reference/shadow_mask.h, top row first.
struct ShadowPicture {
  Image<glm::vec4> mask;  ///< (fraction of the light that arrives, n·l, 1 + mesh or 0 for background, triangle)
  Image<float> depth;     ///< reversed window depth
  double draw_ms;         ///< time of the pass in milliseconds
};

/// Draws the shadow of a light. If `with_shadow` is false, the light is drawn as if it had no shadow map. shading_normals: as in
/// ShadowMask; null: those of the vertices.
ShadowPicture draw_shadow_picture(const LightChoice& light, const View& view, int width, int height, bool with_shadow,
                                  const Workers& workers, const Image<glm::vec3>* shading_normals = nullptr);

/// The camera ray through a point (x, y) of the image, in pixels from the top-left corner. Pixel centers are at + 0.5.
struct PictureRay {
  glm::vec3 origin_rws, direction_ws;  ///< the direction is not normalized
};
PictureRay picture_ray(const View& view, int width, int height, double x, double y);

/// Casts a ray through the center of each pixel. Returns the nearest hits, top row first.
Image<std::optional<RayHit>> primary_hits(const RayScene& rays, const View& view, int width, int height, const Workers& workers);

/// Compares the triangles that the rasterizer shows with those that the rays hit.
struct VisibilityScore {
  int64_t pixels = 0;     ///< pixels covered by the rasterizer, by the rays, or by both
  int64_t same = 0;       ///< both show the same triangle
  int64_t near_edge = 0;  ///< they differ, but a ray within 1/256 px hits the rasterizer's triangle
  int64_t depth_tie = 0;  ///< they differ, but their depths differ by less than the depth changes over 1/256 px
  int64_t unexplained = 0;
};
VisibilityScore compare_visibility(const ShadowPicture& picture, const Image<std::optional<RayHit>>& hits, const RayScene& rays,
                                   const View& view, const Workers& workers);

/// The fraction of a light that reaches a surface point, according to rays.
struct LightTruth {
  float share;           ///< 0 … 1
  float standard_error;  ///< standard error of `share`; 0 for a light without size
};

/// A light source for shadow rays.
struct RayLight {
  Light light;
  double size;  ///< radius in world units; for a directional light, the tangent of half its angular diameter
  int rays;     ///< rays per surface point if size is not 0, a square number; otherwise, one ray is cast
};
/// Casts shadow rays from a surface point to the light. The rays start on the lit side of the surface, at a distance of 2^-20 times the
/// largest coordinate: the float origin and Embree's hit are accurate to a few times 2^-24 of it. `seed` selects the random sample
/// positions.
LightTruth light_truth(const RayScene& casters, const RayLight& light, const glm::dvec3& position_rws, const glm::dvec3& face_normal_ws,
                       uint32_t seed);

}  // namespace halfspace::HS_LANES
