// SPDX-License-Identifier: Apache-2.0
//
// Lesson 1: a triangle covers the pixels whose centers are on the inner side of all three edges. Uses no library.
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <vector>

constexpr int kWidth = 320, kHeight = 240;

struct Point {
  double x, y;  // pixels from the upper left corner of the image
};
struct Color {
  double red, green, blue;  // 0 to 1
};

// Returns twice the signed area of the triangle a, b, p. It is positive if p is on the right when walking from a to b in the image, where
// y points down.
double edge(Point a, Point b, Point p) { return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x); }

uint8_t to_byte(double value) { return static_cast<uint8_t>(255.0 * std::clamp(value, 0.0, 1.0) + 0.5); }

int main(int argc, char** argv) {
  const Point a{160, 20}, b{290, 200}, c{30, 160};  // clockwise in the image
  const Color red{1, 0, 0}, green{0, 1, 0}, blue{0, 0, 1};
  std::vector<uint8_t> image(3 * kWidth * kHeight, 30);

  const double twice_area = edge(a, b, c);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const Point center{x + 0.5, y + 0.5};
      // The weight of a vertex comes from the edge opposite to it. The three weights are the barycentric coordinates of the center.
      const double wa = edge(b, c, center) / twice_area;
      const double wb = edge(c, a, center) / twice_area;
      const double wc = edge(a, b, center) / twice_area;
      if (wa < 0 || wb < 0 || wc < 0) continue;
      uint8_t* pixel = &image[3 * static_cast<std::size_t>(y * kWidth + x)];
      pixel[0] = to_byte(wa * red.red + wb * green.red + wc * blue.red);
      pixel[1] = to_byte(wa * red.green + wb * green.green + wc * blue.green);
      pixel[2] = to_byte(wa * red.blue + wb * green.blue + wc * blue.blue);
    }
  }

  const char* path = argc > 1 ? argv[1] : "lesson01.ppm";
  std::FILE* file = std::fopen(path, "wb");
  if (file != nullptr) {
    std::fprintf(file, "P6\n%d %d\n255\n", kWidth, kHeight);
    const bool complete = std::fwrite(image.data(), 1, image.size(), file) == image.size();
    if (std::fclose(file) == 0 && complete) return 0;
  }
  std::perror(path);
  return 1;
}
