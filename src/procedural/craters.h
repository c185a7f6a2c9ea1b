// SPDX-License-Identifier: Apache-2.0
//
// Craters of the procedural Moon. Sizes are radii in radians of arc; heights are in kilometers. Distances are chords of the unit
// sphere, about a thousandth shorter than the arc for the largest craters, so craters are circular everywhere on the map.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "halfspace/core/cache_line_allocator.h"
#include "halfspace/core/lanes.h"

namespace halfspace::HS_LANES::procedural {

/// One impact crater: a bowl or a flat floor with walls, a rim that slopes down into a blanket of ejecta, and a central peak in
/// large craters.
struct Crater {
  glm::vec3 center, east, north;  // unit vectors, as in SphereFrame
  float radius;
  float depth;      // depth of the floor below the surroundings
  float rim;        // height of the rim above the surroundings
  float floor;      // radius of the flat part, as a fraction of the crater's radius
  float peak;       // height of the central peak above the floor
  float erasing;    // fraction of the older relief that is erased inside, 0 to 1
  float freshness;  // brightness of walls and ejecta, 0 to 1
  float wobble[6];  // amplitudes of the outline's harmonics: cosine and sine of 2, 3 and 5 times the azimuth
  float rays;       // reach of the rays in radians, or 0
  int32_t seed;     // seed of the noise in the rays
};

/// Outer radius of the ejecta blanket, in crater radii.
inline constexpr float kBlanketEnd = 2.1f;

/// Craters from old to young. Craters with an index ≥ `first_young` are younger than the lava of the maria.
struct Craters {
  std::vector<Crater, CacheLineAllocator<Crater>> all;
  std::size_t first_young;
};

/// Returns all craters that a map of `width` texels can resolve. A wider map adds smaller craters and keeps the others.
Craters moon_craters(int width);

/// One row of a map, padded by kLanes texels: the positions of its texels on the unit sphere, and the effect of the craters on
/// them.
struct CraterRow {
  int width;
  float y, ring;  // cosine and sine of the colatitude; y is also the y coordinate of all texels
  std::vector<float> x, z;
  std::vector<float> relief;  // km
  std::vector<float> light;   // brightening of the albedo, about 0 to 1
};

/// The rows of a map of `height` rows that a crater or its rays may reach.
struct RowRange {
  int begin, end;
};
RowRange rows_reached(const Crater& crater, int height);

/// Applies one crater to the texels within its reach.
void stamp(const Crater& crater, CraterRow& row);

/// Adds the rays of a crater, if it has rays.
void add_rays(const Crater& crater, CraterRow& row);

}  // namespace halfspace::HS_LANES::procedural
