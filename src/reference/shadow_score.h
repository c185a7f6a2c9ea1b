// SPDX-License-Identifier: Apache-2.0
//
// How right a shadow map is: a light's picture by the map beside the same picture by rays, as numbers.
#pragma once

#include <string>
#include <vector>

#include "halfspace/reference/edge_distance.h"
#include "halfspace/reference/pixel_truth.h"

namespace halfspace {

/// Shares of pixels by their distance from the true edge: in the light's plane, in texels, less the filter's radius.
struct DistanceShares {
  double within_1 = 0.0, from_1_to_3 = 0.0, beyond_3 = 0.0;
};

/// One light of one scene. A pixel that faces away from the light is dark by map and by rays alike: what is compared is what
/// arrives at a surface, and nothing arrives at its back.
struct ShadowScore {
  std::string scene, light, method, bias;
  int resolution = 0;
  int64_t lit = 0, shadowed = 0;  ///< pixels, by rays; a penumbra's by the greater half
  double sides_differ = 0.0;      ///< share of pixels where geometric and shading normal disagree on the light's side: judged apart
  DistanceShares false_shadow;    ///< |map − rays| > 0.5, of the lit pixels
  DistanceShares false_light;     ///< the same of the shadowed ones
  EdgeDistance edge_px;           ///< from the map's edges to the true ones
  double edge_texels = 0.0;       ///< mean of these, each by what a texel spans there, as it falls on the surface and the picture shows it
  double penumbra_error = 0.0;    ///< mean of |map − rays| where 0 < rays < 1; 0 where there is no penumbra
  double error = 0.0;             ///< the same over all pixels
  double truth_error = 0.0;       ///< largest standard error of the rays
  double map_ms = 0.0, lookup_ms = 0.0;
};

/// The pixels of a comparison, top row first.
struct ShadowComparison {
  Image<float> map, truth;  ///< share of light, by map and by rays; negative where there is nothing to compare
  Image<float> facing;      ///< cosine of the angle from the triangle's normal to the light; 0 where it faces away
  ShadowScore score;
};

/// Compares a prepared scene's light. `rays` holds all meshes, `casters` those that cast; both round the view's eye.
ShadowComparison compare_shadow(const LightChoice& light, const RayScene& rays, const RayScene& casters, int width, int height,
                                int rays_per_pixel, const Workers& workers);

}  // namespace halfspace
