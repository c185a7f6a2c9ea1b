// SPDX-License-Identifier: Apache-2.0
#include <array>

#include "halfspace/core/trig_double.h"
#include "scenes/workshop_parts.h"

namespace halfspace::workshop {

namespace {

// Adds a prism around the y axis. The outline must be star-shaped around the axis, and counter-clockwise seen from above.
void add_prism(SceneShape& shape, const std::function<double(double turns)>& radius, int corners, double low, double high) {
  const auto at = [&](int i, double y) {
    const double u = static_cast<double>(i) / corners;
    const SinCosDouble a = sincos_turns(u);
    return glm::dvec3(radius(u) * a.cos, y, -radius(u) * a.sin);
  };
  for (int i = 0; i < corners; ++i) {
    const auto first = static_cast<uint32_t>(shape.vertices.size());
    const glm::dvec3 side = glm::normalize(glm::cross(at(i + 1, low) - at(i, low), glm::dvec3(0, 1, 0)));
    for (const double y : {low, high}) {
      for (int k = 0; k < 2; ++k)
        shape.vertices.push_back({glm::vec3(at(i + k, y)), glm::vec3(side), glm::vec2(0.2f * static_cast<float>(i + k), 8.0 * y)});
    }
    shape.indices.insert(shape.indices.end(), {first, first + 1, first + 2, first + 2, first + 1, first + 3});
    for (const double y : {low, high}) {
      const auto cap = static_cast<uint32_t>(shape.vertices.size());
      const glm::vec3 up(0, y == high ? 1 : -1, 0);
      for (const glm::dvec3& p : {glm::dvec3(0, y, 0), at(i, y), at(i + 1, y)})
        shape.vertices.push_back({glm::vec3(p), up, glm::vec2(3.0 * p.x, 3.0 * p.z)});
      shape.indices.insert(shape.indices.end(), {cap, cap + (y == high ? 1 : 2), cap + (y == high ? 2 : 1)});
    }
  }
}

void add_hexagon(SceneShape& shape, double radius, double low, double high) {
  add_prism(
      shape, [=](double) { return radius; }, 6, low, high);
}

// Adds an upright cylinder with caps.
void add_cylinder(SceneShape& shape, glm::dvec3 foot, double radius, double height, int sectors) {
  SceneShape part;
  add_lathe(part, std::array<glm::dvec2, 4>{{{0, 0}, {radius, 0}, {radius, height}, {0, height}}}, sectors, {4, 3});
  add_shape(shape, part, placed(foot));
}

}  // namespace

// A threaded shaft, 7 cm long, with the head down.
SceneShape bolt() {
  SceneShape shape;
  add_hexagon(shape, 0.018, 0, 0.014);
  std::vector<glm::dvec2> thread{{0.0105, 0.014}, {0.0105, 0.03}};
  for (int i = 0; i < 12; ++i) {
    thread.push_back({0.009, 0.0315 + 0.0035 * i});
    thread.push_back({0.0105, 0.033 + 0.0035 * i});
  }
  thread.push_back({0.008, 0.076});
  thread.push_back({0.0, 0.076});
  add_lathe(shape, thread, 10);
  return shape;
}

SceneShape nut() {
  SceneShape shape;
  add_lathe(shape, std::array<glm::dvec2, 2>{{{0.0105, 0.014}, {0.0105, 0.0}}}, 16);
  add_hexagon(shape, 0.018, 0, 0.014);
  return shape;
}

// A gear with a radius of about 1 that is 0.3 high, and its hub.
SceneShape gear(int teeth) {
  SceneShape shape;
  add_prism(
      shape,
      [=](double u) {
        const double at = u * teeth - static_cast<int>(u * teeth);
        return at < 0.2 || at > 0.7 ? 0.86 : 1.0;
      },
      8 * teeth, 0.0, 0.22);
  add_lathe(shape, std::array<glm::dvec2, 5>{{{0.42, 0.0}, {0.36, 0.3}, {0.2, 0.3}, {0.18, 0.24}, {0.0, 0.24}}}, 40, {3, 1});
  add_torus(shape, {0, 0.21, 0}, 0.66, 0.07, 48, 8);
  return shape;
}

SceneShape spring() {
  SceneShape shape;
  add_tube(
      shape, 10, 200, {1, 20},
      [](double v) {
        const SinCosDouble a = sincos_turns(8 * v);
        return glm::dvec3(0.03 * a.cos, 0.005 + 0.11 * v, 0.03 * a.sin);
      },
      [](double) { return 0.005; });
  return shape;
}

SceneShape bottle() {
  SceneShape shape;
  add_lathe(shape,
            std::array<glm::dvec2, 11>{{{0.0, 0.0},
                                        {0.035, 0.0},
                                        {0.04, 0.01},
                                        {0.04, 0.15},
                                        {0.036, 0.175},
                                        {0.022, 0.195},
                                        {0.014, 0.215},
                                        {0.013, 0.255},
                                        {0.017, 0.258},
                                        {0.017, 0.27},
                                        {0.0, 0.27}}},
            28, {1, 1}, true);
  return shape;
}

SceneShape jar() {
  SceneShape shape;
  add_lathe(shape,
            std::array<glm::dvec2, 7>{{{0.0, 0.0}, {0.055, 0.0}, {0.06, 0.01}, {0.06, 0.13}, {0.05, 0.15}, {0.05, 0.17}, {0.0, 0.17}}}, 28,
            {1, 1}, true);
  return shape;
}

SceneShape can() {
  SceneShape shape;
  add_lathe(shape,
            std::array<glm::dvec2, 10>{{{0.0, 0.0},
                                        {0.078, 0.0},
                                        {0.08, 0.006},
                                        {0.075, 0.012},
                                        {0.075, 0.17},
                                        {0.08, 0.176},
                                        {0.08, 0.184},
                                        {0.07, 0.184},
                                        {0.068, 0.176},
                                        {0.0, 0.176}}},
            32, {1, 1});
  return shape;
}

SceneShape barrel() {
  SceneShape shape;
  std::vector<glm::dvec2> profile{{0.0, 0.0}, {0.28, 0.0}};
  for (int i = 0; i <= 30; ++i) {
    const double v = i / 30.0;
    profile.push_back({0.29 + (i % 10 == 0 ? 0.015 : 0.0), 0.02 + 0.86 * v});
  }
  profile.insert(profile.end(), {{0.28, 0.9}, {0.26, 0.9}, {0.25, 0.87}, {0.0, 0.87}});
  add_lathe(shape, profile, 48, {3, 2});
  return shape;
}

SceneShape bucket() {
  SceneShape shape;
  add_lathe(shape,
            std::array<glm::dvec2, 8>{
                {{0.0, 0.0}, {0.11, 0.0}, {0.15, 0.27}, {0.16, 0.27}, {0.16, 0.285}, {0.145, 0.285}, {0.105, 0.02}, {0.0, 0.02}}},
            36, {2, 1});
  add_surface(shape, 8, 30, {1, 3}, [](double u, double v) {
    const SinCosDouble a = sincos_turns(u), b = sincos_turns(0.5 * v);
    const double r = 0.152 + 0.004 * a.cos;
    return glm::dvec3(r * b.cos, 0.27 + 0.9 * r * b.sin, -0.004 * a.sin);
  });
  return shape;
}

// Upright, 1 m high.
SceneShape pipe() {
  SceneShape shape;
  add_lathe(shape, std::array<glm::dvec2, 5>{{{0.03, 0.0}, {0.04, 0.0}, {0.04, 1.0}, {0.03, 1.0}, {0.03, 0.0}}}, 24, {1, 4});
  return shape;
}

// A coil of cable with 4 windings, which lies on the floor.
SceneShape coil() {
  SceneShape shape;
  for (int i = 0; i < 4; ++i) add_torus(shape, {0.01 * (i % 2), 0.02 + 0.035 * i, 0.008 * i}, 0.2 - 0.012 * (i % 3), 0.019, 56, 10);
  return shape;
}

SceneShape crate() {
  SceneShape shape;
  add_box(shape, {0, 0.25, 0}, {0.72, 0.46, 0.5}, 1.2);
  for (const double z : {-0.26, 0.26}) {
    for (int i = 0; i < 4; ++i) add_box(shape, {0, 0.07 + 0.12 * i, z}, {0.78, 0.1, 0.03}, 1.2);
    for (const double x : {-0.36, 0.36}) add_box(shape, {x, 0.25, z * 1.06}, {0.07, 0.5, 0.03}, 1.2);
  }
  for (const double x : {-0.38, 0.38}) {
    for (int i = 0; i < 4; ++i) add_box(shape, {x, 0.07 + 0.12 * i, 0}, {0.03, 0.1, 0.52}, 1.2);
  }
  return shape;
}

SceneShape plank() {
  SceneShape shape;
  add_box(shape, {0, 0.02, 0}, {2.4, 0.04, 0.22}, 1.0);
  return shape;
}

SceneShape cardboard_box() {
  SceneShape shape;
  add_box(shape, {0, 0.5, 0}, {1, 1, 1}, 1.0);
  return shape;
}

SceneShape vise() {
  SceneShape shape;
  add_box(shape, {0, 0.04, 0}, {0.16, 0.08, 0.2}, 4.0);
  add_box(shape, {0, 0.13, -0.05}, {0.18, 0.12, 0.09}, 4.0);
  add_box(shape, {0, 0.13, 0.09}, {0.18, 0.12, 0.06}, 4.0);
  SceneShape screw;
  add_cylinder(screw, {0, 0, 0}, 0.018, 0.26, 20);
  add_cylinder(screw, {0.0, 0.22, 0}, 0.03, 0.04, 20);
  add_shape(shape, screw, placed({0, 0.11, 0.08}) * turned_x(0.25));
  add_box(shape, {0, 0.11, 0.33}, {0.24, 0.014, 0.014}, 4.0);
  return shape;
}

SceneShape anvil() {
  SceneShape shape;
  add_cylinder(shape, {0, 0, 0}, 0.26, 0.5, 36);
  add_box(shape, {0, 0.54, 0}, {0.34, 0.08, 0.22}, 3.0);
  add_box(shape, {0, 0.62, 0}, {0.18, 0.1, 0.14}, 3.0);
  add_box(shape, {0, 0.72, 0}, {0.42, 0.12, 0.16}, 3.0);
  SceneShape horn;
  add_lathe(horn, std::array<glm::dvec2, 3>{{{0.07, 0.0}, {0.05, 0.14}, {0.0, 0.26}}}, 24);
  add_shape(shape, horn, placed({0.2, 0.71, 0}) * turned_z(-0.25));
  return shape;
}

Tool wrench() {
  Tool tool;
  add_box(tool.head, {0, 0, 0.008}, {0.022, 0.2, 0.008}, 4.0);
  SceneShape ring;
  add_torus(ring, {0, 0, 0}, 0.02, 0.009, 24, 8);
  add_shape(tool.head, ring, placed({0, 0.115, 0.008}) * turned_x(0.25));
  add_box(tool.head, {-0.018, -0.12, 0.008}, {0.014, 0.05, 0.012}, 4.0);
  add_box(tool.head, {0.018, -0.12, 0.008}, {0.014, 0.05, 0.012}, 4.0);
  add_box(tool.head, {0, -0.1, 0.008}, {0.046, 0.02, 0.012}, 4.0);
  add_box(tool.handle, {0, 0.16, 0.005}, {0.01, 0.03, 0.01});
  return tool;
}

Tool hammer() {
  Tool tool;
  add_cylinder(tool.handle, {0, -0.18, 0.02}, 0.014, 0.32, 14);
  add_box(tool.head, {0, 0.13, 0.02}, {0.06, 0.035, 0.035}, 4.0);
  SceneShape face;
  add_cylinder(face, {0, 0, 0}, 0.02, 0.04, 18);
  add_shape(tool.head, face, placed({0.03, 0.13, 0.02}) * turned_z(-0.25));
  add_box(tool.head, {-0.05, 0.135, 0.02}, {0.05, 0.02, 0.03}, 4.0);
  return tool;
}

Tool saw() {
  Tool tool;
  add_surface(tool.head, 36, 1, {3, 1}, [](double u, double v) {
    const double tooth = static_cast<int>(u * 36 + 0.5) % 2 == 0 ? 0.008 : 0.0;
    return glm::dvec3(-0.3 + 0.42 * u, glm::mix(-0.07 * u - 0.01 - tooth, 0.05, v), 0.012);
  });
  add_torus(tool.handle, {0, 0, 0}, 0.05, 0.016, 28, 10);
  for (SceneVertex& v : tool.handle.vertices) {  // upright, at the wide end
    v.position = glm::vec3(0.17f, 0.0f, 0.018f) + glm::vec3(v.position.x, -v.position.z, v.position.y);
    v.normal = glm::vec3(v.normal.x, -v.normal.z, v.normal.y);
  }
  return tool;
}

Tool screwdriver() {
  Tool tool;
  add_lathe(
      tool.handle,
      std::array<glm::dvec2, 7>{{{0.0, 0.02}, {0.008, 0.02}, {0.014, 0.03}, {0.012, 0.06}, {0.016, 0.1}, {0.012, 0.12}, {0.0, 0.125}}}, 16,
      {1, 1}, true);
  add_cylinder(tool.head, {0, -0.1, 0}, 0.004, 0.125, 10);
  for (SceneShape* part : {&tool.handle, &tool.head}) {
    for (SceneVertex& v : part->vertices) v.position.z += 0.02f;
  }
  return tool;
}

}  // namespace halfspace::workshop
