// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "halfspace/model/detail/simplified_mesh.h"

namespace halfspace::HS_LANES {

/// Keeps simplified meshes longer than SceneAssets does, for example on disk. Copies of SceneAssets share it, so all functions must be
/// thread-safe.
class DetailCache {
 public:
  virtual ~DetailCache() = default;
  /// Returns what was stored for an equal mesh and this step, or nothing. All indices must be in range.
  virtual std::optional<SimplifiedMesh> find(const TriangleList& mesh, int step) = 0;
  virtual void store(const TriangleList& mesh, int step, const SimplifiedMesh& simple) = 0;
};

}  // namespace halfspace::HS_LANES
