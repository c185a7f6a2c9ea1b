// SPDX-License-Identifier: Apache-2.0
//
// Clusters of a mesh: bounds of runs of consecutive triangles. With them, a draw skips triangles that cannot cover a sample before their
// vertices are shaded.
//
//   const Indices indices(mesh.indices, mesh.positions.size());
//   const Clusters clusters(stream(mesh.positions), indices);  // once per mesh
//   ...
//   DrawState state{.cull = CullMode::back, .clusters = ClusterCulling{&clusters, shader.clip_from_object}};
//   pass.draw(shader, vertices, indices, state);               // the same picture, in less time
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "halfspace/raster/vertex_input.h"

namespace halfspace::HS_LANES {

/// The number of triangles of a cluster, except for the last one. Cluster i starts with triangle i · kClusterTriangles.
inline constexpr uint32_t kClusterTriangles = 64;
/// Vertices are skipped in blocks of this number.
inline constexpr uint32_t kClusterVertexBlock = 64;

/// The bounds of the clusters of a triangle list. The tighter the triangles of a cluster lie together, the more are skipped, so neighbors
/// in the list should be neighbors on the surface.
class Clusters {
 public:
  /// positions: a stream of three components, in object space. indices: a list of triangles without restarts. Neither is kept. Create
  /// it once per mesh.
  Clusters(const VertexStream& positions, const Indices& indices);

  std::size_t size() const { return count_; }
  /// Returns true if the clusters can be those of a list: it has the same number of indices and uses the same vertices.
  bool fits(const Indices& indices) const {
    return indices.size() == index_count_ && indices.used_count() == vertex_count_ && indices.first_vertex() == first_vertex_ &&
           indices.end_vertex() == end_vertex_;
  }

  /// The bounds of all clusters, one array per value. The arrays are padded to a multiple of the SIMD width.
  enum Value : std::size_t {
    kLowX,  ///< the bounding box
    kLowY,
    kLowZ,
    kHighX,
    kHighY,
    kHighZ,
    kAxisX,  ///< unit vector: the axis of a cone that contains the normals of the front sides
    kAxisY,
    kAxisZ,
    kCos,  ///< cosine and sine of the angle between the axis and the side of the cone
    kSin,
    kMinHeight,  ///< the smallest height of a triangle on its longest side; 0 if there is no useful cone
    kValues
  };
  const float* values(Value v) const { return values_[v].data(); }

  /// Returns the blocks of the vertices of a cluster, in ascending order: block b consists of the distinct vertices of the index list with
  /// numbers from b · kClusterVertexBlock on (Indices::used).
  std::span<const uint32_t> vertex_blocks(std::size_t cluster) const {
    return std::span(blocks_).subspan(first_block_[cluster], first_block_[cluster + 1] - first_block_[cluster]);
  }

 private:
  std::size_t count_ = 0, index_count_ = 0, vertex_count_ = 0;
  uint32_t first_vertex_ = 0, end_vertex_ = 0;
  std::array<std::vector<float>, kValues> values_;
  std::vector<uint32_t> blocks_, first_block_;
};

}  // namespace halfspace::HS_LANES
