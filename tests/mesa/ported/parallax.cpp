// SPDX-License-Identifier: Apache-2.0
//
// Parallax occlusion mapping: a march through a height map, with a bounded loop.
#include "mesa/ported/scene.h"

namespace halfspace::test::ported::parallax {

// [parallax]
struct Parallax {
  glm::mat4 clip_from_world;
  glm::vec3 eye;
  Texture2DView colors, depths;
  Sampler trilinear, bilinear;

  template <class R>
  struct Attributes {
    vec3<R> position;  // on a floor: s grows with x, and t with -z
    vec2<R> uv;
  };
  template <class R>
  struct Varyings {
    vec3<R> to_eye;
    vec2<R> uv;
  };
  template <class R>
  vec4<R> vertex(const Attributes<R>& in, Varyings<R>& out) const {
    const vec3<R> v = eye - in.position;
    out.to_eye = vec3<R>(v.x, -v.z, v.y);
    out.uv = in.uv;
    return clip_from_world * vec4<R>(in.position, R(1));
  }
  template <class R>
  Fragment<R> fragment(const Varyings<R>& in, const Pixel<R>& px) const {
    const vec3<R> v = normalize(in.to_eye);
    const vec2<R> step = vec2<R>(v) / v.z * (0.1f / 16.0f);
    vec2<R> uv = in.uv;
    R layer(0), depth = depths.sample_level(bilinear, uv, R(0)).x, layer_before(0), depth_before = depth;
    for (int i = 0; i < 16; ++i) {
      const MaskOf<R> inside = layer < depth;  // the pixels whose loop goes on
      if (!any(inside)) break;
      layer_before = select(inside, layer, layer_before);
      depth_before = select(inside, depth, depth_before);
      uv = select(inside, uv - step, uv);
      layer = select(inside, layer + 1.0f / 16.0f, layer);
      depth = select(inside, depths.sample_level(bilinear, uv, R(0)).x, depth);
    }
    const R below = layer - depth, above = depth_before - layer_before;
    uv = uv + step * (below / max(below + above, R(1e-6f)));
    // The derivatives of uv before it moved: those of the moved one jump.
    return {colors.sample(trilinear, uv, px.ddx(&Varyings<R>::uv), px.ddy(&Varyings<R>::uv))};
  }
};
// [end]

constexpr const char* kVertex = R"glsl(#version 330 core
layout(location = 0) in vec3 position;
layout(location = 1) in vec2 texture_position;
uniform mat4 clip_from_world;
uniform vec3 eye;
out vec3 to_eye;
out vec2 uv;

void main() {
  vec3 v = eye - position;
  to_eye = vec3(v.x, -v.z, v.y);
  uv = texture_position;
  gl_Position = clip_from_world * vec4(position, 1.0);
}
)glsl";

constexpr const char* kFragment = R"glsl(#version 330 core
in vec3 to_eye;
in vec2 uv;
uniform sampler2D colors, depths;
out vec4 color;

void main() {
  vec3 v = normalize(to_eye);
  vec2 step = v.xy / v.z * (0.1 / 16.0);
  vec2 moved = uv;
  float layer = 0.0, depth = textureLod(depths, moved, 0.0).r;
  float layer_before = 0.0, depth_before = depth;
  for (int i = 0; i < 16; ++i) {
    if (layer >= depth) break;
    layer_before = layer;
    depth_before = depth;
    moved -= step;
    layer += 1.0 / 16.0;
    depth = textureLod(depths, moved, 0.0).r;
  }
  float below = layer - depth, above = depth_before - layer_before;
  moved += step * (below / max(below + above, 1e-6));
  color = textureGrad(colors, moved, dFdx(uv), dFdy(uv));
}
)glsl";

TEST_F(Ported, ParallaxMapping) {
  TwinTexture depths(TextureKind::two_d, TexelFormat::r8, {64, 64}), colors(TextureKind::two_d, TexelFormat::rgba8, {64, 64}, 7);
  const auto depth_at = [](int x, int y) {
    const float s = static_cast<float>(x) * 0.0981748f, t = static_cast<float>(y) * 0.0981748f;  // 2 pi / 64
    return 0.5f + 0.25f * std::sin(3.0f * s) + 0.25f * std::cos(2.0f * t);
  };
  depths.fill([&](int x, int y, int) { return glm::vec4(depth_at(x, y)); });
  colors.fill([&](int x, int y, int) {
    return glm::vec4(1.0f - depth_at(x, y), static_cast<float>(x) / 64.0f, 0.5f + 0.3f * static_cast<float>(y % 16) / 16.0f, 1.0f);
  });
  colors.generate_mipmaps();
  const std::vector<glm::vec3> positions{{-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1}};
  const std::vector<glm::vec2> uvs{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  const std::vector<uint32_t> indices{0, 1, 2, 0, 2, 3};
  const glm::vec3 eye(0.6f, 1.4f, 2.0f);
  const Parallax shader{
      camera(eye), eye, colors.view<TextureKind::two_d>(), depths.view<TextureKind::two_d>(), {}, {.min = Filter::bilinear}};
  Flat2D picture(TexelFormat::rgba8);
  TwinStage stage({{picture}});
  stage.draw(
      shader, kVertex, kFragment, make_vertex_view(stream(positions), stream(uvs)), indices,
      [&](const UniformSetter& set) {
        set("clip_from_world", shader.clip_from_world);
        set("eye", shader.eye);
        set("colors", colors, shader.trilinear);
        set("depths", depths, shader.bilinear);
      },
      kWithoutDepth);
  stage.run();
  expect_same_picture(picture,
                      {4, 0.001, "the loop may end one layer earlier or later, and Mesa's level of detail is off by up to 0.04 levels"});
}

}  // namespace halfspace::test::ported::parallax
