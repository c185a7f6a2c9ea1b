// SPDX-License-Identifier: Apache-2.0
//
// Shadows of a point light: the distances to it in a cube of depths.
#include "mesa/ported/scene.h"

namespace halfspace::test::ported::point_shadow {

// [point_depth]
struct LightDistance {  // drawn once for each face
  glm::mat4 face_from_world;
  glm::vec3 light;
  float far;

  template <class R>
  struct Attributes {
    vec3<R> position;
  };
  template <class R>
  using Varyings = Attributes<R>;
  template <class R>
  vec4<R> vertex(const Attributes<R>& in, Varyings<R>& out) const {
    out = in;
    return face_from_world * vec4<R>(in.position, R(1));
  }
  template <class R>
  DepthFragment<R> fragment(const Varyings<R>& in) const {  // there is no color attachment
    return {vec4<R>(R(0)), MaskOf<R>(true), length(in.position - light) / far};
  }
};
// [end]

constexpr const char* kDistanceVertex = R"glsl(#version 330 core
layout(location = 0) in vec3 position;
uniform mat4 face_from_world;
out vec3 world_position;

void main() {
  world_position = position;
  gl_Position = face_from_world * vec4(position, 1.0);
}
)glsl";

constexpr const char* kDistanceFragment = R"glsl(#version 330 core
in vec3 world_position;
uniform vec3 light;
uniform float far;

void main() { gl_FragDepth = length(world_position - light) / far; }
)glsl";

// [point_shadow]
struct PointShadowed {
  glm::mat4 clip_from_world;
  glm::vec3 light;
  float far;
  TextureCubeView distances;
  Sampler sampler;  // bilinear, CompareOp::less_equal

  template <class R>
  struct Attributes {
    vec3<R> position, normal;
  };
  template <class R>
  using Varyings = Attributes<R>;
  template <class R>
  vec4<R> vertex(const Attributes<R>& in, Varyings<R>& out) const {
    out = in;
    return clip_from_world * vec4<R>(in.position, R(1));
  }
  template <class R>
  Fragment<R> fragment(const Varyings<R>& in) const {
    const vec3<R> from_light = in.position - light;
    const R distance = length(from_light);
    const R lit = distances.sample_compare_level(sampler, from_light, distance / far - 0.01f, R(0));
    const R diffuse = max(dot(normalize(in.normal), -from_light / distance), R(0));
    return {vec4<R>(vec3<R>(0.1f + 0.9f * lit * diffuse), R(1))};
  }
};
// [end]

constexpr const char* kVertex = R"glsl(#version 330 core
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
uniform mat4 clip_from_world;
out vec3 world_position;
out vec3 world_normal;

void main() {
  world_position = position;
  world_normal = normal;
  gl_Position = clip_from_world * vec4(position, 1.0);
}
)glsl";

constexpr const char* kFragment = R"glsl(#version 330 core
in vec3 world_position;
in vec3 world_normal;
uniform vec3 light;
uniform float far;
uniform samplerCubeShadow distances;
out vec4 color;

void main() {
  vec3 from_light = world_position - light;
  float distance = length(from_light);
  float lit = texture(distances, vec4(from_light, distance / far - 0.01));
  float diffuse = max(dot(normalize(world_normal), -from_light / distance), 0.0);
  color = vec4(vec3(0.1 + 0.9 * lit * diffuse), 1.0);
}
)glsl";

TEST_F(Ported, PointShadowsInACube) {
  const Mesh mesh = still_life();
  const glm::vec3 light(0.0f, 1.2f, 1.1f);
  const float far = 8.0f;
  TwinTexture distances(TextureKind::cube, TexelFormat::d32f, {64, 64, 6});
  // [point_faces]
  struct Face {
    glm::dvec3 forward, up;
  };
  const std::array<Face, 6> faces{Face{{1, 0, 0}, {0, -1, 0}},  Face{{-1, 0, 0}, {0, -1, 0}}, Face{{0, 1, 0}, {0, 0, 1}},
                                  Face{{0, -1, 0}, {0, 0, -1}}, Face{{0, 0, 1}, {0, -1, 0}},  Face{{0, 0, -1}, {0, -1, 0}}};
  const glm::dmat4 projection = perspective_gl(glm::radians(90.0), 1.0, 0.05, static_cast<double>(far));
  for (int i = 0; i < 6; ++i) {
    const auto& [forward, up] = faces[static_cast<std::size_t>(i)];
    const LightDistance shader{glm::mat4(projection * look_at(glm::dvec3(light), glm::dvec3(light) + forward, up)), light, far};
    TwinStage stage({}, TwinTarget{distances, glm::vec4(1), i});
    stage.draw(shader, kDistanceVertex, kDistanceFragment, make_vertex_view(stream(mesh.positions)), mesh.indices,
               [&](const UniformSetter& set) {
                 set("face_from_world", shader.face_from_world);
                 set("light", light);
                 set("far", far);
               });
    stage.run();
  }
  // [end]
  const PointShadowed shader{
      camera({-1.5f, 2.5f, 3.0f}), light, far, distances.view<TextureKind::cube>(), {.mag = Filter::bilinear, .min = Filter::bilinear}};
  Flat2D picture(TexelFormat::rgba8), depth(TexelFormat::d32f);
  TwinStage stage({{picture}}, TwinTarget{depth, glm::vec4(1)});
  stage.draw(shader, kVertex, kFragment, make_vertex_view(stream(mesh.positions), stream(mesh.normals)), mesh.indices,
             [&](const UniformSetter& set) {
               set("clip_from_world", shader.clip_from_world);
               set("light", light);
               set("far", far);
               set("distances", distances, shader.sampler, true);
             });
  stage.run();
  expect_same_picture(picture, {2, 0.001, "a comparison flips where a distance is equal to that in the map up to rounding"});
}

}  // namespace halfspace::test::ported::point_shadow
