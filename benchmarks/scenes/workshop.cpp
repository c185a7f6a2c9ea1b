// SPDX-License-Identifier: Apache-2.0
//
// The workshop: benches, racks and a lathe, with hundreds of tools, bottles, bolts and gears.
#include "scenes/scene_kinds.h"
#include "scenes/scene_plants.h"
#include "scenes/scene_textures.h"
#include "scenes/workshop_contents.h"
#include "workloads/workload_random.h"

namespace halfspace {

namespace {

using namespace workshop;

WorkshopMaterials add_materials(Scene& s) {
  const auto plain = [&](const SceneTexels& image, float gloss = 0.0f) {
    return add_material(s, {.texture = add_texture(s, image), .gloss = gloss});
  };
  const auto cutout = [&](const SceneTexels& image) {
    return add_material(s, {.surface = SceneSurface::cutout, .texture = add_texture(s, image), .two_sided = true});
  };
  WorkshopMaterials m{};
  m.brick = plain(masonry({630, 470}, {0.66f, 0.40f, 0.31f}, {0.70f, 0.66f, 0.60f}, {7, 16}, 101));
  m.floor = plain(mottled({600, 600}, {0.47f, 0.46f, 0.44f}, {0.62f, 0.61f, 0.58f}, {5, 5}, 6, 102), 0.1f);
  m.board = plain(boards({399, 255}, {0.46f, 0.33f, 0.21f}, {0.66f, 0.51f, 0.35f}, 5, 103), 0.1f);
  m.bench = plain(boards({500, 310}, {0.50f, 0.34f, 0.20f}, {0.74f, 0.56f, 0.36f}, 4, 104), 0.3f);
  m.beam = add_material(s, {.texture = s.materials[m.board].texture, .tint = {0.7f, 0.65f, 0.6f}});
  m.roof = plain(roof_tiles({363, 300}, {0.50f, 0.32f, 0.28f}, {9, 7}));
  m.lawn = plain(natural(Pattern::grass, 517, 1.1f));
  m.sky = add_material(s, {.surface = SceneSurface::unlit,
                           .texture = add_texture(s, cloudy_sky({1300, 430}, {0.84f, 0.88f, 0.92f}, {0.38f, 0.56f, 0.82f})),
                           .two_sided = true});
  const std::size_t metal = add_texture(s, mottled({230, 170}, {0.55f, 0.56f, 0.58f}, {0.72f, 0.73f, 0.75f}, {9, 3}, 4, 105));
  const auto tinted = [&](glm::vec3 tint, float gloss) { return add_material(s, {.texture = metal, .tint = tint, .gloss = gloss}); };
  m.steel = tinted({1.0f, 1.0f, 1.0f}, 1.8f);
  m.brass = tinted({1.25f, 1.0f, 0.45f}, 1.8f);
  m.dark = tinted({0.35f, 0.36f, 0.40f}, 1.0f);
  m.green = tinted({0.42f, 0.72f, 0.55f}, 0.7f);
  m.red = tinted({1.15f, 0.32f, 0.26f}, 0.8f);
  m.blue = tinted({0.36f, 0.58f, 1.05f}, 0.8f);
  m.yellow = tinted({1.4f, 1.1f, 0.32f}, 0.8f);
  m.rust = plain(mottled({270, 190}, {0.40f, 0.24f, 0.16f}, {0.62f, 0.42f, 0.28f}, {6, 5}, 5, 106), 0.2f);
  m.cardboard = plain(boards({210, 190}, {0.62f, 0.48f, 0.32f}, {0.72f, 0.58f, 0.41f}, 1, 107));
  m.label = plain(carpet({190, 150}), 0.5f);
  m.bulb = add_material(s, {.surface = SceneSurface::unlit, .texture = metal, .tint = {1.8f, 1.7f, 1.4f}});
  m.mesh = cutout(lattice({170, 170}, {0.50f, 0.52f, 0.54f}, 9, 0.2f, true));
  m.pegs = cutout(lattice({410, 310}, {0.62f, 0.52f, 0.40f}, 9, 0.86f, false));
  m.plant = cutout(leaves({300, 420}, {0.14f, 0.32f, 0.12f}, {0.36f, 0.56f, 0.22f}, 16, 0.34, 108));
  m.tree = cutout(leaves({356, 500}, {0.18f, 0.34f, 0.10f}, {0.46f, 0.58f, 0.22f}, 26, 0.26, 109));
  m.bark = plain(natural(Pattern::bark, 257, 1.3f));
  const auto glass = [&](glm::vec3 tint, float alpha) {
    return add_material(
        s, {.surface = SceneSurface::blended, .texture = metal, .tint = tint, .gloss = 2.0f, .alpha = alpha, .two_sided = true});
  };
  m.glass = glass({1.1f, 1.2f, 1.25f}, 0.18f);
  m.amber = glass({1.1f, 0.6f, 0.2f}, 0.55f);
  m.emerald = glass({0.3f, 0.9f, 0.5f}, 0.5f);
  return m;
}

void add_room(Scene& s, const WorkshopMaterials& m) {
  place(s, walls(), m.brick);
  place(s, room_floor(), m.floor);
  place(s, ceiling(), m.board);
  place(s, trusses(), m.beam);
  place(s, window_frames(), m.beam);
  place(s, roof(), m.roof);
  place(s, gables(), m.brick);
  const std::size_t glass = add_mesh(s, pane());
  for (const WindowPane& p : window_panes()) place(s, glass, m.glass, placed(p.center, 0.0, glm::dvec3(p.size, 1.0)));
  const std::size_t shade = add_mesh(s, lamp_shade()), bulb = add_mesh(s, lamp_bulb());
  for (const double x : {-3.9, 0.0, 3.9}) {
    place(s, shade, m.green, placed({x, 2.75, -1.6}));
    place(s, bulb, m.bulb, placed({x, 2.75, -1.6}));
  }
  place(s, ground_plane(120.0, 30), m.lawn, placed({0, -0.04, 0}));
  place(s, sky_dome(200.0), m.sky);
  const TreeShape tree = tree_shape({.height = 7.5, .crown = 2.6, .cards = 500, .card = 0.6, .seed = 111});
  const std::size_t wood = add_mesh(s, tree.wood), crown = add_mesh(s, tree.leaves);
  for (int i = 0; i < 8; ++i) {
    const glm::dmat4 at = placed({-16.0 + 5.0 * i, 0, i % 2 == 0 ? 13.0 : -13.0}, 0.17 * i, glm::dvec3(0.8 + 0.08 * (i % 4)));
    place(s, wood, m.bark, at);
    place(s, crown, m.tree, at);
  }
}

// Three racks along the right wall, with cans, bottles, jars and boxes on each shelf.
void add_racks(Scene& s, const WorkshopMaterials& m) {
  const std::size_t racks = add_mesh(s, rack()), cans = add_mesh(s, can()), bottles = add_mesh(s, bottle()),
                    boxes = add_mesh(s, cardboard_box());
  const std::size_t coils = add_mesh(s, coil()), gears = add_mesh(s, gear(24));
  const std::array<std::size_t, 7> paints{m.red, m.blue, m.yellow, m.green, m.steel, m.label, m.brass};
  const std::array<std::size_t, 3> glasses{m.amber, m.emerald, m.glass};
  WorkloadRandom random(141);
  for (int r = 0; r < 3; ++r) {
    const glm::dmat4 rack_at = placed({6.0, 0, -2.9 + 2.5 * r}, -0.25);
    place(s, racks, m.dark, rack_at);
    for (int shelf = 0; shelf < 5; ++shelf) {
      const double y = 0.27 + 0.55 * shelf;
      const uint32_t kind = static_cast<uint32_t>(r + 2 * shelf) % 4;
      for (double x = -0.98; x < 0.98;) {
        const double turn = random.unit(), z = random.between(-0.06, 0.06), size = random.between(0.8, 1.3);
        if (kind == 0) place(s, cans, paints[random.below(7)], rack_at * placed({x, y, z}, turn, glm::dvec3(size)));
        if (kind == 1) place(s, bottles, glasses[random.below(3)], rack_at * placed({x, y, z}, turn, glm::dvec3(size)));
        if (kind == 2) place(s, boxes, m.cardboard, rack_at * placed({x + 0.08, y, z}, 0.02 * turn, {0.2, 0.16 * size, 0.34}));
        if (kind == 3 && x < 0.8) {
          const bool is_coil = random.below(2) == 0;
          place(s, is_coil ? coils : gears, is_coil ? m.yellow : m.dark,
                rack_at * placed({x + 0.12, y, z}, turn, glm::dvec3(size * (is_coil ? 0.5 : 0.12))));
        }
        x += kind == 1 ? 0.13 : kind == 0 ? 0.22 : 0.3;
      }
    }
  }
}

void add_machines(Scene& s, const WorkshopMaterials& m) {
  const glm::dmat4 lathe = placed({2.6, 0, 0.6}, 0.04);
  place(s, machine_body(), m.green, lathe);
  place(s, machine_steel(), m.steel, lathe);
  const glm::dmat4 cart = placed({-3.0, 0, 1.2}, 0.08);
  place(s, cart_body(), m.board, cart);
  const std::size_t wheels = add_mesh(s, wheel());
  for (const double x : {-0.65, 0.65}) {
    for (const double z : {-0.66, 0.66}) {
      if (x > 0 && z > 0) continue;  // this wheel is missing
      place(s, wheels, m.beam, cart * placed({x, 0.02, z}));
    }
  }
  place(s, wheels, m.beam, placed({-1.1, 0.0, 2.75}, 0.3) * turned_x(-0.03));
  place(s, anvil(), m.dark, placed({-0.4, 0, 1.4}, 0.1));
  place(s, cage(), m.mesh, placed({5.3, 0, 3.5}));
  const std::size_t seat = add_mesh(s, stool());
  for (const glm::dvec2 at : {glm::dvec2(-2.2, -2.7), glm::dvec2(0.4, -2.6), glm::dvec2(3.3, 1.9)})
    place(s, seat, m.red, placed({at.x, 0, at.y}));
  place(s, ladder(), m.bench, placed({5.0, 0, -4.0}));
}

// Larger things on the floor.
void add_floor_things(Scene& s, const WorkshopMaterials& m) {
  const std::size_t barrels = add_mesh(s, barrel()), crates = add_mesh(s, crate()), pipes = add_mesh(s, pipe()),
                    planks = add_mesh(s, plank());
  const std::size_t coils = add_mesh(s, coil()), buckets = add_mesh(s, bucket()), bolts = add_mesh(s, bolt());
  const std::array<std::size_t, 4> colors{m.blue, m.rust, m.yellow, m.red};
  WorkloadRandom random(151);
  for (int i = 0; i < 7; ++i)
    place(s, barrels, colors[static_cast<std::size_t>(i) % 4],
          placed({-5.9 + 0.68 * (i % 4), i < 4 ? 0.0 : 0.92, 3.9 - 0.1 * (i / 4)}, 0.1 * i));
  for (int i = 0; i < 6; ++i) place(s, crates, m.board, placed({-5.9 + 0.9 * (i / 3), 0.52 * (i % 3), -3.6 + 0.15 * (i % 2)}, 0.02 * i));
  for (int i = 0; i < 22; ++i) {
    const double length = random.between(1.6, 3.2), x = -6.2 + 0.1 * (i % 5), z = 2.0 + 0.1 * (i / 5);
    place(s, pipes, i % 3 == 0 ? m.brass : m.steel, placed({x, 0, z}, 0, {1, length, 1}) * turned_x(0.004 * (i % 4)));
  }
  for (int i = 0; i < 12; ++i) {
    const double x = 0.9 + random.between(-0.08, 0.08), turn = random.between(-0.01, 0.01);
    place(s, planks, i % 2 == 0 ? m.board : m.bench, placed({x, 0.04 * (i / 3), 3.6 + 0.24 * (i % 3)}, turn));
  }
  for (int i = 0; i < 5; ++i)
    place(s, coils, i % 2 == 0 ? m.dark : m.yellow, placed({3.4 + 0.5 * i, 0.17 * (i % 2), 3.5 - 0.2 * (i % 3)}, 0.2 * i));
  for (int i = 0; i < 4; ++i)
    place(s, buckets, colors[static_cast<std::size_t>(i)], placed({4.3 - 0.5 * i, 0, -2.2 + 0.35 * (i % 2)}, 0.15 * i));
  for (int i = 0; i < 60; ++i) {
    const double x = random.between(-2.5, 4.5), z = random.between(-2.4, 2.8), turn = random.unit();
    place(s, bolts, i % 3 == 0 ? m.brass : m.steel, placed({x, 0.016, z}, turn) * turned_z(-0.25));
  }
  const std::size_t pot = add_mesh(s, pot_shape()),
                    plant = add_mesh(s, shrub_leaves({.cards = 90, .radius = 0.42, .card = 0.22, .seed = 152}));
  for (int i = 0; i < 4; ++i) {
    const double x = -4.6 + 3.0 * i;
    place(s, pot, m.rust, placed({x + 0.4, 1.1, 4.38}, 0, glm::dvec3(0.3)));
    place(s, plant, m.plant, placed({x + 0.4, 1.48, 4.38}, 0.2 * i, glm::dvec3(0.62)));
  }
}

}  // namespace

Scene make_workshop() {
  Scene s;
  const WorkshopMaterials m = add_materials(s);
  add_room(s, m);
  workshop::add_benches(s, m);
  workshop::add_tools(s, m);
  add_racks(s, m);
  add_machines(s, m);
  add_floor_things(s, m);
  s.light = {.to_sun = glm::normalize(glm::vec3(-0.30f, 0.58f, 0.76f)),
             .sun = {1.35f, 1.18f, 0.92f},
             .sky = {0.60f, 0.61f, 0.64f},
             .ground = {0.48f, 0.44f, 0.39f},
             .lamp_ws = {0.0f, 2.7f, -1.6f},
             .lamp = {1.7f, 1.35f, 0.9f},
             .haze = {0.80f, 0.84f, 0.88f},
             .haze_distance = 140.0f,
             .shadow_center = {0, 2, 0},
             .shadow_radius = 17.0};
  s.cameras = {{{-5.4, 1.9, 2.9}, {1.6, 1.1, -2.2}},
               {{-1.9, 1.5, -3.1}, {-0.5, 1.1, -4.0}},
               {{-15.0, 4.2, 9.5}, {-1.0, 1.6, 0.0}},
               {{3.4, 1.6, -0.9}, {6.2, 1.2, -1.2}},
               {{5.2, 3.1, 2.4}, {-1.6, 0.4, -0.9}}};
  return s;
}

}  // namespace halfspace
