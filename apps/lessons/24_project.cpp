// SPDX-License-Identifier: Apache-2.0
//
// Lesson 24: the start of a renderer of your own. It draws the corners of a model as dots. Uses no library.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <vector>

constexpr int kWidth = 320, kHeight = 240;
constexpr double kFocal = 1.7320508075688772, kNear = 0.1;

struct Vec {
  double x, y, z;
};
Vec operator+(Vec a, Vec b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
Vec operator-(Vec a, Vec b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
double dot(Vec a, Vec b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
Vec cross(Vec a, Vec b) { return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; }
Vec normalize(Vec a) {
  const double length = std::sqrt(dot(a, a));
  return {a.x / length, a.y / length, a.z / length};
}

struct View {  // as in lesson 4
  Vec eye, right, up, back;
  Vec operator()(Vec p) const { return {dot(right, p - eye), dot(up, p - eye), dot(back, p - eye)}; }
};
View look_at(Vec eye, Vec target, Vec up) {
  const Vec back = normalize(eye - target), right = normalize(cross(up, back));
  return {eye, right, cross(back, right), back};
}

struct Triangle {
  Vec corners[3];
  Vec color;  // red, green and blue, from 0 to 1
};

// A goblet on a large table: 8 rings of 24 corners. The triangles are counterclockwise when seen from outside or from above.
std::vector<Triangle> make_model() {
  const double radii[]{0.8, 0.75, 0.15, 0.12, 0.2, 0.8, 0.95, 0.85}, heights[]{0, 0.1, 0.25, 0.9, 1.1, 1.5, 2, 2.4};
  const auto corner = [&](int ring, int i) {
    const double angle = 6.283185307179586 * i / 24;
    return Vec{radii[ring] * std::sin(angle), heights[ring], radii[ring] * std::cos(angle)};
  };
  std::vector<Triangle> model;
  const Vec gold{0.9, 0.65, 0.25}, wood{0.45, 0.3, 0.2};
  for (int ring = 0; ring < 7; ++ring)
    for (int i = 0; i < 24; ++i) {
      const Vec a = corner(ring, i), b = corner(ring, i + 1), c = corner(ring + 1, i + 1), d = corner(ring + 1, i);
      model.push_back({{a, b, c}, gold});
      model.push_back({{a, c, d}, gold});
    }
  model.push_back({{{-20, 0, 20}, {20, 0, 20}, {20, 0, -20}}, wood});
  model.push_back({{{-20, 0, 20}, {20, 0, -20}, {-20, 0, -20}}, wood});
  return model;
}

struct Image {
  std::vector<uint8_t> colors = std::vector<uint8_t>(3 * kWidth * kHeight, 30);
  std::vector<double> inverse_distances = std::vector<double>(kWidth * kHeight, 0.0);
};

// Draws a triangle whose corners are in view space.
void draw(Image& image, const Triangle& triangle) {
  for (const Vec& p : triangle.corners) {
    if (-p.z < kNear) continue;
    const double scale = kFocal / -p.z * kHeight / 2;
    const double x = kWidth / 2 + p.x * scale, y = kHeight / 2 - p.y * scale;
    if (x < 0 || x >= kWidth || y < 0 || y >= kHeight) continue;
    uint8_t* pixel = &image.colors[3 * (static_cast<int>(y) * kWidth + static_cast<int>(x))];
    std::fill_n(pixel, 3, uint8_t{255});
  }
}

int main(int argc, char** argv) {
  const View view = look_at({1.5, 3.5, 4}, {0, 1, 0}, {0, 1, 0});
  Image image;
  for (const Triangle& t : make_model()) draw(image, {{view(t.corners[0]), view(t.corners[1]), view(t.corners[2])}, t.color});

  const char* path = argc > 1 ? argv[1] : "lesson24.ppm";
  std::FILE* file = std::fopen(path, "wb");
  if (file != nullptr) {
    std::fprintf(file, "P6\n%d %d\n255\n", kWidth, kHeight);
    const bool complete = std::fwrite(image.colors.data(), 1, image.colors.size(), file) == image.colors.size();
    if (std::fclose(file) == 0 && complete) return 0;
  }
  std::perror(path);
  return 1;
}
