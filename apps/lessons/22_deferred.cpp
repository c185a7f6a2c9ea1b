// SPDX-License-Identifier: Apache-2.0
//
// Lesson 22: deferred shading. The first pass stores the surface of each pixel, and the second computes the light of 40 lamps once per
// pixel.
#include <array>
#include <cmath>
#include <cstdio>

#include "halfspace/geometry/camera.h"
#include "halfspace/geometry/shapes.h"
#include "halfspace/image/image_io.h"
#include "halfspace/raster/pass.h"
#include "halfspace/shading/texture/texture_memory.h"

using namespace halfspace;
constexpr int kWidth = 320, kHeight = 240;
constexpr TextureKind kKind = TextureKind::two_d;

struct SurfaceShader {  // the first pass
  glm::mat4 clip_from_world;
  glm::vec3 color;
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
  FragmentMRT<R, 3> fragment(const Varyings<R>& in) const {  // a color for each of three targets
    return {{vec4<R>(in.position, R(1)), vec4<R>(normalize(in.normal), R(0)), vec4<R>(vec3<R>(color), R(1))}};
  }
};

struct LampShader {  // the second pass, with one triangle that covers the picture
  Texture2DView positions, normals, colors;
  std::array<std::array<glm::vec3, 2>, 40> lamps;  // place and color
  template <class R>
  struct Attributes {
    vec2<R> position;
  };
  template <class R>
  struct Varyings {};
  template <class R>
  vec4<R> vertex(const Attributes<R>& in, Varyings<R>&) const {
    return vec4<R>(in.position.x, in.position.y, R(0), R(1));
  }
  template <class R>
  DiscardingFragment<R> fragment(const Varyings<R>&, const Pixel<R>& px) const {
    const ivec3<R> texel(truncate_to_int(px.x), truncate_to_int(px.y), IntOf<R>(0));
    const vec4<R> position = positions.fetch<R>(texel);
    const vec3<R> normal(normals.fetch<R>(texel)), color(colors.fetch<R>(texel));
    vec3<R> light(R(0.02f));
    for (const auto& [place, lamp_color] : lamps) {
      const vec3<R> to_lamp = vec3<R>(place) - vec3<R>(position);
      const R squared = dot(to_lamp, to_lamp) + R(0.02f);
      light += vec3<R>(lamp_color) * (max(dot(normal, to_lamp), R(0)) / (squared * sqrt(squared)));
    }
    return {vec4<R>(color * light, R(1)), position.w != R(0)};  // 0: no surface
  }
};

int main(int argc, char** argv) try {
  const glm::mat4 camera(perspective_reversed(0.7, 4.0 / 3.0, 0.1, 100.0) * look_at({0, 4, 6.5}, {0, 0, 0.3}, {0, 1, 0}));
  Mesh knot = torus_knot(1.1f, 0.25f, 32, 240);
  for (glm::vec3& p : knot.positions) p.y += 0.8f;
  Mesh floor = plane(12.0f);
  const TextureSize size{kWidth, kHeight};
  TextureMemory positions(kKind, TexelFormat::rgba32f, size), normals(kKind, TexelFormat::rgba16f, size),
      colors(kKind, TexelFormat::rgba8, size);
  LampShader lighting{positions.view<kKind>(), normals.view<kKind>(), colors.view<kKind>(), {}};
  for (std::size_t i = 0; i < 40; ++i) {  // on a spiral above the floor
    const float t = static_cast<float>(i), angle = 2.4f * t, radius = 0.55f * std::sqrt(t);
    const glm::vec3 color(0.5f + 0.5f * std::cos(t), 0.5f + 0.5f * std::cos(t + 2.1f), 0.5f + 0.5f * std::cos(t + 4.2f));
    lighting.lamps[i] = {glm::vec3(radius * std::cos(angle), 0.25f, radius * std::sin(angle)), color * 0.12f};
  }

  const std::array targets{color_target(positions.level()), color_target(normals.level()), color_target(colors.level())};
  Pass surfaces(kWidth, kHeight, targets, {.format = DepthFormat::d32f, .clear_value = 0.0f});
  for (const Mesh* const mesh : {&knot, &floor})
    surfaces.draw(SurfaceShader{camera, glm::vec3(mesh == &knot ? 0.9f : 0.6f)},
                  make_vertex_view(stream(mesh->positions), stream(mesh->normals)), mesh->indices, kReversedZState);
  surfaces.run(Workers(1));

  Image<glm::u8vec4> image(kWidth, kHeight);
  Pass light(kWidth, kHeight, srgb8a8_target(image), {});
  light.clear({.colors = {glm::vec4(0.02f, 0.02f, 0.03f, 1)}});
  const std::vector<glm::vec2> triangle{{-1, -1}, {3, -1}, {-1, 3}};
  light.draw(lighting, make_vertex_view(stream(triangle)));
  light.run(Workers(1));
  write_image(argc > 1 ? argv[1] : "lesson22.png", image);
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
