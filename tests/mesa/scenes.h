// SPDX-License-Identifier: Apache-2.0
//
// Meshes for the comparison: the same on every machine, but for the last bit of libm's sin and cos.
#pragma once

#include <ostream>
#include <random>
#include <vector>

#include "halfspace/core/image.h"
#include "halfspace/core/vec.h"
#include "halfspace/raster/vertex_input.h"

namespace halfspace::test {

/// Vertices in clip space with a colour.
struct ColoredMesh {
  std::vector<glm::vec4> pos_clip;
  std::vector<glm::vec4> colors;
  std::vector<uint32_t> indices;

  VertexView positions() const { return make_vertex_view(stream(pos_clip)); }
  VertexView positions_and_colors() const { return make_vertex_view(stream(pos_clip), stream(colors)); }
};

/// What random triangles look like. Lengths in pixels.
struct Soup {
  int triangles = 0;
  float size = 0.0f;          ///< vertices lie within this distance of the centre
  float thickness = 0.0f;     ///< > 0: slivers of about this width
  float w_ratio = 1.0f;       ///< w of the vertices is spread over [1, w_ratio]
  bool crosses_near = false;  ///< some vertices lie behind the near plane or the eye
  float grid = 0.0f;          ///< > 0: window positions are multiples of this, and w a power of two. In a window of
                              ///< 2^m × 2^n px no rounding is then left to differ in up to the 1/256 px grid.
  bool inside = false;        ///< no triangle reaches beyond the window
  uint32_t seed = 1;
};
/// A parameter of tests of soups.
struct SoupCase {
  const char* name;
  Soup soup;
  const char* what_mesa_does = nullptr;  ///< null: it agrees
  friend void PrintTo(const SoupCase& c, std::ostream* os) { *os << c.name; }
};
ColoredMesh make_soup(const Soup& soup, int width, int height);

/// A sheet of quads, each corner shared by six triangles and moved at random by up to `jitter` cells. It covers the
/// window and more. opacity is every corner's alpha.
ColoredMesh make_sheet(int columns, int rows, float jitter, uint32_t seed, float opacity = 1.0f);

/// Right triangles of area 1 px², side by side (the workload tiny_1m at another size).
ColoredMesh make_tiny(int width, int height);

/// A triangle given by three points in pixels, with depths (GL's z/w) and one colour.
void add_triangle(ColoredMesh& mesh, int width, int height, const std::array<glm::vec3, 3>& pos_px, const glm::vec4& color);

struct SphereVertex {
  glm::vec3 position, normal;
  glm::vec2 uv;
};
/// The unit sphere of the benchmark workloads: rows × columns quads, two triangles each but at the poles.
struct Sphere {
  std::vector<SphereVertex> vertices;
  std::vector<uint32_t> indices;

  VertexView view() const;
};
Sphere make_sphere(int rows, int columns);

/// clip ← world of the workloads' sphere scenes.
glm::mat4 sphere_camera(const glm::vec3& eye, int width, int height);

/// The workloads' checker at any size: squares of size/32 texels.
Image<glm::u8vec4> make_checker(int width, int height);

}  // namespace halfspace::test
