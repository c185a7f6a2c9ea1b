// SPDX-License-Identifier: Apache-2.0
//
// Tests ray-sphere intersection in float. Visibility, depth and normal are compared with the textbook quadratic in long double, which is
// independent of the algorithm under test. Screen-space bounds must contain every pixel of the sphere.
#include "halfspace/shading/sphere/sphere_intersection.h"

#include <gtest/gtest.h>

#include <cmath>

namespace halfspace {

namespace {

using Wide = long double;

constexpr int kWidth = 640, kHeight = 360;
constexpr double kNear = 0.1, kFar = 200.0;
const glm::dvec2 kHalf(1.1, 1.1 * kHeight / kWidth);

SphereIntersection lens_for(bool perspective) { return {perspective, perspective ? kHalf : kHalf * 10.0, kNear, kFar, {kWidth, kHeight}}; }

// Random numbers that are identical on every machine.
class Numbers {
 public:
  explicit Numbers(uint64_t seed) : state_(seed) {}
  double next(double low, double high) {
    state_ = state_ * 6364136223846793005u + 1442695040888963407u;
    return low + (high - low) * static_cast<double>(state_ >> 11) * 0x1p-53;
  }

 private:
  uint64_t state_;
};

struct Truth {
  Wide root;  ///< squared half chord divided by the squared radius; negative if the ray misses
  Wide t, depth, n_v;
  Wide n[3];
};

Truth truth_of(const glm::vec3& c, float r, double x, double y, bool perspective) {
  const glm::dvec2 half = perspective ? kHalf : kHalf * 10.0;
  const Wide at[2] = {(2 * Wide(x) / kWidth - 1) * half.x, (2 * Wide(y) / kHeight - 1) * half.y};
  const Wide d[3] = {perspective ? at[0] : 0, perspective ? at[1] : 0, 1};
  const Wide o[3] = {perspective ? 0 : at[0], perspective ? 0 : at[1], 0};
  Wide a = 0, b = 0, cc = 0;
  for (int k = 0; k < 3; ++k) {
    const Wide oc = o[k] - Wide(c[k]);
    a += d[k] * d[k];
    b += oc * d[k];
    cc += oc * oc;
  }
  const Wide rr = Wide(r) * Wide(r), disc = b * b - a * (cc - rr);
  Truth out{disc / (a * rr), 0, 0, 0, {}};
  if (disc < 0) return out;
  out.t = (-b - std::sqrt(disc)) / a;
  out.depth = perspective ? Wide(kNear) * (Wide(kFar) - out.t) / (out.t * Wide(kFar - kNear)) : (Wide(kFar) - out.t) / Wide(kFar - kNear);
  for (int k = 0; k < 3; ++k) {
    out.n[k] = (o[k] + out.t * d[k] - Wide(c[k])) / Wide(r);
    out.n_v -= out.n[k] * d[k] / std::sqrt(a);
  }
  return out;
}

struct Worst {
  double depth = 0.0, normal = 0.0;          ///< for n·v ≥ 0.1: error in float ulps, and absolute error
  double rim_depth = 0.0, rim_normal = 0.0;  ///< elsewhere: error in units of the depth change over 2^-12 px, and error times n·v
  int wrong_inside = 0, seen = 0, missed = 0, rim = 0;
};

// Returns the largest depth change over 2^-12 px in any direction; infinite if the shifted ray misses.
double change_of_depth(const glm::vec3& c, float r, double x, double y, bool perspective) {
  const Truth here = truth_of(c, r, x, y, perspective);
  Wide max_error = 0;
  for (const glm::dvec2& step : {glm::dvec2(1, 0), glm::dvec2(-1, 0), glm::dvec2(0, 1), glm::dvec2(0, -1)}) {
    const Truth there = truth_of(c, r, x + step.x * 0x1p-12, y + step.y * 0x1p-12, perspective);
    if (there.root < 0) return HUGE_VAL;
    max_error = std::max(max_error, std::fabs(there.depth - here.depth));
  }
  return static_cast<double>(max_error);
}

void compare_rim(const SphereIntersection& lens, const SphereHit<float>& h, const Truth& t, double change, Worst& worst) {
  ++worst.rim;
  const double depth = static_cast<double>(std::fabs(Wide(lens.window_depth(h.t, h.t_low)) - t.depth));
  // The depth itself is a float, so the tolerance of the other pixels is added.
  worst.rim_depth = std::max(worst.rim_depth, std::max(depth - 4 * 0x1p-24 * static_cast<double>(t.depth), 0.0) / change);
  for (int k = 0; k < 3; ++k)
    worst.rim_normal = std::max(worst.rim_normal, static_cast<double>(std::fabs(Wide(h.n_cs[k]) - t.n[k]) * t.n_v));
}

// Compares random pixels in and near the bounds of a sphere.
void compare(const SphereIntersection& lens, const glm::vec3& c, float r, Numbers& random, Worst& worst) {
  const SphereSpan<float> sx = lens.span(vec3<float>(c), r, 0), sy = lens.span(vec3<float>(c), r, 1);
  const auto pixel = [&](float low, float high, int size) {
    const double at = std::clamp(random.next(static_cast<double>(low), static_cast<double>(high)), -1.0, 1.0);
    return std::floor((at + 1.0) * 0.5 * size) + 0.5;
  };
  for (int i = 0; i < 40; ++i) {
    const double x = pixel(sx.low, sx.high, kWidth), y = pixel(sy.low, sy.high, kHeight);
    const SphereHit<float> h = lens.hit(vec3<float>(c), r, static_cast<float>(x), static_cast<float>(y));
    const Truth t = truth_of(c, r, x, y, lens.perspective);
    const bool seen = t.root > 0 && t.t >= Wide(lens.near) && t.t <= Wide(lens.far);
    const bool at_the_plane = std::fabs(t.t - Wide(lens.near)) < 0x1p-22L * Wide(lens.near);
    if (!at_the_plane && seen != h.seen) ++worst.wrong_inside;
    ++(seen ? worst.seen : worst.missed);
    if (!seen || !h.seen) continue;
    if (t.n_v < 0.1L) {
      compare_rim(lens, h, t, change_of_depth(c, r, x, y, lens.perspective), worst);
      continue;
    }
    const Wide ulp = std::ldexp(1.0L, std::ilogb(t.depth) - 23);
    worst.depth = std::max(worst.depth, static_cast<double>(std::fabs(Wide(lens.window_depth(h.t, h.t_low)) - t.depth) / ulp));
    for (int k = 0; k < 3; ++k) worst.normal = std::max(worst.normal, static_cast<double>(std::fabs(Wide(h.n_cs[k]) - t.n[k])));
  }
}

// Tests spheres whose radius is at most a fifth of their distance, up to 60 degrees off-axis, with sizes from 1/2 px to half of the
// picture.
Worst of_distant_spheres(bool perspective) {
  const SphereIntersection lens = lens_for(perspective);
  Numbers random(1);
  Worst worst;
  for (int i = 0; i < 20000; ++i) {
    const double z = std::exp2(random.next(-1.0, 6.5));
    const double reach = perspective ? z : 10.0;
    const glm::vec3 c(random.next(-1.2, 1.2) * reach, random.next(-0.7, 0.7) * reach, z);
    const auto r = static_cast<float>(0.2 * z * std::exp2(random.next(-6.0, 0.0)));
    compare(lens, c, r, random, worst);
  }
  return worst;
}

// Requirements for exact spheres: where n·v ≥ 0.1, depth within 4 float ulps and normal within 1e-6. Elsewhere, normal within 1e-6/(n·v)
// and depth within its change over 2^-12 px.
void expect_exact(const Worst& w) {
  EXPECT_EQ(w.wrong_inside, 0);
  EXPECT_LE(w.depth, 4.0);
  EXPECT_LE(w.normal, 1e-6);
  EXPECT_LE(w.rim_depth, 1.0);
  EXPECT_LE(w.rim_normal, 1e-6);
}

TEST(SphereIntersection, DistantSpheresMatchLongDouble) {
  for (const bool perspective : {true, false}) {
    const Worst w = of_distant_spheres(perspective);
    EXPECT_GT(w.seen, 100000);
    EXPECT_GT(w.missed, 50000);
    EXPECT_GT(w.rim, 500);
    expect_exact(w);
    const std::string suffix = perspective ? "_perspective" : "_orthographic";
    RecordProperty("worst_depth_ulp" + suffix, std::to_string(w.depth));
    RecordProperty("worst_normal_1e-6" + suffix, std::to_string(w.normal * 1e6));
  }
}

// Tests spheres that the near plane cuts, some with their center behind the eye, and spheres that contain the eye.
TEST(SphereIntersection, SpheresCutByTheNearPlaneMatchLongDouble) {
  const SphereIntersection lens = lens_for(true);
  Numbers random(2);
  Worst worst;
  for (int i = 0; i < 20000; ++i) {
    const float r = static_cast<float>(std::exp2(random.next(-3.0, 2.0)));
    const auto rd = static_cast<double>(r);
    const glm::vec3 c(random.next(-1.5, 1.5) * rd, random.next(-1.5, 1.5) * rd, kNear + random.next(-1.0, 1.5) * rd);
    if (lens.in_depth(vec3<float>(c), r)) compare(lens, c, r, random, worst);
  }
  EXPECT_GT(worst.seen, 5000);
  EXPECT_GT(worst.rim, 100);
  expect_exact(worst);
  RecordProperty("worst_depth_ulp", std::to_string(worst.depth));
  RecordProperty("worst_normal_1e-6", std::to_string(worst.normal * 1e6));
}

// Constructs spheres that the ray grazes. Ten million rays pass just inside or just outside the silhouette, at distances from 2^-8 of the
// radius down to less than one ulp of the radius.
TEST(SphereIntersection, VisibilityAtTheRimMatchesLongDouble) {
  const SphereIntersection lens = lens_for(true);
  Numbers random(5);
  int wrong = 0, in = 0, close = 0;
  constexpr int kRays = 10000000;
  for (int i = 0; i < kRays; ++i) {
    const double x = std::floor(random.next(0, kWidth)) + 0.5, y = std::floor(random.next(0, kHeight)) + 0.5;
    const double z = std::exp2(random.next(0.0, 6.0)), share = std::exp2(random.next(-7.0, -0.5));
    const glm::dvec2 d = (glm::dvec2(2 * x / kWidth, 2 * y / kHeight) - 1.0) * kHalf;
    const glm::vec3 c(glm::dvec3(d * z + glm::dvec2(random.next(-1, 1), random.next(-1, 1)) * (share * z), z));
    const glm::dvec3 to(c), way = glm::normalize(glm::dvec3(d, 1.0));
    const double distance = glm::length(to - way * glm::dot(to, way));
    const auto r = static_cast<float>(distance * (1.0 + std::exp2(random.next(-30.0, -8.0)) * (i % 2 == 0 ? 1.0 : -1.0)));
    if (!(r > 0.0f) || c.z - r < lens.near) continue;
    const Truth t = truth_of(c, r, x, y, true);
    const bool seen = lens.hit(vec3<float>(c), r, static_cast<float>(x), static_cast<float>(y)).seen;
    wrong += seen != (t.root > 0);
    in += seen;
    close += std::fabs(t.root) < 0x1p-22L;
  }
  EXPECT_EQ(wrong, 0);
  EXPECT_GT(in, kRays / 3);
  EXPECT_GT(close, kRays / 4);  // float arithmetic alone cannot decide these
}

// Every pixel that shows the sphere must be inside the bounds, and the bounds must extend at most 1.5 px beyond these pixels.
TEST(SphereIntersection, BoundsAreConservativeAndTight) {
  const SphereIntersection lens = lens_for(true);
  Numbers random(3);
  int cut = 0, whole = 0;
  for (int i = 0; i < 300; ++i) {
    const float r = static_cast<float>(std::exp2(random.next(-2.0, 1.0)));
    const bool near_one = i % 2 == 0;
    const auto rd = static_cast<double>(r);
    const double z = near_one ? kNear + random.next(-0.9, 1.2) * rd : random.next(3.0, 20.0) * rd + 1.0;
    const glm::vec3 c(random.next(-0.9, 0.9) * std::max(z, rd), random.next(-0.5, 0.5) * std::max(z, rd), z);
    if (!lens.in_depth(vec3<float>(c), r)) continue;
    int x0 = kWidth, x1 = -1, y0 = kHeight, y1 = -1;
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) {
        if (!lens.hit(vec3<float>(c), r, static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f).seen) continue;
        x0 = std::min(x0, x);
        x1 = std::max(x1, x);
        y0 = std::min(y0, y);
        y1 = std::max(y1, y);
      }
    }
    if (x1 < 0) continue;
    const SphereSpan<float> sx = lens.span(vec3<float>(c), r, 0), sy = lens.span(vec3<float>(c), r, 1);
    const auto window = [](float ndc, int size) { return (static_cast<double>(ndc) + 1.0) * 0.5 * size; };
    const double low[2] = {window(sx.low, kWidth), window(sy.low, kHeight)}, high[2] = {window(sx.high, kWidth), window(sy.high, kHeight)};
    ASSERT_LE(low[0], x0 + 0.5) << i;
    ASSERT_GE(high[0], x1 + 0.5) << i;
    ASSERT_LE(low[1], y0 + 0.5) << i;
    ASSERT_GE(high[1], y1 + 0.5) << i;
    const bool inside = x0 > 0 && y0 > 0 && x1 < kWidth - 1 && y1 < kHeight - 1;
    // The bounds of a sphere that the near plane cuts include the far side of the cut, which is not visible.
    if (!inside || c.z - r < lens.near) {
      ++cut;
      continue;
    }
    ++whole;
    // Near the end of an ellipse axis of length a (in px), there is a pixel center within 1/2 px along the axis and 1/(8a) across it. 1.5
    // px is therefore sufficient for the smallest sphere here (10 px).
    EXPECT_GT(low[0], x0 + 0.5 - 1.5) << i;
    EXPECT_LT(high[0], x1 + 0.5 + 1.5) << i;
    EXPECT_GT(low[1], y0 + 0.5 - 1.5) << i;
    EXPECT_LT(high[1], y1 + 0.5 + 1.5) << i;
  }
  EXPECT_GT(cut, 30);
  EXPECT_GT(whole, 30);
}

