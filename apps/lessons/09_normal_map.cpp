// SPDX-License-Identifier: Apache-2.0
//
// Lesson 9: a normal map stores normals relative to the surface. Here, it is computed from the heights of a bump map.
#include <cmath>
#include <cstdio>
#include <exception>

#include "halfspace/geometry/camera.h"
#include "halfspace/geometry/shapes.h"
#include "halfspace/image/image_io.h"
#include "halfspace/raster/pass.h"
#include "halfspace/shading/texture/texture.h"

using namespace halfspace;

struct BumpyShader {
  glm::mat4 clip_from_world;
  const Texture2D* normals;

  template <class R>
  struct Attributes {
    vec3<R> position, normal;
    vec4<R> tangent;  // direction in which u increases; w is -1 where the map is mirrored
    vec2<R> uv;
  };
  template <class R>
  struct Varyings {
    vec3<R> normal;
    vec4<R> tangent;
    vec2<R> uv;
  };
  template <class R>
  vec4<R> vertex(const Attributes<R>& in, Varyings<R>& out) const {
    out = {in.normal, in.tangent, in.uv};
    return clip_from_world * vec4<R>(in.position, R(1));
  }
  template <class R>
  Fragment<R> fragment(const Varyings<R>& in, const Pixel<R>& px) const {
    const vec4<R> texel = normals->sample<R>(Sampler{}, in.uv, px.ddx(&Varyings<R>::uv), px.ddy(&Varyings<R>::uv));
    const vec3<R> detail(texel.x * R(2) - R(1), texel.y * R(2) - R(1), texel.z * R(2) - R(1));
    const vec3<R> tangent(in.tangent.x, in.tangent.y, in.tangent.z);
    const vec3<R> bitangent = cross(in.normal, tangent) * in.tangent.w;
    const vec3<R> normal = normalize(tangent * detail.x + bitangent * detail.y + in.normal * detail.z);
    const R diffuse = max(dot(normal, vec3<R>(glm::normalize(glm::vec3(-2, 2, 1)))), R(0));
    return {vec4<R>(vec3<R>(glm::vec3(0.7f, 0.7f, 0.75f)) * (R(0.05f) + diffuse), R(1))};
  }
};

double height(int x, int y) { return 0.05 * std::cos(x * 6.283185307179586 * 32 / 512) * std::cos(y * 6.283185307179586 * 12 / 256); }

// The normal of a height map is (-dh/dx, -dh/dy, 1), normalized, with x to the right and y up in the map. Rows go down, so y is -row. The
// components are scaled from -1..1 to 0..255.
Image<glm::u8vec4> normal_map() {
  Image<glm::u8vec4> map(512, 256);
  for (int y = 0; y < 256; ++y)
    for (int x = 0; x < 512; ++x) {
      const glm::dvec3 slope(height(x - 1, y) - height(x + 1, y), height(x, y + 1) - height(x, y - 1), 0.04);  // 0.04 sets the steepness
      map.at(x, y) = glm::u8vec4((glm::normalize(slope) * 0.5 + 0.5) * 255.0 + 0.5, 255);
    }
  return map;
}

int main(int argc, char** argv) try {
  const Texture2D normals(normal_map(), TexelFormat::rgba8);
  const Mesh ring = torus(1.0f, 0.45f, 48, 96);
  const glm::dmat4 camera = perspective_reversed(0.6, 320.0 / 240.0, 0.1, 100.0) * look_at({0, 2.5, 4}, {0, 0, 0}, {0, 1, 0});

  Image<glm::u8vec4> image(320, 240);
  ColorTarget color = srgb8a8_target(image);
  color.clear_value = {0.02f, 0.02f, 0.03f, 1};
  Pass pass(320, 240, color, {.format = DepthFormat::d32f, .clear_value = 0.0f});
  pass.draw(BumpyShader{glm::mat4(camera), &normals},
            make_vertex_view(stream(ring.positions), stream(ring.normals), stream(ring.tangents), stream(ring.uvs)), ring.indices,
            kReversedZState);
  pass.run(Workers(1));
  write_image(argc > 1 ? argv[1] : "lesson09.png", image);
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
