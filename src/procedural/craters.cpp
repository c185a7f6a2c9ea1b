// SPDX-License-Identifier: Apache-2.0
#include "halfspace/procedural/craters.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "halfspace/core/cache_line_allocator.h"
#include "halfspace/core/lane_math.h"
#include "halfspace/core/random.h"
#include "halfspace/core/trig_double.h"
#include "halfspace/core/units.h"
#include "halfspace/geometry/shapes.h"
#include "halfspace/procedural/noise.h"

namespace halfspace::HS_LANES::procedural {

namespace {

constexpr float kMoonRadius = 1737.4f;  // km
constexpr float kLargest = 0.085f;      // radius of the largest crater that is not a basin; 148 km
constexpr float kYoung = 0.93f;         // craters of this age or above are younger than the maria

// ---- the population --------------------------------------------------------------------------------------------

// Sets depth and rim from the diameter in km, after Pike, "Size-dependence in the shape of fresh impact craters on the Moon"
// (1977). Craters below about 15 km are simple bowls; larger ones have wide floors and slumped walls. `age` goes from 0 (old) to 1
// (young); older craters are flatter.
void set_shape(Crater& c, float age) {
  const float diameter = 2.0f * kMoonRadius * c.radius;
  const bool simple = diameter < 15.0f;
  const float rim = simple ? 0.036f * pow(diameter, 1.014f) : 0.236f * pow(diameter, 0.399f);
  const float rim_to_floor = simple ? 0.196f * pow(diameter, 1.01f) : 1.044f * pow(diameter, 0.301f);
  const float left = 0.15f + 0.85f * age * age;  // fraction of a fresh crater's height that is left
  c.rim = rim * left;
  c.depth = (rim_to_floor - rim) * (0.45f + 0.55f * left);
  const float size = clamp((diameter - 15.0f) / 120.0f, 0.0f, 1.0f);
  c.floor = simple ? 0.0f : 0.35f + 0.35f * size;
  c.peak = diameter > 35.0f && diameter < 220.0f && age > 0.35f ? 0.35f * c.depth * age : 0.0f;
  c.erasing = 0.75f + 0.2f * age;
  const float recent = clamp((age - 0.94f) / 0.06f, 0.0f, 1.0f);
  c.freshness = 0.06f * age + 0.5f * recent * recent * recent;
}

void set_place(Crater& c, double turns_east, double y) {
  // sphere_frame needs only the sine and cosine of the colatitude, not the angle.
  const SphereFrame frame = sphere_frame(sincos_turns(turns_east), {std::sqrt(1.0 - y * y), y});
  c.center = glm::vec3(frame.normal);
  c.east = glm::vec3(frame.east);
  c.north = glm::vec3(frame.north);
}

void set_outline(Crater& c, SplitMix64& random) {
  const float strength[] = {0.045f, 0.045f, 0.035f, 0.035f, 0.018f, 0.018f};
  for (int i = 0; i < 6; ++i) c.wobble[i] = strength[i] * random.real(-1.0f, 1.0f);
  c.seed = static_cast<int32_t>(random.real(0.0f, 1.0f) * 1e6f);
}

struct Aged {
  Crater crater;
  float age;
};
using AgedCraters = std::vector<Aged, CacheLineAllocator<Aged>>;

// Adds craters with radii from lo to hi = 2·lo. The number of craters larger than r is proportional to r^-2, so every size class
// covers the same area.
void add_class(AgedCraters& out, float lo, float hi, SplitMix64 random) {
  const float covered = 0.24f;  // fraction of the sphere covered by this class, counting overlaps twice
  // A crater covers r²/4 of the sphere. The mean of r² over the class is lo² · 2 ln(hi/lo) / (1 − (lo/hi)²).
  const int count = static_cast<int>(covered * 4.0f / (lo * lo * 1.848f));
  const float cut = 1.0f - (lo / hi) * (lo / hi);
  out.reserve(out.size() + static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) {
    Aged a{};
    a.crater.radius = lo / sqrt(1.0f - cut * random.real(0.0f, 1.0f));
    // Not in the argument list, where the evaluation order is unspecified.
    const double turns_east = static_cast<double>(random.real(0.0f, 1.0f));
    const double y = static_cast<double>(random.real(-1.0f, 1.0f));
    set_place(a.crater, turns_east, y);
    a.age = random.real(0.0f, 1.0f);
    if (a.crater.radius > 0.02f) a.age *= 0.95f;  // most large craters are older than the maria; those with rays are added below
    set_shape(a.crater, a.age);
    set_outline(a.crater, random);
    out.push_back(a);
  }
}

// Young craters with rays, at the positions of the Moon's most prominent ones: degrees east and north, radius in km, reach of the
// rays in degrees.
struct RayCrater {
  double east, north;
  float radius, rays;
};
constexpr RayCrater kRayCraters[] = {{-11.4, -43.3, 43, 62}, {-20.1, 9.6, 46, 22},   {-38.0, 8.1, 16, 15},   {-47.5, 23.7, 20, 14},
                                     {46.8, 16.1, 14, 13},   {54.0, -32.5, 38, 16},  {-10.1, 73.5, 26, 24},  {102.9, 35.9, 11, 30},
                                     {-163.3, 22.0, 36, 24}, {-63.9, -24.6, 10, 16}, {129.0, -61.0, 30, 20}, {-152.0, -36.0, 22, 18}};

void add_ray_craters(AgedCraters& out, SplitMix64 random) {
  for (const RayCrater& r : kRayCraters) {
    Aged a{};
    a.crater.radius = r.radius / kMoonRadius;
    set_place(a.crater, 0.5 + r.east / 360.0, sincos_turns(r.north / 360.0).sin);
    a.age = 1.0f;
    set_shape(a.crater, a.age);
    a.crater.freshness = 0.8f;
    set_outline(a.crater, random);
    a.crater.rays = r.rays * static_cast<float>(kRadiansPerDegree);
    out.push_back(a);
  }
}

// ---- one row ---------------------------------------------------------------------------------------------------

// The texels of a row within slightly more than `reach` radians of a crater: `count` texels that start at `begin` < width and may
// wrap around.
struct Span {
  int begin, count;
};

Span reached(const CraterRow& row, const Crater& crater, float reach) {
  const glm::vec3& center = crater.center;
  const float cos_reach = cos(min(1.01f * reach, 3.1f));
  const float level = cos_reach - row.y * center.y, across = row.ring * crater.north.y;  // north.y is the sine of its colatitude
  if (level > across) return {0, 0};
  if (level <= -across || across < 1e-6f) return {0, row.width};
  const float texels = static_cast<float>(row.width) * static_cast<float>(0.5 / std::numbers::pi);
  const float half = acos(clamp(level / across, -1.0f, 1.0f)) * texels + 2.0f;
  if (2.0f * half >= static_cast<float>(row.width)) return {0, row.width};
  // The position of a texel is (cos 2πu, −sin 2πu) · ring.
  const float middle = atan2(-center.z, center.x) * texels;
  const int begin = truncate_to_int(middle - half + static_cast<float>(2 * row.width)) % row.width;
  return {begin, truncate_to_int(2.0f * half) + 1};
}

// Calls texels(x, mask) for each packet of a span, which may wrap around the seam.
template <class F>
void for_packets(const CraterRow& row, Span span, const F& texels) {
  const int end = span.begin + span.count;
  const auto part = [&](int begin, int stop) {
    for (int x = begin; x < stop; x += kLanes) texels(static_cast<std::size_t>(x), first_lanes<Mask>(stop - x));
  };
  part(span.begin, std::min(end, row.width));
  part(0, end - row.width);
}

// Position of a packet of texels relative to a crater: the distance (a chord) and the unit direction in the crater's east-north
// frame.
struct Bearing {
  Real distance, east, north;
};

Bearing bearing_of(const Crater& c, const CraterRow& row, std::size_t x) {
  const Real dx = load<Real>(&row.x[x]) - Real(c.center.x), dy = Real(row.y - c.center.y), dz = load<Real>(&row.z[x]) - Real(c.center.z);
  const Real east = fma(dx, Real(c.east.x), fma(dy, Real(c.east.y), dz * Real(c.east.z)));
  const Real north = fma(dx, Real(c.north.x), fma(dy, Real(c.north.y), dz * Real(c.north.z)));
  const Real across = Real(1.0f) / sqrt(max(fma(east, east, north * north), Real(1e-20f)));
  return {sqrt(fma(dx, dx, fma(dy, dy, dz * dz))), east * across, north * across};
}

// Returns 1 + the outline's deviation from a circle. Cosines and sines of 2, 3 and 5 times the azimuth follow from the angle
// addition formulas.
Real outline(const Crater& c, const Bearing& b) {
  const Real c2 = b.east * b.east - b.north * b.north, s2 = Real(2.0f) * b.east * b.north;
  const Real c3 = c2 * b.east - s2 * b.north, s3 = s2 * b.east + c2 * b.north;
  const Real c5 = c3 * c2 - s3 * s2, s5 = s3 * c2 + c3 * s2;
  return Real(1.0f) + c2 * Real(c.wobble[0]) + s2 * Real(c.wobble[1]) + c3 * Real(c.wobble[2]) + s3 * Real(c.wobble[3]) +
         c5 * Real(c.wobble[4]) + s5 * Real(c.wobble[5]);
}

// Falls steeply from 1 at q = 0 to 0 at q = 1, with zero slope at both ends.
HS_INLINE Real blanket(Real q) {
  const Real p = Real(1.0f) - q;
  const Real p3 = p * p * p;
  return p3 * p3 * fma(q, Real(6.0f), Real(1.0f));
}

// Returns the reach of the ejecta blanket in radians, where the outline bulges most.
float blanket_reach(const Crater& c) { return 1.15f * kBlanketEnd * c.radius; }

// Returns the height at x radii from the center, with continuous slope. q goes from 0 at the rim to 1 at the end of the ejecta
// blanket.
Real profile(const Crater& c, Real x, Real q) {
  const Real t = clamp((x - Real(c.floor)) * Real(1.0f / (1.0f - c.floor)), Real(0.0f), Real(1.0f));
  const Real wall = t * t * (Real(3.0f) - Real(2.0f) * t);
  const Real bump = max(Real(1.0f) - x * x * Real(18.0f), Real(0.0f));
  const Real inside = fma(Real(c.depth + c.rim), wall, Real(-c.depth)) + Real(c.peak) * bump * bump;
  return select(x < Real(1.0f), inside, Real(c.rim) * blanket(q));
}

}  // namespace

Craters moon_craters(int width) {
  const float smallest = 1.2f * 2.0f * static_cast<float>(std::numbers::pi) / static_cast<float>(width);
  AgedCraters all;
  uint64_t seed = 1;
  for (float hi = kLargest; hi > smallest; hi *= 0.5f) add_class(all, 0.5f * hi, hi, SplitMix64(1000 * seed++));
  add_ray_craters(all, SplitMix64(77));
  std::vector<std::size_t> order(all.size());  // sorting the craters themselves would move more memory
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return all[a].age < all[b].age; });
  Craters craters{{}, 0};
  craters.all.reserve(all.size());
  for (const std::size_t i : order) {
    craters.all.push_back(all[i].crater);
    craters.first_young += all[i].age < kYoung ? 1 : 0;
  }
  return craters;
}

