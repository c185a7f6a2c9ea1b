// SPDX-License-Identifier: Apache-2.0
// Numbers that are not 16 bits wide must not be read as halves, and the error must contain: halves only uint16_t.
#include "halfspace/raster/pass.h"

using namespace halfspace;

auto create(const std::vector<uint8_t>& numbers) { return stream<ReadAs::halves>(numbers); }
