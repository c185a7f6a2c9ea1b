// SPDX-License-Identifier: Apache-2.0
//
// Meshes and camera of the sphere workloads, shared by all renderers.
#pragma once

#include "workloads/workload_assets.h"
#include "workloads/workload_canvas.h"
#include "workloads/workload_sphere.h"

namespace halfspace {

struct SphereDetail {
  int rows, columns;
  constexpr int triangles() const { return 2 * columns * (rows - 1); }
};
inline constexpr SphereDetail k20k{51, 200}, k200k{201, 500}, k2m{501, 2000};  // 20,000, 200,000, 2,000,000 triangles

/// Uniforms for a camera at (0, 0.8, 2.7) looking at the center of the sphere.
inline SphereUniforms sphere_uniforms(WorkloadSize size, const Texture2D& texture) {
  const glm::dmat4 view = look_at({0.0, 0.8, 2.7}, {0, 0, 0}, {0, 1, 0});
  return {.clip_from_world = glm::mat4(workload_projection(size, 0.5, 10.0) * view), .texture = &texture};
}

/// Owns the mesh and texture of a sphere workload.
struct SphereAssets {
  std::shared_ptr<const SphereMesh> mesh;
  std::shared_ptr<const Texture2D> texture;

  SphereAssets(SphereDetail detail, WorkloadAssets& assets) : mesh(assets.sphere(detail.rows, detail.columns)), texture(assets.checker()) {}
  VertexView vertex_view() const { return make_vertex_view(stream(mesh->vertices)); }
  Indices indices() const { return {mesh->indices, mesh->vertices.size()}; }
};

}  // namespace halfspace
