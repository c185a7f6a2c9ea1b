// SPDX-License-Identifier: Apache-2.0
//
// Meshes and a texture that are created once and shared by several workloads.
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

/// Returns a unit sphere with `rows` bands from pole to pole and `columns` sectors, which has 2·columns·(rows − 1) triangles. The front
/// faces are on the outside. rows and columns must be at least 2.
SphereMesh sphere_mesh(int rows, int columns);

/// Returns a 2048 x 1024 checkerboard texture with squares of 64 x 64 texels and all mip levels. Each level averages the 8-bit values of 2
/// x 2 texels of the previous one and rounds halves up.
Texture2D checker_texture();

enum class SceneKind : uint8_t;
struct Scene;

class WorkloadAssets {
 public:
  std::shared_ptr<const SphereMesh> sphere(int rows, int columns);
  std::shared_ptr<const Texture2D> checker();
  std::shared_ptr<const Scene> scene(SceneKind kind);

 private:
  std::map<std::pair<int, int>, std::shared_ptr<const SphereMesh>> spheres_;
  std::shared_ptr<const Texture2D> checker_;
  std::map<SceneKind, std::shared_ptr<const Scene>> scenes_;
};

}  // namespace halfspace
