// SPDX-License-Identifier: Apache-2.0
//
// The invented Earth. Everything is gradient noise (after Perlin, "Improving noise", 2002, with a hash in place of
// his table) summed over octaves in three dimensions and looked up on the unit sphere. Lanes run along a row; only
// correctly rounded operations are used, so the map has the same bits at every lane width.
#include "scene/procedural_earth.h"

#include <type_traits>
#include <vector>

#include "core/check.h"
#include "core/trig_double.h"
#include "core/vec.h"

namespace halfspace {

namespace {

using Vec = vec3<Real>;

// ---- noise -----------------------------------------------------------------------------------------------------

// Lanes wrap round; for a plain int (lanes = 1) that must be said.
template <class I>
HS_INLINE I wrapping_mul(I a, int32_t b) {
  if constexpr (std::is_same_v<I, int32_t>) {
    return static_cast<int32_t>(static_cast<uint32_t>(a) * static_cast<uint32_t>(b));
  } else {
    return a * I(b);
  }
}
template <class I>
HS_INLINE I wrapping_add(I a, int32_t b) {
  if constexpr (std::is_same_v<I, int32_t>) {
    return static_cast<int32_t>(static_cast<uint32_t>(a) + static_cast<uint32_t>(b));
  } else {
    return a + I(b);
  }
}

// The top bits of the result depend on all bits of h.
HS_INLINE Int scramble(Int h) { return wrapping_mul(h ^ (h >> 15), 0x2c1b3c6d); }

// The dot product of (x, y, z) with one of the eight directions (±1, ±1, ±1), chosen by the top three bits.
HS_INLINE Real gradient(Int hash, Real x, Real y, Real z) {
  const Int sign(INT32_MIN);
  return as_real(as_int(x) ^ (hash & sign)) + as_real(as_int(y) ^ ((hash << 1) & sign)) + as_real(as_int(z) ^ ((hash << 2) & sign));
}

HS_INLINE Real fade(Real t) { return t * t * t * fma(t, fma(t, Real(6.0f), Real(-15.0f)), Real(10.0f)); }
HS_INLINE Real lerp(Real a, Real b, Real t) { return fma(t, b - a, a); }

// Gradient noise in about [−1, 1], zero at the integers; |p| must stay below 2^20.
Real noise(const Vec& p, int32_t seed) {
  const Vec cell(floor(p.x), floor(p.y), floor(p.z));
  const Vec f = p - cell;
  const Int x0 = wrapping_mul(truncate_to_int(cell.x), 0x1b873593);
  const Int y0 = wrapping_mul(truncate_to_int(cell.y), 0x19d699a5);
  const Int z0 = wrapping_add(wrapping_mul(truncate_to_int(cell.z), 0x3c6ef372), seed);
  const Int x1 = wrapping_add(x0, 0x1b873593);
  const Int y1 = wrapping_add(y0, 0x19d699a5);
  const Int z1 = wrapping_add(z0, 0x3c6ef372);
  const Vec g = f - Vec(Real(1.0f));
  const Real u = fade(f.x), v = fade(f.y), w = fade(f.z);
  const auto edge = [&](Int yz, Real fy, Real fz) {
    return lerp(gradient(scramble(x0 ^ yz), f.x, fy, fz), gradient(scramble(x1 ^ yz), g.x, fy, fz), u);
  };
  const Real near = lerp(edge(y0 ^ z0, f.y, f.z), edge(y1 ^ z0, g.y, f.z), v);
  const Real far = lerp(edge(y0 ^ z1, f.y, g.z), edge(y1 ^ z1, g.y, g.z), v);
  return lerp(near, far, w);
}

// The next octave's point: twice as fine (nearly, so that lattices do not line up), turned and moved.
HS_INLINE Vec next_octave(const Vec& p) {
  return Vec(fma(p.x, Real(1.624f), fma(p.y, Real(-0.974f), Real(17.3f))),
             fma(p.x, Real(0.771f), fma(p.y, Real(1.285f), fma(p.z, Real(-1.304f), Real(-9.7f)))),
             fma(p.x, Real(0.635f), fma(p.y, Real(1.058f), fma(p.z, Real(1.584f), Real(5.1f)))));
}

// Octaves of noise, each half as strong as the one before.
Real cloud(Vec p, int octaves, int32_t seed) {
  Real sum(0.0f);
  float strength = 1.0f;
  for (int i = 0; i < octaves; ++i) {
    sum += Real(strength) * noise(p, seed + i);
    strength *= 0.5f;
    p = next_octave(p);
  }
  return sum;
}

// The same with sharp crests where the noise is zero: mountain chains, in [0, 2).
Real ridges(Vec p, int octaves, int32_t seed) {
  Real sum(0.0f), crest(1.0f);
  float strength = 1.0f;
  for (int i = 0; i < octaves; ++i) {
    const Real r = max(Real(1.0f) - Real(1.6f) * abs(noise(p, seed + i)), Real(0.0f));
    crest = r * r * min(Real(2.0f) * crest, Real(1.0f));  // fine crests only upon coarse ones
    sum += Real(strength) * crest;
    strength *= 0.5f;
    p = next_octave(p);
  }
  return sum;
}

/// 0 below lo, 1 above hi, smooth between.
HS_INLINE Real step(float lo, float hi, Real x) {
  const Real t = clamp((x - Real(lo)) * Real(1.0f / (hi - lo)), Real(0.0f), Real(1.0f));
  return t * t * (Real(3.0f) - Real(2.0f) * t);
}

// ---- the planet ------------------------------------------------------------------------------------------------

constexpr float kSeaLevel = 0.12f;  // of the continents' noise

struct Terrain {
  Real height;       // above the sea, about −1 to 1
  Real mountains;    // 0 to about 1.5
  Real temperature;  // 0 polar to 1 tropical
  Real moisture;     // 0 desert to 1 rain forest
  Real detail;       // fine noise
};

HS_INLINE Vec scaled(const Vec& p, float s, float x, float y, float z) {
  return Vec(fma(p.x, Real(s), Real(x)), fma(p.y, Real(s), Real(y)), fma(p.z, Real(s), Real(z)));
}

// Rain by latitude: dry belts at about 25° (sine 0.42), on both sides of the rainy equator, and dry inner continents.
Real moisture_at(const Vec& p, Real height) {
  const Real from_belt = (abs(p.y) - Real(0.42f)) * Real(1.0f / 0.26f);
  const Real dry = max(Real(1.0f) - from_belt * from_belt, Real(0.0f));
  return Real(0.72f) - Real(0.42f) * dry + Real(0.55f) * cloud(scaled(p, 2.2f, 8.8f, 3.3f, 2.6f), 4, 41) -
         Real(0.35f) * step(0.15f, 0.55f, height);
}

// What the sea does not need is left out where a whole packet is sea: its land colour is mixed in with weight 0.
Terrain terrain_at(const Vec& p, float coast) {
  // Coasts are bent by a second noise, so that continents do not look like blots.
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

// sRGB codes from 0 to 255, mixed as they are.
constexpr glm::vec3 kAbyss(9, 24, 58), kOcean(15, 47, 98), kShelf(42, 110, 148), kShallows(98, 168, 178);
constexpr glm::vec3 kRainForest(30, 68, 30), kForest(52, 86, 42), kGrass(112, 126, 68), kSavanna(158, 144, 86);
constexpr glm::vec3 kDesert(211, 182, 132), kSand(222, 200, 158), kTaiga(58, 78, 56), kTundra(128, 120, 98);
constexpr glm::vec3 kRock(112, 98, 84), kSnow(242, 246, 250), kSeaIce(214, 228, 238);

HS_INLINE Vec tint(const glm::vec3& c) { return Vec(Real(c.x), Real(c.y), Real(c.z)); }
HS_INLINE Vec blend(const Vec& a, const glm::vec3& b, Real t) {
  return Vec(lerp(a.x, Real(b.x), t), lerp(a.y, Real(b.y), t), lerp(a.z, Real(b.z), t));
}

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
  // Snow lies where it is cold, and on high crests earlier.
  const Real cold = warmth - Real(0.22f) * step(0.7f, 1.4f, t.mountains);
  c = blend(c, kSnow, step(0.27f, 0.17f, cold));
  // Light and shade of the fine relief.
  const Real shade = Real(1.0f) + Real(0.10f) * t.detail + Real(0.10f) * (t.mountains - Real(0.3f)) * step(0.1f, 0.5f, t.mountains);
  return c * shade;
}

// The directions of a row's pixel centres in the plane of the equator, padded to whole packets.
struct Longitudes {
  std::vector<float> cos, minus_sin;
};

Longitudes longitudes_of(int width) {
  const std::size_t padded = static_cast<std::size_t>((width + kLanes - 1) / kLanes * kLanes);
  Longitudes l{std::vector<float>(padded), std::vector<float>(padded)};
  for (std::size_t x = 0; x < padded; ++x) {
    const SinCosDouble a = sincos_turns((static_cast<double>(x) + 0.5) / width);
    l.cos[x] = static_cast<float>(a.cos);
    l.minus_sin[x] = static_cast<float>(-a.sin);
  }
  return l;
}

void fill_row(std::span<glm::u8vec4> out, const Longitudes& longitudes, const SinCosDouble& latitude) {
  const int width = static_cast<int>(out.size());
  // Half the height over which sea turns into land: about that of one pixel, so that coasts are not jagged.
  const float coast = 6.0f / static_cast<float>(width);
  const Real y(static_cast<float>(latitude.cos));
  const Real ring(static_cast<float>(latitude.sin));
  for (int x = 0; x < width; x += kLanes) {
    const Vec p(ring * load<Real>(longitudes.cos.data() + x), y, ring * load<Real>(longitudes.minus_sin.data() + x));
    const Terrain t = terrain_at(p, coast);
    const Real land = step(-coast, coast, t.height);
    const Vec sea_rgb = sea_color(t);
    const Vec land_rgb = land_color(t);
    Int code[3];
    for (int c = 0; c < 3; ++c) code[c] = round_to_int(clamp(lerp(sea_rgb[c], land_rgb[c], land), Real(0.0f), Real(255.0f)));
    for (int i = 0; i < kLanes && x + i < width; ++i) {
      out[static_cast<std::size_t>(x + i)] = glm::u8vec4(lane(code[0], i), lane(code[1], i), lane(code[2], i), 255);
    }
  }
}

}  // namespace

Image<glm::u8vec4> procedural_earth(int width, int height, const Workers& workers) {
  HS_CHECK_OP(width, >=, 1);
  HS_CHECK_OP(height, >=, 1);
  Image<glm::u8vec4> map(width, height);
  const Longitudes longitudes = longitudes_of(width);
  workers.for_each(height, [&](int row) { fill_row(map.row(row), longitudes, sincos_turns(0.5 * (row + 0.5) / height)); });
  return map;
}

}  // namespace halfspace
