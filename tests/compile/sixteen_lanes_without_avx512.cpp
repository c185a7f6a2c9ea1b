// SPDX-License-Identifier: Apache-2.0
// Sixteen lanes without AVX-512 must not compile, and the error must contain: -march=x86-64-v4.
// compile with: -UHALFSPACE_LANES -DHALFSPACE_LANES=16 -march=x86-64-v3
#include "halfspace/raster/pass.h"
