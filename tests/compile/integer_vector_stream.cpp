// SPDX-License-Identifier: Apache-2.0
// A stream of integer vectors must not compile, and the error must contain: vertex attributes must consist of floats.
#include "halfspace/raster/pass.h"

using namespace halfspace;

auto create(const std::vector<glm::ivec4>& joints) { return stream(joints); }
