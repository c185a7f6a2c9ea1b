// SPDX-License-Identifier: Apache-2.0
//
// Lesson 2: a depth buffer stores the depth of the nearest surface at each pixel, so triangles can be drawn in any order. Uses no library.
#include <cstdint>
#include <cstdio>
#include <vector>

constexpr int kWidth = 320, kHeight = 240;

struct Vertex {
  double x, y;   // pixels from the upper left corner of the image
  double depth;  // 0: near, 1: far
};
struct Triangle {
  Vertex a, b, c;
  int red, green, blue;  // 0 to 255
};

double edge(const Vertex& a, const Vertex& b, double x, double y) { return (b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x); }

struct Image {
  std::vector<uint8_t> colors = std::vector<uint8_t>(3 * kWidth * kHeight, 30);
  std::vector<double> depths = std::vector<double>(kWidth * kHeight, 1.0);
};

void draw(Image& image, const Triangle& t) {
  const double twice_area = edge(t.a, t.b, t.c.x, t.c.y);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const double wa = edge(t.b, t.c, x + 0.5, y + 0.5) / twice_area;
      const double wb = edge(t.c, t.a, x + 0.5, y + 0.5) / twice_area;
      const double wc = edge(t.a, t.b, x + 0.5, y + 0.5) / twice_area;
      if (wa < 0 || wb < 0 || wc < 0) continue;
      const double depth = wa * t.a.depth + wb * t.b.depth + wc * t.c.depth;
      const auto i = static_cast<std::size_t>(y * kWidth + x);
      if (depth >= image.depths[i]) continue;  // something nearer is already there
      image.depths[i] = depth;
      image.colors[3 * i] = t.red;
      image.colors[3 * i + 1] = t.green;
      image.colors[3 * i + 2] = t.blue;
    }
  }
}

int main(int argc, char** argv) {
  // Each bar is in front of the next one, and the last is in front of the first, so no drawing order is correct.
  const Triangle bars[]{
      {{70, 225, 0.2}, {110, 225, 0.2}, {120, 15, 0.8}, 230, 200, 70},
      {{300, 160, 0.2}, {300, 200, 0.2}, {20, 140, 0.8}, 80, 120, 220},
      {{210, 15, 0.2}, {250, 15, 0.2}, {190, 225, 0.8}, 90, 180, 90},
      {{20, 60, 0.2}, {300, 80, 0.8}, {20, 100, 0.2}, 230, 90, 60},
  };
  Image image;
  for (const Triangle& bar : bars) draw(image, bar);

  const char* path = argc > 1 ? argv[1] : "lesson02.ppm";
  std::FILE* file = std::fopen(path, "wb");
  if (file != nullptr) {
    std::fprintf(file, "P6\n%d %d\n255\n", kWidth, kHeight);
    const bool complete = std::fwrite(image.colors.data(), 1, image.colors.size(), file) == image.colors.size();
    if (std::fclose(file) == 0 && complete) return 0;
  }
  std::perror(path);
  return 1;
}
