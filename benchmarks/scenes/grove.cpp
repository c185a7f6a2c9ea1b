// SPDX-License-Identifier: Apache-2.0
//
// The grove (leaves): alpha-tested foliage at all distances, with its shadow.
#include "halfspace/core/trig_double.h"
#include "scenes/scene_kinds.h"
#include "scenes/scene_plants.h"
#include "scenes/scene_textures.h"
#include "workloads/workload_random.h"

namespace halfspace {

namespace {

struct GroveMaterials {
  std::size_t ground, bark, oak, birch, bush, grass, fern, sky;
};

GroveMaterials add_materials(Scene& s) {
  const auto plain = [&](const SceneTexels& image) { return add_material(s, {.texture = add_texture(s, image)}); };
  const auto cutout = [&](const SceneTexels& image) {
    return add_material(s, {.surface = SceneSurface::cutout, .texture = add_texture(s, image), .two_sided = true});
  };
  GroveMaterials m{};
  m.ground = plain(natural(Pattern::grass, 721, 1.0f));
  m.bark = plain(natural(Pattern::bark, 257, 1.3f));
  m.oak = cutout(leaves({712, 1000}, {0.16f, 0.32f, 0.09f}, {0.42f, 0.56f, 0.18f}, 34, 0.22, 401));
  m.birch = cutout(leaves({600, 780}, {0.30f, 0.44f, 0.12f}, {0.62f, 0.70f, 0.26f}, 44, 0.16, 402));
  m.bush = cutout(leaves({560, 700}, {0.10f, 0.26f, 0.12f}, {0.28f, 0.46f, 0.22f}, 48, 0.15, 403));
  m.grass = cutout(blades({440, 380}, {0.24f, 0.40f, 0.12f}, {0.52f, 0.62f, 0.24f}, 34, 404));
  m.fern = cutout(leaves({380, 840}, {0.14f, 0.34f, 0.10f}, {0.36f, 0.56f, 0.20f}, 60, 0.3, 405));
  m.sky = add_material(s, {.surface = SceneSurface::unlit,
                           .texture = add_texture(s, cloudy_sky({1500, 460}, {0.82f, 0.88f, 0.94f}, {0.28f, 0.49f, 0.82f})),
                           .two_sided = true});
  return m;
}

// A square of ground with upright cards in random directions. They have the normal of the ground, so that they are lit like it.
SceneShape tufts(int count, double size, double height, uint32_t seed) {
  SceneShape shape;
  WorkloadRandom random(seed);
  for (int i = 0; i < count; ++i) {
    const double x = size * random.between(-0.5, 0.5), z = size * random.between(-0.5, 0.5), tall = height * random.between(0.6, 1.2);
    const double turn = random.unit();
    const glm::dvec3 right(placed({0, 0, 0}, turn)[0]);
    add_card(shape, {x, 0.48 * tall, z}, 0.55 * tall * right, {0, 0.5 * tall, 0}, {0, 1, 0});
  }
  return shape;
}

void add_trees(Scene& s, const GroveMaterials& m) {
  const auto add = [&](const TreeOptions& options, std::size_t material, int count, uint32_t first) {
    const TreeShape tree = tree_shape(options);
    const std::size_t wood = add_mesh(s, tree.wood), crown = add_mesh(s, tree.leaves);
    WorkloadRandom random(options.seed);
    for (int i = 0; i < count; ++i) {
      // A place in a cell of a grid of 7 x 7, on both sides of a path along z.
      const uint32_t cell = (first + 2 * static_cast<uint32_t>(i)) % 49;
      const double x = 5.0 * (static_cast<double>(cell % 7) - 3.0) + random.between(-1.2, 1.2);
      const double z = 5.0 * (static_cast<double>(cell / 7) - 3.0) + random.between(-1.2, 1.2);
      const double scale = random.between(0.8, 1.2), turn = random.unit();
      const glm::dmat4 at = placed({x + (x < 0 ? -1.6 : 1.6), 0, z}, turn, glm::dvec3(scale));
      place(s, wood, m.bark, at);
      place(s, crown, material, at);
    }
  };
  add({.height = 7.5, .crown = 2.6, .cards = 4500, .card = 0.34, .seed = 411}, m.oak, 25, 0);
  add({.height = 6.5, .crown = 2.0, .cards = 4050, .card = 0.28, .seed = 412}, m.birch, 24, 1);
}

void add_low_plants(Scene& s, const GroveMaterials& m) {
  const std::size_t bush = add_mesh(s, shrub_leaves({.cards = 600, .radius = 0.9, .card = 0.22, .seed = 421}));
  const std::size_t grass = add_mesh(s, tufts(500, 4.0, 0.3, 422)), fern = add_mesh(s, tufts(60, 4.0, 0.7, 423));
  WorkloadRandom random(424);
  for (int i = 0; i < 40; ++i) {
    const double side = i % 2 == 0 ? -1.0 : 1.0, scale = random.between(0.6, 1.3), turn = random.unit();
    place(s, bush, m.bush, placed({side * random.between(2.2, 17.0), 0.6 * scale, random.between(-17.0, 15.0)}, turn, glm::dvec3(scale)));
  }
  for (int i = 0; i < 48; ++i) {  // around the grove
    const SinCosDouble a = sincos_turns(i / 48.0);
    const double scale = random.between(1.2, 2.2), turn = random.unit();
    place(s, bush, m.bush, placed({21.0 * a.cos, 0.5 * scale, 21.0 * a.sin}, turn, glm::dvec3(scale)));
  }
  for (int i = 0; i < 81; ++i) {
    const glm::dmat4 at = placed({4.0 * (i % 9 - 4), 0, 4.0 * (i / 9 - 4)}, 0.25 * (i % 4));
    place(s, grass, m.grass, at);
    place(s, fern, m.fern, at);
  }
}

}  // namespace

Scene make_leaves() {
  Scene s;
  const GroveMaterials m = add_materials(s);
  add_trees(s, m);
  add_low_plants(s, m);
  place(s, ground_plane(160.0, 40), m.ground);
  place(s, sky_dome(220.0), m.sky);
  s.culls_objects = true;
  s.light = {.to_sun = glm::normalize(glm::vec3(0.50f, 0.72f, -0.30f)),
             .sun = {1.20f, 1.10f, 0.86f},
             .sky = {0.50f, 0.56f, 0.60f},
             .ground = {0.24f, 0.28f, 0.18f},
             .lamp_ws = {0.0f, 0.0f, 0.0f},
             .lamp = {0.0f, 0.0f, 0.0f},
             .haze = {0.80f, 0.86f, 0.88f},
             .haze_distance = 150.0f,
             .shadow_center = {0, 3, 0},
             .shadow_radius = 26.0};
  s.cameras = {{{0.6, 1.7, 15.5}, {-0.6, 2.6, 0.0}}};
  return s;
}

}  // namespace halfspace
