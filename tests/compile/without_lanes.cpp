// SPDX-License-Identifier: Apache-2.0
// A program that does not link the library's target must not compile, and the error must contain: Halfspace::raster.
// compile with: -UHALFSPACE_LANES
#include "halfspace/raster/pass.h"
