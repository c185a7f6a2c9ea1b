// SPDX-License-Identifier: Apache-2.0
//
// The street: a town of terraced houses behind a square. The first row hides most of the others.
#include <array>

#include "scenes/scene_kinds.h"
#include "scenes/scene_plants.h"
#include "scenes/scene_textures.h"
#include "scenes/street_parts.h"

namespace halfspace {

namespace {

using namespace street;

constexpr int kBlock = 4;  // houses between two cross streets
constexpr double kCrossStreet = 5.0, kYard = 3.0, kStreet = 6.0;
constexpr std::array<glm::vec3, 6> kTints{{{1.0f, 0.95f, 0.82f},
                                           {0.98f, 0.83f, 0.58f},
                                           {0.95f, 0.76f, 0.68f},
                                           {0.80f, 0.88f, 0.78f},
                                           {0.98f, 0.97f, 0.95f},
                                           {0.76f, 0.82f, 0.90f}}};

struct StreetMaterials {
  std::array<std::size_t, kTints.size()> walls;
  std::size_t trim, roof, wood, glass, plants, cobbles, iron, bark, tree, sky;
};

StreetMaterials add_materials(Scene& s) {
  const auto plain = [&](const SceneTexels& image, float gloss = 0.0f) {
    return add_material(s, {.texture = add_texture(s, image), .gloss = gloss});
  };
  const auto cutout = [&](const SceneTexels& image) {
    return add_material(s, {.surface = SceneSurface::cutout, .texture = add_texture(s, image), .two_sided = true});
  };
  StreetMaterials m{};
  const std::size_t plaster = add_texture(s, mottled({510, 510}, {0.74f, 0.73f, 0.70f}, {0.94f, 0.93f, 0.90f}, {6, 6}, 5, 201));
  for (std::size_t i = 0; i < kTints.size(); ++i) m.walls[i] = add_material(s, {.texture = plaster, .tint = kTints[i]});
  m.trim = plain(mottled({300, 450}, {0.66f, 0.63f, 0.57f}, {0.86f, 0.83f, 0.76f}, {5, 8}, 4, 202), 0.1f);
  m.roof = plain(mottled({420, 420}, {0.46f, 0.22f, 0.15f}, {0.70f, 0.38f, 0.27f}, {24, 24}, 3, 203), 0.1f);
  m.wood = plain(boards({255, 399}, {0.20f, 0.27f, 0.24f}, {0.34f, 0.42f, 0.37f}, 4, 204), 0.2f);
  m.glass = plain(mottled({150, 200}, {0.16f, 0.22f, 0.28f}, {0.32f, 0.42f, 0.50f}, {3, 3}, 3, 205), 1.8f);
  m.plants = cutout(flowers({250, 250}, {0.86f, 0.22f, 0.30f}, {0.26f, 0.46f, 0.16f}, 206));
  m.cobbles = plain(masonry({700, 700}, {0.56f, 0.53f, 0.49f}, {0.34f, 0.32f, 0.29f}, {20, 20}, 207), 0.1f);
  m.iron = plain(mottled({100, 100}, {0.10f, 0.12f, 0.11f}, {0.20f, 0.23f, 0.21f}, {5, 5}, 3, 208), 0.6f);
  m.bark = plain(natural(Pattern::bark, 257, 1.3f));
  m.tree = cutout(leaves({356, 500}, {0.16f, 0.32f, 0.09f}, {0.42f, 0.56f, 0.18f}, 28, 0.25, 209));
  m.sky = add_material(s, {.surface = SceneSurface::unlit,
                           .texture = add_texture(s, cloudy_sky({1500, 460}, {0.82f, 0.88f, 0.94f}, {0.28f, 0.49f, 0.82f})),
                           .two_sided = true});
  return m;
}

void place_house(Scene& s, const StreetMaterials& m, uint32_t number, const glm::dmat4& at) {
  const HouseShape house = house_shape(house_options(number));
  place(s, house.walls, m.walls[(number * 5 + number / 7) % m.walls.size()], at);
  place(s, house.trim, m.trim, at);
  place(s, house.roof, m.roof, at);
  place(s, house.wood, m.wood, at);
  place(s, house.glass, m.glass, at);
  place(s, house.plants, m.plants, at);
}

void add_houses(Scene& s, const StreetMaterials& m, TownSize town) {
  const double width = kHouseWidth * town.columns + kCrossStreet * ((town.columns - 1) / kBlock);
  for (int row = 0; row < town.rows; ++row) {
    // Two rows stand back to back, with yards between them.
    const bool is_back = row % 2 == 1;
    const double z = -(row / 2) * (2 * kHouseDepth + kYard + kStreet) - (is_back ? kHouseDepth + kYard : 0.0);
    for (int i = 0; i < town.columns; ++i) {
      const double x = kHouseWidth * (i + 0.5) + kCrossStreet * (i / kBlock) - 0.5 * width;
      place_house(s, m, static_cast<uint32_t>(row * town.columns + i), placed({x, 0, z}, is_back ? 0.5 : 0.0));
    }
  }
}

void add_square(Scene& s, const StreetMaterials& m) {
  place(s, fountain(), m.trim, placed({9, 0, 17}));
  const std::size_t post = add_mesh(s, lamp_post());
  for (int i = 0; i < 8; ++i) place(s, post, m.iron, placed({9.0 * i - 31.5, 0, 8.6}));
  const TreeShape tree = tree_shape({.height = 7.0, .crown = 2.4, .cards = 900, .card = 0.45, .seed = 210});
  const std::size_t trunk = add_mesh(s, tree.wood), crown = add_mesh(s, tree.leaves);
  for (int i = 0; i < 3; ++i) {
    const glm::dmat4 at = placed({-24.0 + 26.0 * i, 0, 13.5}, 0.29 * i, glm::dvec3(0.9 + 0.1 * i));
    place(s, trunk, m.bark, at);
    place(s, crown, m.tree, at);
  }
}

}  // namespace

Scene make_street(TownSize town) {
  Scene s;
  const StreetMaterials m = add_materials(s);
  add_houses(s, m, town);
  add_square(s, m);
  place(s, ground_plane(480.0, 60), m.cobbles);
  place(s, sky_dome(400.0), m.sky);
  s.culls_objects = true;
  s.near_hides_far = true;
  s.light = {.to_sun = glm::normalize(glm::vec3(-0.45f, 0.68f, 0.60f)),
             .sun = {1.15f, 1.05f, 0.88f},
             .sky = {0.50f, 0.55f, 0.63f},
             .ground = {0.36f, 0.33f, 0.29f},
             .lamp_ws = {9.0f, 3.0f, 17.0f},
             .lamp = {0.0f, 0.0f, 0.0f},
             .haze = {0.80f, 0.86f, 0.92f},
             .haze_distance = 220.0f,
             .shadow_center = {0, 4, -60},
             .shadow_radius = 82.0};
  s.cameras = {{{-16.0, 1.75, 31.0}, {4.0, 6.6, 0.0}}};
  return s;
}

}  // namespace halfspace
