// SPDX-License-Identifier: Apache-2.0
#include "peers/gl/gl_matrix.h"

#include <fmt/format.h>

#include <memory>
#include <optional>

#include "matrix/matrix_scene.h"
#include "peers/gl/gl_enums.h"
#include "peers/gl/gl_matrix_glsl.h"
#include "peers/gl/gl_objects.h"
#include "peers/gl/gl_state.h"
#include "workloads/workload_assets.h"
#include "workloads/workload_canvas.h"

namespace halfspace {

namespace {

// Returns the macros that select the parts of the shaders.
std::string macros_of(const MatrixRow& row) {
  const auto list = [](std::string_view name, std::string_view entry, int count) {
    std::string text = fmt::format("#define {}", name);
    for (int i = 0; i < count; ++i) text += fmt::format(" {}({})", entry, i);
    return text + "\n";
  };
  std::string text = fmt::format("#define LIGHT vec3({:.9f}, {:.9f}, {:.9f})\n#define REPEAT {:.9f}\n", kMatrixLight.x, kMatrixLight.y,
                                 kMatrixLight.z, kMatrixRepeat);
  if (row.mesh == MatrixMesh::tiles) {
    text += fmt::format("#define INSTANCED\n#define COLUMNS {}\n#define ROWS {}\n#define SCALE {:.9f}\n", kMatrixColumns, kMatrixRows,
                        kMatrixScale);
  }
  switch (row.shader) {
    case MatrixShader::lit: return text + fmt::format("#define LIT {}\n", row.textures) + list("ALL_LOOKUPS", "LOOKUP", row.textures);
    case MatrixShader::varyings:
      return text + fmt::format("#define VARYINGS {}\n", row.varyings) + list("ALL_VARYINGS", "VARYING", row.varyings / 4);
    case MatrixShader::alpha: return text + "#define ALPHA\n";
    case MatrixShader::tint: return text + "#define TINT\n";
    case MatrixShader::dual: return text + "#define DUAL\n";
    case MatrixShader::holes:
    case MatrixShader::holes_visible: return text + "#define HOLES\n";
    case MatrixShader::depth:
    case MatrixShader::depth_visible: return text + "#define DEPTH\n";
    case MatrixShader::constant: return text + "#define CONSTANT\n";
    case MatrixShader::color: return text + "#define COLOR\n";
    case MatrixShader::texture: return text + "#define TEXTURE\n";
    case MatrixShader::tone: return text + "#define TONE\n";
  }
  return text;
}

class GlMatrix final : public Workload {
 public:
  GlMatrix(const MatrixRow& row, const WorkloadKind& twin, WorkloadSize size)
      : row_(row),
        twin_(twin),
        size_(size),
        scene_(matrix_scene(row, size)),
        target_(size, gl_color_format(row.color), gl_depth_format(depth_format()), row.samples),
        program_(macros_of(row), kMatrixVertex, kMatrixFragment),
        mesh_(floats_of(std::span<const MatrixVertex>(scene_.vertices)), {3, 3, 2}, scene_.indices) {
    if (row.samples > 1) resolved_.emplace(size, gl_color_format(row.color), 0u);
    if (row.shader == MatrixShader::tone) scene_.textures.assign(1, matrix_light(size));
    for (const auto& texels : scene_.textures) {
      textures_.push_back(std::make_unique<GlTexture>(*texels, row.sampler));
    }
    if (!is_constant()) {
      for (int i = 0; i < row.textures; ++i) program_.set(fmt::format("maps[{}]", i).c_str(), i);
    }
    if (row.shader == MatrixShader::holes || row.shader == MatrixShader::holes_visible) program_.set("threshold", row.threshold);
    program_.set("clip_from_world", scene_.clip_from_world);
    state_ = row.state;
    if (row.half_scissor) state_.scissor = matrix_scissor(size);
  }

  void frame(const Workers&) override {
    target_.bind();
    glDisable(GL_SCISSOR_TEST);
    (row_.color == ColorFormat::srgb8a8 ? glEnable : glDisable)(GL_FRAMEBUFFER_SRGB);
    if (row_.depth == DepthFormat::d24s8) glStencilMask(0xff);
    target_.clear(kBackground);
    set_gl_state(state_, depth_format() != DepthFormat::none);
    (row_.mesh == MatrixMesh::strips ? glEnable : glDisable)(GL_PRIMITIVE_RESTART);
    glPrimitiveRestartIndex(0xffffffffu);
    program_.use();
    for (int i = 0; i < row_.draws; ++i) draw_part(i);
    if (resolved_) target_.resolve_into(*resolved_);
    glFinish();
  }

  WorkloadPicture picture() const override {
    color_ = (resolved_ ? *resolved_ : target_).read_color();
    if (depth_format() != DepthFormat::d32f || row_.samples > 1) return {&color_, nullptr};
    depth_ = target_.read_depth();
    return {&color_, &depth_};
  }
  bool has_truth() const override { return false; }  // this picture is compared with Halfspace's, and that one with the reference
  WorkloadTruth truth() const override { return make_twin()->truth(); }
  std::unique_ptr<Workload> twin() const override { return row_.is_comparable ? make_twin() : nullptr; }

 private:
  std::unique_ptr<Workload> make_twin() const {
    WorkloadAssets assets;
    return twin_.prepare(size_, assets);
  }
  // The texture lookups do not depend on these shaders' uniforms.
  bool is_constant() const {
    return row_.shader == MatrixShader::varyings || row_.shader == MatrixShader::constant || row_.shader == MatrixShader::color ||
           row_.shader == MatrixShader::tint;
  }
  DepthFormat depth_format() const { return row_.mesh == MatrixMesh::quad ? DepthFormat::none : row_.depth; }

  void draw_part(int i) const {
    const std::size_t count = textures_.size();
    for (std::size_t k = 0; k < static_cast<std::size_t>(row_.textures) && !is_constant(); ++k) {
      glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(k));
      textures_[(static_cast<std::size_t>(i) + k) % count]->bind();
    }
    glActiveTexture(GL_TEXTURE0);
    const std::span<const uint32_t> part = scene_.part(i, row_.draws);
    mesh_.draw_part(gl(row_.state.topology), static_cast<std::size_t>(part.data() - scene_.indices.data()), part.size(),
                    row_.state.instances);
  }

  const MatrixRow& row_;
  const WorkloadKind& twin_;
  WorkloadSize size_;
  MatrixScene scene_;
  GlTarget target_;
  std::optional<GlTarget> resolved_;
  GlProgram program_;
  GlMesh mesh_;
  std::vector<std::unique_ptr<GlTexture>> textures_;
  DrawState state_;
  mutable Image<glm::u8vec4> color_;  // the images last read by picture()
  mutable Image<float> depth_;
};

}  // namespace

std::span<const WorkloadKind> gl_matrix_workloads() {
  static const std::vector<WorkloadKind> kinds = [] {
    std::vector<WorkloadKind> all;
    for (std::size_t i = 0; i < matrix_rows().size(); ++i) {
      const WorkloadKind& twin = matrix_workloads()[i];
      const MatrixRow& row = matrix_rows()[i];
      all.push_back({twin.name, twin.what,
                     [&row, &twin](WorkloadSize size, WorkloadAssets&) { return std::make_unique<GlMatrix>(row, twin, size); }});
    }
    return all;
  }();
  return kinds;
}

}  // namespace halfspace
