// SPDX-License-Identifier: Apache-2.0
//
// Measures the accuracy of a shadow map: compares the light computed from the map with ray-traced light.
#pragma once

#include <string>
#include <vector>

#include "halfspace/reference/edge_distance.h"
#include "halfspace/reference/pixel_truth.h"

namespace halfspace::HS_LANES {

/// Fractions of pixels by their distance from the exact shadow edge. The distance is measured perpendicular to the light, in shadow map
/// texels, and the filter radius is subtracted.
struct DistanceShares {
  double within_1 = 0.0, from_1_to_3 = 0.0, beyond_3 = 0.0;
};

/// Pixels at which only the shading normal faces the light. In the reference, the smooth surface of smooth_height
/// (shading/shadow/terminator.h) is lit where its normal faces the light and a ray from it reaches the light. Opposite pixels, at which
/// only the triangle faces the light, are dark with every method.
struct SidesScore {
  int64_t lit = 0, shadowed = 0;  ///< pixel counts according to the rays
  double false_shadow = 0.0;      ///< pixels with |map − rays| > 0.5, as a fraction of the lit pixels
  double false_light = 0.0;       ///< pixels with |map − rays| > 0.5, as a fraction of the shadowed pixels
  double error = 0.0;             ///< mean of n·l |map − rays|, where n is the shading normal
};

/// Score of one light of one scene. Pixels that face away from the light count as dark in both the map and the reference.
struct ShadowScore {
  std::string scene, light, method, bias;
  int resolution = 0;
  int64_t lit = 0, shadowed = 0;  ///< pixel counts according to the rays; a pixel is lit if more than half of the light arrives
  double sides_differ = 0.0;      ///< fraction of pixels where only one of face normal and shading normal faces the light
  SidesScore sides;               ///< errors at these pixels; they are not included in the following members
  DistanceShares false_shadow;    ///< pixels with |map − rays| > 0.5, as fractions of the lit pixels
  DistanceShares false_light;     ///< pixels with |map − rays| > 0.5, as fractions of the shadowed pixels
  EdgeDistance edge_px;           ///< distance from the shadow edges of the map to the exact edges
  double edge_texels = 0.0;       ///< mean edge distance in units of the shadow-map texel size projected onto the surface at that point
  double penumbra_error = 0.0;    ///< mean of |map − rays| where 0 < rays < 1; 0 if there is no penumbra
  double error = 0.0;             ///< mean of |map − rays| over all compared pixels
  double truth_error = 0.0;       ///< largest standard error of the rays
  double map_ms = 0.0, lookup_ms = 0.0;
};

/// Per-pixel results of a comparison, top row first. `map` is computed with the shadow map, `truth` with rays.
struct ShadowComparison {
  Image<float> map, truth;  ///< fraction of the light that reaches the pixel; negative for pixels that are not compared
  Image<float> facing;      ///< cosine of the angle between face normal and light; 0 for surfaces that face away
  ShadowScore score;
};

/// Compares the shadow map of one light with rays. `rays` must contain all meshes and `casters` only the shadow casters, both relative
/// to the eye of the scene's view.
ShadowComparison compare_shadow(const LightChoice& light, const RayScene& rays, const RayScene& casters, int width, int height,
                                int rays_per_pixel, const Workers& workers);

}  // namespace halfspace::HS_LANES
