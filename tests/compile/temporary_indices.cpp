// SPDX-License-Identifier: Apache-2.0
// An Indices object that is destroyed before the pass runs must not compile, and the error must contain: the index list is a temporary.
#include "halfspace/raster/pass.h"
#include "support/shaders.h"

using namespace halfspace;

void draw(Pass& pass, const VertexView& view, const std::vector<uint32_t>& list) { pass.draw(ConstantShader{}, view, Indices(list, 3)); }
