// SPDX-License-Identifier: Apache-2.0
#include "halfspace/raster/amplify/run_geometry.h"

#include <algorithm>

#include "halfspace/raster/primitives/primitive_assembly.h"

namespace halfspace::HS_LANES {

namespace {

// Appends the primitives of a strip of `size` vertices.
void append_strip(uint32_t first, uint32_t size, Topology topology, bool first_provokes, CacheLineVector<uint32_t>& indices) {
  const uint32_t corners = topology == Topology::points ? 1 : topology == Topology::lines ? 2 : 3;
  for (uint32_t k = 0; k + corners <= size; ++k) {
    const uint32_t i = first + k;
    if (corners == 1) {
      indices.push_back(i);
    } else if (corners == 2) {
      indices.insert(indices.end(), {i, i + 1});
    } else {
      for (const uint32_t place : strip_triangle(k, first_provokes)) indices.push_back(first + place);
    }
  }
}

}  // namespace

EmittedPrimitives run_geometry(const GeometryStage& stage, const void* shader, const PrimitiveRows& primitives, bool first_provokes) {
  EmittedStrips strips;
  constexpr int kExpectedVertices = 8;  // most functions emit a few vertices per primitive, even if they may emit many
  strips.rows.reserve(static_cast<std::size_t>(primitives.count * std::min(stage.layout.max_vertices, kExpectedVertices) * stage.row));
  stage.geometry(shader, primitives, strips);
  EmittedPrimitives out;
  out.topology = topology_of(stage.layout.output);
  out.row = static_cast<std::size_t>(stage.row);
  out.rows = std::move(strips.rows);
  const std::size_t vertices = out.vertex_count();  // not fewer than primitives
  out.indices.reserve(vertices * out.vertices_per_primitive());
  out.numbers.reserve(vertices);
  out.instances.reserve(vertices);
  uint32_t first = 0;
  for (std::size_t i = 0; i < strips.sizes.size(); ++i) {
    append_strip(first, strips.sizes[i], out.topology, first_provokes, out.indices);
    first += strips.sizes[i];
    out.numbers.resize(out.primitive_count(), primitives.primitives[strips.sources[i]]);
    out.instances.resize(out.primitive_count(), primitives.instances[strips.sources[i]]);
  }
  return out;
}

Topology topology_of(GeometryOutputPrimitive output) {
  switch (output) {
    case GeometryOutputPrimitive::points: return Topology::points;
    case GeometryOutputPrimitive::line_strip: return Topology::lines;
    case GeometryOutputPrimitive::triangle_strip: return Topology::triangles;
  }
  return Topology::points;
}

bool accepts(GeometryInputPrimitive input, Topology topology) {
  switch (input) {
    case GeometryInputPrimitive::points: return topology == Topology::points;
    case GeometryInputPrimitive::lines: return is_lines(topology) && !has_adjacency(topology);
    case GeometryInputPrimitive::lines_adjacency: return is_lines(topology) && has_adjacency(topology);
    case GeometryInputPrimitive::triangles: return is_triangles(topology) && !has_adjacency(topology);
    case GeometryInputPrimitive::triangles_adjacency: return is_triangles(topology) && has_adjacency(topology);
  }
  return false;
}

}  // namespace halfspace::HS_LANES
