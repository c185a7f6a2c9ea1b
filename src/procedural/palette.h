// SPDX-License-Identifier: Apache-2.0
//
// Color helpers for the procedural maps. Colors are sRGB values from 0 to 255, blended without decoding.
#pragma once

#include <glm/glm.hpp>

#include "halfspace/core/lane_math.h"
#include "halfspace/procedural/noise.h"

namespace halfspace::HS_LANES::procedural {

/// Broadcasts a color to all lanes.
HS_INLINE Vec tint(const glm::vec3& c) { return Vec(Real(c.x), Real(c.y), Real(c.z)); }

/// Interpolates from a (t = 0) to b (t = 1).
HS_INLINE Vec blend(const Vec& a, const Vec& b, Real t) { return Vec(lerp(a.x, b.x, t), lerp(a.y, b.y, t), lerp(a.z, b.z, t)); }
HS_INLINE Vec blend(const Vec& a, const glm::vec3& b, Real t) { return blend(a, tint(b), t); }

}  // namespace halfspace::HS_LANES::procedural
