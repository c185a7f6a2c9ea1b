// SPDX-License-Identifier: Apache-2.0
//
// Kinds of lights, shading rates, reflection models, and shadow settings: enums and plain structs that both shaders and scene
// descriptions name.
#pragma once

#include <cstdint>

namespace halfspace {

enum class LightType : uint8_t { directional, point, spot };

/// How often light is computed (shading/surface_shader.h).
enum class ShadingRate : uint8_t {
  none,       ///< no light: colour and emission
  flat,       ///< once a triangle that survives culling, at its middle, with the normal of its face
  provoking,  ///< by vertex, and the provoking vertex's light for all the triangle (GL's flat shading)
  gouraud,    ///< by vertex, interpolated
  phong       ///< by pixel, with the interpolated normal
};

/// Which highlight a surface has: none, by the reflected ray, or by the half vector.
enum class LightModel : uint8_t { lambert, phong, blinn_phong };

/// How the light that arrives is found from the map. docs/shadows.md tells what each costs and how wrong it is.
enum class ShadowFilter : uint8_t {
  hard,      ///< the nearest texel
  bilinear,  ///< four texels, compared and then mixed
  pcf3,      ///< the mean over a square of 3 x 3 texels round the point (Reeves, Salesin and Cook, SIGGRAPH 1987)
  pcf5,
  pcf7,
  vogel,   ///< 16 texels on a sunflower's disk, turned by pixel
  pcss,    ///< of a light with a size: a blocker search (Fernando, SIGGRAPH sketches 2005), then texels projected onto the light
  vsm,     ///< two filtered moments and Chebyshev's bound (Donnelly and Lauritzen, I3D 2006)
  moments  ///< four filtered moments (Peters and Klein, "Moment shadow mapping", I3D 2015)
};

/// How a point is kept from lying in its own shadow.
enum class ShadowBias : uint8_t {
  none,
  constant,        ///< towards the light by a number of texels
  slope,           ///< and by the depth that a texel spans on the surface
  angle,           ///< by the angle between normal and light, as the Earth's original
  normal_offset,   ///< along the normal
  receiver_plane,  ///< each texel is compared with the triangle's plane at its middle
  adaptive,        ///< the same with the shading normal's plane, and a distance of its own (Dou et al., JCGT 3(4), 2014)
  automatic,       ///< what was measured best: docs/shadows.md
  original         ///< 0.0005 of the depth range, as the day and night's original
};

/// How a shadow is looked up; the same for all views of a light.
struct ShadowSettings {
  ShadowFilter filter = ShadowFilter::pcf3;
  ShadowBias bias = ShadowBias::automatic;
  float constant = 1.0f;    ///< texels
  float slope = 1.0f;       ///< factor of the depth that a texel spans
  float max_slope = 16.0f;  ///< largest tangent of the light's angle that the other biases follow
  float radius = 2.0f;      ///< texels; of vogel's disk and of the moments' filter
  /// Half the light's width: the tangent of half its angle (directional), or its radius in world units (point, spot). For pcss.
  float light_radius = 0.0f;
};

}  // namespace halfspace
