// SPDX-License-Identifier: Apache-2.0
#include "halfspace/raster/pipeline/pipeline_data.h"

namespace halfspace::HS_LANES {

void Chunk::clear() {
  ranges.clear();
  triangles.clear();
  clip_vertices.clear();
  clip_varyings.clear();
  primitive_numbers.clear();
  primitives.clear();
  bin_start.clear();
  bin_triangles.clear();
  tile_x0 = tile_y0 = tile_x1 = tile_y1 = 0;
  statistics = {};
}

std::size_t Chunk::bytes() const {
  return triangles.capacity() * sizeof(Triangle) + bin_triangles.capacity() * sizeof(uint16_t) + bin_start.capacity() * sizeof(uint32_t) +
         clip_vertices.capacity() * sizeof(ClipVertex) + primitive_numbers.capacity() * sizeof(uint32_t) +
         (clip_varyings.capacity() + primitives.capacity()) * sizeof(float);
}

}  // namespace halfspace::HS_LANES
