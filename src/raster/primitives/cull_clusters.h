// SPDX-License-Identifier: Apache-2.0
//
// Culling of clusters. Input: a draw with DrawState::clusters. Output: the triangles and the vertices that are left.
#pragma once

#include <vector>

#include "halfspace/raster/pipeline/pass_context.h"

namespace halfspace::HS_LANES {

/// [begin, end) of a list.
struct IndexRange {
  std::size_t begin, end;
};

struct VisibleClusters {
  std::vector<IndexRange> triangles;              ///< numbers of triangles in the draw
  std::vector<IndexRange> vertices;               ///< numbers in the list of distinct vertices of the draw (Indices::used)
  uint64_t triangle_count = 0, vertex_count = 0;  ///< in all ranges
};

/// Returns what is left of the clusters of a draw. A cluster is only skipped if setup would cull all its triangles, because they are
/// outside of one plane of the view volume or face away, or if all its samples fail the depth test (ClusterCulling::hidden_by).
VisibleClusters visible_clusters(const Draw& draw);

/// Returns true if setup culls the triangles [begin, end) of a draw. Slow; for checks.
bool are_culled(const Draw& draw, std::size_t begin, std::size_t end);

/// Checks that a draw can have clusters.
void check_clusters(const Draw& draw);

}  // namespace halfspace::HS_LANES
