// SPDX-License-Identifier: Apache-2.0
//
// Sculptures under the sky: a large statue (detail, turn) and a collection on terraces (far).
#include <array>

#include "halfspace/core/trig_double.h"
#include "scenes/scene_kinds.h"
#include "scenes/scene_plants.h"
#include "scenes/scene_textures.h"
#include "scenes/sculptures.h"
#include "workloads/workload_canvas.h"

namespace halfspace {

namespace {

struct ParkMaterials {
  std::size_t marble, bronze, sandstone, granite, steps, paving, sky;
};

ParkMaterials add_materials(Scene& s) {
  const auto plain = [&](const SceneTexels& image, float gloss) {
    return add_material(s, {.texture = add_texture(s, image), .gloss = gloss});
  };
  ParkMaterials m{};
  m.marble = plain(mottled({510, 600}, {0.76f, 0.75f, 0.73f}, {0.93f, 0.92f, 0.90f}, {6, 7}, 5, 301), 0.35f);
  m.bronze = plain(mottled({400, 400}, {0.26f, 0.30f, 0.24f}, {0.46f, 0.42f, 0.30f}, {8, 8}, 4, 302), 0.9f);
  m.sandstone = plain(mottled({450, 450}, {0.70f, 0.58f, 0.42f}, {0.86f, 0.74f, 0.56f}, {7, 7}, 5, 303), 0.05f);
  m.granite = plain(mottled({420, 420}, {0.34f, 0.34f, 0.36f}, {0.62f, 0.61f, 0.62f}, {30, 30}, 3, 304), 0.3f);
  m.steps = plain(masonry({610, 457}, {0.78f, 0.75f, 0.68f}, {0.58f, 0.55f, 0.50f}, {5, 8}, 305), 0.1f);
  m.paving = plain(marble_tiles({600, 600}, {0.72f, 0.70f, 0.66f}, {0.58f, 0.55f, 0.51f}, 4), 0.1f);
  m.sky = add_material(s, {.surface = SceneSurface::unlit,
                           .texture = add_texture(s, cloudy_sky({1500, 460}, {0.82f, 0.88f, 0.94f}, {0.28f, 0.49f, 0.82f})),
                           .two_sided = true});
  return m;
}

SceneLighting park_light(const glm::dvec3& shadow_center, double shadow_radius) {
  return {.to_sun = glm::normalize(glm::vec3(-0.50f, 0.66f, 0.56f)),
          .sun = {1.10f, 1.02f, 0.86f},
          .sky = {0.46f, 0.51f, 0.60f},
          .ground = {0.34f, 0.32f, 0.28f},
          .lamp_ws = {0.0f, 0.0f, 0.0f},
          .lamp = {0.0f, 0.0f, 0.0f},
          .haze = {0.80f, 0.86f, 0.92f},
          .haze_distance = 300.0f,
          .shadow_center = shadow_center,
          .shadow_radius = shadow_radius};
}

// A round pedestal of 3 m on steps.
SceneShape pedestal() {
  constexpr std::array<glm::dvec2, 13> kProfile{{{6.0, 0.0},
                                                 {6.0, 0.3},
                                                 {5.2, 0.3},
                                                 {5.2, 0.6},
                                                 {4.4, 0.6},
                                                 {4.4, 0.9},
                                                 {3.7, 0.95},
                                                 {3.4, 1.2},
                                                 {3.3, 2.5},
                                                 {3.5, 2.7},
                                                 {3.7, 2.8},
                                                 {3.7, 3.0},
                                                 {0.0, 3.0}}};
  SceneShape shape;
  add_lathe(shape, kProfile, 128, {12, 4});
  return shape;
}

// A round terrace of paving, which lies within the shadow map.
SceneShape terrace(double radius) {
  SceneShape shape;
  add_surface(shape, 96, 24, {0.5 * radius, 0.5 * radius}, [=](double u, double v) {
    const SinCosDouble a = sincos_turns(u);
    return radius * (1 - v) * glm::dvec3(a.cos, 0, -a.sin);
  });
  return shape;
}

// A statue that is 13 m high, on its pedestal.
Scene monument(int triangles) {
  Scene s;
  const ParkMaterials m = add_materials(s);
  place(s, statue(triangles), m.marble, placed({0, 3, 0}, 0.0, glm::dvec3(7)));
  place(s, pedestal(), m.granite);
  place(s, terrace(32.0), m.paving);
  place(s, sky_dome(220.0), m.sky, placed({0, -60, 0}));  // also visible below the horizon
  s.culls_objects = true;
  s.light = park_light({0, 5, 0}, 30.0);
  return s;
}

}  // namespace

Scene make_detail(int triangles) {
  Scene s = monument(triangles);
  s.cameras = {{{1.3, 14.2, 3.4}, {-0.1, 13.9, 0.0}}};  // in front of the head
  return s;
}

Scene make_turn(int triangles) {
  Scene s = monument(triangles);
  constexpr int kPictures = 36;
  for (int i = 0; i < kPictures; ++i) {
    const SinCosDouble a = sincos_turns(static_cast<double>(i) / kPictures);
    s.cameras.push_back({{25 * a.sin, 8.5, 25 * a.cos}, {0, 7.6, 0}});
  }
  return s;
}

Scene make_far(int triangles) {
  constexpr int kRows = 4, kColumns = 10;
  constexpr double kHeight = 60.0;  // of a model, in pixels of a picture with 1080 rows
  Scene s;
  const ParkMaterials m = add_materials(s);
  struct Model {
    std::size_t mesh, material;
    double height;
  };
  const std::array models{Model{add_mesh(s, statue(triangles)), m.marble, 1.9}, Model{add_mesh(s, bust(triangles)), m.bronze, 1.0},
                          Model{add_mesh(s, vase(triangles)), m.sandstone, 1.0}, Model{add_mesh(s, boulder(triangles)), m.granite, 0.9},
                          Model{add_mesh(s, shell(triangles)), m.marble, 1.0}};
  const glm::dvec3 eye(0, 4.2, 26);
  for (int row = 0; row < kRows; ++row) {
    const double z = -2.0 * row, y = 0.4 + 1.9 * row;
    SceneShape step;
    add_box(step, {0, 0.5 * y, z - 0.2}, {38, y, 2.0}, 0.25);
    place(s, step, m.steps);
    for (int i = 0; i < kColumns; ++i) {
      const Model& model = models[static_cast<std::size_t>(3 * row + i) % models.size()];
      const glm::dvec3 at(3.6 * (i - 0.5 * (kColumns - 1)), y, z);
      const double meters = kHeight / 540.0 * kTanHalfAngle * (eye.z - z);
      place(s, model.mesh, model.material, placed(at, 0.07 * (i - 4) + 0.03 * row, glm::dvec3(meters / model.height)));
    }
  }
  place(s, terrace(36.0), m.paving);
  place(s, sky_dome(220.0), m.sky);
  s.culls_objects = true;
  s.light = park_light({0, 3, 0}, 34.0);
  s.cameras = {{eye, {0, 4.0, 0}}};
  return s;
}

}  // namespace halfspace
