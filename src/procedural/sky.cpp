// SPDX-License-Identifier: Apache-2.0
//
// Procedural skies: vertical gradients, lobes around the sun, and noise (procedural/noise.h). SIMD lanes run along a row. Only
// correctly rounded operations are used, so the faces are bit-identical for every SIMD width.
#include "halfspace/procedural/sky.h"

#include "halfspace/core/check.h"
#include "halfspace/core/cube_map.h"
#include "halfspace/core/float_mode.h"
#include "halfspace/core/lane_math.h"
#include "halfspace/procedural/noise.h"
#include "halfspace/procedural/palette.h"

namespace halfspace::HS_LANES {

namespace {

using namespace procedural;

// Returns x^(2^n) for x in [0, 1].
HS_INLINE Real squared(Real x, int n) {
  for (int i = 0; i < n; ++i) x = x * x;
  return x;
}

// Rises from 0 at and below the horizon to about 1 at the zenith, steeply near the horizon.
HS_INLINE Real height_of(const Vec& d) { return Real(1.0f) - exp(max(d.y, Real(0.0f)) * Real(-4.0f)); }
// 0 above the horizon, 1 below the haze.
HS_INLINE Real ground_of(const Vec& d) { return step(0.0f, 0.06f, -d.y); }

// ---- day ---------------------------------------------------------------------------------------------------------------

constexpr glm::vec3 kZenith(0.09f, 0.22f, 0.56f), kHorizon(0.52f, 0.68f, 0.88f), kDusk(0.95f, 0.42f, 0.14f);
constexpr glm::vec3 kCloud(0.92f, 0.94f, 0.98f), kDuskCloud(0.95f, 0.55f, 0.38f), kGround(0.11f, 0.105f, 0.09f);

// Effects of the sun's elevation, constant over the sky.
struct Daylight {
  Real low;     // 1 if the sun is near or below the horizon, 0 if it is high in the sky
  Real bright;  // factor of all light
  Real disc;    // factor of the sun's disk
};

Daylight daylight_of(float sun_y) {
  const Real y(sun_y);
  const Real low = Real(1.0f) - step(0.02f, 0.4f, y);
  return {low, Real(0.04f) + Real(0.96f) * step(-0.25f, 0.35f, y), step(-0.05f, 0.02f, y)};
}

Vec clear_sky(const Vec& d, Real toward_sun, const Daylight& day) {
  // Dusk reddens the side towards the sun and the lower sky most.
  const Real side = (Real(0.5f) + Real(0.5f) * toward_sun) * (Real(0.5f) + Real(0.5f) * toward_sun);
  const Vec horizon = blend(tint(kHorizon), tint(kDusk), day.low * (Real(0.15f) + Real(0.85f) * side));
  return blend(horizon, tint(kZenith), height_of(d));
}

// Lobes around the sun: haze, aureole and disk. Half of the disk's light comes from within one degree of the center.
Vec sun_light(Real toward_sun, const Daylight& day) {
  const Real s = max(toward_sun, Real(0.0f));
  const Vec color = blend(Vec(Real(1.0f), Real(0.96f), Real(0.88f)), Vec(Real(1.0f), Real(0.55f), Real(0.22f)), day.low);
  return color * (Real(0.25f) * squared(s, 3) + Real(0.8f) * squared(s, 7) + Real(25.0f) * squared(s, 12) * day.disc);
}

// A cloud layer at constant height, seen from below. The noise is evaluated where the view ray meets the layer.
Vec with_clouds(const Vec& sky, const Vec& d, Real toward_sun, const Daylight& day, float cover) {
  const Real above = step(0.01f, 0.16f, d.y);
  if (cover <= 0.0f || none(above > Real(0.0f))) return sky;
  const Real reach = Real(1.6f) / (max(d.y, Real(0.0f)) + Real(0.14f));
  const Vec p(fma(d.x, reach, Real(3.7f)), Real(5.3f), fma(d.z, reach, Real(8.1f)));
  const Real shape = cloud(p, 6, 501);
  const float edge = 0.55f - 1.1f * cover;
  const Real mass = step(edge, edge + 0.45f, shape) * above;
  const Real lit =
      Real(1.0f) - Real(0.45f) * step(edge + 0.2f, edge + 0.9f, shape + Real(0.25f) * cloud(scaled(p, 2.7f, 1.2f, 4.5f, 6.6f), 3, 541));
  const Real through = Real(0.7f) * squared(max(toward_sun, Real(0.0f)), 4);
  const Vec color = blend(tint(kCloud), tint(kDuskCloud), day.low) * (lit + through);
  return blend(sky, color, mass);
}

Vec day_light(const Vec& d, const DaySky& sky, const Daylight& day) {
  const Real toward_sun = clamp(dot(d, sky.sun_ms), Real(-1.0f), Real(1.0f));
  const Vec air = clear_sky(d, toward_sun, day) + sun_light(toward_sun, day);
  const Vec above = with_clouds(air, d, toward_sun, day, sky.clouds);
  return blend(above, tint(kGround), ground_of(d)) * day.bright;
}

// ---- night -------------------------------------------------------------------------------------------------------------

constexpr glm::vec3 kNightZenith(0.0008f, 0.0011f, 0.0024f), kNightHorizon(0.0020f, 0.0026f, 0.0038f), kNightGround(0.0005f);
constexpr glm::vec3 kGalacticPole(0.62f, 0.35f, -0.7022f);  // unit vector
constexpr glm::vec3 kGalacticCenter(0.5418f, 0.4564f, 0.7058f);

// A band of unresolved stars, brighter towards the galactic center, behind dust clouds.
Vec milky_way(const Vec& d) {
  const Real across = dot(d, kGalacticPole) + Real(0.05f) * cloud(scaled(d, 3.0f, 1.1f, 2.2f, 3.3f), 3, 601);
  const Real band = max(exp(across * across * Real(-22.0f)) - Real(1e-3f), Real(0.0f));
  if (none(band > Real(0.0f))) return Vec(Real(0.0f));
  const Real center = Real(0.55f) + Real(0.45f) * dot(d, kGalacticCenter);
  const Real grain = max(Real(0.75f) + Real(0.5f) * cloud(scaled(d, 6.0f, 7.4f, 0.3f, 5.2f), 6, 621), Real(0.0f));
  const Real dust = step(0.05f, 0.55f, cloud(scaled(d, 5.0f, 2.6f, 9.1f, 4.4f), 5, 641)) * exp(across * across * Real(-120.0f));
  return Vec(Real(0.0046f), Real(0.0047f), Real(0.0054f)) * (band * center * grain * (Real(1.0f) - Real(0.85f) * dust));
}

Vec night_light(const Vec& d, const NightSky& sky) {
  const Vec air = blend(tint(kNightHorizon), tint(kNightZenith), height_of(d));
  return blend(air + milky_way(d) * Real(sky.milky_way), tint(kNightGround), ground_of(d));
}

// ---- studio ------------------------------------------------------------------------------------------------------------

// A soft light around the unit vector `center`: 1 within the cosine `inner`, 0 beyond `outer`.
HS_INLINE Real lamp(const Vec& d, const glm::vec3& center, float outer, float inner) { return step(outer, inner, dot(d, center)); }

Vec studio_light(const Vec& d) {
  const Real up = Real(0.5f) + Real(0.5f) * d.y;
  const Real wall = Real(0.22f) + Real(0.55f) * up * up;
  const Real key = lamp(d, glm::vec3(-0.5f, 0.7071068f, -0.5f), 0.80f, 0.90f) * Real(5.0f);
  const Real fill = lamp(d, glm::vec3(0.8944272f, 0.4472136f, 0.0f), 0.86f, 0.94f) * Real(2.0f);
  const Real rim = lamp(d, glm::vec3(0.0f, 0.6f, 0.8f), 0.88f, 0.95f) * Real(2.0f);
  const Real floor = step(0.0f, 0.3f, -d.y);
  return Vec(wall * (Real(1.0f) - Real(0.55f) * floor) + key + fill + rim);
}

// ---- faces -------------------------------------------------------------------------------------------------------------

// Evaluates light(d) for the direction d of every texel.
template <class Light>
SkyFaces fill_faces(int size, const Light& light, const Workers& workers) {
  HS_CHECK_OP(size, >=, 1, "sky: the size of the faces is not positive; expected at least 1");
  SkyFaces faces;
  for (Image<glm::vec4>& face : faces) face = Image<glm::vec4>(size, size);
  workers.for_each(6 * size, [&](int i) {
    const int face = i / size, row = i % size;
    const double t = (2 * row + 1.0) / size - 1.0;
    const glm::vec3 start(cube_direction(face, 0, t)), along(cube_direction(face, 1, t) - cube_direction(face, 0, t));
    glm::vec4* out = faces[static_cast<std::size_t>(face)].row(row).data();
    for (int x = 0; x < size; x += kLanes) {
      const Real s =
          fma(to_real<Real>(iota<Int>() + Int(x)), Real(2.0f / static_cast<float>(size)), Real(1.0f / static_cast<float>(size) - 1.0f));
      const Vec d = tint(start) + tint(along) * s;
      const Vec color = light(d * (Real(1.0f) / sqrt(dot(d, d))));
      for (int k = 0; k < kLanes && x + k < size; ++k) out[x + k] = {lane(color.x, k), lane(color.y, k), lane(color.z, k), 1.0f};
    }
  });
  return faces;
}

}  // namespace

SkyFaces procedural_day_sky(int size, const DaySky& sky, const Workers& workers) {
  const FloatMode float_mode;
  const Daylight day = daylight_of(sky.sun_ms.y);
  return fill_faces(
      size, [&](const Vec& d) { return day_light(d, sky, day); }, workers);
}

SkyFaces procedural_studio(int size, const Workers& workers) { return fill_faces(size, studio_light, workers); }

SkyFaces procedural_night_sky(int size, const NightSky& sky, const Workers& workers) {
  const FloatMode float_mode;
  return fill_faces(
      size, [&](const Vec& d) { return night_light(d, sky); }, workers);
}

}  // namespace halfspace::HS_LANES
