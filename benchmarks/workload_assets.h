// SPDX-License-Identifier: Apache-2.0
//
// Meshes and the texture that several workloads share: made once, however many workloads ask.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "halfspace/raster/vertex_input.h"
#include "halfspace/shading/texture.h"

namespace halfspace {

struct SphereVertex {
  glm::vec3 position, normal;
  glm::vec2 uv;
};

struct SphereMesh {
  std::vector<SphereVertex> vertices;
  std::vector<uint32_t> indices;
};

/// The unit sphere of `rows` bands from pole to pole and `columns` sectors: 2·columns·(rows − 1) triangles, front faces
/// outside. Both at least 2.
SphereMesh sphere_mesh(int rows, int columns);

/// Squares of 64 texels in two colours, 2048 x 1024 with all levels: each the mean of 2 x 2 texels of the one before, in
/// 8-bit codes, halves rounded up.
Texture2D checker_texture();

class WorkloadAssets {
 public:
  std::shared_ptr<const SphereMesh> sphere(int rows, int columns);
  std::shared_ptr<const Texture2D> checker();

 private:
  std::map<std::pair<int, int>, std::shared_ptr<const SphereMesh>> spheres_;
  std::shared_ptr<const Texture2D> checker_;
};

}  // namespace halfspace
