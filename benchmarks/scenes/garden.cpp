// SPDX-License-Identifier: Apache-2.0
//
// The garden: a pond with reeds, a pavilion and a greenhouse, between trees and flower beds.
#include "halfspace/core/trig_double.h"
#include "scenes/garden_parts.h"
#include "scenes/scene_kinds.h"
#include "scenes/scene_plants.h"
#include "scenes/scene_textures.h"
#include "workloads/workload_random.h"

namespace halfspace {

namespace {

using namespace garden;

struct GardenMaterials {
  std::size_t lawn, gravel, rock, bark, stone, roof, wood, lily, sky;
  std::size_t oak, birch, bush, grass, reed, red, white, fence;
  std::size_t water, glass;
};

GardenMaterials add_materials(Scene& s) {
  const auto plain = [&](const SceneTexels& image, float gloss = 0.0f) {
    return add_material(s, {.texture = add_texture(s, image), .gloss = gloss});
  };
  const auto cutout = [&](const SceneTexels& image, glm::vec3 tint = glm::vec3(1.0f)) {
    return add_material(s, {.surface = SceneSurface::cutout, .texture = add_texture(s, image), .tint = tint, .two_sided = true});
  };
  GardenMaterials m{};
  m.lawn = plain(natural(Pattern::grass, 721, 1.15f));
  m.gravel = plain(mottled({410, 410}, {0.52f, 0.46f, 0.37f}, {0.78f, 0.72f, 0.60f}, {40, 40}, 3, 31));
  m.rock = plain(natural(Pattern::rock, 333, 1.1f), 0.1f);
  m.bark = plain(natural(Pattern::bark, 257, 1.3f));
  m.stone = plain(mottled({300, 450}, {0.72f, 0.70f, 0.66f}, {0.90f, 0.88f, 0.83f}, {5, 8}, 4, 32), 0.2f);
  m.roof = plain(roof_tiles({363, 300}, {0.58f, 0.30f, 0.24f}, {9, 7}));
  m.wood = plain(boards({255, 399}, {0.78f, 0.80f, 0.78f}, {0.92f, 0.93f, 0.90f}, 3, 33), 0.2f);
  m.lily = plain(mottled({150, 150}, {0.20f, 0.42f, 0.18f}, {0.36f, 0.58f, 0.26f}, {6, 6}, 3, 34), 0.4f);
  m.sky = add_material(s, {.surface = SceneSurface::unlit,
                           .texture = add_texture(s, cloudy_sky({1500, 460}, {0.82f, 0.88f, 0.93f}, {0.30f, 0.52f, 0.84f})),
                           .two_sided = true});
  m.oak = cutout(leaves({356, 500}, {0.16f, 0.32f, 0.09f}, {0.42f, 0.56f, 0.18f}, 28, 0.25, 35));
  m.birch = cutout(leaves({300, 390}, {0.30f, 0.44f, 0.12f}, {0.62f, 0.70f, 0.26f}, 34, 0.18, 36));
  m.bush = cutout(leaves({280, 350}, {0.10f, 0.26f, 0.12f}, {0.28f, 0.46f, 0.22f}, 40, 0.17, 37));
  m.grass = cutout(blades({220, 190}, {0.24f, 0.40f, 0.12f}, {0.52f, 0.62f, 0.24f}, 26, 38));
  m.reed = cutout(blades({190, 420}, {0.30f, 0.42f, 0.18f}, {0.66f, 0.66f, 0.34f}, 18, 39));
  m.red = cutout(flowers({250, 250}, {0.86f, 0.22f, 0.24f}, {0.26f, 0.46f, 0.16f}, 40));
  m.white = cutout(flowers({250, 250}, {0.93f, 0.90f, 0.95f}, {0.30f, 0.48f, 0.20f}, 42));
  m.fence = cutout(lattice({210, 150}, {0.86f, 0.86f, 0.82f}, 5, 0.32f, false));
  m.water = add_material(s, {.surface = SceneSurface::blended,
                             .texture = add_texture(s, mottled({450, 450}, {0.10f, 0.24f, 0.24f}, {0.20f, 0.36f, 0.34f}, {6, 6}, 4, 43)),
                             .gloss = 1.6f,
                             .alpha = 0.62f});
  m.glass = add_material(s, {.surface = SceneSurface::blended,
                             .texture = add_texture(s, mottled({190, 250}, {0.70f, 0.82f, 0.84f}, {0.86f, 0.93f, 0.95f}, {3, 4}, 3, 44)),
                             .gloss = 1.5f,
                             .alpha = 0.16f,
                             .two_sided = true});
  return m;
}

// Calls place_at(position) for `count` free places in a ring around the middle of the garden.
template <class F>
void scatter(int count, double inner, double outer, double margin, uint32_t seed, const F& place_at) {
  WorkloadRandom random(seed);
  for (int found = 0; found < count;) {
    const double x = random.between(-outer, outer), z = random.between(-outer, outer), r2 = x * x + z * z;
    if (r2 < inner * inner || r2 > outer * outer || !is_free(x, z, margin)) continue;
    place_at(x, z, random);
    ++found;
  }
}

void add_trees(Scene& s, const GardenMaterials& m) {
  const auto add = [&](const TreeOptions& options, std::size_t material, int count, double inner, double outer) {
    const TreeShape tree = tree_shape(options);
    const std::size_t wood = add_mesh(s, tree.wood), crown = add_mesh(s, tree.leaves);
    scatter(count, inner, outer, 1.2, options.seed, [&](double x, double z, WorkloadRandom& random) {
      const double scale = random.between(0.75, 1.25), turn = random.unit();
      const glm::dmat4 at = placed(on_ground(x, z), turn, glm::dvec3(scale));
      place(s, wood, m.bark, at);
      place(s, crown, material, at);
    });
  };
  add({.height = 8.5, .crown = 3.0, .cards = 1300, .card = 0.5, .seed = 51}, m.oak, 13, 12.0, 26.0);
  add({.height = 7.5, .crown = 2.2, .cards = 1100, .card = 0.4, .seed = 52}, m.birch, 11, 9.0, 24.0);
  add({.height = 10.0, .crown = 3.6, .cards = 400, .card = 0.95, .seed = 53}, m.oak, 40, 28.0, 80.0);
  add({.height = 9.0, .crown = 3.2, .cards = 400, .card = 0.9, .seed = 54}, m.birch, 25, 28.0, 80.0);
}

void add_low_plants(Scene& s, const GardenMaterials& m) {
  const std::size_t bush = add_mesh(s, shrub_leaves({.cards = 330, .radius = 0.9, .card = 0.26, .seed = 55}));
  scatter(34, 6.0, 22.0, 0.7, 56, [&](double x, double z, WorkloadRandom& random) {
    const double scale = random.between(0.7, 1.5), turn = random.unit();
    place(s, bush, m.bush, placed(on_ground(x, z, 0.55 * scale), turn, glm::dvec3(scale)));
  });
  for (int i = 0; i < 64; ++i) {
    const glm::dvec2 center(4.0 * (i % 8) - 14.0, 5.0 * (i / 8) - 14.0);
    const SceneShape grass = patch({.center = center, .size = 5.0, .count = 220, .height = 0.34, .seed = 60u + static_cast<uint32_t>(i)});
    if (!grass.indices.empty()) place(s, grass, m.grass);
  }
  for (int i = 0; i < 12; ++i) {
    const glm::dvec2 at = path_at(0.06 + 0.07 * i) + glm::dvec2(i % 2 == 0 ? 2.1 : -2.1, 0.0);
    const SceneShape bed = patch({.center = at, .size = 2.0, .count = 130, .height = 0.55, .seed = 130u + static_cast<uint32_t>(i)});
    if (!bed.indices.empty()) place(s, bed, i % 3 == 0 ? m.white : m.red);
  }
  place(s, reeds(420, 1.25, 57), m.reed);
  place(s, lily_pads(46, 58), m.lily);
}

void add_stones(Scene& s, const GardenMaterials& m) {
  std::array<std::size_t, 4> stones{};
  for (std::size_t i = 0; i < stones.size(); ++i) stones[i] = add_mesh(s, stone(71u + static_cast<uint32_t>(i)));
  WorkloadRandom random(75);
  for (int i = 0; i < 44; ++i) {
    const SinCosDouble a = sincos_turns(random.unit());
    const double r = kPondRadius + random.between(0.4, 1.5), scale = random.between(0.15, 0.6);
    const double turn = random.unit();
    const double x = kPond.x + r * a.cos, z = kPond.y + r * a.sin;
    place(s, stones[static_cast<std::size_t>(i) % stones.size()], m.rock, placed(on_ground(x, z, 0.1 * scale), turn, glm::dvec3(scale)));
  }
}

void add_buildings(Scene& s, const GardenMaterials& m) {
  const glm::dmat4 pavilion = placed({kPavilion.x, 0, kPavilion.y}), house = placed({kGreenhouse.x, 0, kGreenhouse.y});
  place(s, pavilion_stone(), m.stone, pavilion);
  place(s, pavilion_roof(), m.roof, pavilion);
  place(s, pavilion_rails(), m.fence, pavilion);
  place(s, fence(), m.fence);
  place(s, greenhouse_frame(), m.wood, house);
  place(s, greenhouse_tables(), m.wood, house);
  for (const SceneShape& pane : greenhouse_panes()) place(s, pane, m.glass, house);
  const std::size_t pot = add_mesh(s, pot_shape()),
                    plant = add_mesh(s, shrub_leaves({.cards = 120, .radius = 0.5, .card = 0.24, .seed = 76}));
  const std::size_t blossom = add_mesh(s, patch({.center = {30, 30}, .size = 0.4, .count = 14, .height = 0.5, .seed = 77}));
  for (int i = 0; i < 16; ++i) {
    const double x = i % 2 == 0 ? -1.85 : 1.85, z = -2.8 + 0.8 * (i / 2), scale = 0.45 + 0.06 * (i % 4);
    place(s, pot, m.roof, house * placed({x, 0.83, z}, 0.0, glm::dvec3(scale)));
    if (i % 3 == 1) {
      place(s, blossom, i % 2 == 0 ? m.red : m.white, house * placed(glm::dvec3(x, 0.83 + 0.6 * scale, z) - on_ground(30, 30)));
    } else {
      place(s, plant, i % 2 == 0 ? m.bush : m.birch, house * placed({x, 1.0 + scale, z}, 0.17 * i, glm::dvec3(0.8 + 0.1 * (i % 3))));
    }
  }
}

}  // namespace

Scene make_garden() {
  Scene s;
  const GardenMaterials m = add_materials(s);
  place(s, terrain(), m.lawn);
  place(s, path(), m.gravel);
  add_buildings(s, m);
  add_stones(s, m);
  add_trees(s, m);
  add_low_plants(s, m);
  place(s, water(), m.water);
  place(s, sky_dome(240.0), m.sky);
  s.light = {.to_sun = glm::normalize(glm::vec3(0.55f, 0.62f, 0.56f)),
             .sun = {0.98f, 0.90f, 0.72f},
             .sky = {0.50f, 0.55f, 0.62f},
             .ground = {0.24f, 0.26f, 0.18f},
             .lamp_ws = {static_cast<float>(kPavilion.x), 2.9f, static_cast<float>(kPavilion.y)},
             .lamp = {0.5f, 0.36f, 0.18f},
             .haze = {0.80f, 0.86f, 0.92f},
             .haze_distance = 130.0f,
             .shadow_center = {0, 2, 0},
             .shadow_radius = 36.0};
  s.cameras = {{{3.6, 2.0, 16.2}, {-3.8, 0.9, 0.0}},
               {{9.7, 1.75, -8.0}, {8.9, 1.15, 0.0}},
               {{24.0, 17.0, 30.0}, {-1.5, 0.0, -2.0}},
               {{2.9, 1.1, 0.2}, {-8.0, 0.1, 4.6}},
               {{-11.4, 2.1, -10.4}, {-5.0, 0.9, 2.0}}};
  return s;
}

}  // namespace halfspace
