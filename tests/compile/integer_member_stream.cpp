// SPDX-License-Identifier: Apache-2.0
// A stream of an integer member must not compile, and the error must contain: vertex attributes must consist of floats.
#include "halfspace/raster/pass.h"

using namespace halfspace;

struct Vertex {
  glm::vec3 position;
  glm::uvec4 joints;
};

auto create(const std::vector<Vertex>& vertices) { return stream(vertices, &Vertex::joints); }
