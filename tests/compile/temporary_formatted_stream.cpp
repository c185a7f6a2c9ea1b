// SPDX-License-Identifier: Apache-2.0
// A stream of a vector that is destroyed before the pass runs must not compile, however it is read, and
// the error must contain: the vector must outlive the stream.
#include "halfspace/raster/vertex_input.h"

using namespace halfspace;

auto create() { return stream<ReadAs::normalized>(std::vector<uint8_t>{0, 1, 2}); }
