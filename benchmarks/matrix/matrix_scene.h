// SPDX-License-Identifier: Apache-2.0
//
// Meshes and textures of the matrix.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "halfspace/raster/vertex_input.h"
#include "halfspace/shading/texture/texture.h"
#include "matrix/matrix.h"

namespace halfspace {

struct MatrixVertex {
  glm::vec3 position, normal;
  glm::vec2 uv;
};

/// Data that all draw calls of a row share. Positions are in world space, except for MatrixMesh::triangles and quad (clip space).
struct MatrixScene {
  std::vector<MatrixVertex> vertices;
  std::vector<uint32_t> indices;  ///< 0xffffffff is the restart index
  glm::mat4 clip_from_world{1.0f};
  std::vector<std::shared_ptr<const Texture2D>> textures;  ///< the textures that the row uses, at most eight

  /// Returns part i of the indices, which are divided into n parts.
  std::span<const uint32_t> part(int i, int n) const;
};

MatrixScene matrix_scene(const MatrixRow& row, WorkloadSize size);

/// Returns a half-float texture of the size of the target with colors from 0 to 8, without mip levels.
std::shared_ptr<const Texture2D> matrix_light(WorkloadSize size);

/// Returns the scissor rectangle of rows with half_scissor.
Rect matrix_scissor(WorkloadSize size);

/// Direction to the light.
inline constexpr glm::vec3 kMatrixLight{0.48f, 0.6f, 0.64f};
/// Texture i of a row is repeated 1 + i · kMatrixRepeat times as often as texture 0.
inline constexpr float kMatrixRepeat = 0.25f;
/// Columns and rows of the instances in MatrixMesh::tiles, and their scale.
inline constexpr int kMatrixColumns = 14, kMatrixRows = 7;
inline constexpr float kMatrixScale = 0.125f;

}  // namespace halfspace
