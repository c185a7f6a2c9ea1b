// SPDX-License-Identifier: Apache-2.0
//
// Tests values stored in render targets, and their order: light beyond the range of half, and blending on several threads.
#include <limits>

#include "halfspace/core/half.h"
#include "raster/raster_test.h"
#include "stability/regime.h"

namespace halfspace::stability {
namespace {

using namespace raster_test;

TEST(Stability, HalfFloatTargetsDoNotStoreInfinity) {
  int common = 0, ours = 0;
  for (const float light : {65504.0f, 65519.0f, 65520.0f, 1e5f, 1e9f, 3e38f, std::numeric_limits<float>::infinity()}) {
    const uint16_t half = float_to_half(light);
    common += (half & 0x7fffu) >= 0x7c00u;
    Image<U16Vec4> picture(8, 8);
    Pass pass(8, 8, rgba16f_target(picture), {});
    const std::vector<glm::vec4> corners = full_screen();
    pass.draw(ConstantShader{glm::vec4(light)}, make_vertex_view(stream(corners)));
    pass.run(one_worker());
    for (const U16Vec4& p : picture.texels()) ours += (p.x & 0x7fffu) >= 0x7c00u;
  }
  record_and_check(
      {22, "fp16 overflow", "light from 65504 to infinity; IEEE conversion vs. the conversion of the render target", "infinities stored"},
      common, 4, ours, 0);
}

Image<glm::vec4> blended(const std::vector<PointTriangle>& triangles, const std::vector<glm::vec4>& colors, int threads) {
  std::vector<glm::vec4> positions, vertex_colors;
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    for (const Point& p : triangles[i]) {
      positions.push_back(clip_position(p, 128, 128));
      vertex_colors.push_back(colors[i]);
    }
  }
  Image<glm::vec4> image(128, 128);
  Pass pass(128, 128, rgba32f_target(image), {}, {.tuning = {.tile_size = 16, .chunk_triangles = 16}});
  DrawState state;
  state.blend = BlendState{};
  pass.draw(FlatColorShader{}, make_vertex_view(stream(positions), stream(vertex_colors)), state);
  pass.run(Workers(threads));
  return image;
}

TEST(Stability, BlendingFollowsSubmissionOrder) {
  Random r(11);
  std::vector<PointTriangle> triangles(300);
  std::vector<glm::vec4> colors;
  for (PointTriangle& t : triangles) {
    for (Point& p : t) p = {r.integer(0, 32767), r.integer(0, 32767)};
    colors.emplace_back(r.real(0.0f, 1.0f), r.real(0.0f, 1.0f), r.real(0.0f, 1.0f), r.real(0.2f, 0.9f));
  }
  const Image<glm::vec4> one = blended(triangles, colors, 1);
  // The common method distributes triangles to n threads that draw concurrently; here the threads run one after another.
  int common = 0;
  for (std::size_t n = 2; n <= 8; ++n) {
    std::vector<PointTriangle> dealt;
    std::vector<glm::vec4> dealt_colors;
    for (std::size_t thread = 0; thread < n; ++thread) {
      for (std::size_t i = thread; i < triangles.size(); i += n) {
        dealt.push_back(triangles[i]);
        dealt_colors.push_back(colors[i]);
      }
    }
    common += !(blended(dealt, dealt_colors, 1) == one);
  }
  int ours = 0;
  for (int run = 0; run < 100; ++run) ours += !(blended(triangles, colors, 1 + run % 8) == one);
  record_and_check(
      {25, "order-dependent blending", "300 blended triangles; distributed over 2 to 8 threads vs. 100 runs of a pass with 1 to 8 threads",
       "images that differ from the single-threaded one"},
      common, 7, ours, 0);
}

}  // namespace
}  // namespace halfspace::stability
