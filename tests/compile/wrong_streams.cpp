// SPDX-License-Identifier: Apache-2.0
// A shader whose Attributes do not match the streams must not compile, and the error must contain: the streams do not match.
#include "halfspace/raster/pass.h"
#include "support/shaders.h"

using namespace halfspace;

void draw(Pass& pass, const std::vector<glm::vec3>& positions) { pass.draw(ConstantShader{}, make_vertex_view(stream(positions))); }
