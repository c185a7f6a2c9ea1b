// SPDX-License-Identifier: Apache-2.0
#include "halfspace/reference/edge_distance.h"

#include <algorithm>
#include <cmath>

namespace halfspace::HS_LANES {

std::vector<double> edge_distances(const std::vector<glm::ivec2>& from, const std::vector<glm::ivec2>& to, int width, int height) {
  if (to.empty()) return {};
  Image<uint8_t> marked(width, height);
  for (const glm::ivec2& p : to) marked.at(p.x, p.y) = 1;
  std::vector<double> distances;
  for (const glm::ivec2& p : from) {
    double best = 1e18;
    for (int r = 0; r * r <= best && r < std::max(width, height); ++r) {  // search squares of growing size around p
      for (int y = std::max(0, p.y - r); y <= std::min(height - 1, p.y + r); ++y) {
        const bool whole_row = std::abs(y - p.y) == r;
        for (int x = p.x - r; x <= p.x + r; x += whole_row ? 1 : std::max(1, 2 * r)) {
          if (x >= 0 && x < width && marked.at(x, y) != 0) best = std::min(best, std::pow(x - p.x, 2) + std::pow(y - p.y, 2));
        }
      }
    }
    distances.push_back(std::sqrt(best));
  }
  return distances;
}

EdgeDistance summary_of(std::vector<double> distances) {
  if (distances.empty()) return {};
  std::ranges::sort(distances);
  double sum = 0.0;
  for (const double d : distances) sum += d;
  const auto n = distances.size();
  return {sum / static_cast<double>(n), distances[(n - 1) * 95 / 100], distances.back()};
}

EdgeDistance wrong_band_width(const Image<uint8_t>& wrong, int finer) {
  std::vector<glm::ivec2> from, to;
  for (int y = 0; y < wrong.height(); ++y) {
    for (int x = 0; x < wrong.width(); ++x) (wrong.at(x, y) != 0 ? from : to).emplace_back(x, y);
  }
  const EdgeDistance depth = summary_of(edge_distances(from, to, wrong.width(), wrong.height()));
  const auto width = [&](double d) { return std::max(0.0, 2.0 * d - 1.0) / finer; };
  return {width(depth.mean), width(depth.p95), width(depth.max)};
}

}  // namespace halfspace::HS_LANES
