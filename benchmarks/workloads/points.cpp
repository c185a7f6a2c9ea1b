// SPDX-License-Identifier: Apache-2.0
//
// points_100k: point sprites that are shaded as spheres and write depth.
#include <cmath>

#include "workloads/families.h"
#include "workloads/workload_canvas.h"
#include "workloads/workload_geometry.h"

namespace halfspace {

namespace {

constexpr double kRadius = 0.012;
constexpr double kEyeZ = 4.0;

class Points final : public Workload {
 public:
  explicit Points(WorkloadSize size)
      : canvas_(size), size_(size), cloud_(point_cloud()), indices_(Indices::sequential(cloud_.size())), shader_(point_shader(size)) {}

  void frame(const Workers& workers) override {
    DrawState state;
    state.topology = Topology::points;
    Pass pass = canvas_.pass();
    pass.draw(shader_, make_vertex_view(stream(cloud_)), indices_, state);
    pass.run(workers);
  }
  WorkloadPicture picture() const override { return canvas_.picture(); }

  // Evaluates the formulas in double at every pixel in the disk of a point. The centers are not snapped.
  WorkloadTruth truth() const override {
    WorkloadTruth target = canvas_.truth();
    for (const glm::vec3& p : cloud_) draw_exact(target, glm::dvec3(p));
    return target;
  }

 private:
  void draw_exact(WorkloadTruth& target, const glm::dvec3& position) const {
    const glm::dvec3 center = position - glm::dvec3(0, 0, kEyeZ);
    const double w = -center.z, focal = size_.height / (2.0 * kTanHalfAngle);  // px per unit of x/w
    const double x = 0.5 * size_.width + focal * center.x / w, y = 0.5 * size_.height + focal * center.y / w;
    const double radius = focal * kRadius / w;
    const int x1 = std::min(static_cast<int>(std::floor(x + radius)), size_.width - 1);
    const int y1 = std::min(static_cast<int>(std::floor(y + radius)), size_.height - 1);
    for (int j = std::max(static_cast<int>(std::floor(y - radius)), 0); j <= y1; ++j) {
      for (int i = std::max(static_cast<int>(std::floor(x - radius)), 0); i <= x1; ++i) {
        shade_exact(target, i, j, {(i + 0.5 - x) / radius, (j + 0.5 - y) / radius}, position);
      }
    }
  }
  void shade_exact(WorkloadTruth& target, int i, int j, const glm::dvec2& d, const glm::dvec3& position) const {
    const double squared = d.x * d.x + d.y * d.y;
    if (squared > 1.0) return;
    const glm::dvec3 n(d.x, d.y, std::sqrt(1.0 - squared)), p = position - glm::dvec3(0, 0, kEyeZ) + kRadius * n;
    const double near = 0.5, far = 10.0;
    const double depth = 0.5 + 0.5 * ((far + near) / (far - near) + 2.0 * far * near / (far - near) / p.z);
    const int row = size_.height - 1 - j;
    if (depth >= target.depth.at(i, row)) return;
    target.depth.at(i, row) = depth;
    const WorkloadLight<double> light = phong(vec3<double>(n), unit(vec3<double>(shader_.light_es) - p), unit(vec3<double>(-p)));
    target.color.at(i, row) = lit(vec3<double>(0.5 + 0.5 * position), light);
  }

  Canvas canvas_;
  WorkloadSize size_;
  std::vector<glm::vec3> cloud_;
  Indices indices_;
  PointShader shader_;
};

}  // namespace

std::unique_ptr<Workload> prepare_points_100k(WorkloadSize size, WorkloadAssets&) { return std::make_unique<Points>(size); }

}  // namespace halfspace
