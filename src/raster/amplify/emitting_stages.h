// SPDX-License-Identifier: Apache-2.0
//
// The stages of a shader type that emit primitives (tessellation, geometry), without the type: their kernels, and what these exchange.
#pragma once

#include <cstdint>
#include <vector>

#include "halfspace/raster/amplify/tessellator.h"
#include "halfspace/raster/pipeline/pass_context.h"
#include "halfspace/shading/geometry_stage.h"

namespace halfspace::HS_LANES {

/// Vertices as a stage receives them: rows of floats at a constant distance.
struct VertexRows {
  const float* positions;  ///< clip space
  std::size_t position_step;
  const float* varyings;  ///< null if there are none
  std::size_t varying_step;

  const float* position(std::size_t vertex) const { return positions + vertex * position_step; }
  const float* varying(std::size_t vertex) const { return varyings + vertex * varying_step; }
};

/// Primitives or patches for a kernel.
struct PrimitiveRows {
  VertexRows vertices;
  const uint32_t* slots;      ///< vertices of each primitive, all with the same number
  const int32_t* primitives;  ///< number of each primitive in its instance
  const int32_t* instances;   ///< instance of each primitive
  int count;
};

/// Strips of vertices that a geometry function has emitted. A vertex is a row of values: clip-space position, extra values if there are any
/// (kExtraValues in geometry_stage.h), varyings.
struct EmittedStrips {
  CacheLineVector<float> rows;
  std::vector<uint32_t> sizes;  ///< number of vertices of each strip
  std::vector<int> sources;     ///< number in PrimitiveRows of the primitive of each strip
};

/// What a control function returns for each of some patches.
struct PatchRows {
  std::vector<TessellationLevels<float>> levels;
  std::vector<float> values;  ///< of Patch
};

/// Vertices that an evaluation function computes.
struct EvaluatedVertices {
  const float* values;           ///< PatchRows::values
  const uint32_t* patches;       ///< of each vertex: number in PrimitiveRows
  const glm::vec3* coordinates;  ///< of each vertex in the domain of its patch
  int count;
  float* rows;  ///< output: as in EmittedStrips
};

struct TessellationStage {
  void (*control)(const void* shader, const PrimitiveRows& patches, PatchRows& out);
  void (*evaluate)(const void* shader, const PrimitiveRows& patches, const EvaluatedVertices& vertices);
  TessellatorOptions options;
  int patch_vertices;
  int row;            ///< values of an evaluated vertex
  int varying_count;  ///< the last ones of them
};

struct GeometryStage {
  void (*geometry)(const void* shader, const PrimitiveRows& primitives, EmittedStrips& out);
  GeometryLayout layout;
  int row;  ///< values of an emitted vertex
};

/// The stages of a shader before those that its draw would have without them. If there are neither tessellation
/// nor a geometry function, primitives are emitted as they are, and their vertices have the values of EmittedStrips.
struct EmittingStages {
  void (*vertex)(const void* shader, const VertexBatch&);  ///< the vertex function, with the outputs that the next stage reads
  int varying_count;                                       ///< values of these outputs per vertex, without the position
  const TessellationStage* tessellation;
  const GeometryStage* geometry;
  void (*layer)(const void* shader, const VertexBatch&);  ///< VertexOutput::layer; null unless only the vertex function chooses it
};

/// The vertex kernel of draws of emitted vertices. It copies the rows of the streams of streams_of() (emit_primitives.h).
void copy_emitted_vertices(const void* shader, const VertexBatch& batch);

}  // namespace halfspace::HS_LANES
