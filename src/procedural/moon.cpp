// SPDX-License-Identifier: Apache-2.0
//
// The procedural Moon, computed row by row: basins and highlands from noise, old craters, lava in the lowlands, young craters on
// top of it, their rays, and the color derived from all of them. SIMD lanes run along a row.
#include "halfspace/procedural/moon.h"

#include <algorithm>
#include <vector>

#include "halfspace/core/check.h"
#include "halfspace/core/float_mode.h"
#include "halfspace/core/trig_double.h"
#include "halfspace/procedural/craters.h"
#include "halfspace/procedural/noise.h"
#include "halfspace/procedural/palette.h"

namespace halfspace::HS_LANES {

namespace {

using namespace procedural;

// ---- basins ----------------------------------------------------------------------------------------------------

// A large old impact: position in degrees east and north, radius in degrees, and three heights in km: the depth, the mountain ring,
// and the level to which lava has risen inside. kDry means no lava.
struct Basin {
  double east, north;
  float radius, depth, ring, lava;
};

constexpr float kDry = -20.0f;

constexpr Basin kBasins[] = {
    {-16, 35, 20.0f, 3.6f, 1.1f, -1.5f},   // Imbrium
    {18, 27, 12.0f, 3.4f, 0.8f, -1.6f},    // Serenitatis
    {31, 9, 15.0f, 3.0f, 0.3f, -1.4f},     // Tranquillitatis
    {59, 17, 8.5f, 3.8f, 1.0f, -2.0f},     // Crisium
    {51, -6, 12.5f, 2.9f, 0.3f, -1.5f},    // Fecunditatis
    {35, -16, 7.0f, 3.2f, 0.8f, -1.7f},    // Nectaris
    {-15, -19, 13.0f, 2.9f, 0.2f, -1.4f},  // Nubium
    {-39, -24, 7.5f, 3.4f, 0.7f, -1.6f},   // Humorum
    {-54, 18, 22.0f, 3.1f, 0.1f, -1.4f},   // Procellarum, north and south
    {-45, -4, 15.0f, 2.9f, 0.0f, -1.4f},   //
    {-26, 4, 13.0f, 2.9f, 0.0f, -1.5f},    // Insularum
    {-45, 52, 10.0f, 2.9f, 0.0f, -1.5f},   // Roris
    {-22, 58, 8.5f, 2.9f, 0.0f, -1.5f},    // Frigoris, from west to east
    {0, 58, 8.0f, 2.9f, 0.0f, -1.5f},      //
    {22, 56, 7.5f, 2.9f, 0.0f, -1.5f},     //
    {40, 52, 6.0f, 2.7f, 0.0f, -1.5f},     //
    {3, 13, 5.5f, 2.8f, 0.1f, -1.5f},      // Vaporum
    {-93, -19, 13.0f, 2.0f, 1.5f, kDry},   // Orientale and its lava
    {-94, -20, 5.0f, 2.4f, 0.5f, -2.9f},   //
    {87, -2, 6.5f, 3.0f, 0.4f, -1.9f},     // Smythii
    {87, 13, 6.0f, 2.9f, 0.4f, -1.9f},     // Marginis
    {93, -40, 8.0f, 2.6f, 0.3f, -1.9f},    // Australe
    {148, 27, 5.0f, 3.8f, 0.9f, -1.9f},    // Moscoviense
    {163, -34, 4.0f, 3.2f, 0.4f, -2.8f},   // Ingenii
    {-169, -54, 33.0f, 3.4f, 0.8f, kDry},  // South Pole-Aitken and its lava
    {-176, -48, 5.0f, 1.2f, 0.0f, -3.1f},  //
    {-129, 2, 15.0f, 2.2f, 1.0f, kDry},    // Hertzsprung
    {-158, 5, 10.0f, 1.8f, 0.8f, kDry},    // Korolev
    {129, -5, 8.0f, 1.6f, 0.8f, kDry},     // Mendeleev
    {81, 58, 8.0f, 2.4f, 0.5f, -2.0f},     // Humboldtianum
};

struct PlacedBasin {
  glm::vec3 center;
  float per_radius;  // reciprocal of the radius, measured as a chord
  float depth, ring, lava;
};

std::vector<PlacedBasin> placed_basins() {
  std::vector<PlacedBasin> basins;
  for (const Basin& b : kBasins) {
    const SinCosDouble u = sincos_turns(0.5 + b.east / 360.0), latitude = sincos_turns(b.north / 360.0);
    const double chord = 2.0 * sincos_turns(static_cast<double>(b.radius) / 720.0).sin;
    basins.push_back({glm::vec3(glm::dvec3(latitude.cos * u.cos, latitude.sin, -latitude.cos * u.sin)), static_cast<float>(1.0 / chord),
                      b.depth, b.ring, b.lava});
  }
  return basins;
}

// ---- the ground ------------------------------------------------------------------------------------------------

// Heights in km.
struct Ground {
  Real height;  // without craters
  Real lava;    // level to which lava would rise
  Real floor;   // depth of basins with lava
  Real basin;   // 1 within basins with lava, 0 outside
};

void add_basin(Ground& g, const PlacedBasin& b, const Vec& p, Real gaps) {
  const Vec d = p - Vec(Real(b.center.x), Real(b.center.y), Real(b.center.z));
  const Real x = sqrt(fma(d.x, d.x, fma(d.y, d.y, d.z * d.z))) * Real(b.per_radius);
  if (none(x < Real(1.6f))) return;
  const Real from_ring = (x - Real(1.03f)) * Real(1.0f / 0.16f);
  const Real ring = max(Real(1.0f) - from_ring * from_ring, Real(0.0f));
  g.height = fma(Real(b.ring) * gaps, ring * ring, g.height);
  const Real inside = step(1.04f, 0.72f, x);
  if (b.lava <= kDry) {
    g.height -= Real(b.depth) * inside;
    return;
  }
  // Overlapping basins with lava take the maximum of their depths, not the sum.
  g.floor = max(g.floor, Real(b.depth) * inside);
  g.lava = max(g.lava, Real(b.lava) - Real(9.0f) * step(0.90f, 1.4f, x));
  g.basin = max(g.basin, step(1.1f, 0.9f, x));
}

Ground ground_at(const Vec& p, const std::vector<PlacedBasin>& basins) {
  Ground g{Real(0.9f) * cloud(scaled(p, 2.3f, 3.9f, 7.1f, 1.6f), 5, 501) + Real(0.55f) + Real(0.9f) * p.x, Real(kDry), Real(0.0f),
           Real(0.0f)};
  // Noise distorts the shores.
  const Vec bend(cloud(scaled(p, 3.1f, 2.2f, 5.8f, 9.4f), 3, 511), cloud(scaled(p, 3.1f, 8.5f, 1.4f, 3.3f), 3, 521),
                 cloud(scaled(p, 3.1f, 4.1f, 6.6f, 7.2f), 3, 531));
  const Vec q = p + bend * Vec(Real(0.095f));
  for (const PlacedBasin& b : basins) add_basin(g, b, q, clamp(Real(0.7f) + Real(2.0f) * bend.y, Real(0.0f), Real(1.3f)));
  g.height -= g.floor;
  return g;
}

// ---- rows ------------------------------------------------------------------------------------------------------

// Data shared by all rows.
struct Moon {
  Longitudes longitudes;
  std::vector<PlacedBasin> basins;
  Craters craters;
  std::vector<std::vector<std::size_t>> craters_of_row;  // crater indices, from old to young
  int octaves;                                           // number of octaves of the finest noise
};

// A row of the map under construction.
struct MoonRow {
  CraterRow craters;
  std::vector<float> height, lava;  // km
  std::vector<float> basin;         // 1 within basins with lava
  std::vector<float> sea;           // fraction of the texel that is covered by a mare
};

std::vector<std::vector<std::size_t>> craters_by_row(const Craters& craters, int height) {
  std::vector<std::vector<std::size_t>> rows(static_cast<std::size_t>(height));
  for (std::size_t i = 0; i < craters.all.size(); ++i) {
    const RowRange range = rows_reached(craters.all[i], height);
    for (int row = range.begin; row < range.end; ++row) rows[static_cast<std::size_t>(row)].push_back(i);
  }
  return rows;
}

MoonRow start_row(const Moon& moon, int width, const SinCosDouble& colatitude) {
  const std::size_t padded = static_cast<std::size_t>(width + kLanes);
  const float ring = static_cast<float>(colatitude.sin);
  MoonRow row{{width, static_cast<float>(colatitude.cos), ring, {}, {}, {}, {}}, {}, {}, {}, {}};
  for (auto* v : {&row.craters.x, &row.craters.z, &row.craters.relief, &row.craters.light, &row.height, &row.lava, &row.basin, &row.sea}) {
    v->resize(padded);
  }
  for (std::size_t x = 0; x < static_cast<std::size_t>(width); ++x) {
    row.craters.x[x] = ring * moon.longitudes.cos[x];
    row.craters.z[x] = ring * moon.longitudes.minus_sin[x];
  }
  return row;
}

Vec place(const CraterRow& row, std::size_t x) { return Vec(load<Real>(&row.x[x]), Real(row.y), load<Real>(&row.z[x])); }

template <class F>
void for_row(const MoonRow& row, const F& packet) {
  for (int x = 0; x < row.craters.width; x += kLanes) packet(static_cast<std::size_t>(x));
}

void lay_ground(const Moon& moon, MoonRow& row) {
  for_row(row, [&](std::size_t x) {
    const Vec p = place(row.craters, x);
    const Ground g = ground_at(p, moon.basins);
    store(&row.height[x], g.height + Real(0.30f) * cloud(scaled(p, 19.0f, 6.2f, 2.7f, 8.8f), moon.octaves, 541));
    store(&row.lava[x], g.lava + Real(0.65f) * cloud(scaled(p, 8.0f, 7.4f, 0.8f, 2.1f), 4, 546));
    store(&row.basin[x], g.basin);
  });
}

// Fills terrain below the lava level with nearly flat lava. A trace of the covered relief remains visible.
void flood(MoonRow& row) {
  for_row(row, [&](std::size_t x) {
    const Vec p = place(row.craters, x);
    const Real height = load<Real>(&row.height[x]), lava = load<Real>(&row.lava[x]);
    // The impact that formed the basin destroyed most of the older relief.
    const Real relief = load<Real>(&row.craters.relief[x]) * (Real(1.0f) - Real(0.6f) * load<Real>(&row.basin[x]));
    const Real below = lava - (height + relief);
    const Real sea = step(-0.12f, 0.22f, below);
    // Highlands show through thin lava.
    store(&row.sea[x], Real(0.25f) * step(-0.6f, 0.2f, below) + Real(0.75f) * step(-0.15f, 0.6f, below));
    const Real wrinkles = Real(0.10f) * ridges(scaled(p, 9.0f, 1.1f, 4.9f, 7.3f), 3, 551);
    store(&row.height[x], lerp(height, lava + wrinkles, sea));
    store(&row.craters.relief[x], relief * (Real(1.0f) - Real(0.97f) * sea));
  });
}

// sRGB values from 0 to 255, blended without decoding.
constexpr glm::vec3 kHighland(158, 154, 148), kSeaBlue(82, 83, 85), kSeaBrown(95, 92, 88), kFreshDust(232, 230, 226);

Vec color_at(const Moon& moon, const Vec& p, Real sea, Real light) {
  const Real wide = cloud(scaled(p, 3.4f, 5.1f, 9.2f, 2.4f), 5, 561), fine = cloud(scaled(p, 31.0f, 1.8f, 3.7f, 6.1f), moon.octaves, 571);
  const Vec lava = blend(tint(kSeaBlue), kSeaBrown, step(-0.25f, 0.35f, wide));
  Vec c = tint(kHighland) * (Real(1.0f) + Real(0.10f) * wide + Real(0.08f) * fine);
  const Vec dark = lava * (Real(1.0f) + Real(0.14f) * wide + Real(0.10f) * fine);
  c = Vec(lerp(c.x, dark.x, sea), lerp(c.y, dark.y, sea), lerp(c.z, dark.z, sea));
  return blend(c, kFreshDust, Real(0.75f) * min(light, Real(1.0f)));
}

void finish(const Moon& moon, const MoonRow& row, std::span<glm::u8vec4> color, std::span<uint16_t> height) {
  for_row(row, [&](std::size_t x) {
    const Real km = load<Real>(&row.height[x]) + load<Real>(&row.craters.relief[x]);
    const Int height_code = round_to_int(clamp((km + Real(10.0f)) * Real(65535.0f / 20.0f), Real(0.0f), Real(65535.0f)));
    const Vec rgb = color_at(moon, place(row.craters, x), load<Real>(&row.sea[x]), load<Real>(&row.craters.light[x]));
    Int code[3];
    for (int c = 0; c < 3; ++c) code[c] = round_to_int(clamp(rgb[c], Real(0.0f), Real(255.0f)));
    for (int i = 0; i < kLanes && x + static_cast<std::size_t>(i) < color.size(); ++i) {
      color[x + static_cast<std::size_t>(i)] = glm::u8vec4(lane(code[0], i), lane(code[1], i), lane(code[2], i), 255);
      height[x + static_cast<std::size_t>(i)] = static_cast<uint16_t>(lane(height_code, i));
    }
  });
}

void fill_row(const Moon& moon, int y, MoonMaps& maps) {
  const int width = maps.color.width(), height = maps.color.height();
  MoonRow row = start_row(moon, width, sincos_turns(0.5 * (y + 0.5) / height));
  const std::vector<std::size_t>& craters = moon.craters_of_row[static_cast<std::size_t>(y)];
  const auto young = std::lower_bound(craters.begin(), craters.end(), moon.craters.first_young);
  lay_ground(moon, row);
  for (auto i = craters.begin(); i != young; ++i) stamp(moon.craters.all[*i], row.craters);
  flood(row);
  for (auto i = young; i != craters.end(); ++i) stamp(moon.craters.all[*i], row.craters);
  for (auto i = young; i != craters.end(); ++i) add_rays(moon.craters.all[*i], row.craters);
  finish(moon, row, maps.color.row(y), maps.height.row(y));
}

// Returns the number of octaves for which a lattice cell of the finest noise is about one texel wide.
int octaves_of(int width) {
  int octaves = 1;
  while (octaves < 12 && (60 << octaves) < width) ++octaves;
  return octaves;
}

}  // namespace

MoonMaps procedural_moon(int width, const Workers& workers) {
  const FloatMode float_mode;
  HS_CHECK_OP(width, >=, 2, "procedural_moon: the width is too small; expected at least 2");
  HS_CHECK_OP(width % 2, ==, 0, "procedural_moon: the width is odd; expected an even number");
  const int height = width / 2;
  MoonMaps maps{Image<glm::u8vec4>(width, height), Image<uint16_t>(width, height)};
  Moon moon{longitudes_of(width), placed_basins(), moon_craters(width), {}, octaves_of(width)};
  moon.craters_of_row = craters_by_row(moon.craters, height);
  workers.for_each(height, [&](int y) { fill_row(moon, y, maps); });
  return maps;
}

}  // namespace halfspace::HS_LANES
