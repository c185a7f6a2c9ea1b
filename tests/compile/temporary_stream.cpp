// SPDX-License-Identifier: Apache-2.0
// A stream of a vector that is destroyed before the pass runs must not compile, and
// the error must contain: the vector must outlive the stream.
#include "halfspace/raster/vertex_input.h"

using namespace halfspace;

auto create() { return stream(std::vector<float>{0.0f, 1.0f, 2.0f}); }
