// SPDX-License-Identifier: Apache-2.0
#include "matrix/matrix_draw.h"
#include "matrix/matrix_shaders.h"
#include "workloads/workload_varyings.h"

namespace halfspace {

namespace {

template <class Target>
void draw_lit(Target& target, const MatrixJob& job) {
  switch (job.row.textures) {
    case 2: return matrix::draw_textured<MatrixLit<2>>(target, job);
    case 4: return matrix::draw_textured<MatrixLit<4>>(target, job);
    case 8: return matrix::draw_textured<MatrixLit<8>>(target, job);
    default: return matrix::draw_textured<MatrixLit<1>>(target, job);
  }
}

template <int N, class Target>
void draw_floats(Target& target, const MatrixJob& job) {
  const auto view = make_vertex_view(stream(job.scene.vertices, &MatrixVertex::position));
  for (const Indices& part : job.parts) matrix::draw_part(target, VaryingsShader<N>{job.scene.clip_from_world}, view, part, job.state);
}

template <class Target>
void draw_varyings(Target& target, const MatrixJob& job) {
  switch (job.row.varyings) {
    case 4: return draw_floats<4>(target, job);
    case 8: return draw_floats<8>(target, job);
    case 16: return draw_floats<16>(target, job);
    default: return draw_floats<0>(target, job);
  }
}

}  // namespace

void draw_matrix_lit(Pass& pass, const MatrixJob& job) {
  if (job.state.instances > 1) return matrix::draw_textured<MatrixInstanced>(pass, job);
  draw_lit(pass, job);
}
void draw_matrix_lit(WorkloadTruth& truth, const MatrixJob& job) { draw_lit(truth, job); }
void draw_matrix_varyings(Pass& pass, const MatrixJob& job) { draw_varyings(pass, job); }
void draw_matrix_varyings(WorkloadTruth& truth, const MatrixJob& job) { draw_varyings(truth, job); }

}  // namespace halfspace
