// SPDX-License-Identifier: Apache-2.0
//
// Lesson 12: light has no upper limit, but pixel values do. A float target stores the light, and a tone curve maps it to the display.
#include <cstdio>
#include <exception>

#include "halfspace/geometry/camera.h"
#include "halfspace/geometry/shapes.h"
#include "halfspace/image/image_io.h"
#include "halfspace/raster/pass.h"

using namespace halfspace;

struct LampShader {
  glm::mat4 clip_from_world;
  glm::vec3 lamp;

  template <class R>
  struct Attributes {
    vec3<R> position, normal;
  };
  template <class R>
  struct Varyings {
    vec3<R> position, normal;
  };
  template <class R>
  vec4<R> vertex(const Attributes<R>& in, Varyings<R>& out) const {
    out = {in.position, in.normal};
    return clip_from_world * vec4<R>(in.position, R(1));
  }
  template <class R>
  Fragment<R> fragment(const Varyings<R>& in, const Pixel<R>&) const {
    const vec3<R> towards = vec3<R>(lamp) - in.position;
    const R squared = dot(towards, towards);
    const R cosine = max(dot(normalize(in.normal), towards) / sqrt(squared), R(0));
    const vec3<R> light = vec3<R>(glm::vec3(6.0f, 4.0f, 2.2f)) * (cosine / squared);  // falls off with the square of the distance
    return {vec4<R>(light + vec3<R>(R(0.01f)), R(1))};
  }
};

// Runs for each pixel when its tile is finished.
struct ToneCurve {
  float exposure;
  template <class R>
  vec4<R> operator()(const vec4<R>& light) const {
    const vec3<R> exposed = vec3<R>(light.x, light.y, light.z) * R(exposure);
    const vec3<R> mapped(exposed.x / (R(1) + exposed.x), exposed.y / (R(1) + exposed.y), exposed.z / (R(1) + exposed.z));
    return vec4<R>(mapped, R(1));
  }
};

int main(int argc, char** argv) try {
  const Mesh meshes[]{plane(12.0f), uv_sphere(48, 96, 0.8f)};
  const glm::dmat4 camera = perspective_reversed(0.7, 320.0 / 240.0, 0.1, 100.0) * look_at({0, 2.2, 5}, {0, 0.4, 0}, {0, 1, 0});

  Image<glm::u8vec4> image(320, 240);
  // The pass renders to 16-bit floats, up to 65504. They exist only while a tile is being drawn. The tone curve writes to the image.
  Pass pass(320, 240, {.format = ColorFormat::rgba16f, .store = StoreOp::dont_care}, {.format = DepthFormat::d32f, .clear_value = 0.0f});
  for (const Mesh& mesh : meshes)
    pass.draw(LampShader{glm::mat4(camera), {1.4f, 1.0f, 0.7f}}, make_vertex_view(stream(mesh.positions), stream(mesh.normals)),
              mesh.indices, kReversedZState);
  pass.post(ToneCurve{1.0f}, srgb8a8_target(image));
  pass.run(Workers(1));
  write_image(argc > 1 ? argv[1] : "lesson12.png", image);
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
