// SPDX-License-Identifier: Apache-2.0
#include "cli/naive_picture.h"

#include <fmt/format.h>

#include <chrono>
#include <cstring>

#include "halfspace/render/frame/frame.h"
#include "halfspace/render/frame/naive_render.h"

namespace halfspace {

namespace {

template <class F>
double milliseconds_of(F&& run) {
  const auto start = std::chrono::steady_clock::now();
  run();
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

int64_t differing_pixels(const Image<glm::vec4>& a, const Image<glm::vec4>& b) {
  int64_t count = 0;
  for (std::size_t i = 0; i < a.texels().size(); ++i) count += std::memcmp(&a.texels()[i], &b.texels()[i], sizeof(glm::vec4)) != 0 ? 1 : 0;
  return count;
}

}  // namespace

PassStatistics draw_naive_picture(const PreparedScene& scene, const FrameImages& images, const Workers& workers, NaiveReport& report) {
  Image<glm::vec4> naive(scene.view.width_px, scene.view.height_px), tiles(naive.width(), naive.height());
  PassStatistics counts;
  report.naive_ms += milliseconds_of([&] { render_naive(scene, naive); });
  report.tiles_ms += milliseconds_of([&] { counts = render(scene, tiles, workers); });
  report.pixels += static_cast<int64_t>(naive.texels().size());
  report.differing += differing_pixels(naive, tiles);
  display_frame(scene, naive, images, workers);
  return counts;
}

std::string naive_line(const NaiveReport& r, int threads) {
  const double ratio = r.naive_ms / r.tiles_ms;
  return fmt::format(
      "naive pipeline: {} of {} pixels differ; takes {:.{}f} times as long ({:.1f} ms instead of {:.1f} ms with {} thread{})\n",
      r.differing, r.pixels, ratio, ratio < 1.0 ? 2 : 1, r.naive_ms, r.tiles_ms, threads, threads == 1 ? "" : "s");
}

}  // namespace halfspace
