// SPDX-License-Identifier: Apache-2.0
//
// Meshes for the comparison. They are the same on every machine, except for the last bit of libm's sin and cos.
#pragma once

#include <ostream>
#include <random>
#include <vector>

#include "halfspace/core/image.h"
#include "halfspace/core/vec.h"
#include "halfspace/raster/vertex_input.h"

namespace halfspace::test {

/// Vertices in clip space with colors.
struct ColoredMesh {
  std::vector<glm::vec4> pos_clip;
  std::vector<glm::vec4> colors;
  std::vector<uint32_t> indices;

  VertexView positions() const { return make_vertex_view(stream(pos_clip)); }
  VertexView positions_and_colors() const { return make_vertex_view(stream(pos_clip), stream(colors)); }
};

/// Parameters of random triangles. Lengths are in pixels.
struct Soup {
  int triangles = 0;
  float size = 0.0f;          ///< maximum distance of the vertices from the center
  float thickness = 0.0f;     ///< if positive, triangles are slivers of about this width
  float w_ratio = 1.0f;       ///< w of the vertices ranges over [1, w_ratio]
  bool crosses_near = false;  ///< some vertices are behind the near plane or the eye
  float grid = 0.0f;    ///< if positive, window positions are multiples of this and w is a power of two. In a window of 2^m × 2^n px,
                        ///< no rounding differs between renderers up to the 1/256 px grid.
  bool inside = false;  ///< no triangle extends beyond the window
  uint32_t seed = 1;
};
/// Parameter of the tests of random triangles.
struct SoupCase {
  const char* name;
  Soup soup;
  const char* what_mesa_does = nullptr;  ///< how Mesa differs; null if it must agree
  friend void PrintTo(const SoupCase& c, std::ostream* os) { *os << c.name; }
};
ColoredMesh make_soup(const Soup& soup, int width, int height);

/// Returns a grid of quads that extends beyond the window. Each vertex is shared by six triangles and displaced at random by up to `jitter`
/// cells. `opacity` is the alpha of every vertex.
ColoredMesh make_sheet(int columns, int rows, float jitter, uint32_t seed, float opacity = 1.0f);

/// Returns adjacent right triangles with an area of 1 px² (the workload tiny_1m at another size).
ColoredMesh make_tiny(int width, int height);

/// Adds a triangle with one color. Positions are in pixels, with depth (GL's z/w) as the third component.
void add_triangle(ColoredMesh& mesh, int width, int height, const std::array<glm::vec3, 3>& pos_px, const glm::vec4& color);

struct SphereVertex {
  glm::vec3 position, normal;
  glm::vec2 uv;
};
/// The unit sphere of the benchmark workloads: rows × columns quads of two triangles, or one triangle at the poles.
struct Sphere {
  std::vector<SphereVertex> vertices;
  std::vector<uint32_t> indices;

  VertexView view() const;
};
Sphere make_sphere(int rows, int columns);

/// Returns the transform from world space to clip space of the workloads' sphere scenes.
glm::mat4 sphere_camera(const glm::vec3& eye, int width, int height);

/// Returns the checkerboard of the workloads (32 × 16 squares) at any size.
Image<glm::u8vec4> make_checker(int width, int height);

}  // namespace halfspace::test
