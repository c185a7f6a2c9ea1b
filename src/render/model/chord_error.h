// SPDX-License-Identifier: Apache-2.0
//
// Distance between the triangles of a generated shape and its smooth surface, and the number of triangles needed for a given
// distance.
#pragma once

#include "halfspace/scene/description.h"

namespace halfspace {

/// Returns the maximum distance between the shape's triangles and its smooth surface, without heights, in object space.
///
/// The chord of an arc of 2π/n is r·(1 − cos(π/n)) below the arc. On a surface curved in both directions, the diagonal of a quad is
/// below the surface by the sum for both of its sides. (This is exact for the sphere, where the circumcenter of the triangle is the
/// lowest point.) The result is 0 for shapes with flat faces.
double chord_error(const ObjectDescription& o);

/// Rounds up to one of the part counts used for meshes: 1, 2, 3, 4, 6, 8, 12, 16, … There are only a few, so that a moving
/// camera rarely changes a mesh.
int part_step(int minimum);

/// Returns the object with `parts` from top to bottom (or around a tube, or along an edge). The count in the other direction is
/// chosen to give both directions the same chord error. An icosphere gets the lowest level whose triangles are small enough.
///
/// places_maps: texture coordinates must also be accurate to within the chord error. This only affects cones. Their bands narrow
/// towards the apex, so interpolation across a triangle bends straight lines of a map, by up to s/4n for sectors of width s and n
/// bands.
ObjectDescription with_parts(ObjectDescription o, int parts, bool places_maps);

/// Returns the maximum number of parts for the object's shape.
int max_parts(const ObjectDescription& o);

}  // namespace halfspace
