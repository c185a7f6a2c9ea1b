// SPDX-License-Identifier: Apache-2.0
//
// What a pass keeps of its draws, and everything that the stages after the vertex stage read.
#pragma once

#include <algorithm>
#include <limits>
#include <memory>
#include <memory_resource>
#include <utility>
#include <vector>

#include "halfspace/raster/pipeline/pipeline_data.h"
#include "halfspace/raster/target.h"
#include "halfspace/shading/varyings.h"

namespace halfspace {

struct PrimitiveBatch;
struct FragmentBatch;
struct VisibilityBatch;

/// The thin functions that call one shader; everything else in the pipeline is shared by all shaders.
struct ShaderKernels {
  void (*vertex)(const void* shader, const VertexBatch&) = nullptr;
  void (*position)(const void* shader, const VertexBatch&) = nullptr;      ///< as vertex, without varyings
  void (*primitive)(const void* shader, const PrimitiveBatch&) = nullptr;  ///< null: no primitive stage
  void (*visibility)(const void* shader, VisibilityBatch&) = nullptr;      ///< null: the triangle decides
  void (*fragment)(const void* shader, const FragmentBatch&) = nullptr;
  int varying_count = 0;                          ///< floats per vertex
  int primitive_count = 0;                        ///< floats per triangle
  const Interpolation* interpolations = nullptr;  ///< varying_count entries
  bool uses_centroid = false;                     ///< some varying does
  bool gives_point_size = false;                  ///< the vertex function does
  bool gives_point_sprite = false;                ///< and bounds of points
  int clip_distance_count = 0;                    ///< and clip distances
  int color_count = 1;                            ///< colours that the fragment function returns
  bool discards = false;
  bool writes_depth = false;
  bool is_constant = false;  ///< one colour for the whole draw: the fragment kernel reads nothing of its batch but the count
};

/// Where a list, strip or fan begins after a primitive restart.
struct IndexRun {
  uint32_t first_primitive;  ///< primitives of the draw before it
  uint32_t first_index;      ///< its place in the index list
};

/// A copy of the caller's shader, so that uniforms may change after draw(). Its memory is the frame's; the deleter ends its life alone.
using KeptShader = std::unique_ptr<const void, void (*)(const void*)>;

/// A draw as the pass keeps it: its arguments, and what follows from them once for all triangles. A pass may have many thousands, so it
/// holds no more than it needs: streams and shader lie in the frame's memory, one behind the other.
struct Draw {
  const ShaderKernels& kernels;  ///< one for each type of shader, for ever
  KeptShader shader;
  std::shared_ptr<const Indices> indices;
  VertexStreams vertices;
  DrawState state;

  // These are set when the draw's vertices are shaded.
  Viewport viewport{};
  PixelBounds bounds{};    ///< viewport ∩ scissor ∩ target
  float depth_low = 0.0f;  ///< depth range in order
  float depth_high = 1.0f;
  bool deferred = false;        ///< shaded after visibility, once per visible pixel: replaces all colours; else shaded at once, in order
  bool writes_color = false;    ///< some channel of some attachment
  bool shades_samples = false;  ///< the fragment function runs for each sample, not for each pixel
  uint32_t sample_mask = 1;     ///< samples that may be drawn

  std::size_t vertex_count = 0;  ///< that its indices use, of all instances
  uint32_t primitive_count = 0;  ///< of one instance
  std::vector<IndexRun> runs{};  ///< those with a primitive in them; empty where no index is a restart

  Draw(const ShaderKernels& kernels_, KeptShader shader_, std::shared_ptr<const Indices> indices_, const VertexStreams& vertices_,
       const DrawState& state_)
      : kernels(kernels_), shader(std::move(shader_)), indices(std::move(indices_)), vertices(vertices_), state(state_) {}
};

/// Are a draw's vertices few enough that a row's place in their arrays fits in a gather's index?
inline bool can_gather(const ShadedVertices& v, const Draw& draw) {
  const std::size_t floats = std::size_t{v.count} * draw.state.instances * static_cast<std::size_t>(std::max(4, v.varying_count));
  return floats <= std::size_t{std::numeric_limits<int32_t>::max()};
}

/// Everything the stages after the vertex stage read.
struct PassContext {
  std::unique_ptr<std::pmr::monotonic_buffer_resource> memory;  ///< of the draws' shaders and streams
  std::vector<Draw> draws;
  std::vector<ShadedVertices> shaded;  ///< one a draw
  std::vector<Chunk> chunks;
  int width = 0, height = 0;  ///< target, px
  int tile_size = 64;
  int tiles_x = 0, tiles_y = 0;
  DepthFormat depth_format = DepthFormat::none;  ///< without its stencil
  int samples = 1;                               ///< of a pixel
  SampleSpan samples_at{};
};

inline const Triangle& triangle_of(const PassContext& context, TriangleId id) {
  return context.chunks[chunk_of(id)].triangles[index_in_chunk(id)];
}

/// The draw that a triangle belongs to.
inline const Draw& draw_of(const PassContext& context, TriangleId id) {
  const Chunk& chunk = context.chunks[chunk_of(id)];
  const std::size_t range = chunk.ranges.size() == 1 ? 0 : chunk.triangles[index_in_chunk(id)].range();
  return context.draws[chunk.ranges[range].draw];
}

}  // namespace halfspace
