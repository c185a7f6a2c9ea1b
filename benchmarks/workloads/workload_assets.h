// SPDX-License-Identifier: Apache-2.0
//
// Meshes, a texture and other objects that are created once and shared by several workloads.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "halfspace/raster/vertex_input.h"
#include "halfspace/shading/texture/texture.h"

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

class WorkloadAssets {
 public:
  std::shared_ptr<const SphereMesh> sphere(int rows, int columns);
  std::shared_ptr<const Texture2D> checker();
  /// Returns the object of this name, which make() creates at the first call. The name determines the type.
  template <class T, class F>
  std::shared_ptr<const T> once(const std::string& name, const F& make) {
    std::shared_ptr<const void>& object = others_[name];
    if (!object) object = std::make_shared<const T>(make());
    return std::static_pointer_cast<const T>(object);
  }

 private:
  std::map<std::pair<int, int>, std::shared_ptr<const SphereMesh>> spheres_;
  std::shared_ptr<const Texture2D> checker_;
  std::map<std::string, std::shared_ptr<const void>> others_;
};

}  // namespace halfspace
