// SPDX-License-Identifier: Apache-2.0
//
// Ambient occlusion in screen space, from positions and normals in view space.
#include "mesa/ported/scene.h"

namespace halfspace::test::ported::ssao {

// [ssao_geometry]
struct ViewGeometry {
  glm::mat4 view_from_world, projection;

  template <class R>
  struct Attributes {
    vec3<R> position, normal;
  };
  template <class R>
  struct Varyings {
    vec3<R> position, normal;  // in view space
  };
  template <class R>
  vec4<R> vertex(const Attributes<R>& in, Varyings<R>& out) const {
    const vec4<R> position = view_from_world * vec4<R>(in.position, R(1));
    out.position = vec3<R>(position);
    out.normal = glm::mat3(view_from_world) * in.normal;
    return projection * position;
  }
  template <class R>
  FragmentMRT<R, 2> fragment(const Varyings<R>& in) const {
    return {{vec4<R>(in.position, R(1)), vec4<R>(normalize(in.normal), R(1))}};
  }
};
// [end]

constexpr const char* kGeometryVertex = R"glsl(#version 330 core
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
uniform mat4 view_from_world, projection;
out vec3 view_position;
out vec3 view_normal;

void main() {
  vec4 p = view_from_world * vec4(position, 1.0);
  view_position = p.xyz;
  view_normal = mat3(view_from_world) * normal;
  gl_Position = projection * p;
}
)glsl";

constexpr const char* kGeometryFragment = R"glsl(#version 330 core
in vec3 view_position;
in vec3 view_normal;
layout(location = 0) out vec4 g_position;
layout(location = 1) out vec4 g_normal;

void main() {
  g_position = vec4(view_position, 1.0);
  g_normal = vec4(normalize(view_normal), 1.0);
}
)glsl";

// [ssao]
struct Occlusion : FullScreen {
  glm::mat4 projection;
  std::array<glm::vec3, 16> kernel;  // in a half sphere around +z
  Texture2DView positions, normals, turns;
  Sampler nearest;  // clamped, for positions and normals
  Sampler tiled;    // repeated, for the random turns
  float radius, tiles;

  template <class R>
  Fragment<R> fragment(const Varyings<R>& in) const {
    const vec3<R> position(positions.sample_level(nearest, in.uv, R(0)));
    const vec3<R> normal(normals.sample_level(nearest, in.uv, R(0)));
    const vec3<R> turn(turns.sample_level(tiled, in.uv * tiles, R(0)));
    const vec3<R> tangent = normalize(turn - normal * dot(turn, normal));
    const mat3<R> frame(tangent, cross(normal, tangent), normal);
    R occlusion(0);
    for (const glm::vec3& offset : kernel) {
      const vec3<R> sample = position + frame * vec3<R>(offset) * radius;
      const vec4<R> clip = projection * vec4<R>(sample, R(1));
      const vec2<R> uv = vec2<R>(clip) / clip.w * 0.5f + 0.5f;
      const R z = positions.sample_level(nearest, uv, R(0)).z;
      const R near = smoothstep(0.0f, 1.0f, radius / max(abs(position.z - z), R(1e-4f)));
      occlusion += select(z >= sample.z + 0.02f, near, R(0));
    }
    return {vec4<R>(vec3<R>(1.0f - occlusion / 16.0f), R(1))};
  }
};
// [end]

constexpr const char* kOcclusionFragment = R"glsl(#version 330 core
in vec2 uv;
uniform mat4 projection;
uniform vec3 kernel[16];
uniform sampler2D positions, normals, turns;
uniform float radius, tiles;
out vec4 color;

void main() {
  vec3 position = texture(positions, uv).xyz;
  vec3 normal = texture(normals, uv).xyz;
  vec3 turn = texture(turns, uv * tiles).xyz;
  vec3 tangent = normalize(turn - normal * dot(turn, normal));
  mat3 frame = mat3(tangent, cross(normal, tangent), normal);
  float occlusion = 0.0;
  for (int i = 0; i < 16; ++i) {
    vec3 sample_position = position + frame * kernel[i] * radius;
    vec4 clip = projection * vec4(sample_position, 1.0);
    vec2 place = clip.xy / clip.w * 0.5 + 0.5;
    float z = texture(positions, place).z;
    float near = smoothstep(0.0, 1.0, radius / max(abs(position.z - z), 1e-4));
    occlusion += z >= sample_position.z + 0.02 ? near : 0.0;
  }
  color = vec4(vec3(1.0 - occlusion / 16.0), 1.0);
}
)glsl";

