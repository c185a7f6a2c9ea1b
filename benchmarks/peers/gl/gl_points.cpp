// SPDX-License-Identifier: Apache-2.0
//
// points_100k: point sprites that are shaded as spheres and write depth.
#include "peers/gl/gl_families.h"
#include "peers/gl/gl_workload.h"
#include "peers/gl/glsl_light.h"
#include "workloads/workload_geometry.h"

namespace halfspace::gl {

namespace {

constexpr std::string_view kVertex = R"(
layout(location = 0) in vec3 position_ws;
uniform mat4 clip_from_world;
uniform vec3 eye_ws;
uniform float size_at_w1;
flat out vec3 center_es, base;
void main() {
  center_es = position_ws - eye_ws;
  base = 0.5 + 0.5 * position_ws;
  gl_Position = clip_from_world * vec4(position_ws, 1.0);
  gl_PointSize = size_at_w1 / gl_Position.w;
}
)";
constexpr std::string_view kFragment = R"(
flat in vec3 center_es, base;
uniform float radius, depth_a, depth_b;
uniform vec3 light_es;
out vec4 result;
void main() {
  vec2 d = vec2(2.0 * gl_PointCoord.x - 1.0, 1.0 - 2.0 * gl_PointCoord.y);
  float squared = dot(d, d);
  if (squared > 1.0) discard;
  vec3 n = vec3(d, sqrt(1.0 - squared)), p = center_es + radius * n;
  gl_FragDepth = 0.5 - 0.5 * (depth_a * p.z + depth_b) / p.z;
  vec2 light = phong(n, normalize(light_es - p), normalize(-p));
  result = vec4(base * light.x + light.y, 1.0);
}
)";

class Points final : public GlWorkload {
 public:
  explicit Points(const GlInput& in) : GlWorkload(in), mesh_(floats_of(std::span<const glm::vec3>(point_cloud())), {3}) {
    const PointShader shader = point_shader(in.size);
    program_.set("clip_from_world", shader.clip_from_world);
    program_.set("eye_ws", shader.eye_ws);
    program_.set("size_at_w1", shader.size_at_w1);
    program_.set("radius", shader.radius);
    program_.set("depth_a", shader.depth_a);
    program_.set("depth_b", shader.depth_b);
    program_.set("light_es", shader.light_es);
  }
  void draw() override {
    begin();
    glEnable(GL_PROGRAM_POINT_SIZE);
    program_.use();
    mesh_.draw(GL_POINTS);
  }

 private:
  GlProgram program_{kGlslLight, kVertex, kFragment};
  GlMesh mesh_;
};

}  // namespace

Made points(const GlInput& in) { return std::make_unique<Points>(in); }

}  // namespace halfspace::gl
