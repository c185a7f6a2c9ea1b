// SPDX-License-Identifier: Apache-2.0
#include "scenes/scene_shape.h"

#include <algorithm>
#include <array>

#include "halfspace/core/trig_double.h"

namespace halfspace {

namespace {

uint32_t next_index(const SceneShape& shape) { return static_cast<uint32_t>(shape.vertices.size()); }

void add_vertex(SceneShape& shape, const glm::dvec3& position, const glm::dvec3& normal, const glm::dvec2& uv) {
  shape.vertices.push_back({glm::vec3(position), glm::vec3(normal), glm::vec2(uv)});
}

// Adds the indices of a grid of vertices with columns + 1 vertices per row.
void add_grid(SceneShape& shape, uint32_t first, int columns, int rows) {
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      const uint32_t a = first + static_cast<uint32_t>(j * (columns + 1) + i), c = a + static_cast<uint32_t>(columns + 1);
      shape.indices.insert(shape.indices.end(), {a, a + 1, c, c, a + 1, c + 1});
    }
  }
}

// Adds the quad a, b, c, d, in counter-clockwise order.
struct QuadCorner {
  glm::dvec3 position, normal;
  glm::dvec2 uv;
};
void add_quad(SceneShape& shape, const std::array<QuadCorner, 4>& corners) {
  const uint32_t first = next_index(shape);
  for (const QuadCorner& c : corners) add_vertex(shape, c.position, c.normal, c.uv);
  shape.indices.insert(shape.indices.end(), {first, first + 1, first + 3, first + 3, first + 1, first + 2});
}

// Adds both sides of a vertical strip of a wall between x0 and x1, from the lower to the upper edge. The edges may be slanted.
struct Strip {
  double x0, low0, high0, x1, low1, high1;
};
void add_strip(SceneShape& shape, const Strip& s, double thickness, double scale) {
  for (const double side : {1.0, -1.0}) {
    const double z = 0.5 * side * thickness;
    const auto corner = [&](double x, double y) { return QuadCorner{{x, y, z}, {0, 0, side}, {side * x * scale, y * scale}}; };
    const QuadCorner a = corner(s.x0, s.low0), b = corner(s.x1, s.low1), c = corner(s.x1, s.high1), d = corner(s.x0, s.high0);
    add_quad(shape, side > 0 ? std::array{a, b, c, d} : std::array{b, a, d, c});
  }
}

// Adds the inner surface of an opening between two points of its outline. The normals point into the opening.
void add_reveal(SceneShape& shape, const std::array<glm::dvec2, 2>& at, const std::array<glm::dvec2, 2>& normal, double thickness,
                double scale) {
  const auto corner = [&](std::size_t k, double side) {
    const double along = k == 0 ? 0.0 : glm::length(at[1] - at[0]);
    return QuadCorner{
        {at[k].x, at[k].y, 0.5 * side * thickness}, {normal[k].x, normal[k].y, 0}, glm::dvec2(side * 0.5 * thickness, along) * scale};
  };
  add_quad(shape, {corner(0, -1), corner(0, 1), corner(1, 1), corner(1, -1)});
}

}  // namespace

void add_surface(SceneShape& shape, int columns, int rows, glm::dvec2 repeats, const SurfaceFunction& point) {
  constexpr double kStep = 1e-4;
  const uint32_t first = next_index(shape);
  for (int j = 0; j <= rows; ++j) {
    for (int i = 0; i <= columns; ++i) {
      const double u = static_cast<double>(i) / columns, v = static_cast<double>(j) / rows;
      const double inner = std::clamp(v, kStep, 1 - kStep);  // at a pole, du is zero
      const glm::dvec3 du = point(u + kStep, inner) - point(u - kStep, inner), dv = point(u, inner + kStep) - point(u, inner - kStep);
      add_vertex(shape, point(u, v), glm::normalize(glm::cross(du, dv)), glm::dvec2(u, v) * repeats);
    }
  }
  add_grid(shape, first, columns, rows);
}

