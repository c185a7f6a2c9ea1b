// SPDX-License-Identifier: Apache-2.0
//
// The matrix: one scene of medium size, drawn with many different draw states, one per row. A row describes its state completely, and
// halfspace-bench and halfspace-bench-gl draw the same rows.
#pragma once

#include <span>
#include <string_view>

#include "halfspace/raster/draw_state.h"
#include "halfspace/raster/target.h"
#include "halfspace/shading/texture/sampler.h"
#include "workloads/workload.h"

namespace halfspace {

enum class MatrixMesh : uint8_t {
  sheets,     ///< three intersecting wavy sheets of 200,000 triangles in total, which cover the image three times
  near,       ///< the sheets seen from so close that the near plane clips triangles
  tiles,      ///< 98 instances of one sheet of 2048 triangles
  edges,      ///< the grid lines of the sheets in one direction
  strips,     ///< the sheets as triangle strips with primitive restart
  points,     ///< the vertices of the sheets
  triangles,  ///< `count` random triangles of size `pixels`, without shared vertices
  quad        ///< a full-screen quad without a depth buffer
};
enum class MatrixOrder : uint8_t { ordered, shuffled_triangles, shuffled_vertices };
enum class MatrixTexture : uint8_t {
  square,     ///< 1024 x 1024, rgba8
  odd,        ///< 1000 x 602, rgba8
  srgb,       ///< 1024 x 1024, srgb8a8
  half_float  ///< 1024 x 1024, rgba16f
};
/// Fragment functions. Those with the suffix `visible` also have a visibility function.
enum class MatrixShader : uint8_t {
  lit,    ///< diffuse light times the mean of `textures` lookups
  alpha,  ///< lit, with the alpha of the textures
  tint,   ///< an interpolated color with an alpha of 0.5
  dual,   ///< alpha, with a second color for dual-source blending
  holes,  ///< lit; discards fragments with an alpha below `threshold`
  holes_visible,
  depth,  ///< lit; writes a modified depth
  depth_visible,
  varyings,  ///< the mean of `varyings` floats
  constant,  ///< a constant color
  color,     ///< an interpolated color
  texture,   ///< one texture
  tone       ///< the tone curve of the workload `tonemap`, applied to a half-float texture of the size of the image
};

/// A row of the matrix. The defaults describe the row `plain`, with which all other rows are compared.
struct MatrixRow {
  std::string_view name, what;
  MatrixMesh mesh = MatrixMesh::sheets;
  MatrixShader shader = MatrixShader::lit;
  MatrixOrder order = MatrixOrder::ordered;
  MatrixTexture texels = MatrixTexture::square;
  int textures = 1;     ///< 1, 2, 4 or 8
  int varyings = 0;     ///< 0, 4, 8 or 16
  int count = 0;        ///< number of random triangles
  float pixels = 0;     ///< diameter of the circumscribed circle of random triangles, in pixels of a 1080-pixel-high image
  float threshold = 0;  ///< alpha threshold of `holes`
  int draws = 3;        ///< number of draw calls that share the indices; each uses the next texture
  ColorFormat color = ColorFormat::rgba8;
  DepthFormat depth = DepthFormat::d32f;
  int samples = 1;
  bool half_scissor = false;  ///< scissor rectangle in the center of the image, with half its width and height
  DrawState state{};
  Sampler sampler{};
  /// The row draws opaque triangles with one sample, so its picture can be compared with a double-precision reference.
  bool is_exact = false;
  /// The picture can be compared with OpenGL. False if the OpenGL specification leaves the result to the implementation.
  bool is_comparable = true;
};

/// Returns the rows of the matrix in display order.
std::span<const MatrixRow> matrix_rows();
/// Returns a workload for each row, rendered by Halfspace.
std::span<const WorkloadKind> matrix_workloads();

}  // namespace halfspace
