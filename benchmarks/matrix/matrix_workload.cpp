// SPDX-License-Identifier: Apache-2.0
//
// The rows of the matrix as workloads, drawn by Halfspace.
#include "halfspace/core/half.h"
#include "matrix/matrix_draw.h"
#include "workloads/picture_errors.h"
#include "workloads/workload_canvas.h"

namespace halfspace {

namespace {

// Returns the scene of a row. Full-screen tone mapping reads a half-float picture instead of the textures.
MatrixScene scene_of(const MatrixRow& row, WorkloadSize size) {
  MatrixScene scene = matrix_scene(row, size);
  if (row.shader == MatrixShader::tone) scene.textures.assign(1, matrix_light(size));
  return scene;
}

class MatrixWorkload final : public Workload {
 public:
  MatrixWorkload(const MatrixRow& row, WorkloadSize size)
      : row_(row),
        scene_(scene_of(row, size)),
        job_{row_, scene_, {}, row.state},
        color_(size.width, size.height),
        half_(row.color == ColorFormat::rgba16f ? size.width : 0, row.color == ColorFormat::rgba16f ? size.height : 0),
        depth_(size.width, size.height) {
    const PrimitiveRestart restart = row.mesh == MatrixMesh::strips ? PrimitiveRestart::on : PrimitiveRestart::off;
    for (int i = 0; i < row.draws; ++i) job_.parts.emplace_back(scene_.part(i, row.draws), scene_.vertices.size(), restart);
    if (row.half_scissor) job_.state.scissor = matrix_scissor(size);
  }

  void frame(const Workers& workers) override {
    Pass pass(color_.width(), color_.height(), color_target(), depth_target(), {.samples = row_.samples});
    switch (row_.shader) {
      case MatrixShader::lit: draw_matrix_lit(pass, job_); break;
      case MatrixShader::varyings: draw_matrix_varyings(pass, job_); break;
      case MatrixShader::alpha:
      case MatrixShader::tint:
      case MatrixShader::dual: draw_matrix_blended(pass, job_); break;
      case MatrixShader::constant:
      case MatrixShader::color:
      case MatrixShader::texture:
      case MatrixShader::tone: draw_matrix_full_screen(pass, job_); break;
      default: draw_matrix_decided(pass, job_); break;
    }
    pass.run(workers);
  }

  WorkloadPicture picture() const override {
    for (std::size_t i = 0; i < half_.texels().size(); ++i) {
      for (int k = 0; k < 4; ++k) {
        const float value = std::clamp(half_to_float(half_.data()[i][k]), 0.0f, 1.0f);
        color_.data()[i][k] = static_cast<uint8_t>(std::lround(255.0f * value));
      }
    }
    const bool has_depth = row_.mesh != MatrixMesh::quad && row_.depth == DepthFormat::d32f && row_.samples == 1;
    return {&color_, has_depth ? &depth_ : nullptr};
  }

  bool has_truth() const override { return row_.is_exact; }
  WorkloadTruth truth() const override {
    WorkloadTruth truth(color_.width(), color_.height(), vec4<double>(glm::dvec4(kBackground)), 1.0);
    if (row_.shader == MatrixShader::varyings) {
      draw_matrix_varyings(truth, job_);
    } else {
      draw_matrix_lit(truth, job_);
    }
    return truth;
  }

 private:
  ColorTarget color_target() {
    ColorTarget target = row_.color == ColorFormat::rgba16f ? rgba16f_target(half_) : rgba8_target(color_);
    target.format = row_.color;
    target.clear_value = kBackground;
    return target;
  }
  // Depth is stored only if it is compared with a reference. Applications that do not use it after drawing would not store it either.
  DepthTarget depth_target() {
    if (row_.mesh == MatrixMesh::quad) return {};
    if (row_.depth == DepthFormat::d32f && row_.samples == 1) return d32f_target(depth_);
    return {.format = row_.depth};
  }

  const MatrixRow& row_;
  MatrixScene scene_;
  MatrixJob job_;
  mutable Image<glm::u8vec4> color_;
  Image<U16Vec4> half_;
  Image<float> depth_;
};

}  // namespace

std::span<const WorkloadKind> matrix_workloads() {
  static const std::vector<WorkloadKind> kinds = [] {
    std::vector<WorkloadKind> all;
    for (const MatrixRow& row : matrix_rows()) {
      all.push_back({std::string(row.name), std::string(row.what),
                     [&row](WorkloadSize size, WorkloadAssets&) { return std::make_unique<MatrixWorkload>(row, size); }});
    }
    return all;
  }();
  return kinds;
}

}  // namespace halfspace
