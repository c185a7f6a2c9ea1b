// SPDX-License-Identifier: Apache-2.0
//
// shadow_200k: renders a depth map from the light, then an image that reads nine depth-map texels per pixel.
#include "peers/gl/gl_families.h"
#include "peers/gl/gl_workload.h"
#include "peers/gl/glsl_light.h"
#include "workloads/workload_geometry.h"
#include "workloads/workload_shadow.h"

namespace halfspace::gl {

namespace {

constexpr std::string_view kDepthVertex = R"(
layout(location = 0) in vec3 position;
uniform mat4 light_from_world;
void main() { gl_Position = light_from_world * vec4(position, 1.0); }
)";
constexpr std::string_view kNothing = "void main() {}\n";

constexpr std::string_view kVertex = R"(
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
uniform mat4 clip_from_world;
out vec3 position_ws, normal_ws;
void main() {
  position_ws = position;
  normal_ws = normal;
  gl_Position = clip_from_world * vec4(position, 1.0);
}
)";
constexpr std::string_view kFragment = R"(
in vec3 position_ws, normal_ws;
uniform mat4 light_from_world;
uniform vec3 eye_ws, to_light_ws, base;
uniform sampler2D map;
out vec4 result;
void main() {
  vec2 light = blinn_phong(normal_ws, to_light_ws, normalize(eye_ws - position_ws));
  float seen = unoccluded_fraction(map, light_from_world, 0.004, position_ws);
  result = vec4(base * (0.08 + seen * (light.x - 0.08)) + seen * light.y, 1.0);
}
)";

class Shadowed final : public GlWorkload {
 public:
  explicit Shadowed(const GlInput& in) : Shadowed(in, *in.assets.sphere(k200k.rows, k200k.columns), shadow_cameras(in.size)) {}

  void draw() override {
    map_.bind();
    map_.clear(glm::vec4(0));
    depth_program_.use();
    sphere_.draw(GL_TRIANGLES);
    begin();
    map_.bind_depth();
    program_.set("base", kShadowSphereBase);
    sphere_.draw(GL_TRIANGLES);
    program_.set("base", kShadowPlaneBase);
    plane_.draw(GL_TRIANGLES);
  }

 private:
  Shadowed(const GlInput& in, const SphereMesh& mesh, const ShadowCameras& cameras)
      : GlWorkload(in),
        map_({kShadowMapSize, kShadowMapSize}, 0, true),
        sphere_(floats_of(std::span<const SphereVertex>(mesh.vertices)), {3, 3, 2}, mesh.indices),
        plane_(floats_of(std::span<const PlaneVertex>(kShadowPlane)), {3, 3}, kRoundTriangles) {
    depth_program_.set("light_from_world", cameras.light_from_world);
    program_.set("light_from_world", cameras.light_from_world);
    program_.set("clip_from_world", cameras.clip_from_world);
    program_.set("eye_ws", cameras.eye_ws);
    program_.set("to_light_ws", cameras.to_light_ws);
  }

  GlTarget map_;
  GlProgram depth_program_{"", kDepthVertex, kNothing};
  GlProgram program_{std::string(kGlslLight) + std::string(kGlslShadow), kVertex, kFragment};
  GlMesh sphere_, plane_;
};

}  // namespace

Made shadow(const GlInput& in) { return std::make_unique<Shadowed>(in); }

}  // namespace halfspace::gl