void add_box(SceneShape& shape, glm::dvec3 center, glm::dvec3 size, double scale) {
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {1.0, -1.0}) {
      glm::dvec3 normal(0), right(0), up(0);
      normal[axis] = side;
      const int across = axis == 0 ? 2 : 0, along = axis == 1 ? 2 : 1;
      up[along] = axis == 1 ? -side : 1.0;
      right = glm::cross(up, normal);
      const double width = size[across], height = size[along];
      const auto corner = [&](double x, double y) {
        return QuadCorner{center + 0.5 * (normal * size[axis] + right * (x * width) + up * (y * height)), normal,
                          glm::dvec2(x * width, y * height) * (0.5 * scale)};
      };
      add_quad(shape, {corner(-1, -1), corner(1, -1), corner(1, 1), corner(-1, 1)});
    }
  }
}

void add_lathe(SceneShape& shape, std::span<const glm::dvec2> profile, int sectors, glm::dvec2 repeats, bool smooth) {
  const std::size_t pieces = profile.size() - 1;
  std::vector<glm::dvec2> normals;
  for (std::size_t k = 0; k < pieces; ++k) {
    const glm::dvec2 d = profile[k + 1] - profile[k];
    normals.push_back(glm::normalize(glm::dvec2(d.y, -d.x)));
  }
  for (std::size_t k = 0; k < pieces; ++k) {
    const uint32_t first = next_index(shape);
    for (std::size_t end = 0; end < 2; ++end) {
      glm::dvec2 n = normals[k];
      if (smooth && end == 0 && k > 0) n += normals[k - 1];
      if (smooth && end == 1 && k + 1 < pieces) n += normals[k + 1];
      n = glm::normalize(n);
      const glm::dvec2 at = profile[k + end];
      for (int i = 0; i <= sectors; ++i) {
        const double u = static_cast<double>(i) / sectors;
        const SinCosDouble a = sincos_turns(u);
        const double v = static_cast<double>(k + end) / static_cast<double>(pieces);
        add_vertex(shape, {at.x * a.cos, at.y, -at.x * a.sin}, {n.x * a.cos, n.y, -n.x * a.sin}, glm::dvec2(u, v) * repeats);
      }
    }
    add_grid(shape, first, sectors, 1);
  }
}

void add_tube(SceneShape& shape, int sectors, int rows, glm::dvec2 repeats, const std::function<glm::dvec3(double v)>& curve,
              const std::function<double(double v)>& radius) {
  add_surface(shape, sectors, rows, repeats, [&](double u, double v) {
    const glm::dvec3 along = glm::normalize(curve(v + 1e-3) - curve(v - 1e-3));
    const glm::dvec3 a = glm::normalize(glm::cross(along, glm::dvec3(0, 0, 1))), b = glm::cross(along, a);
    const SinCosDouble at = sincos_turns(u);
    return curve(v) + radius(v) * (a * at.cos + b * at.sin);
  });
}

void add_torus(SceneShape& shape, glm::dvec3 center, double radius, double tube, int sectors, int bands) {
  add_surface(shape, sectors, bands, {8, 1}, [=](double u, double v) {
    const SinCosDouble a = sincos_turns(u), b = sincos_turns(v);
    const double r = radius - tube * b.cos;
    return center + glm::dvec3(r * a.cos, -tube * b.sin, -r * a.sin);
  });
}

void add_card(SceneShape& shape, glm::dvec3 center, glm::dvec3 right, glm::dvec3 up, glm::dvec3 normal) {
  const auto corner = [&](double x, double y) { return QuadCorner{center + right * x + up * y, normal, {0.5 + 0.5 * x, 0.5 - 0.5 * y}}; };
  add_quad(shape, {corner(-1, -1), corner(1, -1), corner(1, 1), corner(-1, 1)});
}

