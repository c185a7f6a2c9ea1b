// SPDX-License-Identifier: Apache-2.0
// Eight lanes without AVX2 must not compile, and the error must contain: -march=x86-64-v3.
// compile with: -UHALFSPACE_LANES -DHALFSPACE_LANES=8 -march=x86-64-v2
#include "halfspace/raster/pass.h"
