// SPDX-License-Identifier: Apache-2.0
//
// Draws as stored by a pass, and all data that the stages after the vertex stage read.
#pragma once

#include <algorithm>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "halfspace/raster/pipeline/draw_arena.h"
#include "halfspace/raster/pipeline/pipeline_data.h"
#include "halfspace/raster/target.h"
#include "halfspace/shading/contract.h"

namespace halfspace::HS_LANES {

struct EmittingStages;
struct PrimitiveBatch;
struct FragmentBatch;
struct VisibilityBatch;

/// Functions that are compiled for each shader. The rest of the pipeline is shared by all shaders.
struct ShaderKernels {
  /// Stages that emit primitives, or null. They run before all others, and the vertex kernel copies the vertices that they have emitted.
  const EmittingStages* emitting = nullptr;
  /// Kernels for instances whose vertices all have the same layer and viewport. Null unless only the vertex function chooses them.
  const ShaderKernels* one_layer = nullptr;
  int patch_vertices = 0;  ///< of Topology::patches
  void (*vertex)(const void* shader, const VertexBatch&) = nullptr;
  void (*primitive)(const void* shader, const PrimitiveBatch&) = nullptr;    ///< null: no primitive stage
  void (*visibility)(const void* shader, const VisibilityBatch&) = nullptr;  ///< null: visibility does not depend on the shader
  void (*fragment)(const void* shader, const FragmentBatch&) = nullptr;
  void (*color)(const void* shader, const FragmentBatch&) = nullptr;  ///< same as fragment, without keep masks and depths
  int varying_count = 0;                                              ///< floats per vertex
  int primitive_count = 0;                                            ///< floats per triangle in Chunk::primitives
  const Interpolation* interpolations = nullptr;                      ///< varying_count entries
  bool uses_centroid = false;                                         ///< some varying has centroid interpolation
  bool uses_id = false;                    ///< the fragment function has a PrimitiveId parameter; primitive_count is kIdRow
  bool gives_point_size = false;           ///< vertices have a point size
  bool gives_layer = false;                ///< vertices have a layer and a viewport (LayeredVertex)
  bool gives_point_sprite = false;         ///< the vertex function sets the bounds of points
  int clip_distance_count = 0;             ///< clip distances of a vertex
  int cull_distance_count = 0;             ///< cull distances of a vertex
  int color_count = 1;                     ///< colors returned by the fragment function
  const ColorType* color_types = nullptr;  ///< color_count entries; null: not checked
  bool discards = false;
  bool writes_depth = false;
  ConservativeDepth conservative_depth = ConservativeDepth::any;  ///< of the depth that the shader writes
  bool tests_early = false;                                       ///< all tests and writes of depth and stencil precede the shader
  bool runs_per_sample = false;                                   ///< the shader runs per sample, for any state
  bool writes_sample_mask = false;
  bool is_constant = false;  ///< the whole draw has one color: the fragment kernel only uses the count and the output of its batch
};

/// Start of a list, strip or fan after a primitive restart.
struct IndexRun {
  uint32_t first_primitive;  ///< number of preceding primitives in the draw
  uint32_t first_index;      ///< position in the index list
};

/// Copy of the caller's shader, which lets the caller change uniforms after draw(). The pass owns the memory; the deleter only calls the
/// destructor.
using KeptShader = std::unique_ptr<const void, void (*)(const void*)>;

/// What follows from the state of a draw and from its pass.
struct DrawPlacement {
  Viewport viewport{};
  PixelBounds bounds{};    ///< viewport ∩ scissor ∩ target
  float depth_low = 0.0f;  ///< bounds of the depth range
  float depth_high = 1.0f;
  uint32_t sample_mask = 1;           ///< bit s: sample s can be drawn
  bool is_multisampled = false;       ///< there are several samples per pixel
  bool state_shades_samples = false;  ///< by its state, the fragment function runs per sample instead of per pixel
  /// Alpha to coverage applies: there are several samples, and the first color attachment does not contain integers (OpenGL 4.6, section
  /// 17.3.1).
  bool covers_by_alpha = false;
  bool sets_alpha_to_one = false;  ///< alpha_to_one, and there are several samples
};

/// A draw as stored by the pass: its arguments, and values derived from them once for all triangles. A pass may contain many thousands of
/// draws, so Draw is kept small: shader, streams and state are stored consecutively in the arena of the pass.
struct Draw : DrawPlacement {
  const ShaderKernels& kernels;  ///< static, one per shader type
  KeptShader shader;
  std::shared_ptr<const Indices> indices;
  VertexStreams vertices;
  const DrawState& state;  ///< consecutive draws with equal states share one

