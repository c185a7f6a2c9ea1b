// SPDX-License-Identifier: Apache-2.0
//
// Light types, shading rates, reflection models and shadow settings: enums and plain structs that are used by both shaders and
// scene descriptions.
#pragma once

#include <cstdint>

#include "halfspace/core/namespace.h"

namespace halfspace::HS_LANES {

enum class LightType : uint8_t { directional, point, spot };

/// How often lighting is computed (shading/surface/surface_shader.h).
enum class ShadingRate : uint8_t {
  none,       ///< no lighting: only color and emission
  flat,       ///< once per triangle that survives culling, at its centroid, with the face normal
  provoking,  ///< per vertex; the whole triangle has the light of its provoking vertex (OpenGL's flat shading)
  gouraud,    ///< per vertex, interpolated
  phong       ///< per pixel, with the interpolated normal
};

/// Specular model: none, based on the reflected ray (Phong), or based on the half vector (Blinn-Phong).
enum class LightModel : uint8_t { lambert, phong, blinn_phong };

/// How a shadow map is filtered. docs/explanation/shadows.md lists the cost and the error of each filter.
enum class ShadowFilter : uint8_t {
  hard,      ///< the nearest texel
  bilinear,  ///< four texels, compared first and then interpolated
  pcf3,      ///< mean over a square of 3 x 3 texels centered at the point (Reeves, Salesin and Cook, SIGGRAPH 1987)
  pcf5,
  pcf7,
  vogel,   ///< 16 texels on a Vogel disk that is rotated per pixel
  pcss,    ///< for area lights: blocker search (Fernando, SIGGRAPH sketches 2005), then backprojection of texels onto the light
  vsm,     ///< two filtered moments and Chebyshev's inequality (Donnelly and Lauritzen, I3D 2006)
  moments  ///< four filtered moments (Peters and Klein, "Moment shadow mapping", I3D 2015)
};

/// How self-shadowing (shadow acne) is avoided.
enum class ShadowBias : uint8_t {
  none,
  constant,        ///< moves the point towards the light, by a number of texels
  slope,           ///< adds the depth that a texel spans on the surface
  angle,           ///< proportional to 1 minus the cosine of the angle between normal and light
  normal_offset,   ///< moves the point along the normal
  receiver_plane,  ///< compares each texel with the plane of the triangle at the texel center
  adaptive,        ///< the same with the plane of the shading normal, and an additional offset (Dou et al., JCGT 3(4), 2014)
  automatic,       ///< the method that performed best in measurements: docs/explanation/shadows.md
  original         ///< a constant bias of 0.0005 of the depth range
};

/// Settings of a shadow lookup. They are the same for all views of a light.
struct ShadowSettings {
  ShadowFilter filter = ShadowFilter::pcf3;
  ShadowBias bias = ShadowBias::automatic;
  float constant = 1.0f;    ///< in texels
  float slope = 1.0f;       ///< factor applied to the depth that a texel spans on the surface
  float max_slope = 16.0f;  ///< upper limit of the tangent of the angle of incidence, for the biases that depend on it
  float radius = 2.0f;      ///< radius in texels of the Vogel disk and of the moment filter
  /// Radius of the light, for pcss: the tangent of half its angular diameter (directional), or in world units (point, spot).
  float light_radius = 0.0f;
};

}  // namespace halfspace::HS_LANES
