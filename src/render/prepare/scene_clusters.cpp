// SPDX-License-Identifier: Apache-2.0
#include "halfspace/render/prepare/scene_clusters.h"

#include <mutex>
#include <optional>

namespace halfspace::HS_LANES {

namespace {

// With fewer triangles, the vertex stage takes too little time to matter.
constexpr std::size_t kMinTriangles = 2048;

// A mesh that has been drawn. Threads that share it build its clusters once.
class DrawnMesh {
 public:
  // indices: kept, so that no other mesh gets their address.
  explicit DrawnMesh(std::shared_ptr<const Indices> indices) : indices_(std::move(indices)) {}

  const Clusters* clusters(std::span<const glm::vec3> positions) const {
    std::call_once(once_, [&] { clusters_.emplace(stream(positions), *indices_); });
    return &*clusters_;
  }

 private:
  std::shared_ptr<const Indices> indices_;
  mutable std::once_flag once_;
  mutable std::optional<Clusters> clusters_{};
};

}  // namespace

const Clusters* SceneClusters::of(const std::shared_ptr<const Indices>& indices, std::span<const glm::vec3> positions) {
  if (indices->size() < 3 * kMinTriangles) return nullptr;
  const auto address = [](const void* p) { return std::to_string(reinterpret_cast<std::uintptr_t>(p)); };
  const std::string words = recipe("drawn mesh", address(indices.get()), address(positions.data()));
  if (const std::shared_ptr<const DrawnMesh> mesh = used_.existing<DrawnMesh>(words))
    return new_.contains(words) ? nullptr : mesh->clusters(positions);
  used_.add(words, std::make_shared<const DrawnMesh>(indices));
  new_.insert(words);
  return nullptr;
}

}  // namespace halfspace::HS_LANES
