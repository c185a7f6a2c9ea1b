// SPDX-License-Identifier: Apache-2.0
//
// Lesson 11: SIMD lanes compute the same formula for several pixels at once. Measures a scalar loop and a loop that uses lanes.
#include <chrono>
#include <cstdio>
#include <cstring>

#include "halfspace/core/lanes.h"
#include "halfspace/image/image_io.h"

using namespace halfspace;
constexpr int kSize = 512, kRepeats = 20;

// A Mandelbrot set, colored by the number of steps until |z| > 2. R is float, or Real: kLanes floats in one register.
template <class R>
R steps(const R& cx, const R& cy) {
  R x = cx, y = cy, count(0.0f);
  for (int i = 0; i < 64; ++i) {
    const R xx = x * x, yy = y * y;
    const auto inside = xx + yy <= R(4.0f);  // a bool, or one bool per lane
    if (!any(inside)) break;                 // finished lanes wait for the others
    count = select(inside, count + R(1.0f), count);
    const R next = xx - yy + cx;
    y = select(inside, x * y * R(2.0f) + cy, y);
    x = select(inside, next, x);
  }
  return count;
}

float scale(int pixel) { return static_cast<float>(pixel) * (2.5f / kSize) - 1.25f; }

void draw_by_pixel(float* image) {
  for (int y = 0; y < kSize; ++y)
    for (int x = 0; x < kSize; ++x) image[y * kSize + x] = steps(scale(x) - 0.5f, scale(y));
}

void draw_by_lanes(float* image) {
  for (int y = 0; y < kSize; ++y)
    for (int x = 0; x < kSize; x += kLanes) {
      alignas(64) float cx[kLanes];
      for (int lane = 0; lane < kLanes; ++lane) cx[lane] = scale(x + lane) - 0.5f;
      store(image + y * kSize + x, steps(load<Real>(cx), Real(scale(y))));
    }
}

template <class F>
double milliseconds(const F& draw) {
  double best = 1e9;
  for (int i = 0; i < kRepeats; ++i) {
    const auto begin = std::chrono::steady_clock::now();
    draw();
    best = std::min(best, std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count());
  }
  return best;
}

int main(int argc, char** argv) {
  Image<float> by_pixel(kSize, kSize), by_lanes(kSize, kSize);
  const double scalar_ms = milliseconds([&] { draw_by_pixel(by_pixel.data()); });
  const double lanes_ms = milliseconds([&] { draw_by_lanes(by_lanes.data()); });
  const bool same = std::memcmp(by_pixel.data(), by_lanes.data(), sizeof(float) * kSize * kSize) == 0;
  std::printf("scalar %.2f ms, %d lanes %.2f ms: %.1f times as fast, %s\n", scalar_ms, kLanes, lanes_ms, scalar_ms / lanes_ms,
              same ? "the same image" : "different images");
  Image<glm::u8vec4> image(kSize, kSize);
  for (int y = 0; y < kSize; ++y)
    for (int x = 0; x < kSize; ++x) image.at(x, y) = glm::u8vec4(glm::vec4(glm::vec3(by_lanes.at(x, y) * 255.0f / 64.0f), 255.0f));
  write_image(argc > 1 ? argv[1] : "lesson11.png", image);
  return same ? 0 : 1;
}
