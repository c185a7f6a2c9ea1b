// SPDX-License-Identifier: Apache-2.0
#include "workloads/workload_assets.h"

#include <algorithm>

#include "halfspace/core/trig_double.h"

namespace halfspace {

namespace {

Image<glm::u8vec4> half_size(const Image<glm::u8vec4>& from) {
  const int up = from.height() > 1 ? 1 : 0;  // in a level with a single row, the sum below counts each texel twice
  Image<glm::u8vec4> to(std::max(from.width() / 2, 1), std::max(from.height() / 2, 1));
  for (int row = 0; row < to.height(); ++row) {
    for (int x = 0; x < to.width(); ++x) {
      const auto sum = [&](int channel) {
        const auto code = [&](int i, int j) { return static_cast<int>(from.at(2 * x + i, (row << up) + j)[channel]); };
        return code(0, 0) + code(1, 0) + code(0, up) + code(1, up);
      };
      for (int k = 0; k < 4; ++k) to.at(x, row)[k] = static_cast<uint8_t>((sum(k) + 2) >> 2);
    }
  }
  return to;
}

}  // namespace

SphereMesh sphere_mesh(int rows, int columns) {
  SphereMesh mesh;
  mesh.vertices.reserve(static_cast<std::size_t>(rows + 1) * static_cast<std::size_t>(columns + 1));
  mesh.indices.reserve(6 * static_cast<std::size_t>(rows - 1) * static_cast<std::size_t>(columns));
  for (int i = 0; i <= rows; ++i) {
    const double v = static_cast<double>(i) / rows;
    const SinCosDouble theta = sincos_turns(0.5 * v);
    for (int j = 0; j <= columns; ++j) {
      const double u = static_cast<double>(j) / columns;
      const SinCosDouble phi = sincos_turns(u);
      const glm::vec3 position(glm::dvec3(theta.sin * phi.cos, theta.cos, theta.sin * phi.sin));
      mesh.vertices.push_back({position, position, glm::vec2(glm::dvec2(u, v))});
    }
  }
  for (int i = 0; i < rows; ++i) {
    for (int j = 0; j < columns; ++j) {
      const auto a = static_cast<uint32_t>(i * (columns + 1) + j), d = a + 1;
      const auto b = a + static_cast<uint32_t>(columns + 1), c = b + 1;
      if (i > 0) mesh.indices.insert(mesh.indices.end(), {a, d, b});
      if (i < rows - 1) mesh.indices.insert(mesh.indices.end(), {b, d, c});
    }
  }
  return mesh;
}

Texture2D checker_texture() {
  std::vector<Image<glm::u8vec4>> levels{Image<glm::u8vec4>(2048, 1024)};
  for (int row = 0; row < 1024; ++row) {
    for (int x = 0; x < 2048; ++x) {
      const bool light = (((x >> 6) + (row >> 6)) & 1) != 0;
      levels[0].at(x, row) = light ? glm::u8vec4(230, 230, 230, 255) : glm::u8vec4(40, 90, 160, 255);
    }
  }
  while (levels.back().width() > 1) levels.push_back(half_size(levels.back()));
  return Texture2D(levels, TexelFormat::rgba8);
}

std::shared_ptr<const SphereMesh> WorkloadAssets::sphere(int rows, int columns) {
  std::shared_ptr<const SphereMesh>& mesh = spheres_[{rows, columns}];
  if (!mesh) mesh = std::make_shared<const SphereMesh>(sphere_mesh(rows, columns));
  return mesh;
}

std::shared_ptr<const Texture2D> WorkloadAssets::checker() {
  if (!checker_) checker_ = std::make_shared<const Texture2D>(checker_texture());
  return checker_;
}

}  // namespace halfspace
