// SPDX-License-Identifier: Apache-2.0
//
// Draws a row of the matrix in a pass, or with the naive pipeline in double precision as the reference.
#pragma once

#include "halfspace/raster/pass.h"
#include "matrix/matrix_scene.h"
#include "workloads/workload_constant.h"

namespace halfspace {

/// A row and the data of its draw calls.
struct MatrixJob {
  const MatrixRow& row;
  const MatrixScene& scene;
  std::vector<Indices> parts;  ///< one per draw call
  DrawState state;
};

/// These functions add the draw calls of a row. Each of them supports some of the fragment functions.
void draw_matrix_lit(Pass& pass, const MatrixJob& job);
void draw_matrix_blended(Pass& pass, const MatrixJob& job);  ///< alpha, tint and dual
void draw_matrix_decided(Pass& pass, const MatrixJob& job);  ///< holes and depth, with and without visibility
void draw_matrix_varyings(Pass& pass, const MatrixJob& job);
void draw_matrix_full_screen(Pass& pass, const MatrixJob& job);

/// Draws lit and varyings in double precision.
void draw_matrix_lit(WorkloadTruth& truth, const MatrixJob& job);
void draw_matrix_varyings(WorkloadTruth& truth, const MatrixJob& job);

namespace matrix {

template <class S, class V>
void draw_part(Pass& pass, const S& shader, const V& vertices, const Indices& indices, const DrawState& state) {
  pass.draw(shader, vertices, indices, state);
}
template <class S, class V>
void draw_part(WorkloadTruth& truth, const S& shader, const V& vertices, const Indices& indices, const DrawState& state) {
  draw_naive(truth, shader, vertices, indices, state);
}

/// Draws all parts with a shader that derives from MatrixUniforms. The textures of part i start with texture i.
template <class S, class Target>
void draw_textured(Target& target, const MatrixJob& job) {
  const std::vector<MatrixVertex>& v = job.scene.vertices;
  const auto view = make_vertex_view(stream(v, &MatrixVertex::position), stream(v, &MatrixVertex::normal), stream(v, &MatrixVertex::uv));
  S shader{};
  shader.clip_from_world = job.scene.clip_from_world;
  shader.sampler = job.row.sampler;
  shader.threshold = job.row.threshold;
  for (std::size_t i = 0; i < job.parts.size(); ++i) {
    for (std::size_t k = 0; k < shader.maps.size(); ++k) shader.maps[k] = job.scene.textures[(i + k) % job.scene.textures.size()].get();
    draw_part(target, shader, view, job.parts[i], job.state);
  }
}

}  // namespace matrix

}  // namespace halfspace
