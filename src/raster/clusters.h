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

/// The bounds of the clusters of a triangle list. The tighter the triangles of a cluster lie together, the more are skipped, so the list
/// should be in an order for which neighbors in the list are neighbors on the surface. Meshes of modeling programs usually are.
class Clusters {
 public:
  /// positions: a stream of three components, in object space. indices: a list of triangles without restarts. Neither is kept. Computes in
  /// O(n) time; create it once per mesh.
  Clusters(const VertexStream& positions, const Indices& indices);

  std::size_t size() const { return count_; }
  /// Returns the number of indices of the list.
  std::size_t index_count() const { return index_count_; }

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
  std::size_t count_ = 0, index_count_ = 0;
  std::array<std::vector<float>, kValues> values_;
  std::vector<uint32_t> blocks_, first_block_;
};

}  // namespace halfspace::HS_LANES
