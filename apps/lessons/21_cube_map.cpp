// SPDX-License-Identifier: Apache-2.0
//
// Lesson 21: a cube map stores what is visible from a point in all directions. A mirror looks up the direction of reflection.
#include <cmath>
#include <cstdio>
#include <exception>

#include "halfspace/geometry/camera.h"
#include "halfspace/geometry/shapes.h"
#include "halfspace/image/image_io.h"
#include "halfspace/raster/pass.h"
#include "halfspace/shading/texture/texture_memory.h"

using namespace halfspace;

// The light from a direction: a sky with a sun, and a floor of tiles one unit below the eye.
glm::vec3 surroundings(const glm::vec3& d) {
  if (d.y < 0) {
    const float x = std::floor(d.x / -d.y), z = std::floor(d.z / -d.y);
    const float fog = std::min(std::hypot(d.x, d.z) / -d.y / 12, 1.0f);
    const glm::vec3 tile = std::fmod(std::abs(x + z), 2.0f) == 0 ? glm::vec3(0.6f, 0.5f, 0.3f) : glm::vec3(0.08f, 0.1f, 0.15f);
    return tile + (glm::vec3(0.6f, 0.7f, 0.8f) - tile) * fog;
  }
  const glm::vec3 sky = glm::vec3(0.6f, 0.7f, 0.8f) + (glm::vec3(0.1f, 0.25f, 0.6f) - glm::vec3(0.6f, 0.7f, 0.8f)) * d.y;
  return glm::dot(d, glm::normalize(glm::vec3(-2, 2, 1))) > 0.985f ? glm::vec3(1, 0.95f, 0.8f) : sky;
}

// The direction of a point on a face; s and t are from -1 to 1. This is the convention of OpenGL (version 4.6, table 8.19).
glm::vec3 direction(int face, float s, float t) {
  const glm::vec3 directions[]{{1, -t, -s}, {-1, -t, s}, {s, 1, t}, {s, -1, -t}, {s, -t, 1}, {-s, -t, -1}};
  return glm::normalize(directions[face]);
}

struct MirrorShader {
  glm::mat4 clip_from_world;
  glm::vec3 eye;
  TextureCubeView environment;
  bool mirror;  // or the surroundings themselves: the direction of view instead of that of reflection

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
  Fragment<R> fragment(const Varyings<R>& in, const Pixel<R>& px) const {
    const auto looked_up = [&](const Varyings<R>& v) {
      const vec3<R> view = v.position - vec3<R>(eye), normal = normalize(v.normal);
      return mirror ? view - normal * (R(2) * dot(view, normal)) : view;
    };
    // The direction is computed, not a varying, so its derivatives are differences between neighboring pixels.
    const vec3<R> across = px.template quad_ddx<Varyings<R>>(looked_up), up = px.template quad_ddy<Varyings<R>>(looked_up);
    return {environment.sample(Sampler{}, looked_up(in), across, up)};
  }
};

int main(int argc, char** argv) try {
  constexpr int size = 256;
  TextureMemory faces(TextureKind::cube, TexelFormat::srgb8a8, {size, size, 6}, 9);
  for (int i = 0; i < 6 * size * size; ++i) {
    const int x = i % size, y = i / size % size, face = i / size / size;
    const float s = (static_cast<float>(x) + 0.5f) * 2 / size - 1, t = (static_cast<float>(y) + 0.5f) * 2 / size - 1;
    faces.set(x, y, face, 0, glm::vec4(surroundings(direction(face, s, t)), 1));
  }
  faces.generate_mipmaps();

  const glm::vec3 eye(0, 0.6f, 4.2f);
  const glm::mat4 camera(perspective_reversed(0.8, 4.0 / 3.0, 0.1, 200.0) * look_at(glm::dvec3(eye), {0, 0, 0}, {0, 1, 0}));
  const Mesh knot = torus_knot(0.8f, 0.3f, 64, 384), box = cube(100.0f);
  Image<glm::u8vec4> image(320, 240);
  Pass pass(320, 240, srgb8a8_target(image), {.format = DepthFormat::d32f, .clear_value = 0.0f}, {.samples = 4});
  const TextureCubeView view = faces.view<TextureKind::cube>();
  pass.draw(MirrorShader{camera, eye, view, false}, make_vertex_view(stream(box.positions), stream(box.normals)), box.indices,
            kReversedZState);
  pass.draw(MirrorShader{camera, eye, view, true}, make_vertex_view(stream(knot.positions), stream(knot.normals)), knot.indices,
            kReversedZState);
  pass.run(Workers(1));
  write_image(argc > 1 ? argv[1] : "lesson21.png", image);
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