RowRange rows_reached(const Crater& c, int height) {
  const float rows_a_radian = static_cast<float>(height) * static_cast<float>(1.0 / std::numbers::pi);
  const float middle = atan2(c.north.y, c.center.y) * rows_a_radian;
  const float half = 1.01f * max(blanket_reach(c), c.rays) * rows_a_radian + 2.0f;
  return {std::max(truncate_to_int(middle - half), 0), std::min(truncate_to_int(middle + half) + 1, height)};
}

void stamp(const Crater& c, CraterRow& row) {
  const float reach = blanket_reach(c);
  for_packets(row, reached(row, c, reach), [&](std::size_t i, Mask mask) {
    const Bearing b = bearing_of(c, row, i);
    mask &= b.distance < Real(reach);
    if (none(mask)) return;
    const Real x = b.distance * Real(1.0f / c.radius) * outline(c, b);
    const Real q = clamp((x - Real(1.0f)) * Real(1.0f / (kBlanketEnd - 1.0f)), Real(0.0f), Real(1.0f));
    const Real before = load<Real>(&row.relief[i]), light = load<Real>(&row.light[i]);
    const Real erased = Real(c.erasing) * step(1.35f, 0.85f, x);
    const Real after = fma(-erased, before, before) + profile(c, x, q);
    const Real halo = Real(c.freshness) * blanket(q) * (Real(0.7f) + Real(0.3f) * step(0.2f, 0.95f, x));
    store(&row.relief[i], select(mask, after, before));
    store(&row.light[i], select(mask, max(light, halo), light));
  });
}

