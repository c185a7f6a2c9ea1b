// SPDX-License-Identifier: Apache-2.0
//
// Shared helpers of the raster tests: meshes in units of 1/256 px whose positions pass through the vertex stage exactly, and draws into a
// float image.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "halfspace/raster/pass.h"
#include "halfspace/raster/primitives/vertex_stage.h"
#include "support/random.h"
#include "support/sanitized.h"
#include "support/shaders.h"
#include "support/workers.h"

namespace halfspace::raster_test {

/// Returns the number of repetitions of a random test. It is reduced for sanitizer builds, which are many times slower.
constexpr int effort(int n) { return kSanitized ? (n + 15) / 16 : n; }

/// A window position in units of 1/256 px.
struct Point {
  int32_t x, y;
  friend bool operator==(const Point&, const Point&) = default;
};
using PointTriangle = std::array<Point, 3>;

/// Returns the clip position (w = 1) that maps to p in a viewport of width × height px at the origin. The result is exact if both sizes are
/// powers of two and |p| ≤ 2^23.
inline glm::vec4 clip_position(const Point& p, int width, int height, float z = 0.0f) {
  return {static_cast<float>(p.x - 128 * width) / static_cast<float>(128 * width),
          static_cast<float>(p.y - 128 * height) / static_cast<float>(128 * height), z, 1.0f};
}

inline constexpr BlendState kAdd{BlendEquation::add, BlendFactor::one, BlendFactor::one,
                                 BlendEquation::add, BlendFactor::one, BlendFactor::one};

/// Returns a triangle that covers any render target completely, at clip-space depth z.
inline std::vector<glm::vec4> full_screen(float z = 0.0f) { return {{-1, -1, z, 1}, {3, -1, z, 1}, {-1, 3, z, 1}}; }

/// Returns the pixel at window coordinates (x, y). The window origin is at the lower left, while images store the top row first.
template <class T>
const T& pixel(const Image<T>& image, int x, int y) {
  return image.at(x, image.height() - 1 - y);
}

/// Draws triangles with one color each. The colors are either added (blended), or the last triangle replaces the color (deferred).
inline PassStatistics draw_colors(Image<glm::vec4>& image, std::span<const PointTriangle> triangles, std::span<const glm::vec4> colors,
                                  bool add_up, const PassOptions& options = {}) {
  std::vector<glm::vec4> positions, vertex_colors;
  positions.reserve(triangles.size() * 3);
  vertex_colors.reserve(triangles.size() * 3);
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    for (const Point& p : triangles[i]) {
      positions.push_back(clip_position(p, image.width(), image.height()));
      vertex_colors.push_back(colors[i]);
    }
  }
  Pass pass(image.width(), image.height(), rgba32f_target(image), {}, options);
  DrawState state;
  if (add_up) state.blend = kAdd;
  pass.draw(FlatColorShader{}, make_vertex_view(stream(positions), stream(vertex_colors)), state);
  return pass.run(one_worker());
}

/// Runs only the vertex stage, on every vertex of the view.
template <class S>
ShadedVertices shade(const S& shader, const VertexView& view, const Rect& viewport, const DrawState& state = {}) {
  std::pmr::monotonic_buffer_resource memory;
  Draw draw(detail::kKernels<S, detail::DrawKind::color>, detail::keep_shader(shader, memory),
            std::make_shared<const Indices>(Indices::sequential(view.vertex_count)),
            {view.used_streams(), view.has_instance_streams, view.needs_conversion}, state,
            {.viewport = make_viewport(viewport, state.depth)});
  ShadedVertices out;
  allocate_vertices(draw, out);
  shade_vertices(draw, 0, view.vertex_count, out);
  return out;
}

/// Draws a mesh of clip positions. Every covered sample adds 1 to its pixel.
inline PassStatistics count_coverage(Image<glm::vec4>& image, const std::vector<glm::vec4>& positions, const std::vector<uint32_t>& indices,
                                     DrawState state = {}, const PassOptions& options = {}) {
  const Indices list(indices, positions.size());
  Pass pass(image.width(), image.height(), rgba32f_target(image), {}, options);
  state.blend = kAdd;
  pass.draw(ConstantShader{}, make_vertex_view(stream(positions)), list, state);
  return pass.run(one_worker());
}

}  // namespace halfspace::raster_test
