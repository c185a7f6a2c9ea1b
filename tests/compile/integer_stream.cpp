// SPDX-License-Identifier: Apache-2.0
// A stream of integers must not compile, and the error must contain: vertex attributes must consist of floats.
// The error names the choices: the error must contain: stream<ReadAs::normalized>.
// the error must contain: stream<ReadAs::integers>.
#include "halfspace/raster/pass.h"

using namespace halfspace;

auto create(const std::vector<uint32_t>& joints) { return stream(joints); }
