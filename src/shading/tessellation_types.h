// SPDX-License-Identifier: Apache-2.0
//
// The domains, spacings and levels of tessellation (OpenGL 4.6, section 11.2.2).
#pragma once

#include <array>
#include <cstdint>

#include "halfspace/core/namespace.h"

namespace halfspace::HS_LANES {

/// What a patch is divided into: a triangle or a square into triangles, or a square into horizontal lines.
enum class TessellationDomain : uint8_t { triangles, quads, isolines };

/// How an edge is divided: into equal segments, or into an even or odd number of segments, two of which are shorter. With the fractional
/// spacings, the points move continuously when a level changes.
enum class TessellationSpacing : uint8_t { equal, fractional_even, fractional_odd };

inline constexpr int kMaxTessellationLevel = 64;  ///< GL_MAX_TESS_GEN_LEVEL; larger levels are clamped

/// The tessellation levels of a patch: approximately the numbers of segments of its edges. R is float, or SIMD lanes for a patch per lane.
template <class R>
struct TessellationLevels {
  /// Triangles: the edges u = 0, v = 0 and w = 0. Quads: the edges u = 0, v = 0, u = 1 and v = 1. Isolines: the number of lines, and the
  /// segments of each line. The patch is discarded if one of these levels is not greater than zero or is NaN. Others are ignored.
  std::array<R, 4> outer{R(1), R(1), R(1), R(1)};
  /// Triangles: the inner triangles (only the first level). Quads: the inner lines along u and along v. Isolines ignore both. Levels that
  /// are too small or NaN mean the smallest level of the spacing.
  std::array<R, 2> inner{R(1), R(1)};
};

}  // namespace halfspace::HS_LANES
