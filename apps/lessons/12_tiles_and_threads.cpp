// SPDX-License-Identifier: Apache-2.0
//
// Lesson 12: a tile fits into the cache of a core, and tiles are independent, so threads can draw them in parallel. Measures the frame time
// with small and large tiles, on one thread and on all threads.
#include <chrono>
#include <cstdio>

#include "halfspace/geometry/camera.h"
#include "halfspace/geometry/shapes.h"
#include "halfspace/image/image_io.h"
#include "halfspace/raster/pass.h"

using namespace halfspace;
constexpr int kWidth = 1280, kHeight = 720, kRepeats = 5;

struct NormalShader {
  glm::mat4 clip_from_world;

  template <class R>
  struct Attributes {
    vec3<R> position, normal;
  };
  template <class R>
  struct Varyings {
    vec3<R> normal;
  };
  template <class R>
  vec4<R> vertex(const Attributes<R>& in, Varyings<R>& out) const {
    out.normal = in.normal;
    return clip_from_world * vec4<R>(in.position, R(1));
  }
  template <class R>
  Fragment<R> fragment(const Varyings<R>& in) const {
    return {vec4<R>(normalize(in.normal) * R(0.5f) + vec3<R>(R(0.5f)), R(1))};
  }
};

double milliseconds(Image<glm::u8vec4>& image, const Mesh& mesh, int tile_size, const Workers& workers) {
  const glm::dmat4 camera = perspective_reversed(0.7, 16.0 / 9.0, 0.1, 100.0) * look_at({0, 2.2, 3.4}, {0, 0, 0}, {0, 1, 0});
  double best = 1e9;
  for (int i = 0; i < kRepeats; ++i) {
    const auto begin = std::chrono::steady_clock::now();
    ColorTarget color = srgb8a8_target(image);
    color.clear_value = {0.02f, 0.02f, 0.03f, 1};
    Pass pass(kWidth, kHeight, color, {.format = DepthFormat::d32f, .clear_value = 0.0f}, {.tile_size = tile_size});
    pass.draw(NormalShader{glm::mat4(camera)}, make_vertex_view(stream(mesh.positions), stream(mesh.normals)), mesh.indices,
              kReversedZState);
    pass.run(workers);
    best = std::min(best, std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count());
  }
  return best;
}

int main(int argc, char** argv) {
  const Mesh mesh = torus_knot(1.0f, 0.24f, 128, 1024);  // 262,144 triangles
  const int cores = Workers::cores();
  const Workers one(1), all(cores);
  Image<glm::u8vec4> first(kWidth, kHeight), image(kWidth, kHeight);
  bool same = true;
  for (const int tile_size : {8, 16, 32, 64}) {
    const double one_ms = milliseconds(image, mesh, tile_size, one);
    if (tile_size == 8) first = image;
    same = same && image == first;
    const double all_ms = milliseconds(image, mesh, tile_size, all);
    same = same && image == first;
    std::printf("tiles of %2d x %-2d pixels: 1 thread %6.2f ms, %d threads %6.2f ms: %.2f times as fast\n", tile_size, tile_size, one_ms,
                cores, all_ms, one_ms / all_ms);
  }
  std::printf("%s\n", same ? "all images are the same" : "the images differ");
  write_image(argc > 1 ? argv[1] : "lesson12.png", image);
  return same ? 0 : 1;
}
