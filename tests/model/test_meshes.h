// SPDX-License-Identifier: Apache-2.0
//
// Meshes without normals for tests.
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>

#include "halfspace/core/trig_double.h"
#include "halfspace/model/model.h"

namespace halfspace {

/// The cube [−1, 1]^3: 8 vertices and 12 triangles, counter-clockwise from outside. Each consecutive pair of triangles forms a face, in the
/// order x = −1, x = 1, y = −1, y = 1, z = −1, z = 1.
inline ModelMesh cube() {
  ModelMesh mesh;
  for (int i = 0; i < 8; ++i) mesh.positions.emplace_back((i & 1) * 2 - 1, (i >> 1 & 1) * 2 - 1, (i >> 2) * 2 - 1);
  mesh.indices = {0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5, 0, 1, 5, 0, 5, 4, 2, 6, 7, 2, 7, 3, 0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6};
  return mesh;
}

/// A unit sphere around the origin with one vertex at each pole, counter-clockwise from outside.
inline ModelMesh sphere(uint32_t columns, uint32_t rows) {
  ModelMesh mesh;
  mesh.positions.emplace_back(0.0f, 0.0f, 1.0f);
  for (uint32_t r = 1; r < rows; ++r) {
    for (uint32_t c = 0; c < columns; ++c) {
      const double theta = std::numbers::pi * r / rows, phi = 2.0 * std::numbers::pi * c / columns;
      mesh.positions.emplace_back(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta));
    }
  }
  mesh.positions.emplace_back(0.0f, 0.0f, -1.0f);
  const auto last = static_cast<uint32_t>(mesh.positions.size() - 1);
  for (uint32_t c = 0; c < columns; ++c) {
    const uint32_t d = (c + 1) % columns;
    const auto at = [&](uint32_t row, uint32_t column) { return 1 + (row - 1) * columns + column; };
    mesh.indices.insert(mesh.indices.end(), {0, at(1, c), at(1, d)});
    for (uint32_t r = 1; r + 1 < rows; ++r) {
      mesh.indices.insert(mesh.indices.end(), {at(r, c), at(r + 1, c), at(r + 1, d), at(r, c), at(r + 1, d), at(r, d)});
    }
    mesh.indices.insert(mesh.indices.end(), {at(rows - 1, c), last, at(rows - 1, d)});
  }
  return mesh;
}

/// A stone with knobs around the origin: a sphere() whose radius varies from 0.75 to 1.25. The normals are the positions, because only the
/// outline matters.
inline ModelMesh stone(uint32_t columns, uint32_t rows) {
  ModelMesh mesh = sphere(columns, rows);
  for (glm::vec3& p : mesh.positions) {
    const auto wave = [](float turns, float x) { return static_cast<float>(sincos_turns(std::fabs(turns * x)).cos); };
    p *= 1.0f + 0.2f * wave(0.7f, p.x) * wave(0.9f, p.y) + 0.05f * wave(2.0f, p.y) * wave(2.5f, p.z);
  }
  mesh.normals = mesh.positions;
  return mesh;
}

}  // namespace halfspace
