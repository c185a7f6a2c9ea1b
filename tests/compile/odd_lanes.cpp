// SPDX-License-Identifier: Apache-2.0
// An unsupported lane count must not compile, and the error must contain: 1, 4, 8 or 16.
// compile with: -UHALFSPACE_LANES -DHALFSPACE_LANES=2
#include "halfspace/raster/pass.h"
