// SPDX-License-Identifier: Apache-2.0
//
// layers_b2f, layers_f2b, blend_10, alpha_test, depth_prepass: ten quads over the whole image.
#include <optional>

#include "peers/gl/gl_families.h"
#include "peers/gl/gl_workload.h"
#include "peers/gl/glsl_light.h"
#include "workloads/layer_mesh.h"

namespace halfspace::gl {

namespace {

constexpr std::string_view kVertex = R"(
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec3 color;
uniform mat4 clip_from_eye;
out vec3 position_es, normal_es, base;
#ifdef PERFORATED
out vec2 uv;
#endif
void main() {
  position_es = position;
  normal_es = normal;
  base = color;
#ifdef PERFORATED
  uv = 0.3 * position.xy + vec2(0.05 * position.z);
#endif
  gl_Position = clip_from_eye * vec4(position, 1.0);
}
)";
constexpr std::string_view kFragment = R"(
in vec3 position_es, normal_es, base;
uniform vec3 light_es;
#ifdef PERFORATED
in vec2 uv;
uniform sampler2D holes;
#endif
out vec4 result;
void main() {
#ifdef PERFORATED
  if (texture(holes, uv).x < 0.5) discard;
#endif
  vec2 light = phong(normalize(normal_es), normalize(light_es - position_es), normalize(-position_es));
  result = vec4(base * light.x + light.y, ALPHA);
}
)";
constexpr std::string_view kNothing = "void main() {}\n";

std::string shared_glsl(Layers kind) {
  std::string text(kGlslLight);
  text += kind == Layers::blended ? "#define ALPHA 0.5\n" : "#define ALPHA 1.0\n";
  if (kind == Layers::perforated) text += "#define PERFORATED\n";
  return text;
}

class LayerWorkload final : public GlWorkload {
 public:
  LayerWorkload(const GlInput& in, Layers kind, bool front_to_back, int count)
      : GlWorkload(in),
        kind_(kind),
        program_(shared_glsl(kind), kVertex, kFragment),
        mesh_(floats_of(std::span<const LayerMesh::value_type>(layer_mesh(in.size, front_to_back, count))), {3, 3, 3}) {
    const LayerShader shader = layer_shader(in.size);
    program_.set("clip_from_eye", shader.clip_from_eye);
    program_.set("light_es", shader.light_es);
    if (kind == Layers::perforated) texture_.emplace(*in.assets.checker(), GL_REPEAT);
    if (kind == Layers::prepass) {
      depth_program_.emplace(shared_glsl(kind), kVertex, kNothing);
      depth_program_->set("clip_from_eye", shader.clip_from_eye);
    }
  }
  void draw() override {
    begin();
    if (depth_program_) {
      glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
      depth_program_->use();
      mesh_.draw(GL_TRIANGLES);
      glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
      glDepthFunc(GL_EQUAL);
      glDepthMask(GL_FALSE);
    }
    if (kind_ == Layers::blended) {
      glEnable(GL_BLEND);
      glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
      glDepthMask(GL_FALSE);
    }
    if (texture_) texture_->bind();
    program_.use();
    mesh_.draw(GL_TRIANGLES);
  }

 private:
  Layers kind_;
  GlProgram program_;
  std::optional<GlProgram> depth_program_;
  std::optional<GlTexture> texture_;
  GlMesh mesh_;
};

}  // namespace

Made layers(const GlInput& in, Layers kind, bool front_to_back, int count) {
  return std::make_unique<LayerWorkload>(in, kind, front_to_back, count);
}

}  // namespace halfspace::gl
