// SPDX-License-Identifier: Apache-2.0
//
// sphere_phong, sphere_gouraud, sphere_flat, near_clip, msaa4_200k, and hdr_200k and tonemap, which draw to half-float targets.
#include "peers/gl/gl_families.h"
#include "peers/gl/gl_workload.h"
#include "peers/gl/glsl_light.h"
#include "workloads/workload_geometry.h"

namespace halfspace::gl {

namespace {

constexpr std::string_view kVertex = R"(
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec2 coordinates;
uniform mat4 clip_from_world;
out vec2 uv;
#ifdef LIGHT_OF_VERTEX
uniform vec3 eye_ws, light_ws;
LIGHT_OF_VERTEX out vec2 light;
#else
out vec3 position_ws, normal_ws;
#endif
void main() {
  uv = coordinates;
#ifdef LIGHT_OF_VERTEX
  light = blinn_phong(normal, normalize(light_ws - position), normalize(eye_ws - position));
#else
  position_ws = position;
  normal_ws = normal;
#endif
  gl_Position = clip_from_world * vec4(position, 1.0);
}
)";
constexpr std::string_view kFragment = R"(
in vec2 uv;
uniform sampler2D map;
#ifdef LIGHT_OF_VERTEX
LIGHT_OF_VERTEX in vec2 light;
#else
uniform vec3 eye_ws, light_ws;
in vec3 position_ws, normal_ws;
#endif
out vec4 result;
void main() {
#ifndef LIGHT_OF_VERTEX
  vec2 light = blinn_phong(normal_ws, normalize(light_ws - position_ws), normalize(eye_ws - position_ws));
#endif
  result = vec4((texture(map, uv).rgb * light.x + light.y) * BRIGHTNESS, 1.0);
}
)";

std::string shared_glsl(Light light, bool bright) {
  std::string text(kGlslLight);
  if (light == Light::vertex) text += "#define LIGHT_OF_VERTEX smooth\n";
  if (light == Light::flat) text += "#define LIGHT_OF_VERTEX flat\n";
  return text + (bright ? "#define BRIGHTNESS 8.0\n" : "#define BRIGHTNESS 1.0\n");
}

// The mesh, texture and program of a sphere. Draws to the bound target.
class SphereDrawing {
 public:
  SphereDrawing(const SphereUniforms& uniforms, const SphereMesh& mesh, Light light, bool bright = false)
      : program_(shared_glsl(light, bright), kVertex, kFragment),
        texture_(*uniforms.texture, GL_CLAMP_TO_EDGE),
        mesh_(floats_of(std::span<const SphereVertex>(mesh.vertices)), {3, 3, 2}, mesh.indices) {
    program_.set("clip_from_world", uniforms.clip_from_world);
    program_.set("eye_ws", uniforms.eye_ws);
    program_.set("light_ws", uniforms.light_ws);
  }
  void draw() const {
    program_.use();
    texture_.bind();
    mesh_.draw(GL_TRIANGLES);
  }

 private:
  GlProgram program_;
  GlTexture texture_;
  GlMesh mesh_;
};

class Sphere final : public GlWorkload {
 public:
  Sphere(const GlInput& in, const SphereUniforms& uniforms, Light light, SphereDetail detail, bool culled)
      : GlWorkload(in), drawing_(uniforms, *in.assets.sphere(detail.rows, detail.columns), light), culled_(culled) {}
  void draw() override {
    begin();
    if (!culled_) glDisable(GL_CULL_FACE);
    drawing_.draw();
  }

 private:
  SphereDrawing drawing_;
  bool culled_;
};

// Draws with four samples per pixel and resolves them to the image.
class MultisampledSphere final : public GlWorkload {
 public:
  explicit MultisampledSphere(const GlInput& in)
      : GlWorkload(in, false),
        samples_(in.size, GL_RGBA8, true, 4),
        drawing_(sphere_uniforms(in.size, *in.assets.checker()), *in.assets.sphere(k200k.rows, k200k.columns), Light::pixel) {}
  void draw() override {
    samples_.bind();
    samples_.clear(kBackground);
    drawing_.draw();
    samples_.resolve_into(target());
  }

 private:
  GlTarget samples_;
  SphereDrawing drawing_;
};

constexpr std::string_view kFullVertex = R"(
void main() {
  vec2 corner = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
  gl_Position = vec4(corner, 0.0, 1.0);
}
)";
constexpr std::string_view kToneFragment = R"(
uniform sampler2D hdr;
out vec4 result;
void main() {
  vec3 c = 0.8 * texelFetch(hdr, ivec2(gl_FragCoord.xy), 0).rgb;
  result = vec4(pow(c / (1.0 + c), vec3(1.0 / 2.2)), 1.0);
}
)";

class Hdr final : public GlWorkload {
 public:
  Hdr(const GlInput& in, bool tone_alone)
      : GlWorkload(in, false),
        light_(in.size, GL_RGBA16F, true),
        drawing_(sphere_uniforms(in.size, *in.assets.checker()), *in.assets.sphere(k200k.rows, k200k.columns), Light::pixel, true),
        empty_(std::array<float, 3>{}, {1}),
        tone_alone_(tone_alone) {
    draw_light();
  }
  void draw() override {
    if (!tone_alone_) draw_light();
    target().bind();
    light_.bind_color();
    tone_.use();
    empty_.draw(GL_TRIANGLES);
  }

 private:
  void draw_light() const {
    light_.bind();
    light_.clear({0.4f, 0.6f, 1.5f, 1.0f});
    drawing_.draw();
  }
  GlTarget light_;
  SphereDrawing drawing_;
  GlProgram tone_{"", kFullVertex, kToneFragment};
  GlMesh empty_;  // three vertices; the shader only reads gl_VertexID
  bool tone_alone_;
};

}  // namespace

Made sphere(const GlInput& in, Light light, SphereDetail detail) {
  return std::make_unique<Sphere>(in, sphere_uniforms(in.size, *in.assets.checker()), light, detail, true);
}
Made multisampled_sphere(const GlInput& in) { return std::make_unique<MultisampledSphere>(in); }
Made near_clip(const GlInput& in) {
  return std::make_unique<Sphere>(in, near_clip_uniforms(in.size, *in.assets.checker()), Light::pixel, k200k, false);
}
Made hdr(const GlInput& in) { return std::make_unique<Hdr>(in, false); }
Made tonemap(const GlInput& in) { return std::make_unique<Hdr>(in, true); }

}  // namespace halfspace::gl
