// SPDX-License-Identifier: Apache-2.0
//
// Everything of the shading language: the functions of GLSL 3.30, chapter 8, and the functions on integers and bits of GLSL 4.x, by their
// names in GLSL. docs/reference/shading_language.md lists them with their errors, and says what is absent and why.
//
// Argument-dependent lookup finds the functions of vectors, matrices and lanes. Shaders are also compiled for R = float, whose arguments
// have no namespace. A shader outside of namespace halfspace therefore names the functions that it calls with scalars: `using
// halfspace::mod, halfspace::sin;`. After `using namespace halfspace`, calls also compile, but those with a float that the C library
// declares as well (sin, exp and others) may call it and give other bits than lanes.
#pragma once

#include "halfspace/core/glsl_common.h"
#include "halfspace/core/glsl_geometric.h"
#include "halfspace/core/glsl_integer.h"
#include "halfspace/core/glsl_matrix.h"
#include "halfspace/core/glsl_packing.h"
#include "halfspace/core/glsl_relational.h"
#include "halfspace/core/glsl_trigonometric.h"
#include "halfspace/core/swizzle.h"
