// SPDX-License-Identifier: Apache-2.0
#include "halfspace/render/prepare/scene_clusters.h"

#include <optional>

namespace halfspace::HS_LANES {

namespace {

// With fewer triangles, the vertex stage takes too little time to matter.
constexpr std::size_t kMinTriangles = 2048;

struct ClusteredMesh {
  std::shared_ptr<const Indices> indices;  // keeps its address from being used again
  std::optional<Clusters> clusters{};      // none in the first frame
};

}  // namespace

const Clusters* SceneClusters::of(const std::shared_ptr<const Indices>& indices, std::span<const glm::vec3> positions) {
  if (indices->size() < 3 * kMinTriangles) return nullptr;
  const std::string words = recipe("clusters", std::to_string(reinterpret_cast<std::uintptr_t>(indices.get())));
  std::shared_ptr<const ClusteredMesh> mesh = used_.existing<ClusteredMesh>(words);
  if (mesh == nullptr) new_.insert(words);
  const bool is_new = new_.contains(words);
  if (mesh == nullptr || (!is_new && !mesh->clusters))
    mesh = used_.replaced(words, ClusteredMesh{indices, is_new ? std::nullopt : std::optional<Clusters>({stream(positions), *indices})});
  return mesh->clusters ? &*mesh->clusters : nullptr;
}

}  // namespace halfspace::HS_LANES
