// SPDX-License-Identifier: Apache-2.0
//
// How far a generated shape's triangles lie off the surface that they stand for, and how many it needs to lie nearer.
#pragma once

#include "halfspace/scene/description.h"

namespace halfspace {

/// The largest distance between the shape's triangles and its smooth surface, without heights; units of the object.
///
/// Of an arc of 2π/n the chord lies r·(1 − cos(π/n)) below. On a surface curved both ways the diagonal of a quad lies below by the sum
/// of both its sides' (exact for the sphere, where it is the triangle's circumcentre that lies lowest). 0 for what has plane faces.
double chord_error(const ObjectDescription& o);

/// Numbers of parts from which counts are chosen: 1, 2, 3, 4, 6, 8, 12, 16, …: few, so that a moving view rarely changes a mesh. The
/// smallest that is not below `least`.
int part_step(int minimum);

/// The same object with `parts` from top to bottom (or round a tube, or along an edge), and with as many along the other
/// direction as make both directions' chords err alike. For an icosphere the level whose triangles are no larger.
///
/// places_maps: the surface's maps, too, lie nearer than the chord error to where they belong. That asks for more on a cone alone: its
/// bands are narrower above, and a triangle of one bends what is straight. In sectors of width s, and n bands, by up to s/4n.
ObjectDescription with_parts(ObjectDescription o, int parts, bool places_maps);

/// The most parts that its keys allow.
int max_parts(const ObjectDescription& o);

}  // namespace halfspace
