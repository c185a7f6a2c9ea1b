// SPDX-License-Identifier: Apache-2.0
#include "explain/pixel_history.h"

#include <algorithm>
#include <array>

namespace halfspace {

namespace {

struct OutcomeWords {
  const char *name, *text;
};
constexpr std::array<OutcomeWords, kFragmentOutcomes> kOutcomeWords{{
    {"tile_rejected", "rejected with its tile"},
    {"block_rejected", "rejected with its block"},
    {"depth_failed", "failed the depth test"},
    {"stencil_failed", "failed the stencil test"},
    {"discarded", "discarded"},
    {"hidden_before_shading", "hidden before shading"},
    {"depth_only", "wrote depth only"},
    {"shaded", "shaded"},
    {"blended", "blended"},
    {"layered", "kept as a transparent layer"},
    {"layer_merged", "kept as a transparent layer; the two farthest layers were merged"},
}};

std::size_t index_of(const FrameTrace& trace, const glm::ivec2& pixel) {
  return static_cast<std::size_t>(pixel.y) * static_cast<std::size_t>(trace.width) + static_cast<std::size_t>(pixel.x);
}

}  // namespace

const char* outcome_name(FragmentOutcome outcome) { return kOutcomeWords[static_cast<std::size_t>(outcome)].name; }
const char* outcome_text(FragmentOutcome outcome) { return kOutcomeWords[static_cast<std::size_t>(outcome)].text; }

std::span<const TracedFragment> FrameTrace::at(glm::ivec2 pixel) const {
  const std::size_t i = index_of(*this, pixel);
  return std::span(fragments).subspan(first[i], first[i + 1] - first[i]);
}

uint32_t FrameTrace::count(glm::ivec2 pixel) const {
  const std::size_t i = index_of(*this, pixel);
  return first[i + 1] - first[i] + others[i];
}

glm::ivec2 FrameTrace::busiest_pixel() const {
  std::size_t best = 0;
  const auto count_of = [this](std::size_t i) { return first[i + 1] - first[i] + others[i]; };
  for (std::size_t i = 1; i < others.size(); ++i) {
    if (count_of(i) > count_of(best)) best = i;
  }
  const auto row = static_cast<std::size_t>(width);
  return {static_cast<int>(best % row), static_cast<int>(best / row)};
}

}  // namespace halfspace