void add_rays(const Crater& c, CraterRow& row) {
  if (c.rays == 0.0f) return;
  for_packets(row, reached(row, c, c.rays), [&](std::size_t i, Mask mask) {
    const Bearing b = bearing_of(c, row, i);
    mask &= b.distance < Real(c.rays) && b.distance > Real(c.radius);
    if (none(mask)) return;
    // Rays are the zero crossings of a noise over the azimuth. Their angular width decreases with the distance. A second noise over the
    // azimuth varies their reach, and a third noise over the position breaks them up.
    const Vec azimuth(b.east, b.north, Real(0.37f));
    const Real crossing = abs(noise(azimuth * Vec(Real(3.3f)), c.seed));
    const Real reach =
        Real(c.rays) * clamp(Real(0.55f) + Real(0.9f) * noise(azimuth * Vec(Real(2.1f)), c.seed + 1), Real(0.2f), Real(1.0f));
    const Real sharpness = Real(4.0f) + Real(0.45f / c.radius) * b.distance;
    const Real crest = max(Real(1.0f) - crossing * min(sharpness, Real(16.0f)), Real(0.0f));
    const Vec p(load<Real>(&row.x[i]), Real(row.y), load<Real>(&row.z[i]));
    const Real patches = clamp(Real(0.62f) + Real(0.9f) * cloud(scaled(p, 23.0f, 1.7f, 4.4f, 2.9f), 3, c.seed + 2), Real(0.0f), Real(1.0f));
    const Real fade = max(Real(1.0f) - b.distance / reach, Real(0.0f));
    const Real near = max(Real(1.0f) - b.distance * Real(0.22f / c.radius), Real(0.0f));
    const Real ray = fade * patches * max(crest * (Real(2.0f) - crest) * Real(0.8f), near * near);
    const Real light = load<Real>(&row.light[i]);
    store(&row.light[i], select(mask, light + ray * (Real(1.0f) - Real(0.5f) * light), light));
  });
}

}  // namespace halfspace::HS_LANES::procedural
