// SPDX-License-Identifier: Apache-2.0
#include "halfspace/render/prepare/light_cells.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace halfspace::HS_LANES {

namespace {

bool is_limited(const Light& light) { return light.type == LightType::spot || light.inverse_range > 0.0f; }

// The part of space that a point or spot light can reach, in camera-relative world space.
class Reach {
 public:
  explicit Reach(const Light& light) : position_(light.position_rws), forward_(-light.axis_ws) {
    // The margin covers the rounding of positions in the shader.
    if (light.inverse_range > 0.0f) range_ = 1.001 / static_cast<double>(light.inverse_range);
    if (light.type != LightType::spot) return;
    is_cone_ = true;
    cos_ = std::clamp(static_cast<double>(light.cos_outer) - 1e-6, -1.0, 1.0);
    sin_ = std::sqrt(1.0 - cos_ * cos_);
  }

  // Returns true if a point of the reach is in front of a plane: dot(plane, (p, 1)) ≥ 0. The normal must be a unit vector.
  bool is_in_front(const glm::dvec4& plane) const {
    const glm::dvec3 normal(plane);
    const double distance = glm::dot(normal, position_) + plane.w;
    if (distance >= 0.0) return true;
    const double ascent = steepest_ascent(normal);
    return ascent > 0.0 && distance + range_ * ascent >= 0.0;
  }

 private:
  // Returns the largest dot product of the normal with a direction of the light: cos(max(φ − θ, 0)), where θ is the angle of the cone, and
  // φ the angle between its axis and the normal.
  double steepest_ascent(const glm::dvec3& normal) const {
    if (!is_cone_) return 1.0;
    const double cos_axis = glm::dot(normal, forward_);
    if (cos_axis >= cos_) return 1.0;
    return cos_axis * cos_ + std::sqrt(std::max(1.0 - cos_axis * cos_axis, 0.0)) * sin_;
  }

  glm::dvec3 position_, forward_;
  double range_ = std::numeric_limits<double>::infinity();
  bool is_cone_ = false;
  double cos_ = -1.0, sin_ = 0.0;
};

int cells_in(int pixels) { return (pixels + kLightCellPixels - 1) / kLightCellPixels; }

glm::dvec4 unit_plane(const glm::dvec4& plane) { return plane / std::sqrt(glm::dot(glm::dvec3(plane), glm::dvec3(plane))); }

// The planes between cells along one axis of the window. Everything in front of plane i is seen at or after the start of cell i.
std::vector<glm::dvec4> planes_between(const glm::dvec4& clip_row, const glm::dvec4& w_row, int pixels) {
  std::vector<glm::dvec4> planes;
  for (int i = 0; i <= cells_in(pixels); ++i) {
    const double ndc = 2.0 * std::min(i * kLightCellPixels, pixels) / pixels - 1.0;
    planes.push_back(unit_plane(clip_row - ndc * w_row));
  }
  return planes;
}

// Returns for each cell along an axis whether it can see a part of the reach.
std::vector<bool> seen_cells(const Reach& reach, const std::vector<glm::dvec4>& planes) {
  std::vector<bool> seen;
  for (std::size_t i = 0; i + 1 < planes.size(); ++i) seen.push_back(reach.is_in_front(planes[i]) && reach.is_in_front(-planes[i + 1]));
  return seen;
}

}  // namespace

std::shared_ptr<const LightCells> light_cells(const View& view, std::span<const Light> lights) {
  if (static_cast<std::size_t>(std::ranges::count_if(lights, is_limited)) < kManyLights) return nullptr;
  glm::dmat4 world_from_rws(1.0);
  world_from_rws[3] = glm::dvec4(view.eye_ws, 1.0);
  const glm::dmat4 rows = glm::transpose(view.clip_from_world * world_from_rws);
  const std::vector<glm::dvec4> x_planes = planes_between(rows[0], rows[3], view.width_px);
  const std::vector<glm::dvec4> y_planes = planes_between(rows[1], rows[3], view.height_px);

  LightCells cells;
  cells.columns = cells_in(view.width_px);
  cells.rows = cells_in(view.height_px);
  std::vector<std::vector<uint32_t>> lists(static_cast<std::size_t>(cells.columns) * static_cast<std::size_t>(cells.rows));
  for (uint32_t i = 0; i < lights.size(); ++i) {
    std::vector<bool> in_column(static_cast<std::size_t>(cells.columns), true), in_row(static_cast<std::size_t>(cells.rows), true);
    if (is_limited(lights[i])) {
      const Reach reach(lights[i]);
      in_column = seen_cells(reach, x_planes);
      in_row = seen_cells(reach, y_planes);
    }
    for (std::size_t row = 0; row < in_row.size(); ++row) {
      for (std::size_t column = 0; column < in_column.size(); ++column) {
        if (in_row[row] && in_column[column]) lists[row * in_column.size() + column].push_back(i);
      }
    }
  }
  cells.first.push_back(0);
  for (const std::vector<uint32_t>& list : lists) {
    cells.numbers.insert(cells.numbers.end(), list.begin(), list.end());
    cells.first.push_back(static_cast<uint32_t>(cells.numbers.size()));
  }
  return std::make_shared<const LightCells>(std::move(cells));
}

}  // namespace halfspace::HS_LANES
