// SPDX-License-Identifier: Apache-2.0
//
// Lesson 3: perspective divides by the distance, and interpolation must account for this division. Uses no library.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <vector>

constexpr int kWidth = 320, kHeight = 240;
constexpr double kFocal = 1.7320508075688772;  // 1 / tan(30 degrees): the vertical field of view is 60 degrees

struct Vertex {
  double x, y, z;  // the camera is at the origin and looks along -z; y points up
  double u, v;     // position on the floor, in tiles
};
struct Projected {
  double x, y;      // pixels from the upper left corner of the image
  double distance;  // along the view axis
  double u, v;
};

Projected project(const Vertex& p) {
  const double distance = -p.z;
  const double x = kFocal * kHeight / kWidth * p.x / distance, y = kFocal * p.y / distance;  // -1 to 1 within the image
  return {(x + 1) * 0.5 * kWidth, (1 - y) * 0.5 * kHeight, distance, p.u, p.v};              // y points down in the image
}

double edge(const Projected& a, const Projected& b, double x, double y) { return (b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x); }

void draw(std::vector<uint8_t>& image, const Projected& a, const Projected& b, const Projected& c) {
  const double twice_area = edge(a, b, c.x, c.y);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const double wa = edge(b, c, x + 0.5, y + 0.5) / twice_area;
      const double wb = edge(c, a, x + 0.5, y + 0.5) / twice_area;
      const double wc = edge(a, b, x + 0.5, y + 0.5) / twice_area;
      if (wa < 0 || wb < 0 || wc < 0) continue;
      // u/distance, v/distance and 1/distance are linear in the image; u and v are not.
      const double qa = wa / a.distance, qb = wb / b.distance, qc = wc / c.distance;
      const double sum = qa + qb + qc;  // 1/distance of the pixel
      const double u = (qa * a.u + qb * b.u + qc * c.u) / sum;
      const double v = (qa * a.v + qb * b.v + qc * c.v) / sum;
      // Some centers are exactly on a line between two tiles. 1e-9 decides for them; otherwise, rounding would.
      const bool dark = static_cast<int>(std::floor(u + 1e-9) + std::floor(v + 1e-9)) % 2 != 0;
      uint8_t* pixel = &image[3 * static_cast<std::size_t>(y * kWidth + x)];
      pixel[0] = dark ? 40 : 230;
      pixel[1] = dark ? 60 : 180;
      pixel[2] = dark ? 120 : 60;
    }
  }
}

int main(int argc, char** argv) {
  // A floor of 8 x 8 tiles, one unit below the camera.
  const Projected near_left = project({-4, -1, -1.25, 0, 0}), near_right = project({4, -1, -1.25, 8, 0});
  const Projected far_left = project({-4, -1, -9.25, 0, 8}), far_right = project({4, -1, -9.25, 8, 8});
  std::vector<uint8_t> image(3 * kWidth * kHeight, 30);
  draw(image, near_left, far_left, far_right);
  draw(image, near_left, far_right, near_right);

  const char* path = argc > 1 ? argv[1] : "lesson03.ppm";
  std::FILE* file = std::fopen(path, "wb");
  if (file != nullptr) {
    std::fprintf(file, "P6\n%d %d\n255\n", kWidth, kHeight);
    const bool complete = std::fwrite(image.data(), 1, image.size(), file) == image.size();
    if (std::fclose(file) == 0 && complete) return 0;
  }
  std::perror(path);
  return 1;
}