// [ssao_blur]
struct BoxBlur : FullScreen {
  Texture2DView image;

  template <class R>
  Fragment<R> fragment(const Varyings<R>&, const Pixel<R>& px) const {
    const IntOf<R> x = truncate_to_int(px.x), y = truncate_to_int(px.y);
    R sum(0);
    for (int dy = -2; dy < 2; ++dy)
      for (int dx = -2; dx < 2; ++dx) sum += image.fetch<R>(ivec3<R>(x + dx, y + dy, IntOf<R>(0))).x;
    return {vec4<R>(vec3<R>(sum / 16.0f), R(1))};
  }
};
// [end]

constexpr const char* kBlurFragment = R"glsl(#version 330 core
uniform sampler2D image;
out vec4 color;

void main() {
  ivec2 texel = ivec2(gl_FragCoord.xy);
  float sum = 0.0;
  for (int dy = -2; dy < 2; ++dy)
    for (int dx = -2; dx < 2; ++dx) sum += texelFetch(image, texel + ivec2(dx, dy), 0).r;
  color = vec4(vec3(sum / 16.0), 1.0);
}
)glsl";

TEST_F(Ported, ScreenSpaceAmbientOcclusion) {
  const Mesh mesh = still_life();
  const ViewGeometry geometry{glm::mat4(look_at({0.8, 1.2, 2.2}, {0, 0.3, 0}, {0, 1, 0})), glm::mat4(perspective_gl(0.8, 1.0, 0.1, 50.0))};
  Flat2D positions(TexelFormat::rgba32f), normals(TexelFormat::rgba32f), depth(TexelFormat::d32f);
  TwinStage stage({{positions, glm::vec4(0, 0, -50, 1)}, {normals, glm::vec4(0, 0, 1, 1)}}, TwinTarget{depth, glm::vec4(1)});
  stage.draw(geometry, kGeometryVertex, kGeometryFragment, make_vertex_view(stream(mesh.positions), stream(mesh.normals)), mesh.indices,
             [&](const UniformSetter& set) {
               set("view_from_world", geometry.view_from_world);
               set("projection", geometry.projection);
             });
  stage.run();

  TwinTexture turns(TextureKind::two_d, TexelFormat::rgba32f, {4, 4});
  turns.fill([](int x, int y, int) {
    const float angle = static_cast<float>(x * 7 + y * 5) * 0.39f;
    return glm::vec4(std::cos(angle), std::sin(angle), 0, 0);
  });
  Occlusion shader{{},
                   geometry.projection,
                   {},
                   positions.view<TextureKind::two_d>(),
                   normals.view<TextureKind::two_d>(),
                   turns.view<TextureKind::two_d>(),
                   {.mag = Filter::nearest, .min = Filter::nearest, .wrap_s = Wrap::clamp, .wrap_t = Wrap::clamp},
                   {.mag = Filter::nearest, .min = Filter::nearest},
                   0.4f,
                   kSize / 4.0f};
  for (std::size_t i = 0; i < shader.kernel.size(); ++i) {  // points of a spiral, more of them near the center
    const float k = (static_cast<float>(i) + 0.5f) / 16.0f, angle = 2.4f * static_cast<float>(i);
    const float z = 0.1f + 0.9f * k, r = std::sqrt(1.0f - z * z);
    shader.kernel[i] = glm::vec3(r * std::cos(angle), r * std::sin(angle), z) * (0.1f + 0.9f * std::fmod(k * 5.0f, 1.0f));
  }
  Flat2D occlusion(TexelFormat::rgba8), picture(TexelFormat::rgba8);
  draw_full_screen({{occlusion}}, shader, kOcclusionFragment, [&](const UniformSetter& set) {
    set("projection", shader.projection);
    set("positions", positions, shader.nearest);
    set("normals", normals, shader.nearest);
    set("turns", turns, shader.tiled);
    set("radius", shader.radius);
    set("tiles", shader.tiles);
    for (std::size_t i = 0; i < shader.kernel.size(); ++i) set(("kernel[" + std::to_string(i) + ']').c_str(), shader.kernel[i]);
  });
  draw_full_screen({{picture}}, BoxBlur{{}, occlusion.view<TextureKind::two_d>()}, kBlurFragment,
                   [&](const UniformSetter& set) { set("image", occlusion, shader.nearest); });
  expect_same_picture(
      picture, {2, 0.001, "a lookup that falls between two texels may read either, which changes a pixel by one code after the blur"}, 20);
}

}  // namespace halfspace::test::ported::ssao
