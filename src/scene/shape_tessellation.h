// SPDX-License-Identifier: Apache-2.0
//
// Functions for the table in shapes.cpp: the errors of tessellated shapes, and the choice of a tessellation. ShapeKind documents them.
#pragma once

#include "halfspace/scene/description.h"

namespace halfspace::HS_LANES {

// ---- chord_error ------------------------------------------------------------------------------------------------

double sphere_chord_error(const ObjectDescription& o);
double icosphere_chord_error(const ObjectDescription& o);
double cone_chord_error(const ObjectDescription& o);
double torus_chord_error(const ObjectDescription& o);
double knot_chord_error(const ObjectDescription& o);

// ---- diagonal_angle ---------------------------------------------------------------------------------------------

double icosphere_angle(const ObjectDescription& o);
double sphere_angle(const ObjectDescription& o);
double cone_angle(const ObjectDescription& o);
double ring_angle(const ObjectDescription& o);

// ---- set_parts --------------------------------------------------------------------------------------------------

void no_parts(ObjectDescription& o, int parts, bool places_maps);
void sphere_parts(ObjectDescription& o, int parts, bool places_maps);
void icosphere_parts(ObjectDescription& o, int parts, bool places_maps);
void edge_parts(ObjectDescription& o, int parts, bool places_maps);
void cylinder_parts(ObjectDescription& o, int parts, bool places_maps);
void cone_parts(ObjectDescription& o, int parts, bool places_maps);
void torus_parts(ObjectDescription& o, int parts, bool places_maps);
void knot_parts(ObjectDescription& o, int parts, bool places_maps);

}  // namespace halfspace::HS_LANES
