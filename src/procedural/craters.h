// SPDX-License-Identifier: Apache-2.0
//
// The craters of the invented Moon. Sizes are radii in radians of arc, heights kilometres; distances are chords of the
// unit sphere (a thousandth less than the arc for the largest), so craters are round wherever they lie.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "halfspace/core/lanes.h"

namespace halfspace::procedural {

/// One impact: a bowl or a flat floor with a wall, a rim that falls off into a blanket of ejecta, and a central peak in a
/// large one.
struct Crater {
  glm::vec3 center, east, north;  // unit vectors of uv_sphere's frame
  float radius;
  float depth;      // of the floor below the surroundings
  float rim;        // of the crest above them
  float floor;      // the flat part of the radius
  float peak;       // of the central peak above the floor
  float erasing;    // how much of the older relief is gone inside, 0 to 1
  float freshness;  // brightness of walls and ejecta, 0 to 1
  float wobble[6];  // cosines and sines of 2, 3 and 5 times the azimuth in the outline
  float rays;       // radians that rays reach, or 0
  int32_t seed;     // of the rays' noise
};

/// Where the ejecta end, in radii.
inline constexpr float kBlanketEnd = 2.1f;

/// Craters from old to young; those from `first_young` on came after the lava of the maria.
struct Craters {
  std::vector<Crater> all;
  std::size_t first_young;
};

/// All craters that a map of `width` texels can show. A wider map has the same ones and smaller ones.
Craters moon_craters(int width);

/// One row of a map, padded by kLanes texels: the places of its texels on the unit sphere (x and z; y is the row's), and
/// what craters do to it.
struct CraterRow {
  int width;
  float y, ring;  // cosine and sine of the colatitude
  std::vector<float> x, z;
  std::vector<float> relief;  // km
  std::vector<float> light;   // to be added to the albedo, about 0 to 1
};

/// The rows, of `height` in a map, that a crater or its rays may reach.
struct RowRange {
  int begin, end;
};
RowRange rows_reached(const Crater& crater, int height);

/// Applies one crater to the texels that it reaches.
void stamp(const Crater& crater, CraterRow& row);

/// Adds the crater's rays, if it has any.
void add_rays(const Crater& crater, CraterRow& row);

}  // namespace halfspace::procedural
