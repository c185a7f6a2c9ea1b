// SPDX-License-Identifier: Apache-2.0
//
// Lesson 13: SIMD lanes compute several pixels at once. One function template draws triangles pixel by pixel, or by lanes. Measures both.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <exception>

#include "halfspace/core/vec.h"
#include "halfspace/geometry/shapes.h"
#include "halfspace/image/image_io.h"

using namespace halfspace;
constexpr int kWidth = 896, kHeight = 448, kRepeats = 20;

struct Vertex {
  glm::vec3 position;  // x and y in pixels from the upper left corner of the image, and the depth from 1 (near) to 0 (far)
  glm::vec4 color;     // red, green, blue and opacity, from 0 to 1
};

// The edge function of lesson 1. R is float for one pixel, or Real for kLanes pixels: kLanes floats in one register.
template <class R>
R edge(const glm::vec3& a, const glm::vec3& b, const R& x, const R& y) {
  return R(b.x - a.x) * (y - R(a.y)) - R(b.y - a.y) * (x - R(a.x));
}

// Draws a list of triangles, each given by three vertices.
template <class R>
void draw(Image<glm::u8vec4>& image, const std::vector<Vertex>& vertices) {
  using I = IntOf<R>;             // int, or kLanes ints
  constexpr int n = kWidthOf<R>;  // 1, or kLanes
  Image<float> depths(kWidth, kHeight);
  std::fill_n(image.data(), kWidth * kHeight, glm::u8vec4(30, 30, 30, 255));

  for (std::size_t k = 0; k < vertices.size(); k += 3) {
    // The triangles of a mesh are counterclockwise. The edge functions need clockwise triangles, so b and c are swapped.
    const glm::vec3 a = vertices[k].position, c = vertices[k + 1].position, b = vertices[k + 2].position;
    const float twice_area = edge(a, b, c.x, c.y);
    if (twice_area <= 0) continue;  // the back of the surface
    // The first and the last pixel of the bounding box.
    const glm::ivec2 first(glm::min(a, glm::min(b, c))), last(glm::max(a, glm::max(b, c)));
    for (int y = first.y; y <= last.y; ++y) {
      for (int x = first.x / n * n; x <= last.x; x += n) {
        // The centers of n pixels. The lanes of iota are 0, 1, 2, ...
        const R px = R(static_cast<float>(x) + 0.5f) + to_real<R>(iota<I>());
        const R py(static_cast<float>(y) + 0.5f);
        const R ea = edge(b, c, px, py), eb = edge(c, a, px, py), ec = edge(a, b, px, py);
        MaskOf<R> visible = ea >= R(0) && eb >= R(0) && ec >= R(0);  // a bool, or one bool per lane
        if (!any(visible)) continue;
        const R wa = ea * R(1 / twice_area), wb = eb * R(1 / twice_area), wc = ec * R(1 / twice_area);
        const R depth = wa * R(a.z) + wb * R(b.z) + wc * R(c.z);
        const R old_depth = load<R>(&depths.at(x, y));
        visible = visible && depth > old_depth;
        if (!any(visible)) continue;
        const vec4<R> color = (vertices[k].color * wa + vertices[k + 2].color * wb + vertices[k + 1].color * wc) * R(255);
        const I red = round_to_int(color.x), green = round_to_int(color.y), blue = round_to_int(color.z);
        const I pixel = red | green << 8 | blue << 16 | I(-1) << 24;  // the four bytes of an opaque pixel
        store(&depths.at(x, y), select(visible, depth, old_depth));
        store(&image.at(x, y), select(visible, pixel, load<I>(&image.at(x, y))));
      }
    }
  }
}

template <class F>
double milliseconds(const F& function) {
  double best = 1e9;
  for (int i = 0; i < kRepeats; ++i) {
    const auto begin = std::chrono::steady_clock::now();
    function();
    best = std::min(best, std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count());
  }
  return best;
}

int main(int argc, char** argv) try {
  // Five torus knots of 4096 triangles each, seen from above and without perspective. x and y are rounded to 1/16 pixel; see the page.
  const Mesh mesh = torus_knot(1.0f, 0.24f, 16, 128);
  std::vector<Vertex> vertices;
  for (int knot = 0; knot < 5; ++knot)
    for (const uint32_t i : mesh.indices) {
      const glm::vec3 color(knot % 2 == 0 ? 0.95f : 0.55f);
      const glm::vec3 p = mesh.positions[i];
      const glm::vec2 pixels = glm::round((glm::vec2(196 + 117 * knot, 224) + glm::vec2(p.x, p.z) * 140.0f) * 16.0f) / 16.0f;
      const float diffuse = std::max(glm::dot(mesh.normals[i], glm::normalize(glm::vec3(-1, 2, -1))), 0.0f);
      vertices.push_back({glm::vec3(pixels, 0.5f + 0.25f * p.y), glm::vec4(color * (0.2f + 0.8f * diffuse), 1)});
    }

  Image<glm::u8vec4> by_pixel(kWidth, kHeight), by_lanes(kWidth, kHeight);
  const double pixel_ms = milliseconds([&] { draw<float>(by_pixel, vertices); });
  const double lanes_ms = milliseconds([&] { draw<Real>(by_lanes, vertices); });
  const bool same = by_pixel == by_lanes;
  std::printf("scalar loop %.2f ms, %d lanes %.2f ms: %.1f times as fast, %s\n", pixel_ms, kLanes, lanes_ms, pixel_ms / lanes_ms,
              same ? "the same picture" : "different pictures");
  write_image(argc > 1 ? argv[1] : "lesson13.png", by_lanes);
  return same ? 0 : 1;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
