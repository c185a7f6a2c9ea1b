// SPDX-License-Identifier: Apache-2.0
//
// aniso_floor: a textured plane that reaches almost to the horizon, with anisotropic filtering.
#include "peers/gl/gl_families.h"
#include "peers/gl/gl_workload.h"
#include "workloads/workload_geometry.h"

namespace halfspace::gl {

namespace {

constexpr std::string_view kVertex = R"(
layout(location = 0) in vec3 position_ws;
uniform mat4 clip_from_world;
out vec2 uv;
void main() {
  uv = 0.0625 * position_ws.xz;
  gl_Position = clip_from_world * vec4(position_ws, 1.0);
}
)";
constexpr std::string_view kFragment = R"(
in vec2 uv;
uniform sampler2D map;
out vec4 result;
void main() { result = texture(map, uv); }
)";

class Floor final : public GlWorkload {
 public:
  explicit Floor(const GlInput& in)
      : GlWorkload(in),
        texture_(*in.assets.checker(), GL_REPEAT, 16.0f),
        mesh_(floats_of(std::span<const glm::vec3>(kFloor)), {3}, kRoundTriangles) {
    program_.set("clip_from_world", floor_camera(in.size));
  }
  void draw() override {
    begin();
    texture_.bind();
    program_.use();
    mesh_.draw(GL_TRIANGLES);
  }

 private:
  GlProgram program_{"", kVertex, kFragment};
  GlTexture texture_;
  GlMesh mesh_;
};

}  // namespace

Made floor(const GlInput& in) { return std::make_unique<Floor>(in); }

}  // namespace halfspace::gl
