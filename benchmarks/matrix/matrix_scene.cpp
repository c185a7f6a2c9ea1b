// SPDX-License-Identifier: Apache-2.0
#include "matrix/matrix_scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

#include "halfspace/geometry/camera.h"
#include "workloads/workload_canvas.h"
#include "workloads/workload_random.h"

namespace halfspace {

namespace {

constexpr int kSheets = 3, kColumns = 258, kRows = 129, kTextures = 8;
constexpr double kEyeZ = 3.5, kNearEyeZ = 0.75;
constexpr uint32_t kRestart = 0xffffffffu;

// Adds a wavy sheet of columns x rows quads. At its distance, it is wider than the view.
void add_sheet(MatrixScene& scene, int sheet, int columns, int rows, double aspect) {
  const double z0 = 0.7 * (1 - sheet), half_height = 1.15 * kTanHalfAngle * (kEyeZ - z0 + 0.4), half_width = half_height * aspect;
  for (int j = 0; j <= rows; ++j) {
    for (int i = 0; i <= columns; ++i) {
      const double u = static_cast<double>(i) / columns, v = static_cast<double>(j) / rows;
      const double a = 9.0 * u + 2.0 * sheet, b = 7.0 * v + sheet;
      const double x = half_width * (2 * u - 1), y = half_height * (2 * v - 1), z = z0 + 0.4 * std::sin(a) * std::cos(b);
      const double dx = 0.4 * std::cos(a) * std::cos(b) * 9.0 / (2 * half_width);
      const double dy = -0.4 * std::sin(a) * std::sin(b) * 7.0 / (2 * half_height);
      scene.vertices.push_back({glm::vec3(x, y, z), glm::vec3(glm::normalize(glm::dvec3(-dx, -dy, 1.0))),
                                glm::vec2(static_cast<float>(2 * u - 0.5), static_cast<float>(2 * v - 0.5))});
    }
  }
}

uint32_t vertex_at(int sheet, int columns, int rows, int i, int j) {
  return static_cast<uint32_t>((sheet * (rows + 1) + j) * (columns + 1) + i);
}

// Calls f(lower left, lower right, upper left, upper right) for each quad of the sheets.
template <class F>
void for_each_quad(int sheets, int columns, int rows, F f) {
  for (int s = 0; s < sheets; ++s) {
    for (int j = 0; j < rows; ++j) {
      for (int i = 0; i < columns; ++i) {
        f(vertex_at(s, columns, rows, i, j), vertex_at(s, columns, rows, i + 1, j), vertex_at(s, columns, rows, i, j + 1),
          vertex_at(s, columns, rows, i + 1, j + 1));
      }
    }
  }
}

void add_grid(MatrixScene& scene, int sheets, int columns, int rows, double aspect) {
  for (int s = 0; s < sheets; ++s) add_sheet(scene, s, columns, rows, aspect);
  for_each_quad(sheets, columns, rows, [&](uint32_t a, uint32_t b, uint32_t c, uint32_t d) {
    scene.indices.insert(scene.indices.end(), {a, b, c, c, b, d});
  });
}

void use_edges(MatrixScene& scene) {
  scene.indices.clear();
  for_each_quad(kSheets, kColumns, kRows, [&](uint32_t a, uint32_t b, uint32_t, uint32_t) {
    scene.indices.insert(scene.indices.end(), {a, b});
  });
}

void use_strips(MatrixScene& scene) {
  scene.indices.clear();
  for (int s = 0; s < kSheets; ++s) {
    for (int j = 0; j < kRows; ++j) {
      for (int i = 0; i <= kColumns; ++i) {
        scene.indices.push_back(vertex_at(s, kColumns, kRows, i, j + 1));
        scene.indices.push_back(vertex_at(s, kColumns, kRows, i, j));
      }
      scene.indices.push_back(kRestart);
    }
  }
}

void add_triangles(MatrixScene& scene, int count, float pixels, double aspect) {
  WorkloadRandom random;
  const float radius = pixels / 1080.0f;  // of the circumscribed circle; clip space is 2 units high
  for (int t = 0; t < count; ++t) {
    const glm::vec3 center(2 * random.unit() - 1, 2 * random.unit() - 1, 1.8f * random.unit() - 0.9f);
    const float turn = 6.2831853f * random.unit();
    for (int k = 0; k < 3; ++k) {
      const float angle = turn + 2.0943951f * static_cast<float>(k);
      const glm::vec2 corner(std::cos(angle), std::sin(angle));
      const glm::vec3 at(corner.x / static_cast<float>(aspect), corner.y, 0.1f * corner.x);
      scene.indices.push_back(static_cast<uint32_t>(scene.vertices.size()));
      scene.vertices.push_back({center + radius * at, glm::normalize(glm::vec3(0.5f * corner, 1.0f)), glm::vec2(center) + radius * corner});
    }
  }
}

void add_quad(MatrixScene& scene) {
  for (int i = 0; i < 4; ++i) {
    const glm::vec2 uv(static_cast<float>(i & 1), static_cast<float>(i >> 1));
    scene.vertices.push_back({glm::vec3(2.0f * uv - 1.0f, 0.0f), {0, 0, 1}, uv});
  }
  scene.indices = {0, 1, 2, 2, 1, 3};
}

void shuffle_triangles(MatrixScene& scene) {
  WorkloadRandom random;
  for (auto n = static_cast<uint32_t>(scene.indices.size() / 3); n > 1; --n) {
    const uint32_t other = random.below(n);
    std::swap_ranges(&scene.indices[3 * (n - 1)], &scene.indices[3 * (n - 1)] + 3, &scene.indices[3 * std::size_t{other}]);
  }
}

void shuffle_vertices(MatrixScene& scene) {
  WorkloadRandom random;
  std::vector<uint32_t> place(scene.vertices.size());
  std::iota(place.begin(), place.end(), 0u);
  for (auto n = static_cast<uint32_t>(place.size()); n > 1; --n) std::swap(place[n - 1], place[random.below(n)]);
  std::vector<MatrixVertex> moved(scene.vertices.size());
  for (std::size_t i = 0; i < place.size(); ++i) moved[place[i]] = scene.vertices[i];
  scene.vertices = std::move(moved);
  for (uint32_t& i : scene.indices) i = place[i];
}

// Returns k periods of sine and cosine over `size` texels.
struct Waves {
  Waves(int k, int size) {
    for (int i = 0; i < size; ++i) {
      const double angle = 6.283185307179586 * k * (i + 0.5) / size;
      sine.push_back(static_cast<float>(std::sin(angle)));
      cosine.push_back(static_cast<float>(std::cos(angle)));
    }
  }
  std::vector<float> sine, cosine;
};

// Returns a texture with smooth waves between 0.1 and 0.9 in all four channels. `index` shifts the waves.
Image<glm::vec4> wave_image(int width, int height, int index) {
  constexpr std::array<std::array<int, 2>, 4> periods{{{3, 1}, {-1, 2}, {4, -2}, {5, 4}}};
  Image<glm::vec4> image(width, height);
  for (int k = 0; k < 4; ++k) {
    const Waves along_x(periods[static_cast<std::size_t>(k)][0], width), along_y(periods[static_cast<std::size_t>(k)][1], height);
    const float turn = 0.7f * static_cast<float>(index * (k + 1)), s = std::sin(turn), c = std::cos(turn);
    for (int y = 0; y < height; ++y) {
      const float sin_y = along_y.sine[static_cast<std::size_t>(y)], cos_y = along_y.cosine[static_cast<std::size_t>(y)];
      const float sin_at = sin_y * c + cos_y * s, cos_at = cos_y * c - sin_y * s;
      for (int x = 0; x < width; ++x) {
        const auto i = static_cast<std::size_t>(x);
        image.at(x, y)[k] = 0.5f + 0.4f * (along_x.sine[i] * cos_at + along_x.cosine[i] * sin_at);
      }
    }
  }
  return image;
}

std::shared_ptr<const Texture2D> make_texture(MatrixTexture kind, int index) {
  const bool odd = kind == MatrixTexture::odd;
  const Image<glm::vec4> image = wave_image(odd ? 1000 : 1024, odd ? 602 : 1024, index);
  if (kind == MatrixTexture::half_float) return std::make_shared<Texture2D>(image, TexelFormat::rgba16f);
  Image<glm::u8vec4> codes(image.width(), image.height());
  for (std::size_t i = 0; i < codes.texels().size(); ++i) codes.data()[i] = glm::u8vec4(glm::round(image.data()[i] * 255.0f));
  return std::make_shared<Texture2D>(codes, kind == MatrixTexture::srgb ? TexelFormat::srgb8a8 : TexelFormat::rgba8);
}

// Returns a texture that is created once for all rows.
std::shared_ptr<const Texture2D> shared_texture(MatrixTexture kind, int index) {
  static std::map<std::pair<MatrixTexture, int>, std::shared_ptr<const Texture2D>> textures;
  std::shared_ptr<const Texture2D>& texture = textures[{kind, index}];
  if (!texture) texture = make_texture(kind, index);
  return texture;
}

}  // namespace

std::span<const uint32_t> MatrixScene::part(int i, int n) const {
  const auto at = [&](int k) { return indices.size() / 6 * static_cast<std::size_t>(k) / static_cast<std::size_t>(n) * 6; };
  if (n == 1) return indices;
  const std::size_t begin = at(i), end = i + 1 == n ? indices.size() : at(i + 1);
  return std::span(indices).subspan(begin, end - begin);
}

MatrixScene matrix_scene(const MatrixRow& row, WorkloadSize size) {
  MatrixScene scene;
  const double aspect = static_cast<double>(size.width) / size.height;
  switch (row.mesh) {
    case MatrixMesh::triangles: add_triangles(scene, row.count, row.pixels, aspect); break;
    case MatrixMesh::quad: add_quad(scene); break;
    case MatrixMesh::tiles: add_grid(scene, 1, 32, 32, aspect); break;
    default: add_grid(scene, kSheets, kColumns, kRows, aspect); break;
  }
  if (row.mesh == MatrixMesh::edges) use_edges(scene);
  if (row.mesh == MatrixMesh::strips) use_strips(scene);
  if (row.mesh == MatrixMesh::points) {
    scene.indices.resize(scene.vertices.size());
    std::iota(scene.indices.begin(), scene.indices.end(), 0u);
  }
  if (row.order == MatrixOrder::shuffled_triangles) shuffle_triangles(scene);
  if (row.order == MatrixOrder::shuffled_vertices) shuffle_vertices(scene);
  if (row.mesh != MatrixMesh::triangles && row.mesh != MatrixMesh::quad) {
    const double z = row.mesh == MatrixMesh::near ? kNearEyeZ : kEyeZ;
    scene.clip_from_world = glm::mat4(workload_projection(size, 0.25, 10.0) * look_at({0, 0, z}, {0, 0, z - 1}, {0, 1, 0}));
  }
  for (int i = 0; i < std::min(kTextures, row.draws + row.textures - 1); ++i) scene.textures.push_back(shared_texture(row.texels, i));
  return scene;
}

std::shared_ptr<const Texture2D> matrix_light(WorkloadSize size) {
  Image<glm::vec4> image = wave_image(size.width, size.height, 0);
  for (std::size_t i = 0; i < image.texels().size(); ++i) image.data()[i] *= 8.0f;
  return std::make_shared<Texture2D>(std::span<const Image<glm::vec4>>(&image, 1), TexelFormat::rgba16f);
}

Rect matrix_scissor(WorkloadSize size) { return {size.width / 4, size.height / 4, size.width / 2, size.height / 2}; }

}  // namespace halfspace