  bool shades_samples;    ///< the fragment function runs per sample instead of per pixel
  bool covers_by_shader;  ///< the shader determines which samples are drawn
  bool is_smooth;         ///< pixels are covered by their area; see visibility/coverage/smooth.h

  // These are set when the draw is added.
  bool is_clear = false;      ///< applies to all layers
  bool is_emitted = false;    ///< created from a draw with emitting stages; its vertices are already counted
  bool deferred = false;      ///< shaded after visibility, once per visible pixel; otherwise shaded immediately, in order
  bool writes_color = false;  ///< writes any channel of any attachment
  /// Order-independent draws with the same number are sorted together: the number of preceding draws that write color in another way.
  uint32_t layer_group = 0;

  std::size_t vertex_count = 0;  ///< vertices used by the indices, for all instances
  uint32_t primitive_count = 0;  ///< per instance
  std::vector<IndexRun> runs{};  ///< runs with at least one primitive; empty if there are no restarts
  uint32_t first_instance = 0;   ///< number of the first instance, for the shader and its streams
  uint32_t number = 0;           ///< of the draw that was added to the pass

  /// Null, or, if is_emitted: the number and the instance of the submitted primitive that each primitive comes from.
  const int32_t* primitive_numbers = nullptr;
  const int32_t* primitive_instances = nullptr;

  Draw(const ShaderKernels& kernels_, KeptShader shader_, std::shared_ptr<const Indices> indices_, const VertexStreams& vertices_,
       const DrawState& state_, const DrawPlacement& placement)
      : DrawPlacement(placement),
        kernels(kernels_),
        shader(std::move(shader_)),
        indices(std::move(indices_)),
        vertices(vertices_),
        state(state_),
        shades_samples(state_shades_samples || (is_multisampled && kernels.runs_per_sample)),
        covers_by_shader(is_multisampled && kernels.writes_sample_mask),
        is_smooth(!is_multisampled && HS_LANES::is_smooth(state)) {}
};

/// The submitted primitive that a primitive of a draw comes from.
struct PrimitiveNumber {
  uint32_t primitive, instance;
};
inline PrimitiveNumber submitted_primitive(const Draw& draw, uint32_t instance, uint32_t primitive) {
  if (draw.primitive_numbers == nullptr) return {primitive, draw.first_instance + instance};
  return {static_cast<uint32_t>(draw.primitive_numbers[primitive]), static_cast<uint32_t>(draw.primitive_instances[primitive])};
}

/// Returns true if all offsets into the draw's vertex arrays fit in the 32-bit indices of a gather.
inline bool can_gather(const ShadedVertices& v, const Draw& draw) {
  const std::size_t floats = std::size_t{v.count} * draw.state.instances * static_cast<std::size_t>(std::max(4, v.varying_count));
  return floats <= std::size_t{std::numeric_limits<int32_t>::max()};
}

/// Input data of all stages that follow the vertex stage.
struct PassContext {
  std::unique_ptr<DrawArena> arena;  ///< for the shaders, streams and states of the draws; destroyed after them
  std::vector<Draw> draws;
  std::vector<ShadedVertices> shaded;  ///< one per draw
  std::vector<Chunk> chunks;
  std::vector<TriangleIds> triangle_ids;  ///< of each draw, in `chunks`
  int width = 0, height = 0;              ///< size of the target in pixels
  int tile_size = 64;
  int tiles_x = 0, tiles_y = 0;
  DepthFormat depth_format = DepthFormat::none;  ///< without stencil
  int samples = 1;                               ///< per pixel
  SampleSpan samples_at{};
  bool inspects_primitives = false;  ///< the tile runner reads the primitive numbers of all draws
};

/// Returns true if setup must record the primitive number of each triangle of the draw.
inline bool needs_primitive_numbers(const PassContext& context, const Draw& draw) {
  return context.inspects_primitives || draw.kernels.primitive_count != 0;
}

inline const Triangle& triangle_of(const PassContext& context, TriangleId id) {
  return context.chunks[chunk_of(id)].triangles[index_in_chunk(id)];
}

/// Returns the draw that a triangle belongs to.
inline const Draw& draw_of(const PassContext& context, TriangleId id) {
  const Chunk& chunk = context.chunks[chunk_of(id)];
  return context.draws[chunk.ranges[chunk.range_of(index_in_chunk(id))].draw];
}

}  // namespace halfspace::HS_LANES
