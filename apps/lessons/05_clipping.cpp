// SPDX-License-Identifier: Apache-2.0
//
// Lesson 5: a projection produces x, y, z and w, and triangles are clipped before the division by w. Uses no library.
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <vector>

constexpr int kWidth = 320, kHeight = 240;
constexpr double kFocal = 1.7320508075688772, kNear = 0.5, kFar = 40;

struct Vertex {
  double x, y, z, w;  // in clip space
  double u, v;        // position on the wall, in tiles
};

// The projection: four sums of products, the rows of a 4x4 matrix. The camera is at the origin and looks along -z.
Vertex project(double x, double y, double z, double u, double v) {
  const double a = (kFar + kNear) / (kFar - kNear), b = -2 * kFar * kNear / (kFar - kNear);
  return {kFocal * kHeight / kWidth * x, kFocal * y, -a * z + b, -z, u, v};
}

Vertex mix(const Vertex& a, const Vertex& b, double t) {
  const auto between = [t](double from, double to) { return from + t * (to - from); };
  return {between(a.x, b.x), between(a.y, b.y), between(a.z, b.z), between(a.w, b.w), between(a.u, b.u), between(a.v, b.v)};
}

// Positive in front of the near plane, 0 on it, and negative behind it.
double near_side(const Vertex& p) { return p.z + p.w; }

// Returns the part of a polygon in front of the near plane.
std::vector<Vertex> clip(const std::vector<Vertex>& polygon) {
  std::vector<Vertex> kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vertex &from = polygon[i], &to = polygon[(i + 1) % polygon.size()];
    const double d = near_side(from), e = near_side(to);
    if (d >= 0) kept.push_back(from);
    if ((d >= 0) != (e >= 0)) kept.push_back(mix(from, to, d / (d - e)));  // the edge crosses the plane
  }
  return kept;
}

struct Image {
  std::vector<uint8_t> colors = std::vector<uint8_t>(3 * kWidth * kHeight, 30);
  std::vector<double> depths = std::vector<double>(kWidth * kHeight, 1.0);
};

// Divides by w. x and y are then pixels, z is the depth from -1 (near) to 1 (far), and w is 1 / distance.
Vertex to_window(const Vertex& p) { return {(p.x / p.w + 1) / 2 * kWidth, (1 - p.y / p.w) / 2 * kHeight, p.z / p.w, 1 / p.w, p.u, p.v}; }

double edge(const Vertex& a, const Vertex& b, double x, double y) { return (b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x); }

void draw_triangle(Image& image, const Vertex& a, const Vertex& b, const Vertex& c, int blue) {
  const double twice_area = edge(a, b, c.x, c.y);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const double wa = edge(b, c, x + 0.5, y + 0.5) / twice_area, wb = edge(c, a, x + 0.5, y + 0.5) / twice_area,
                   wc = edge(a, b, x + 0.5, y + 0.5) / twice_area;
      if (!(wa >= 0 && wb >= 0 && wc >= 0)) continue;
      const double depth = wa * a.z + wb * b.z + wc * c.z;
      const int i = y * kWidth + x;
      if (depth >= image.depths[i]) continue;
      image.depths[i] = depth;
      const double qa = wa * a.w, qb = wb * b.w, qc = wc * c.w, sum = qa + qb + qc;  // as in lesson 3
      const double u = (qa * a.u + qb * b.u + qc * c.u) / sum, v = (qa * a.v + qb * b.v + qc * c.v) / sum;
      const bool dark = static_cast<int>(std::floor(u + 1e-9) + std::floor(v + 1e-9)) % 2 != 0;
      image.colors[3 * i] = dark ? 60 : 220;
      image.colors[3 * i + 1] = dark ? 70 : 190;
      image.colors[3 * i + 2] = blue;
    }
  }
}

void draw(Image& image, const std::vector<Vertex>& polygon, int blue) {
  std::vector<Vertex> window;
  for (const Vertex& p : clip(polygon)) window.push_back(to_window(p));
  for (std::size_t i = 2; i < window.size(); ++i) draw_triangle(image, window[0], window[i - 1], window[i], blue);
}

int main(int argc, char** argv) {
  // A corridor that begins 6 units behind the camera and ends 30 units ahead of it, and a board in it.
  Image image;
  draw(image, {project(-2, -1, 6, 0, 0), project(2, -1, 6, 4, 0), project(2, -1, -30, 4, 36), project(-2, -1, -30, 0, 36)}, 60);
  draw(image, {project(-2, -1, 6, 0, 0), project(-2, 2, 6, 3, 0), project(-2, 2, -30, 3, 36), project(-2, -1, -30, 0, 36)}, 130);
  draw(image, {project(2, -1, 6, 0, 0), project(2, 2, 6, 3, 0), project(2, 2, -30, 3, 36), project(2, -1, -30, 0, 36)}, 130);
  draw(image, {project(-0.2, -1, -7, 0, 0), project(1.3, -1, -5, 3, 0), project(1.3, 0.7, -5, 3, 4), project(-0.2, 0.7, -7, 0, 4)}, 220);

  const char* path = argc > 1 ? argv[1] : "lesson05.ppm";
  std::FILE* file = std::fopen(path, "wb");
  if (file != nullptr) {
    std::fprintf(file, "P6\n%d %d\n255\n", kWidth, kHeight);
    const bool complete = std::fwrite(image.colors.data(), 1, image.colors.size(), file) == image.colors.size();
    if (std::fclose(file) == 0 && complete) return 0;
  }
  std::perror(path);
  return 1;
}
