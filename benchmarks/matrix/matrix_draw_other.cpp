// SPDX-License-Identifier: Apache-2.0
#include "matrix/matrix_draw.h"
#include "matrix/matrix_shaders.h"

namespace halfspace {

void draw_matrix_blended(Pass& pass, const MatrixJob& job) {
  if (job.row.shader == MatrixShader::dual) return matrix::draw_textured<MatrixDual>(pass, job);
  if (job.row.shader == MatrixShader::tint) return matrix::draw_textured<MatrixTint>(pass, job);
  matrix::draw_textured<MatrixAlpha>(pass, job);
}

void draw_matrix_decided(Pass& pass, const MatrixJob& job) {
  switch (job.row.shader) {
    case MatrixShader::holes: return matrix::draw_textured<MatrixHoles>(pass, job);
    case MatrixShader::holes_visible: return matrix::draw_textured<MatrixHolesVisible>(pass, job);
    case MatrixShader::depth: return matrix::draw_textured<MatrixDepth>(pass, job);
    default: return matrix::draw_textured<MatrixDepthVisible>(pass, job);
  }
}

void draw_matrix_full_screen(Pass& pass, const MatrixJob& job) {
  switch (job.row.shader) {
    case MatrixShader::color: return matrix::draw_textured<MatrixPassColor>(pass, job);
    case MatrixShader::texture: return matrix::draw_textured<MatrixPassTexture>(pass, job);
    case MatrixShader::tone: return matrix::draw_textured<MatrixPassTone>(pass, job);
    default: break;
  }
  const auto view = make_vertex_view(stream(job.scene.vertices, &MatrixVertex::position));
  for (const Indices& part : job.parts) pass.draw(ConstantShader{{0.25f, 0.5f, 0.75f, 1.0f}}, view, part, job.state);
}

}  // namespace halfspace
