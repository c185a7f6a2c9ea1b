// SPDX-License-Identifier: Apache-2.0
//
// The procedural Earth. All features are 3D noise (procedural/noise.h) evaluated on the unit sphere. SIMD lanes run along a row.
// Only correctly rounded operations are used, so the map is bit-identical for every SIMD width.
#include "halfspace/procedural/earth.h"

#include <cmath>

#include "halfspace/core/check.h"
#include "halfspace/core/float_mode.h"
#include "halfspace/core/trig_double.h"
#include "halfspace/geometry/displaced_sphere.h"
#include "halfspace/procedural/noise.h"
#include "halfspace/procedural/palette.h"

namespace halfspace::HS_LANES {

namespace {

using namespace procedural;

// ---- the planet ------------------------------------------------------------------------------------------------

constexpr float kSeaLevel = 0.12f;  // value of the continent noise at sea level

struct Terrain {
  Real height;       // relative to the sea, about −1 to 1
  Real mountains;    // 0 to about 1.5
  Real temperature;  // 0 polar to 1 tropical
  Real moisture;     // 0 desert to 1 rain forest
  Real detail;       // fine noise
};

// Rainfall by latitude, with dry belts at about 25° (sine 0.42) on both sides of the rainy equator and dry continental interiors.
Real moisture_at(const Vec& p, Real height) {
  const Real from_belt = (abs(p.y) - Real(0.42f)) * Real(1.0f / 0.26f);
  const Real dry = max(Real(1.0f) - from_belt * from_belt, Real(0.0f));
  return Real(0.72f) - Real(0.42f) * dry + Real(0.55f) * cloud(scaled(p, 2.2f, 8.8f, 3.3f, 2.6f), 4, 41) -
         Real(0.35f) * step(0.15f, 0.55f, height);
}

// If the whole packet is sea, terms that affect only land are skipped, because the weight of the land color is 0 there.
Terrain terrain_at(const Vec& p, float coast) {
  // A second noise distorts the coastlines; without it, continents look like blots.
  const Vec bend(cloud(scaled(p, 1.9f, 3.1f, 8.2f, 1.7f), 2, 101), cloud(scaled(p, 1.9f, 11.4f, 2.9f, 6.3f), 2, 202),
                 cloud(scaled(p, 1.9f, 5.6f, 13.8f, 9.1f), 2, 303));
  const Vec q = scaled(p, 1.25f, 4.7f, 2.3f, 7.9f) + bend * Vec(Real(0.30f));
  Terrain t;
  t.height = cloud(q, 8, 1) - Real(kSeaLevel);
  t.mountains = t.moisture = t.detail = Real(0.0f);
  const Real y2 = p.y * p.y;
  t.temperature =
      Real(1.02f) - Real(1.08f) * y2 * (Real(0.35f) + Real(0.65f) * y2) + Real(0.10f) * cloud(scaled(p, 3.0f, 7.7f, 1.9f, 4.2f), 3, 61);
  const bool all_sea = none(t.height > Real(-coast));
  if (all_sea && none(t.temperature < Real(0.25f))) return t;
  t.detail = cloud(scaled(p, 21.0f, 1.3f, 5.7f, 3.9f), 4, 71);
  if (all_sea) return t;
  t.moisture = moisture_at(p, t.height);
  const Real inland = step(0.0f, 0.22f, t.height);
  const Real belts = step(-0.05f, 0.30f, noise(scaled(p, 1.6f, 9.2f, 4.4f, 1.1f), 51));
  t.mountains = ridges(scaled(q, 2.1f, 2.2f, 6.1f, 3.3f), 6, 31) * inland * belts;
  t.temperature -= Real(0.10f) * max(t.height, Real(0.0f)) + Real(0.20f) * t.mountains;
  return t;
}

// sRGB values from 0 to 255, blended without decoding.
constexpr glm::vec3 kAbyss(9, 24, 58), kOcean(15, 47, 98), kShelf(42, 110, 148), kShallows(98, 168, 178);
constexpr glm::vec3 kRainForest(30, 68, 30), kForest(52, 86, 42), kGrass(112, 126, 68), kSavanna(158, 144, 86);
constexpr glm::vec3 kDesert(211, 182, 132), kSand(222, 200, 158), kTaiga(58, 78, 56), kTundra(128, 120, 98);
constexpr glm::vec3 kRock(112, 98, 84), kSnow(242, 246, 250), kSeaIce(214, 228, 238);

Vec sea_color(const Terrain& t) {
  Vec c = blend(tint(kAbyss), kOcean, step(-0.75f, -0.18f, t.height));
  c = blend(c, kShelf, step(-0.13f, -0.02f, t.height));
  c = blend(c, kShallows, Real(0.7f) * step(-0.035f, 0.0f, t.height));
  return blend(c, kSeaIce, step(0.10f, 0.06f, t.temperature + Real(0.05f) * t.detail));
}

Vec land_color(const Terrain& t) {
  const Real moisture = t.moisture + Real(0.10f) * t.detail;
  const Real warmth = t.temperature + Real(0.03f) * t.detail;
  Vec c = blend(tint(kDesert), kSavanna, step(0.20f, 0.36f, moisture));
  c = blend(c, kGrass, step(0.34f, 0.50f, moisture));
  c = blend(c, kForest, step(0.48f, 0.66f, moisture));
  c = blend(c, kRainForest, step(0.62f, 0.84f, moisture) * step(0.62f, 0.80f, warmth));
  c = blend(c, kTaiga, step(0.56f, 0.44f, warmth) * step(0.25f, 0.45f, moisture));
  c = blend(c, kTundra, step(0.42f, 0.30f, warmth));
  c = blend(c, kSand, Real(0.5f) * step(0.018f, 0.0f, t.height) * step(0.4f, 0.6f, warmth));
  c = blend(c, kRock, Real(0.85f) * step(0.40f, 0.95f, t.mountains + Real(0.15f) * t.detail));
  // Snow appears where it is cold. On high crests it appears at warmer temperatures.
  const Real cold = warmth - Real(0.22f) * step(0.7f, 1.4f, t.mountains);
  c = blend(c, kSnow, step(0.27f, 0.17f, cold));
  // Shading of the fine relief.
  const Real shade = Real(1.0f) + Real(0.10f) * t.detail + Real(0.10f) * (t.mountains - Real(0.3f)) * step(0.1f, 0.5f, t.mountains);
  return c * shade;
}

// Half the height range over which sea blends into land. It is about the height difference across a pixel and antialiases the
// coasts.
float coast_of(int width) { return 6.0f / static_cast<float>(width); }

// Returns the directions of kLanes pixels of a row, starting at x.
HS_INLINE Vec directions(const Longitudes& longitudes, const SinCosDouble& latitude, int x) {
  const Real ring(static_cast<float>(latitude.sin));
  return Vec(ring * load<Real>(longitudes.cos.data() + x), Real(static_cast<float>(latitude.cos)),
             ring * load<Real>(longitudes.minus_sin.data() + x));
}

// Calls f(x, terrain) for each packet of kLanes pixels of a row, where x is the first pixel.
template <class F>
HS_INLINE void for_each_terrain(int width, int row, int height, const Longitudes& longitudes, const F& f) {
  const SinCosDouble latitude = sincos_turns(0.5 * (row + 0.5) / height);
  for (int x = 0; x < width; x += kLanes) f(x, terrain_at(directions(longitudes, latitude, x), coast_of(width)));
}

void put_colors(const Terrain& t, int x, std::span<glm::u8vec4> row) {
  const float coast = coast_of(static_cast<int>(row.size()));
  const Real land = step(-coast, coast, t.height);
  const Vec sea_rgb = sea_color(t);
  const Vec land_rgb = land_color(t);
  Int code[3];
  for (int c = 0; c < 3; ++c) code[c] = round_to_int(clamp(lerp(sea_rgb[c], land_rgb[c], land), Real(0.0f), Real(255.0f)));
  for (int i = 0; i < kLanes && x + i < static_cast<int>(row.size()); ++i) {
    row[static_cast<std::size_t>(x + i)] = glm::u8vec4(lane(code[0], i), lane(code[1], i), lane(code[2], i), 255);
  }
}

// Plains that rise inland with mountains on top. The sea is flat.
void put_heights(const Terrain& t, int x, std::span<float> row) {
  const float coast = coast_of(static_cast<int>(row.size()));
  const Real plain = Real(0.012f) + Real(0.25f) * max(t.height, Real(0.0f)) + Real(0.02f) * t.detail;
  const Real land = clamp(plain + Real(0.42f) * t.mountains * (Real(1.0f) + Real(0.25f) * t.detail), Real(0.0f), Real(1.0f));
  const Real height = land * step(-coast, coast, t.height);
  for (int i = 0; i < kLanes && x + i < static_cast<int>(row.size()); ++i) row[static_cast<std::size_t>(x + i)] = lane(height, i);
}

}  // namespace

Image<float> procedural_earth_heights(int width, int height, const Workers& workers) {
  const FloatMode float_mode;
  HS_CHECK_OP(width, >=, 1, "procedural_earth: the width is not positive; expected at least 1");
  HS_CHECK_OP(height, >=, 1, "procedural_earth: the height is not positive; expected at least 1");
  Image<float> map(width, height);
  const Longitudes longitudes = longitudes_of(width);
  workers.for_each(height, [&](int row) {
    for_each_terrain(width, row, height, longitudes, [&](int x, const Terrain& t) { put_heights(t, x, map.row(row)); });
  });
  return map;
}

Image<glm::u8vec4> procedural_earth(int width, int height, const Workers& workers) {
  const FloatMode float_mode;
  HS_CHECK_OP(width, >=, 1, "procedural_earth: the width is not positive; expected at least 1");
  HS_CHECK_OP(height, >=, 1, "procedural_earth: the height is not positive; expected at least 1");
  Image<glm::u8vec4> map(width, height);
  const Longitudes longitudes = longitudes_of(width);
  workers.for_each(height, [&](int row) {
    for_each_terrain(width, row, height, longitudes, [&](int x, const Terrain& t) { put_colors(t, x, map.row(row)); });
  });
  return map;
}

EarthMaps procedural_earth_maps(int width, int height, const Workers& workers) {
  const FloatMode float_mode;
  HS_CHECK_OP(width, >=, 1, "procedural_earth: the width is not positive; expected at least 1");
  HS_CHECK_OP(height, >=, 1, "procedural_earth: the height is not positive; expected at least 1");
  EarthMaps maps{Image<glm::u8vec4>(width, height), Image<float>(width, height)};
  const Longitudes longitudes = longitudes_of(width);
  workers.for_each(height, [&](int row) {
    for_each_terrain(width, row, height, longitudes, [&](int x, const Terrain& t) {
      put_colors(t, x, maps.color.row(row));
      put_heights(t, x, maps.height.row(row));
    });
  });
  return maps;
}

Image<glm::vec4> procedural_earth_normals(const Image<float>& heights, const Workers& workers) {
  constexpr double kSmoothing = 1.0, kRelief = 0.02;  // texels; radii
  const HeightField field(heights, kSmoothing, workers);
  Image<glm::vec4> map(heights.width(), heights.height());
  const SlopeRows slopes(field, map.width(), map.height(), 1.0, kRelief, 0.0);
  workers.for_each(map.height(), [&](int row) {
    slopes(row, map.row(row));
    for (glm::vec4& t : map.row(row)) {
      const glm::vec3 n(-t.x, -t.y, t.z);
      t = glm::vec4(n / std::sqrt(n.x * n.x + n.y * n.y + n.z * n.z) * 0.5f + 0.5f, 1.0f);
    }
  });
  return map;
}

}  // namespace halfspace::HS_LANES
