// SPDX-License-Identifier: Apache-2.0
// Indices of an 8-bit list that is destroyed before the pass runs must not compile, and
// the error must contain: the list must outlive the Indices.
#include "halfspace/raster/vertex_input.h"

using namespace halfspace;

Indices create() { return Indices(std::vector<uint8_t>{0, 1, 2}, 3); }
