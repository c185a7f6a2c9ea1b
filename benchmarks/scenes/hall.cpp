// SPDX-License-Identifier: Apache-2.0
//
// The hall: a nave with a painted barrel vault and two aisles. The sun shines through the windows on one side. The nave is along z and ends
// at a dais with stairs.
#include "scenes/hall_parts.h"
#include "scenes/scene_kinds.h"
#include "scenes/scene_plants.h"
#include "scenes/scene_textures.h"

namespace halfspace {

namespace {

using namespace hall;

struct HallMaterials {
  std::size_t wall, column, floor, vault, wood, carpet, grille, plant, roof, lawn, sky, glass, stained, gold, banner, flame, tree, bark;
};

HallMaterials add_materials(Scene& s) {
  const auto plain = [&](const SceneTexels& image, float gloss = 0.0f) {
    return add_material(s, {.texture = add_texture(s, image), .gloss = gloss});
  };
  const auto cutout = [&](const SceneTexels& image) {
    return add_material(s, {.surface = SceneSurface::cutout, .texture = add_texture(s, image), .two_sided = true});
  };
  HallMaterials m{};
  m.wall = plain(masonry({610, 457}, {0.80f, 0.74f, 0.63f}, {0.62f, 0.57f, 0.49f}, {5, 8}, 11));
  m.column = plain(mottled({301, 507}, {0.74f, 0.69f, 0.60f}, {0.88f, 0.84f, 0.76f}, {6, 9}, 4, 12), 0.2f);
  m.floor = plain(marble_tiles({720, 720}, {0.84f, 0.80f, 0.73f}, {0.27f, 0.24f, 0.23f}, 4), 0.5f);
  m.vault = plain(starry_vault({450, 450}));
  m.wood = plain(boards({399, 255}, {0.27f, 0.16f, 0.09f}, {0.48f, 0.31f, 0.18f}, 5, 13), 0.25f);
  m.carpet = plain(carpet({240, 720}));
  m.grille = cutout(lattice({333, 333}, {0.16f, 0.16f, 0.17f}, 6, 0.16f, true));
  m.plant = cutout(leaves({300, 420}, {0.12f, 0.28f, 0.10f}, {0.34f, 0.52f, 0.20f}, 16, 0.34, 14));
  m.roof = plain(roof_tiles({363, 300}, {0.62f, 0.33f, 0.24f}, {9, 7}));
  m.lawn = plain(natural(Pattern::grass, 517, 1.1f));
  m.sky = add_material(s, {.surface = SceneSurface::unlit,
                           .texture = add_texture(s, cloudy_sky({1400, 450}, {0.80f, 0.87f, 0.94f}, {0.27f, 0.47f, 0.78f})),
                           .two_sided = true});
  m.stained = add_material(
      s, {.surface = SceneSurface::blended, .texture = add_texture(s, stained_glass({270, 410}, 15)), .gloss = 0.6f, .two_sided = true});
  m.gold = add_material(
      s, {.texture = add_texture(s, mottled({100, 60}, {0.70f, 0.52f, 0.20f}, {0.90f, 0.72f, 0.36f}, {8, 5}, 3, 16)), .gloss = 2.0f});
  m.banner = add_material(s, {.texture = s.materials[m.carpet].texture, .tint = {0.75f, 0.9f, 1.6f}, .two_sided = true});
  m.flame = add_material(s, {.surface = SceneSurface::unlit, .texture = s.materials[m.gold].texture, .tint = {1.5f, 1.5f, 1.6f}});
  m.glass = add_material(s, {.surface = SceneSurface::blended,
                             .texture = s.materials[m.column].texture,
                             .tint = {0.75f, 0.85f, 0.9f},
                             .gloss = 1.0f,
                             .alpha = 0.25f,
                             .two_sided = true});
  m.tree = cutout(leaves({356, 500}, {0.16f, 0.30f, 0.10f}, {0.42f, 0.55f, 0.20f}, 26, 0.26, 17));
  m.bark = plain(natural(Pattern::bark, 257, 1.3f));
  return m;
}

void add_structure(Scene& s, const HallMaterials& m) {
  const std::size_t arcade = add_mesh(s, arched({kBay, 3.8, 0.7, 1.75, 0, 0.0}));
  const std::size_t clerestory = add_mesh(s, arched({kBay, kEaves - 7.8, 0.7, 1.1, 0.4, 1.6}));
  const std::size_t aisle_wall = add_mesh(s, arched({kBay, kAisleHeight, 0.7, 1.1, 1.1, 3.8}));
  for (const double side : {-1.0, 1.0}) {
    for (int i = 0; i < kBays; ++i) {
      const double z = bay_center(i), turn = side * 0.25;
      place(s, arcade, m.wall, placed({side * kNave, kSpring, z}, turn));
      place(s, clerestory, m.wall, placed({side * kNave, 8.0, z}, turn));
      place(s, aisle_wall, m.wall, placed({side * kAisle, 0, z}, turn));
    }
  }
  place(s, end_wall(2.0, 4.2), m.wall, placed({0, 0, kEnd}));
  place(s, end_wall(0.0, 0.0), m.wall, placed({0, 0, -kEnd}));
  place(s, vault(), m.vault);
  place(s, vault_ribs(), m.column);
  place(s, floor_plane(), m.floor);
  place(s, aisle_ceilings(), m.wood);
  place(s, roofs(), m.roof);
  place(s, buttresses(), m.wall);
  const std::size_t column = add_mesh(s, column_shape()), capital = add_mesh(s, capital_shape());
  for (const double side : {-1.0, 1.0}) {
    for (int i = 0; i <= kBays; ++i) {
      const glm::dmat4 at = placed({side * kNave, 0, bay_edge(i)});
      place(s, column, m.column, at);
      place(s, capital, m.column, at);
    }
  }
}

void add_windows(Scene& s, const HallMaterials& m) {
  const std::size_t low = add_mesh(s, window_pane(1.1, 1.1, 3.8)), high = add_mesh(s, window_pane(1.1, 0.4, 1.6));
  for (const double side : {-1.0, 1.0}) {
    for (int i = 0; i < kBays; ++i) {
      const double turn = side * 0.25;
      place(s, low, i % 2 == 0 ? m.stained : m.glass, placed({side * kAisle, 0, bay_center(i)}, turn));
      place(s, low, m.grille, placed({side * (kAisle + 0.25), 0, bay_center(i)}, turn));
      place(s, high, m.glass, placed({side * kNave, 8.0, bay_center(i)}, turn));
    }
  }
  const std::size_t rose = add_mesh(s, window_pane(2.0, 9.0, 12.0));
  for (const double side : {-1.0, 1.0}) place(s, rose, m.stained, placed({0, 0, side * kEnd}));
}

void add_furniture(Scene& s, const HallMaterials& m) {
  place(s, stairs(), m.column);
  place(s, carpet_runner(), m.carpet);
  const std::size_t bench = add_mesh(s, bench_shape()), baluster = add_mesh(s, baluster_shape());
  for (const double x : {-2.6, 2.6}) {
    for (int i = 0; i < 9; ++i) place(s, bench, m.wood, placed({x, 0, 12.0 - 2.2 * i}));
  }
  for (const double side : {-1.0, 1.0}) {
    for (int i = 0; i < 16; ++i) place(s, baluster, m.column, placed({side * (1.45 + 0.18 * i), kDais, kDaisFront - 0.35}));
    place(s, handrail(), m.column, placed({side * 2.8, kDais + 0.9, kDaisFront - 0.35}));
  }
  place(s, throne(), m.wood, placed({0, kDais, -kEnd + 1.6}));
  const std::size_t ring = add_mesh(s, chandelier()), flames = add_mesh(s, chandelier_flames());
  for (int i = 0; i < 4; ++i) {
    const glm::dmat4 at = placed({0, 7.2, 13.0 - 7.5 * i});
    place(s, ring, m.gold, at);
    place(s, flames, m.flame, at);
  }
  const std::size_t banner = add_mesh(s, banner_shape());
  for (const double side : {-1.0, 1.0}) {
    for (int i = 1; i < kBays; ++i) place(s, banner, m.banner, placed({side * (kNave - 0.55), 7.4, bay_edge(i)}, side * 0.25));
  }
}

void add_plants(Scene& s, const HallMaterials& m) {
  const std::size_t pot = add_mesh(s, pot_shape()),
                    shrub = add_mesh(s, shrub_leaves({.cards = 150, .radius = 0.65, .card = 0.34, .seed = 21}));
  for (const double side : {-1.0, 1.0}) {
    for (int i = 1; i < kBays; i += 2) {
      place(s, pot, m.roof, placed({side * (kAisle - 1.0), 0, bay_edge(i)}));
      place(s, shrub, m.plant, placed({side * (kAisle - 1.0), 1.25, bay_edge(i)}, 0.1 * i));
    }
    place(s, pot, m.gold, placed({side * 2.6, kDais, -kEnd + 2.2}));
    place(s, shrub, m.plant, placed({side * 2.6, kDais + 1.25, -kEnd + 2.2}, 0.37));
  }
  const TreeShape tree = tree_shape({.height = 9.0, .crown = 3.2, .cards = 500, .card = 0.75, .seed = 22});
  const std::size_t trunk = add_mesh(s, tree.wood), crown = add_mesh(s, tree.leaves);
  for (int i = 0; i < 14; ++i) {
    const double side = i % 2 == 0 ? 1.0 : -1.0;
    const glm::dmat4 at = placed({side * (19.0 + 3.0 * (i % 3)), 0, 27.0 - 4.2 * i}, 0.13 * i, glm::dvec3(0.8 + 0.07 * (i % 5)));
    place(s, trunk, m.bark, at);
    place(s, crown, m.tree, at);
  }
  place(s, ground_plane(160.0, 40), m.lawn, placed({0, -0.05, 0}));
  place(s, sky_dome(220.0), m.sky);
}

}  // namespace

Scene make_hall() {
  Scene s;
  const HallMaterials m = add_materials(s);
  add_structure(s, m);
  add_windows(s, m);
  add_furniture(s, m);
  add_plants(s, m);
  s.light = {.to_sun = glm::normalize(glm::vec3(0.62f, 0.70f, 0.28f)),
             .sun = {1.45f, 1.28f, 1.0f},
             .sky = {0.62f, 0.63f, 0.68f},
             .ground = {0.52f, 0.46f, 0.40f},
             .lamp_ws = {0.0f, 6.6f, -2.0f},
             .lamp = {1.3f, 0.95f, 0.55f},
             .haze = {0.78f, 0.82f, 0.88f},
             .haze_distance = 160.0f,
             .shadow_center = {0, 5, 0},
             .shadow_radius = 34.0};
  s.cameras = {{{0.6, 1.7, 17.2}, {-0.2, 4.2, -6.0}},
               {{6.9, 1.6, 9.6}, {-1.5, 2.6, -6.0}},
               {{34.0, 9.0, 42.0}, {0.0, 6.0, 0.0}},
               {{-2.0, 3.6, -16.4}, {0.8, 4.2, 6.0}},
               {{-1.5, 8.6, 9.0}, {1.2, 10.9, -9.0}}};
  return s;
}

}  // namespace halfspace
