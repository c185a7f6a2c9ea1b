// SPDX-License-Identifier: Apache-2.0
//
// Vertex stage. Input: the streams of a draw and the indices that it uses. Output: ShadedVertices with window positions snapped to
// 1/256 px, outcodes and varyings. Each vertex that an instance uses is shaded once.
#pragma once

#include <optional>

#include "halfspace/raster/pipeline/pass_context.h"

namespace halfspace::HS_LANES {

/// Returns the transform from clip space to window coordinates. The fractions of the viewport must be multiples of 1/256 px. clips_sides:
/// the guard band is the viewport.
Viewport make_viewport(const ViewportRect& viewport, const DepthState& depth, ClipOrigin origin = ClipOrigin::lower_left,
                       bool clips_sides = false);

/// Shades vertices [begin, end) of the list of vertices that the draw's indices use; the list contains the instances one after the other.
/// Returns the union of the outcodes.
Outcode shade_vertices(const Draw& draw, std::size_t begin, std::size_t end, ShadedVertices& out);

/// A kernel that runs a vertex function.
using VertexKernel = void (*)(const void* shader, const VertexBatch&);

/// Runs a vertex kernel for vertices [begin, end) of the same list, and keeps what the vertex function returns.
void shade_clip_vertices(const Draw& draw, VertexKernel kernel, std::size_t begin, std::size_t end, ClipVertices& out);
/// Allocates memory for all vertices that the draw uses, with varying_count values each.
void allocate_clip_vertices(const Draw& draw, int varying_count, ClipVertices& out);

/// Number of vertices that one task shades.
inline constexpr std::size_t kVerticesPerTask = 8 * kVertexBatch;

/// Fails if the draw has too many vertices for slots.
void check_vertex_count(const Draw& draw);

/// Returns the memory that allocate_vertices() needs for a draw, in bytes.
std::size_t shaded_bytes(const Draw& draw);

/// Allocates memory for all vertices that the draw uses.
void allocate_vertices(const Draw& draw, ShadedVertices& out);

/// Runs a kernel with VertexOutput::layer for vertices [begin, end) of the same list, at least one, all of one instance. Returns the layer
/// and the viewport that they choose if all choose the same. has_layers: the pass has several layers; otherwise, the layer is 0.
std::optional<Destination> common_destination(const Draw& draw, VertexKernel kernel, std::size_t begin, std::size_t end, bool has_layers);

/// Runs the vertex function for three vertices of an instance and returns their clip-space positions. index: as in the index list of the
/// draw.
std::array<glm::vec4, 3> clip_positions(const Draw& draw, uint32_t instance, const std::array<uint32_t, 3>& index);

}  // namespace halfspace::HS_LANES