void add_arched_wall(SceneShape& shape, const ArchedWall& w, double scale) {
  constexpr int kSegments = 24;
  const double half = 0.5 * w.width, r = w.radius;
  add_strip(shape, {-half, 0, w.height, -r, 0, w.height}, w.thickness, scale);
  add_strip(shape, {r, 0, w.height, half, 0, w.height}, w.thickness, scale);
  if (w.base > 0) {
    add_strip(shape, {-r, 0, w.base, r, 0, w.base}, w.thickness, scale);
    add_reveal(shape, {{{-r, w.base}, {r, w.base}}}, {{{0, 1}, {0, 1}}}, w.thickness, scale);
  }
  add_reveal(shape, {{{r, w.base}, {r, w.spring}}}, {{{-1, 0}, {-1, 0}}}, w.thickness, scale);
  add_reveal(shape, {{{-r, w.spring}, {-r, w.base}}}, {{{1, 0}, {1, 0}}}, w.thickness, scale);
  for (int i = 0; i < kSegments; ++i) {
    std::array<glm::dvec2, 2> at, normal;
    for (int k = 0; k < 2; ++k) {
      const SinCosDouble a = sincos_turns(0.5 * (i + k) / kSegments);
      at[static_cast<std::size_t>(k)] = {r * a.cos, w.spring + r * a.sin};
      normal[static_cast<std::size_t>(k)] = {-a.cos, -a.sin};
    }
    add_reveal(shape, at, normal, w.thickness, scale);
    add_strip(shape, {at[1].x, at[1].y, w.height, at[0].x, at[0].y, w.height}, w.thickness, scale);
  }
}

void add_shape(SceneShape& shape, const SceneShape& part, const glm::dmat4& transform) {
  const uint32_t first = next_index(shape);
  for (const SceneVertex& v : part.vertices) {
    add_vertex(shape, glm::dvec3(transform * glm::dvec4(v.position, 1.0)), glm::normalize(glm::dmat3(transform) * glm::dvec3(v.normal)),
               glm::dvec2(v.uv));
  }
  for (const uint32_t i : part.indices) shape.indices.push_back(first + i);
}

glm::dmat4 placed(glm::dvec3 position, double turns, glm::dvec3 scale) {
  const SinCosDouble a = sincos_turns(turns);
  return {scale.x * glm::dvec4(a.cos, 0, -a.sin, 0), scale.y * glm::dvec4(0, 1, 0, 0), scale.z * glm::dvec4(a.sin, 0, a.cos, 0),
          glm::dvec4(position, 1.0)};
}
glm::dmat4 turned_x(double turns) {
  const SinCosDouble a = sincos_turns(turns);
  return {glm::dvec4(1, 0, 0, 0), glm::dvec4(0, a.cos, a.sin, 0), glm::dvec4(0, -a.sin, a.cos, 0), glm::dvec4(0, 0, 0, 1)};
}
glm::dmat4 turned_z(double turns) {
  const SinCosDouble a = sincos_turns(turns);
  return {glm::dvec4(a.cos, a.sin, 0, 0), glm::dvec4(-a.sin, a.cos, 0, 0), glm::dvec4(0, 0, 1, 0), glm::dvec4(0, 0, 0, 1)};
}

std::size_t add_mesh(Scene& scene, const SceneShape& shape) {
  glm::dvec3 low(shape.vertices.front().position), high = low;
  for (const SceneVertex& v : shape.vertices) {
    low = glm::min(low, glm::dvec3(v.position));
    high = glm::max(high, glm::dvec3(v.position));
  }
  const auto base = static_cast<uint32_t>(scene.vertices.size());
  scene.meshes.push_back({static_cast<uint32_t>(scene.indices.size()), static_cast<uint32_t>(shape.indices.size()), low, high});
  scene.vertices.insert(scene.vertices.end(), shape.vertices.begin(), shape.vertices.end());
  for (const uint32_t i : shape.indices) scene.indices.push_back(base + i);
  return scene.meshes.size() - 1;
}

std::size_t add_texture(Scene& scene, const Image<glm::u8vec4>& image) {
  scene.textures.push_back(std::make_shared<const Texture2D>(image, TexelFormat::rgba8));
  return scene.textures.size() - 1;
}

std::size_t add_material(Scene& scene, const SceneMaterial& material) {
  scene.materials.push_back(material);
  return scene.materials.size() - 1;
}

void place(Scene& scene, std::size_t mesh, std::size_t material, const glm::dmat4& world_from_object) {
  scene.objects.push_back({mesh, material, world_from_object});
}

void place(Scene& scene, const SceneShape& shape, std::size_t material, const glm::dmat4& world_from_object) {
  place(scene, add_mesh(scene, shape), material, world_from_object);
}

}  // namespace halfspace