// For spheres that the near plane cuts, computes the range of x/z of the part beyond the plane by sampling the circle.
TEST(SphereIntersection, BoundsOfCutSpheresExcludeThePartBeforeTheNearPlane) {
  const SphereIntersection lens = lens_for(true);
  Numbers random(4);
  int at_the_plane = 0;
  for (int i = 0; i < 500; ++i) {
    const float r = static_cast<float>(std::exp2(random.next(-2.0, 1.0)));
    const auto rd = static_cast<double>(r);
    const glm::vec3 c(random.next(-1.2, 1.2) * rd, 0.0, kNear + random.next(-0.9, 0.99) * rd);
    const double cx = static_cast<double>(c.x), down = kNear - static_cast<double>(c.z), chord = std::sqrt(rd * rd - down * down);
    const double plane_low = (cx - chord) / kNear, plane_high = (cx + chord) / kNear;
    double low = plane_low, high = plane_high;
    for (int k = 0; k < 40000; ++k) {
      const double angle = 2.0 * std::acos(-1.0) * k / 40000.0, z = static_cast<double>(c.z) + rd * std::cos(angle);
      if (z < kNear) continue;
      low = std::min(low, (cx + rd * std::sin(angle)) / z);
      high = std::max(high, (cx + rd * std::sin(angle)) / z);
    }
    at_the_plane += (low == plane_low ? 1 : 0) + (high == plane_high ? 1 : 0);
    const SphereSpan<float> s = lens.span(vec3<float>(c), r, 0);
    // The bounds must be conservative and tight to an eighth of a pixel. If the eye is almost on the surface, the uncertainty of the
    // tangent length is added.
    const double eye = std::fabs(static_cast<double>(glm::dot(c, c)) / (rd * rd) - 1.0);
    const auto tolerance = [&](double end) { return 0.26 / kWidth + std::fabs(end) * (1e-4 + 1e-6 / eye); };
    EXPECT_LE(static_cast<double>(s.low), low / kHalf.x) << i;
    EXPECT_GE(static_cast<double>(s.high), high / kHalf.x) << i;
    EXPECT_LE(low / kHalf.x - static_cast<double>(s.low), tolerance(low / kHalf.x)) << i << ": " << eye;
    EXPECT_LE(static_cast<double>(s.high) - high / kHalf.x, tolerance(high / kHalf.x)) << i << ": " << eye;
  }
  EXPECT_GT(at_the_plane, 100);
  EXPECT_LT(at_the_plane, 900);
}

TEST(SphereIntersection, SpheresOutsideOfTheDepthRangeAreRejected) {
  const SphereIntersection lens = lens_for(true);
  EXPECT_TRUE(lens.in_depth(vec3<float>(0, 0, 5), 1.0f));
  EXPECT_TRUE(lens.in_depth(vec3<float>(0, 0, -0.5f), 0.75f));
  EXPECT_FALSE(lens.in_depth(vec3<float>(0, 0, -5), 1.0f));
  EXPECT_FALSE(lens.in_depth(vec3<float>(0, 0, 250), 1.0f));
  EXPECT_FALSE(lens.in_depth(vec3<float>(0, 0, 5), 0.0f));
  EXPECT_FALSE(lens.in_depth(vec3<float>(0, 0, 5), std::nanf("")));
}

}  // namespace

}  // namespace halfspace
