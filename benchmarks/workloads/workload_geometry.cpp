// SPDX-License-Identifier: Apache-2.0
#include "workloads/workload_geometry.h"

#include <algorithm>
#include <cmath>

#include "workloads/workload_random.h"

namespace halfspace {

std::vector<glm::vec3> tiny_triangles(WorkloadSize size, int count, double area) {
  const double side = std::sqrt(2.0 * area), width = size.width, height = size.height;
  const int columns = std::max(static_cast<int>(std::floor(width / side)), 1);
  const int rows = std::max(static_cast<int>(std::floor(height / side)), 1);
  std::vector<glm::vec3> corners;
  corners.reserve(3 * static_cast<std::size_t>(count));
  for (int t = 0; t < count; ++t) {
    const int layer = t / (columns * rows), q = t % (columns * rows);
    const double x0 = q % columns * side, y0 = q / columns * side, z = 0.9 - 0.1 * layer;
    const auto corner = [&](double x, double y) { corners.emplace_back(glm::dvec3(2 * x / width - 1, 2 * y / height - 1, z)); };
    corner(x0, y0);
    corner(x0 + side, y0);
    corner(x0, y0 + side);
  }
  return corners;
}

std::vector<glm::vec3> point_cloud() {
  WorkloadRandom random;
  const auto coordinate = [&] { return static_cast<float>(random.between(-1.0, 1.0)); };
  std::vector<glm::vec3> cloud(100'000);
  for (glm::vec3& p : cloud) {
    p.x = coordinate();
    p.y = coordinate();
    p.z = coordinate();
  }
  return cloud;
}

PointShader point_shader(WorkloadSize size) {
  constexpr double kRadius = 0.012;
  const glm::dvec3 eye{0, 0, 4};
  const glm::dmat4 projection = workload_projection(size, 0.5, 10.0);
  return {.clip_from_world = glm::mat4(projection * look_at(eye, {0, 0, 0}, {0, 1, 0})),
          .eye_ws = glm::vec3(eye),
          .half_size = 0.5f * glm::vec2(size.width, size.height),
          .size_at_w1 = static_cast<float>(kRadius * size.height / kTanHalfAngle),
          .depth_a = static_cast<float>(projection[2][2]),
          .depth_b = static_cast<float>(projection[3][2]),
          .radius = static_cast<float>(kRadius)};
}

std::vector<ColoredQuad> grid_of_quads() {
  constexpr int kColumns = 100;
  std::vector<ColoredQuad> quads;
  const auto place = [](double cell) { return 2.0 * cell / kColumns - 1.0; };
  const auto corner = [](double x, double y) { return glm::vec3(glm::dvec3(x, y, 0.0)); };
  const auto share = [](int i) { return static_cast<float>(i) / kColumns; };
  for (int row = 0; row < kColumns; ++row) {
    for (int column = 0; column < kColumns; ++column) {
      const double x0 = place(column), x1 = place(column + 0.8), y0 = place(row), y1 = place(row + 0.8);
      quads.push_back({{share(column), share(row), 0.5f, 1.0f}, {corner(x0, y0), corner(x1, y0), corner(x0, y1), corner(x1, y1)}});
    }
  }
  return quads;
}

glm::mat4 floor_camera(WorkloadSize size) { return glm::mat4(workload_projection(size, 0.1, 2000.0)); }

ShadowCameras shadow_cameras(WorkloadSize size) {
  const glm::dvec3 to_light = unit_or_zero({0.5, 1.0, 0.3}), eye{0.0, 1.5, 4.5};
  const glm::dmat4 light = orthographic_gl(3.2, 1.0, 0.5, 8.0) * look_at(3.0 * to_light, {0, 0, 0}, {0, 1, 0});
  const glm::dmat4 camera = workload_projection(size, 0.5, 20.0) * look_at(eye, {0.0, -0.3, 0.0}, {0, 1, 0});
  return {glm::mat4(camera), glm::mat4(light), glm::vec3(eye), glm::vec3(to_light)};
}

SphereUniforms near_clip_uniforms(WorkloadSize size, const Texture2D& texture) {
  const glm::dvec3 eye{0.0, 0.0, 0.99};
  return {.clip_from_world = glm::mat4(workload_projection(size, 0.05, 10.0) * look_at(eye, eye + glm::dvec3(1, 0, 0), {0, 1, 0})),
          .texture = &texture,
          .eye_ws = glm::vec3(eye)};
}

}  // namespace halfspace
