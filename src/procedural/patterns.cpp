// SPDX-License-Identifier: Apache-2.0
//
// SIMD lanes run along a row. Only correctly rounded operations are used (procedural/noise.h), so the maps are bit-identical for
// every SIMD width.
#include "halfspace/procedural/patterns.h"

#include <algorithm>

#include "halfspace/core/check.h"
#include "halfspace/core/float_mode.h"
#include "halfspace/core/hash.h"
#include "halfspace/procedural/noise.h"
#include "halfspace/procedural/palette.h"

namespace halfspace::HS_LANES {

namespace {

using namespace procedural;

// Material of one texel.
struct TexelMaterial {
  Vec color = tint(glm::vec3(128.0f));  // sRGB values, 0 to 255
  Real specular{0.0f};                  // 0 to 1
  Vec emissive = tint(glm::vec3(0.0f));
  Real height{0.5f};  // 0 to 1
};

// Position of a texel: (u, v) of its center in [0, 1), and the number of texels across the map.
struct Place {
  Real u, v;
  int texels;
};

// ---- grass, bark, rock, hills ----------------------------------------------------------------------------------

constexpr glm::vec3 kBlade(92, 122, 46), kShade(34, 56, 20), kFresh(120, 148, 62), kStraw(160, 150, 92);

TexelMaterial grass(const Place& p) {
  const Real patches = tiled_cloud(p.u, p.v, 3, 3, 4, p.texels, 1001);
  const Real tufts = tiled_cloud(p.u, p.v, 16, 16, 4, p.texels, 1011);
  const Real blades = tiled_cloud(p.u, p.v, 96, 48, 3, p.texels, 1021) + Real(0.7f) * tiled_cloud(p.u, p.v, 64, 128, 2, p.texels, 1031);
  TexelMaterial m;
  m.height = clamp(Real(0.5f) + Real(0.2f) * tufts + Real(0.25f) * blades, Real(0.0f), Real(1.0f));
  m.color = blend(tint(kBlade), kFresh, step(-0.2f, 0.7f, patches));
  m.color = blend(m.color, kStraw, Real(0.7f) * step(0.25f, 0.9f, tufts - patches));
  m.color = blend(m.color, kShade, Real(0.85f) * step(0.55f, 0.15f, m.height));
  return m;
}

constexpr glm::vec3 kBarkDark(44, 33, 25), kBarkMiddle(104, 82, 62), kBarkLight(152, 132, 110), kMoss(96, 110, 58);

TexelMaterial bark(const Place& p) {
  // Ridges run along v and are slightly bent.
  const Real bend = Real(0.02f) * tiled_cloud(p.u, p.v, 3, 5, 3, p.texels, 1101);
  const Real ridge = tiled_ridges(p.u + bend, p.v, 10, 2, 5, p.texels, 1111);
  const Real fine = tiled_cloud(p.u, p.v, 48, 16, 3, p.texels, 1121);
  TexelMaterial m;
  m.height = clamp(Real(0.15f) + Real(0.55f) * ridge + Real(0.08f) * fine, Real(0.0f), Real(1.0f));
  m.color = blend(tint(kBarkDark), kBarkMiddle, step(0.1f, 0.55f, m.height));
  m.color = blend(m.color, kBarkLight, Real(0.8f) * step(0.5f, 1.0f, m.height + Real(0.15f) * fine));
  m.color = blend(m.color, kMoss, Real(0.5f) * step(0.45f, 0.9f, tiled_cloud(p.u, p.v, 4, 4, 4, p.texels, 1131)));
  return m;
}

constexpr glm::vec3 kRockDark(70, 66, 62), kRockMiddle(128, 122, 114), kRockLight(178, 172, 160), kLichen(140, 138, 96);

TexelMaterial rock(const Place& p) {
  const Real folds = tiled_ridges(p.u, p.v, 4, 4, 6, p.texels, 1201);
  const Real grain = tiled_cloud(p.u, p.v, 32, 32, 4, p.texels, 1211), wide = tiled_cloud(p.u, p.v, 3, 3, 4, p.texels, 1221);
  TexelMaterial m;
  m.height = clamp(Real(0.2f) + Real(0.38f) * folds + Real(0.2f) * wide + Real(0.06f) * grain, Real(0.0f), Real(1.0f));
  m.color = blend(tint(kRockDark), kRockMiddle, step(0.15f, 0.5f, m.height + Real(0.1f) * grain));
  m.color = blend(m.color, kRockLight, step(0.5f, 0.95f, m.height + Real(0.12f) * grain));
  m.color = blend(m.color, kLichen, Real(0.45f) * step(0.25f, 0.7f, wide + Real(0.4f) * grain));
  return m;
}

TexelMaterial hills(const Place& p) {
  TexelMaterial m;
  const Real wide = tiled_cloud(p.u, p.v, 2, 2, 8, p.texels, 1301), crests = tiled_ridges(p.u, p.v, 3, 3, 6, p.texels, 1311);
  m.height = clamp(Real(0.45f) + Real(0.38f) * wide + Real(0.12f) * crests * step(0.0f, 0.6f, wide), Real(0.0f), Real(1.0f));
  m.color = Vec(Real(255.0f) * m.height);
  return m;
}

// ---- bricks, facade, checkerboard --------------------------------------------------------------------------------

// Returns a pseudorandom number in [0, 1) for a cell of a grid.
HS_INLINE Real chance(Real column, Real row, int32_t seed) {
  const Int cell = wrapping_mul(truncate_to_int(column), 0x1b873593) ^ wrapping_mul(truncate_to_int(row), 0x19d699a5) ^ Int(seed);
  return unit_fraction<Real>(mix_bits(cell));
}

HS_INLINE Real modulo_period(Real x, float period) { return x - Real(period) * floor(x * Real(1.0f / period)); }

constexpr glm::vec3 kMortar(168, 160, 148), kBrickDark(118, 54, 40), kBrickRed(164, 82, 60), kBrickPale(186, 118, 88);

TexelMaterial bricks(const Place& p) {
  constexpr float kColumns = 4.0f, kRows = 8.0f;
  const Real y = p.v * Real(kRows), row = floor(y);
  const Real x = fma(p.u, Real(kColumns), Real(0.5f) * modulo_period(row, 2.0f)), column = modulo_period(floor(x), kColumns);
  const Real fine = tiled_cloud(p.u, p.v, 64, 64, 3, p.texels, 1401), wear = tiled_cloud(p.u, p.v, 16, 16, 4, p.texels, 1411);
  // A brick is twice as long as it is high, so the joint is doubled along y to be equally wide along both axes. Noise wears the
  // edges.
  constexpr float kJoint = 0.03f;
  const Real worn = Real(0.012f) * wear;
  const auto along = [&](Real t, float joint) { return min(t, Real(1.0f) - t) - Real(joint) + worn * Real(joint / kJoint); };
  const Real brick = step(0.0f, 0.04f, along(x - floor(x), kJoint)) * step(0.0f, 0.08f, along(y - row, 2.0f * kJoint));
  const Real kind = chance(column, row, 1421);
  TexelMaterial m;
  Vec clay = blend(tint(kBrickDark), kBrickRed, step(0.0f, 0.5f, kind));
  clay = blend(clay, kBrickPale, step(0.6f, 1.0f, kind));
  clay = clay * (Real(1.0f) + Real(0.12f) * fine + Real(0.10f) * wear);
  const Vec mortar = tint(kMortar) * (Real(1.0f) + Real(0.10f) * fine);
  for (int c = 0; c < 3; ++c) m.color[c] = lerp(mortar[c], clay[c], brick);
  m.height = clamp(Real(0.15f) + (Real(0.6f) + Real(0.15f) * kind) * brick + Real(0.05f) * fine, Real(0.0f), Real(1.0f));
  return m;
}

constexpr glm::vec3 kPlaster(186, 174, 152), kFrame(226, 222, 212), kGlassDark(26, 34, 44), kGlassSky(92, 116, 138), kLamp(255, 204, 128);

TexelMaterial facade(const Place& p) {
  constexpr float kWindows = 4.0f;
  const Real x = p.u * Real(kWindows), y = p.v * Real(kWindows), column = floor(x), row = floor(y), fx = x - column, fy = y - row;
  const float texel = kWindows / static_cast<float>(p.texels);  // edges are two texels wide
  const auto box = [&](float left, float right, float top, float bottom) {
    const auto band = [&](Real t, float low, float high) {
      return step(low - texel, low + texel, t) * step(high + texel, high - texel, t);
    };
    return band(fx, left, right) * band(fy, top, bottom);
  };
  const Real frame = box(0.22f, 0.78f, 0.16f, 0.80f);
  // Two panes, divided by a bar.
  const Real glass = box(0.26f, 0.485f, 0.20f, 0.76f) + box(0.515f, 0.74f, 0.20f, 0.76f);
  const Real sill = box(0.18f, 0.82f, 0.80f, 0.85f);
  const Real fine = tiled_cloud(p.u, p.v, 48, 48, 3, p.texels, 1501), stains = tiled_cloud(p.u, p.v, 6, 3, 5, p.texels, 1511);
  TexelMaterial m;
  m.color = tint(kPlaster) * (Real(1.0f) + Real(0.05f) * fine + Real(0.10f) * stains);
  m.color = m.color * (Real(1.0f) - Real(0.35f) * box(0.0f, 1.0f, 0.96f, 1.0f));  // joint between two stories
  m.color = blend(m.color, kFrame, max(frame, sill));
  const Real reflection = step(0.2f, 0.8f, fx + Real(0.5f) * fy - Real(0.3f) + Real(0.2f) * chance(column, row, 1521));
  const Vec pane = blend(tint(kGlassDark), kGlassSky, Real(0.6f) * reflection);
  for (int c = 0; c < 3; ++c) m.color[c] = lerp(m.color[c], pane[c], glass);
  m.specular = Real(0.04f) + Real(0.12f) * frame + Real(0.80f) * glass;
  // A third of the windows are lit with varying brightness, brighter towards the top.
  const Real lamp = step(0.64f, 0.66f, chance(column, row, 1531)) * (Real(0.55f) + Real(0.45f) * chance(column, row, 1541));
  m.emissive = tint(kLamp) * (glass * lamp * (Real(1.0f) - Real(0.35f) * fy));
  m.height = Real(0.5f) + Real(0.2f) * max(frame, sill) - Real(0.4f) * glass;
  return m;
}

TexelMaterial checkerboard(int x, int y, int width) {
  // The square that contains the texel center, in integer arithmetic. SIMD lanes would not pay off here.
  const auto square = [&](int i) { return (2 * i + 1) * 8 / (2 * width); };
  TexelMaterial m;
  m.color = tint(glm::vec3((square(x) + square(y)) % 2 == 0 ? 255.0f : 0.0f));
  return m;
}

// ---- maps ------------------------------------------------------------------------------------------------------

TexelMaterial material_at(Pattern pattern, const Place& p) {
  switch (pattern) {
    case Pattern::grass: return grass(p);
    case Pattern::bark: return bark(p);
    case Pattern::bricks: return bricks(p);
    case Pattern::facade: return facade(p);
    case Pattern::rock: return rock(p);
    default: return hills(p);
  }
}

glm::u8vec4 codes(const Vec& c, int lane_index) {
  glm::u8vec4 t(255);
  for (int k = 0; k < 3; ++k) t[k] = static_cast<uint8_t>(lane(round_to_int(clamp(c[k], Real(0.0f), Real(255.0f))), lane_index));
  return t;
}

void store_material(PatternMaps& maps, int x, int y, const TexelMaterial& m, int count) {
  const Int height = round_to_int(clamp(m.height, Real(0.0f), Real(1.0f)) * Real(65535.0f));
  for (int i = 0; i < count; ++i) {
    maps.color.at(x + i, y) = codes(m.color, i);
    maps.specular.at(x + i, y) = codes(Vec(Real(255.0f) * m.specular), i);
    maps.emissive.at(x + i, y) = codes(m.emissive, i);
    maps.height.at(x + i, y) = static_cast<uint16_t>(lane(height, i));
  }
}

void fill_row(PatternMaps& maps, Pattern pattern, int y) {
  const int width = maps.color.width();
  if (pattern == Pattern::checkerboard) {
    for (int x = 0; x < width; ++x) store_material(maps, x, y, checkerboard(x, y, width), 1);
    return;
  }
  const float per_texel = 1.0f / static_cast<float>(width);
  const Real v((static_cast<float>(y) + 0.5f) * per_texel);
  for (int x = 0; x < width; x += kLanes) {
    const Real u = (to_real<Real>(iota<Int>() + Int(x)) + Real(0.5f)) * Real(per_texel);
    store_material(maps, x, y, material_at(pattern, {u, v, width}), std::min(kLanes, width - x));
  }
}

}  // namespace

PatternMaps procedural_pattern(Pattern pattern, int width, const Workers& workers) {
  const FloatMode float_mode;
  HS_CHECK_OP(width, >=, 1, "procedural_pattern: the width is not positive; expected at least 1");
  PatternMaps maps{Image<glm::u8vec4>(width, width), Image<glm::u8vec4>(width, width), Image<glm::u8vec4>(width, width),
                   Image<uint16_t>(width, width)};
  workers.for_each(width, [&](int y) { fill_row(maps, pattern, y); });
  return maps;
}

}  // namespace halfspace::HS_LANES
