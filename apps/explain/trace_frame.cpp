// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <utility>

#include "explain/pixel_history.h"
#include "halfspace/raster/inspect/inspection.h"
#include "halfspace/render/frame/scene_pass.h"

namespace halfspace {

namespace {

// Calls f(index of the pixel by row from the upper left, its fragments) for each pixel of a tile.
template <class F>
void for_each_traced_pixel(const TileFragments& tile, const PassTrace& trace, const F& f) {
  if (tile.first.empty()) return;
  for (int y = 0; y < tile.height; ++y) {
    const std::size_t row = static_cast<std::size_t>(trace.height - 1 - (tile.y0 + y)) * static_cast<std::size_t>(trace.width);
    for (int x = 0; x < tile.width; ++x) {
      const auto i = static_cast<std::size_t>(y * tile.width + x);
      f(row + static_cast<std::size_t>(tile.x0 + x), std::span(tile.fragments).subspan(tile.first[i], tile.first[i + 1] - tile.first[i]));
    }
  }
}

// Limits the number of fragments to kMaxFragments. Removes unshaded fragments first, starting at the end. Returns the number of removed
// fragments.
uint32_t limit_fragments(std::vector<TracedFragment>& fragments) {
  if (fragments.size() <= FrameTrace::kMaxFragments) return 0;
  const auto excess = static_cast<uint32_t>(fragments.size()) - FrameTrace::kMaxFragments;
  uint32_t removed = 0;
  for (const bool shaded : {false, true}) {
    for (std::size_t i = fragments.size(); i-- > 0 && removed < excess;) {
      if (fragments[i].is_shaded != shaded) continue;
      fragments.erase(fragments.begin() + static_cast<std::ptrdiff_t>(i));
      ++removed;
    }
  }
  return removed;
}

// Sorts the fragments of all rounds of the pass by pixel.
void collect_fragments(PassTrace& pass, FrameTrace& out) {
  const std::size_t pixels = static_cast<std::size_t>(out.width) * static_cast<std::size_t>(out.height);
  std::vector<std::vector<std::span<const TracedFragment>>> by_pixel(pixels);
  for (const std::vector<TileFragments>& tiles : pass.rounds) {
    for (const TileFragments& tile : tiles) {
      for_each_traced_pixel(tile, pass, [&](std::size_t pixel, std::span<const TracedFragment> fragments) {
        if (!fragments.empty()) by_pixel[pixel].push_back(fragments);
      });
    }
  }
  out.first.push_back(0);
  std::vector<TracedFragment> here;
  for (const std::vector<std::span<const TracedFragment>>& rounds : by_pixel) {
    here.clear();
    for (const std::span<const TracedFragment> fragments : rounds) here.insert(here.end(), fragments.begin(), fragments.end());
    out.others.push_back(limit_fragments(here));
    out.fragments.insert(out.fragments.end(), here.begin(), here.end());
    out.first.push_back(static_cast<uint32_t>(out.fragments.size()));
  }
}

}  // namespace

FrameTrace trace_frame(const PreparedScene& scene, const Workers& workers) {
  FrameTrace out;
  out.width = scene.view.width_px;
  out.height = scene.view.height_px;
  out.samples = scene.samples;
  out.picture = Image<glm::u8vec4>(out.width, out.height);
  PassTrace trace;
  out.statistics = render_with(scene, out.picture, workers, [&](Pass& pass) { return run_traced(pass, workers, trace); });
  out.format = trace.format;
  collect_fragments(trace, out);
  out.values = std::move(trace.values);
  out.light = Image<glm::vec4>(out.width, out.height);
  std::ranges::copy(trace.resolved, out.light.data());
  out.exposure = frame_exposure(scene, out.light, workers);
  return out;
}

void visit_set_up_scene(const PreparedScene& scene, const Workers& workers,
                        const std::function<void(const PassContext& context, int round)>& visit) {
  Image<glm::u8vec4> unused(scene.view.width_px, scene.view.height_px);
  render_with(scene, unused, workers, [&](Pass& pass) {
    visit_set_up(pass, workers, visit);
    return PassStatistics{};
  });
}

}  // namespace halfspace
