// SPDX-License-Identifier: Apache-2.0
#include "mesa/scenes.h"

#include <cmath>
#include <numbers>

#include <glm/gtc/matrix_transform.hpp>

namespace halfspace::test {

namespace {

/// std::mt19937 is the same on every platform; the distributions of std are not.
class Random {
 public:
  explicit Random(uint32_t seed) : engine_(seed) {}
  float uniform(float low, float high) { return low + (high - low) * static_cast<float>(engine_() >> 8) * 0x1p-24f; }

 private:
  std::mt19937 engine_;
};

glm::vec4 random_color(Random& random) { return {random.uniform(0, 1), random.uniform(0, 1), random.uniform(0, 1), 1.0f}; }

glm::vec2 ndc_from_px(const glm::vec2& p, int width, int height) {
  return {2.0f * p.x / static_cast<float>(width) - 1.0f, 2.0f * p.y / static_cast<float>(height) - 1.0f};
}

// Vectors are initialized with braces where they take two random numbers, because only braces fix the order of evaluation.
std::array<glm::vec2, 3> random_corners(const Soup& soup, Random& random, const glm::vec2& center) {
  std::array<glm::vec2, 3> corners;
  const float angle = random.uniform(0, 6.2831853f);
  const glm::mat2 turn(std::cos(angle), std::sin(angle), -std::sin(angle), std::cos(angle));
  for (glm::vec2& p : corners) {
    const float across = soup.thickness > 0.0f ? soup.thickness : soup.size;
    p = glm::vec2{random.uniform(-soup.size, soup.size), random.uniform(-across, across)};
    if (soup.thickness > 0.0f) p = turn * p;
    p += center;
    if (soup.grid > 0.0f) p = glm::floor(p / soup.grid) * soup.grid;
  }
  return corners;
}

}  // namespace

ColoredMesh make_soup(const Soup& soup, int width, int height) {
  Random random(soup.seed);
  ColoredMesh mesh;
  const float margin = soup.inside ? soup.size : 0.0f;
  for (int i = 0; i < soup.triangles; ++i) {
    const glm::vec2 center{random.uniform(margin, static_cast<float>(width) - margin),
                           random.uniform(margin, static_cast<float>(height) - margin)};
    for (const glm::vec2& corner : random_corners(soup, random, center)) {
      float w = random.uniform(1.0f, soup.w_ratio);
      if (soup.grid > 0.0f) w = std::exp2(std::floor(std::log2(w)));
      float z = random.uniform(-0.99f, 0.99f) * w;
      if (soup.crosses_near) {  // some z are below −w, some w below 0
        w = random.uniform(-0.5f, 2.0f);
        z = random.uniform(-1.5f, 1.0f) * std::fabs(w);
      }
      mesh.pos_clip.emplace_back(ndc_from_px(corner, width, height) * std::fabs(w), z, w);
      mesh.colors.push_back(random_color(random));
      mesh.indices.push_back(static_cast<uint32_t>(mesh.indices.size()));
    }
  }
  return mesh;
}

ColoredMesh make_sheet(int columns, int rows, float jitter, uint32_t seed, float opacity) {
  Random random(seed);
  ColoredMesh mesh;
  for (int j = 0; j <= rows; ++j) {
    for (int i = 0; i <= columns; ++i) {
      const float x = static_cast<float>(i) + random.uniform(-jitter, jitter), y = static_cast<float>(j) + random.uniform(-jitter, jitter);
      const glm::vec2 ndc(-1.2f + 2.4f * x / static_cast<float>(columns), -1.2f + 2.4f * y / static_cast<float>(rows));
      mesh.pos_clip.emplace_back(ndc, random.uniform(-0.9f, 0.9f), 1.0f);
      mesh.colors.push_back(random_color(random));
      mesh.colors.back().w = opacity;
    }
  }
  const auto at = [columns](int i, int j) { return static_cast<uint32_t>(j * (columns + 1) + i); };
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < columns; ++i)
      for (const uint32_t k : {at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j), at(i + 1, j + 1), at(i, j + 1)})
        mesh.indices.push_back(k);
  return mesh;
}

void add_triangle(ColoredMesh& mesh, int width, int height, const std::array<glm::vec3, 3>& pos_px, const glm::vec4& color) {
  for (const glm::vec3& p : pos_px) {
    mesh.indices.push_back(static_cast<uint32_t>(mesh.pos_clip.size()));
    mesh.pos_clip.emplace_back(ndc_from_px(glm::vec2(p.x, p.y), width, height), p.z, 1.0f);
    mesh.colors.push_back(color);
  }
}

ColoredMesh make_tiny(int width, int height) {
  const double s = std::numbers::sqrt2;
  const int columns = static_cast<int>(width / s), rows = static_cast<int>(height / s);
  ColoredMesh mesh;
  const auto ndc = [](double px, int size) { return static_cast<float>(2.0 * px / size - 1.0); };
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      for (const glm::dvec2& corner : {glm::dvec2(0, 0), glm::dvec2(s, 0), glm::dvec2(0, s)}) {
        mesh.indices.push_back(static_cast<uint32_t>(mesh.pos_clip.size()));
        mesh.pos_clip.emplace_back(ndc(i * s + corner.x, width), ndc(j * s + corner.y, height), 0.9f, 1.0f);
        mesh.colors.emplace_back(0.9f, 0.6f, 0.1f, 1.0f);
      }
    }
  }
  return mesh;
}

VertexView Sphere::view() const {
  return make_vertex_view(stream(vertices, &SphereVertex::position), stream(vertices, &SphereVertex::normal),
                          stream(vertices, &SphereVertex::uv));
}

Sphere make_sphere(int rows, int columns) {
  Sphere sphere;
  for (int i = 0; i <= rows; ++i) {
    for (int j = 0; j <= columns; ++j) {
      const double theta = std::numbers::pi * i / rows, phi = 2.0 * std::numbers::pi * j / columns;
      const glm::vec3 p(glm::dvec3(std::sin(theta) * std::cos(phi), std::cos(theta), std::sin(theta) * std::sin(phi)));
      sphere.vertices.push_back({p, p, glm::vec2(glm::dvec2(static_cast<double>(j) / columns, static_cast<double>(i) / rows))});
    }
  }
  for (int i = 0; i < rows; ++i) {
    for (int j = 0; j < columns; ++j) {
      const auto at = [columns](int row, int column) { return static_cast<uint32_t>(row * (columns + 1) + column); };
      const uint32_t a = at(i, j), b = at(i + 1, j), c = at(i + 1, j + 1), d = at(i, j + 1);
      if (i > 0) sphere.indices.insert(sphere.indices.end(), {a, d, b});
      if (i < rows - 1) sphere.indices.insert(sphere.indices.end(), {b, d, c});
    }
  }
  return sphere;
}

glm::mat4 sphere_camera(const glm::vec3& eye, int width, int height) {
  const glm::dmat4 projection = glm::perspective(glm::radians(45.0), static_cast<double>(width) / height, 0.5, 10.0);
  return glm::mat4(projection * glm::lookAt(glm::dvec3(eye), glm::dvec3(0.0), glm::dvec3(0.0, 1.0, 0.0)));
}

Image<glm::u8vec4> make_checker(int width, int height) {
  Image<glm::u8vec4> image(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      image.at(x, y) = ((x * 32 / width + y * 16 / height) & 1) != 0 ? glm::u8vec4(230, 230, 230, 255) : glm::u8vec4(40, 90, 160, 255);
  return image;
}

}  // namespace halfspace::test
