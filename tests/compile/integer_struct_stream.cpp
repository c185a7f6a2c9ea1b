// SPDX-License-Identifier: Apache-2.0
// A stream of structs with an integer must not compile, and the error must contain: vertex attributes must consist of floats.
#include "halfspace/raster/pass.h"

using namespace halfspace;

struct Vertex {
  glm::vec3 position;
  uint32_t color;
};

auto create(const std::vector<Vertex>& vertices) { return stream(vertices); }
