// SPDX-License-Identifier: Apache-2.0
#include "halfspace/model/ply/ply_colors.h"

#include <algorithm>
#include <cmath>

#include "halfspace/model/text/srgb_color.h"

namespace halfspace::HS_LANES {

namespace {

bool is_finite_color(const glm::vec4& c) { return std::isfinite(c.x) && std::isfinite(c.y) && std::isfinite(c.z) && std::isfinite(c.w); }

// Returns the value that means 1 if `largest` is the largest value of its kind.
float one_of(float largest, bool is_floating) {
  constexpr float kRounding = 1e-3f;  // values that other programs computed may exceed 1 slightly
  if (is_floating && largest <= 1.0f + kRounding) return 1.0f;
  return largest <= 255.0f + kRounding ? 255.0f : 65535.0f;
}

}  // namespace

std::vector<glm::vec4> linear_ply_colors(PlyColors& colors, std::size_t& replaced) {
  std::vector<glm::vec4> linear = std::move(colors.values);
  colors.values.clear();
  replaced = 0;
  glm::vec4 largest(0.0f);
  for (glm::vec4& c : linear) {
    for (glm::length_t i = 0; i < 4; ++i) {
      if (colors.types[static_cast<std::size_t>(i)] == PlyType::int8 && c[i] < 0.0f) c[i] += 256.0f;  // bytes declared as signed
    }
    if (is_finite_color(c)) largest = glm::max(largest, c);
  }
  const auto is_floating = [](PlyType type) { return type >= PlyType::float32; };
  const bool has_floats = std::all_of(colors.types.begin(), colors.types.begin() + 3, is_floating);
  const float one = one_of(std::max({largest.x, largest.y, largest.z}), has_floats),
              opaque = one_of(largest.w, is_floating(colors.types[3]));
  const auto channel = [one](float value) { return linear_from_srgb_code(one == 1.0f ? 255.0f * value : value / (one / 255.0f)); };
  for (glm::vec4& c : linear) {
    if (is_finite_color(c)) {
      c = {channel(c.x), channel(c.y), channel(c.z), std::clamp(c.w / opaque, 0.0f, 1.0f)};
    } else {
      c = glm::vec4(1.0f);
      ++replaced;
    }
  }
  return linear;
}

}  // namespace halfspace::HS_LANES
