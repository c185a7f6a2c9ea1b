// SPDX-License-Identifier: Apache-2.0
#include "halfspace/render/prepare/model_detail.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>

#include "halfspace/core/resource_limits.h"
#include "halfspace/model/detail/simplified_mesh.h"

namespace halfspace::HS_LANES {

namespace {

// With fewer triangles, a mesh takes too little time to matter.
constexpr std::size_t kMinDetailTriangles = 1024;
// A mesh with more triangles than this share of all is not worth a second list.
constexpr double kMaxDetailShare = 0.7;

// The size of a mesh, in its own space. These structs keep the model alive, so that no other mesh gets the address of theirs.
struct MeshExtent {
  MeshExtent(std::shared_ptr<const ModelAsset> asset, const ModelMesh& mesh) : model(std::move(asset)) {
    glm::dvec3 low(std::numeric_limits<double>::infinity()), high(-low);
    for (const glm::vec3& p : mesh.positions) {
      low = glm::min(low, glm::dvec3(p));
      high = glm::max(high, glm::dvec3(p));
    }
    center = 0.5 * (low + high);
    radius = 0.5 * glm::length(high - low);
    longest_side = std::max({high.x - low.x, high.y - low.y, high.z - low.z});
  }

  std::shared_ptr<const ModelAsset> model;
  glm::dvec3 center;  // of a ball around the bounding box
  double radius;
  double longest_side;
};

// Bytes per triangle of a mesh that is simplified: the tree, what building it takes, and the lists of meshoptimizer.
constexpr uint64_t kSimplifyBytes = 160;

// A simplified list of triangles of a mesh.
struct MeshDetail {
  MeshDetail(std::shared_ptr<const ModelAsset> asset, std::size_t mesh, SimplifiedMesh simple)
      : model(std::move(asset)),
        list(std::move(simple.indices)),
        error(simple.error),
        indices(list, model->model.meshes[mesh].positions.size()) {}

  std::shared_ptr<const ModelAsset> model;
  std::vector<uint32_t> list;
  double error;
  Indices indices;
};

}  // namespace

std::shared_ptr<const Indices> all_indices(const std::shared_ptr<const ModelAsset>& model, int mesh) {
  return {model, &model->indices[static_cast<std::size_t>(mesh)]};
}

SimplifiedMesh ModelDetail::simplified_mesh(const ModelMesh& mesh, int step, std::optional<OriginalMesh>& original) {
  const TriangleList triangles{mesh.positions, mesh.indices};
  if (cache_ != nullptr) {
    if (std::optional<SimplifiedMesh> found = cache_->find(triangles, step)) return std::move(*found);
  }
  const MemoryClaim claim(kSimplifyBytes * (mesh.indices.size() / 3), "model_error");
  if (!original) original.emplace(triangles);
  SimplifiedMesh made = simplified(*original, step, workers_);
  if (cache_ != nullptr) cache_->store(triangles, step, made);
  return made;
}

std::shared_ptr<const Indices> ModelDetail::indices_of(const std::shared_ptr<const ModelAsset>& model, int mesh_index,
                                                       const glm::dmat4& world_from_mesh, double error_px, SimplifiedObject& report) {
  const auto number = static_cast<std::size_t>(mesh_index);
  const ModelMesh& mesh = model->model.meshes[number];
  std::shared_ptr<const Indices> all = all_indices(model, mesh_index);
  const std::size_t triangles = all->size() / 3;
  report.triangles += triangles;
  report.drawn += triangles;
  if (triangles < kMinDetailTriangles || mesh.indices.empty()) return all;
  const std::string key = recipe("detail", std::to_string(reinterpret_cast<std::uintptr_t>(&mesh)));
  const auto extent = used_.asset<MeshExtent>(key + "extent", [&] { return MeshExtent(model, mesh); });
  const double stretch = stretch_of(world_from_mesh);
  const glm::dvec3 center_ws(world_from_mesh * glm::dvec4(extent->center, 1.0));
  const double px = stretch * pixels_per_unit(view_, center_ws, extent->radius * stretch), allowed = error_px / px;
  // With less than a triangle per pixel, pixels take more time than vertices.
  const double side_px = extent->longest_side * px;
  if (static_cast<double>(triangles) < side_px * side_px) return all;
  std::optional<OriginalMesh> original;
  for (int step = kCoarsestDetail; step <= kFinestDetail; ++step) {
    if (detail_tolerance(extent->longest_side, step) > allowed) continue;
    const auto detail = used_.asset<MeshDetail>(key + std::to_string(step),
                                                [&] { return MeshDetail(model, number, simplified_mesh(mesh, step, original)); });
    if (static_cast<double>(detail->list.size()) > kMaxDetailShare * static_cast<double>(mesh.indices.size())) return all;
    if (!(detail->error <= allowed)) continue;
    report.drawn -= triangles - detail->list.size() / 3;
    report.error_px = std::max(report.error_px, detail->error * px);
    return {detail, &detail->indices};
  }
  return all;
}

}  // namespace halfspace::HS_LANES
