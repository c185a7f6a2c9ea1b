// SPDX-License-Identifier: Apache-2.0
//
// Lesson 4: rotations place objects in the world, and the view moves the world in front of the camera. Uses no library.
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <vector>

constexpr int kWidth = 320, kHeight = 240;
constexpr double kFocal = 1.7320508075688772;  // the vertical field of view is 60 degrees, as in lesson 3

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

// Turns p around the y axis, counterclockwise when seen from above.
Vec rotate_y(Vec p, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return {c * p.x + s * p.z, p.y, -s * p.x + c * p.z};
}

// The camera: its place, and three perpendicular directions of length 1.
struct View {
  Vec eye, right, up, back;
  Vec operator()(Vec p) const { return {dot(right, p - eye), dot(up, p - eye), dot(back, p - eye)}; }
};
View look_at(Vec eye, Vec target, Vec above) {
  const Vec back = normalize(eye - target);  // the camera looks along -back
  const Vec right = normalize(cross(above, back));
  return {eye, right, cross(back, right), back};
}

struct Image {
  std::vector<uint8_t> colors = std::vector<uint8_t>(3 * kWidth * kHeight, 30);
  std::vector<double> inverse_distances = std::vector<double>(kWidth * kHeight, 0.0);  // 0: infinitely far
};
struct Projected {
  double x, y, inverse_distance;
};
double edge(Projected a, Projected b, double x, double y) { return (b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x); }

void draw(Image& image, const View& view, const Vec (&corners)[3], double light) {
  Projected p[3];
  for (int k = 0; k < 3; ++k) {
    const Vec v = view(corners[k]);
    const double scale = kFocal / -v.z * kHeight / 2;  // pixels per unit at this distance
    p[k] = {kWidth / 2 + v.x * scale, kHeight / 2 - v.y * scale, 1 / -v.z};
  }
  const double twice_area = edge(p[0], p[1], p[2].x, p[2].y);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const double wa = edge(p[1], p[2], x + 0.5, y + 0.5) / twice_area, wb = edge(p[2], p[0], x + 0.5, y + 0.5) / twice_area,
                   wc = edge(p[0], p[1], x + 0.5, y + 0.5) / twice_area;
      if (wa < 0 || wb < 0 || wc < 0) continue;
      const double inverse_distance = wa * p[0].inverse_distance + wb * p[1].inverse_distance + wc * p[2].inverse_distance;
      const int i = y * kWidth + x;
      if (inverse_distance <= image.inverse_distances[i]) continue;  // something nearer is already there
      image.inverse_distances[i] = inverse_distance;
      for (int k = 0; k < 3; ++k) image.colors[3 * i + k] = static_cast<uint8_t>(light * (230 - 30 * k));
    }
  }
}

int main(int argc, char** argv) {
  const View view = look_at({2.6, 3.4, 7.2}, {0, 0.6, 0}, {0, 1, 0});
  Image image;
  for (int stone = 0; stone < 12; ++stone) {
    Vec world[8];  // the corners of a box: bit 0 of the number selects x, bit 1 y and bit 2 z
    for (int i = 0; i < 8; ++i) {
      const Vec corner{i & 1 ? 0.3 : -0.3, i & 2 ? 2.0 : 0.0, i & 4 ? 0.6 : -0.6};
      world[i] = rotate_y(corner + Vec{4, 0, 0}, stone * 0.5235987755982988);  // 30 degrees
    }
    for (const auto& [a, b, c, d] : {std::array{0, 1, 3, 2}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 3, 7, 5}}) {
      const Vec normal = normalize(cross(world[b] - world[a], world[c] - world[a]));
      const double light = 0.3 + 0.7 * std::abs(dot(normal, normalize({2, 5, 3})));
      draw(image, view, {world[a], world[b], world[c]}, light);
      draw(image, view, {world[a], world[c], world[d]}, light);
    }
  }

  const char* path = argc > 1 ? argv[1] : "lesson04.ppm";
  std::FILE* file = std::fopen(path, "wb");
  if (file != nullptr) {
    std::fprintf(file, "P6\n%d %d\n255\n", kWidth, kHeight);
    const bool complete = std::fwrite(image.colors.data(), 1, image.colors.size(), file) == image.colors.size();
    if (std::fclose(file) == 0 && complete) return 0;
  }
  std::perror(path);
  return 1;
}
