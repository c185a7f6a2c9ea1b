// SPDX-License-Identifier: Apache-2.0
// A vertex view without streams and without a vertex count must not compile, and the error must contain: needs the number of vertices.
#include "halfspace/raster/vertex_input.h"

using namespace halfspace;

VertexView nothing() { return make_vertex_view(); }
