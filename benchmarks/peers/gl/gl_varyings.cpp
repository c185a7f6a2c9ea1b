// SPDX-License-Identifier: Apache-2.0
//
// The series varyings: interpolates float varyings (see workload_varyings.h).
#include <fmt/format.h>

#include "peers/gl/gl_families.h"
#include "peers/gl/gl_workload.h"

namespace halfspace::gl {

namespace {

constexpr std::string_view kVertex = R"(
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec2 coordinates;
uniform mat4 clip_from_world;
#if VECTORS > 0
out vec4 v[VECTORS];
#endif
void main() {
#if VECTORS > 0
  for (int i = 0; i < VECTORS; ++i) v[i] = position.xyzx / float(i + 1);
#endif
  gl_Position = clip_from_world * vec4(position, 1.0);
}
)";
constexpr std::string_view kFragment = R"(
#if VECTORS > 0
in vec4 v[VECTORS];
#endif
out vec4 result;
void main() {
  float mean = 0.5;
#if VECTORS > 0
  for (int i = 0; i < VECTORS; ++i) mean += dot(v[i], vec4(0.25 / float(VECTORS)));
#endif
  result = vec4(vec3(mean), 1.0);
}
)";

class Varyings final : public GlWorkload {
 public:
  Varyings(const GlInput& in, int count, const SphereMesh& mesh)
      : GlWorkload(in),
        program_(fmt::format("#define VECTORS {}\n", count / 4), kVertex, kFragment),
        mesh_(floats_of(std::span<const SphereVertex>(mesh.vertices)), {3, 3, 2}, mesh.indices) {
    program_.set("clip_from_world", sphere_uniforms(in.size, *in.assets.checker()).clip_from_world);
  }
  void draw() override {
    begin();
    program_.use();
    mesh_.draw(GL_TRIANGLES);
  }

 private:
  GlProgram program_;
  GlMesh mesh_;
};

}  // namespace

Made varyings(const GlInput& in, int count) { return std::make_unique<Varyings>(in, count, *in.assets.sphere(k20k.rows, k20k.columns)); }

}  // namespace halfspace::gl
