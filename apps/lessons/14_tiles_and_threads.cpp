// SPDX-License-Identifier: Apache-2.0
//
// Lesson 14: threads draw parts of an image in parallel: bands of rows with the loops of lesson 13, and the tiles of the library.
#include <chrono>
#include <cstdio>
#include <exception>

#include "halfspace/geometry/shapes.h"
#include "halfspace/image/image_io.h"
#include "halfspace/raster/pass.h"
#include "halfspace/shading/surface/colored_primitives.h"

using namespace halfspace;
constexpr int kWidth = 896, kHeight = 448, kTriangles = 20480, kParts = 8, kRepeats = 20;

struct Vertex {
  glm::vec3 position;  // as in lesson 13
  glm::vec4 color;     // 0 to 1
};

template <class R>
R edge(const glm::vec3& a, const glm::vec3& b, const R& x, const R& y) {
  return R(b.x - a.x) * (y - R(a.y)) - R(b.y - a.y) * (x - R(a.x));
}
// The loop of lesson 13, for some of the rows of the image and some of the triangles: those from `first` to the one before `last`.
template <class R>
void draw(Image<glm::u8vec4>& image, const std::vector<Vertex>& vertices, int top, int bottom, std::size_t first, std::size_t last) {
  using I = IntOf<R>;
  constexpr int n = kWidthOf<R>;
  Image<float> depths(kWidth, bottom - top);  // only this part of the image needs them
  for (std::size_t k = 3 * first; k < 3 * last; k += 3) {
    const glm::vec3 a = vertices[k].position, c = vertices[k + 1].position, b = vertices[k + 2].position;
    const float twice_area = edge(a, b, c.x, c.y);
    if (twice_area <= 0) continue;
    const glm::ivec2 low(glm::min(a, glm::min(b, c))), high(glm::max(a, glm::max(b, c)));
    for (int y = std::max(low.y, top); y <= std::min(high.y, bottom - 1); ++y)
      for (int x = low.x / n * n; x <= high.x; x += n) {
        const R px = to_real<R>(iota<I>()) + R(static_cast<float>(x) + 0.5f), py(static_cast<float>(y) + 0.5f);
        const R ea = edge(b, c, px, py), eb = edge(c, a, px, py), ec = edge(a, b, px, py);
        MaskOf<R> visible = ea >= R(0) && eb >= R(0) && ec >= R(0);
        if (!any(visible)) continue;
        const R wa = ea * R(1 / twice_area), wb = eb * R(1 / twice_area), wc = ec * R(1 / twice_area);
        const R depth = wa * R(a.z) + wb * R(b.z) + wc * R(c.z), old_depth = load<R>(&depths.at(x, y - top));
        visible = visible && depth > old_depth;
        if (!any(visible)) continue;
        const vec4<R> color = (vertices[k].color * wa + vertices[k + 2].color * wb + vertices[k + 1].color * wc) * R(255);
        const I red = round_to_int(color.x), green = round_to_int(color.y), blue = round_to_int(color.z);
        const I pixel = red | green << 8 | blue << 16 | I(-1) << 24;
        store(&depths.at(x, y - top), select(visible, depth, old_depth));
        store(&image.at(x, y), select(visible, pixel, load<I>(&image.at(x, y))));
      }
  }
}

int main(int argc, char** argv) try {
  const Mesh mesh = torus_knot(1.0f, 0.24f, 16, 128);
  std::vector<Vertex> vertices;
  for (int knot = 0; knot < 5; ++knot)
    for (const uint32_t i : mesh.indices) {
      const glm::vec3 color(knot % 2 == 0 ? 0.95f : 0.55f), p = mesh.positions[i];
      const glm::vec2 pixels = glm::round((glm::vec2(196 + 117 * knot, 224) + glm::vec2(p.x, p.z) * 140.0f) * 16.0f) / 16.0f;
      const float diffuse = std::max(glm::dot(mesh.normals[i], glm::normalize(glm::vec3(-1, 2, -1))), 0.0f);
      vertices.push_back({glm::vec3(pixels, 0.5f + 0.25f * p.y), glm::vec4(color * (0.2f + 0.8f * diffuse), 1)});
    }
  Image<glm::u8vec4> image(kWidth, kHeight), first;
  double first_ms = 0;
  const auto measure = [&](const char* name, int threads, const auto& draw_picture) {
    const Workers workers(threads);
    double ms = 1e9;
    for (int i = 0; i < kRepeats; ++i) {
      const auto begin = std::chrono::steady_clock::now();
      std::fill_n(image.data(), kWidth * kHeight, glm::u8vec4(30, 30, 30, 255));
      draw_picture(workers);
      ms = std::min(ms, std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count());
    }
    if (first.empty()) first = image, first_ms = ms;
    int differing = 0;
    for (int i = 0; i < kWidth * kHeight; ++i) differing += image.data()[i] != first.data()[i];
    std::printf("%-12s threads: %d  time: %6.2f ms  speedup: %5.2f  differing pixels: %d\n", name, threads, ms, first_ms / ms, differing);
  };
  const auto draw_part = [&](int i) { draw<Real>(image, vertices, kHeight * i / kParts, kHeight * (i + 1) / kParts, 0, kTriangles); };
  const auto bands = [&](const Workers& workers) { workers.for_each(kParts, draw_part); };
  const auto library = [&](const Workers& workers) {
    ColorTarget color = rgba8_target(image);
    color.clear_value = glm::vec4(30, 30, 30, 255) / 255.0f;
    Pass pass(kWidth, kHeight, color, {.format = DepthFormat::d32f, .clear_value = 0.0f});
    const glm::mat4 clip(2.0f / kWidth, 0, 0, 0, 0, -2.0f / kHeight, 0, 0, 0, 0, 1, 0, -1, 1, 0, 1);
    pass.draw(ColoredPrimitives{clip}, make_vertex_view(stream(vertices, &Vertex::position), stream(vertices, &Vertex::color)),
              {.cull = CullMode::back, .depth = kReversedZ});
    pass.run(workers);
  };
  measure("scalar loop", 1, [&](const Workers&) { draw<float>(image, vertices, 0, kHeight, 0, kTriangles); });
  measure("lanes", 1, [&](const Workers&) { draw<Real>(image, vertices, 0, kHeight, 0, kTriangles); });
  for (const int threads : {1, Workers::cores()}) measure("bands", threads, bands);
  write_image(argc > 1 ? argv[1] : "lesson14.png", image);
  for (const int threads : {1, Workers::cores()}) measure("library", threads, library);
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
