// SPDX-License-Identifier: Apache-2.0
//
// Tests coverage where common rasterizers fail. Positions are given in 1/256 px (tests/raster/raster_test.h), so the reference can be
// computed in integer arithmetic.
#include <cmath>
#include <limits>

#include "raster/raster_test.h"
#include "stability/regime.h"

namespace halfspace::stability {
namespace {

using namespace raster_test;
__extension__ using Wide = __int128;

constexpr int kSize = 64;

// Returns whether a triangle covers the center of a pixel, using edge functions evaluated in type T. With `inclusive`, centers on any edge
// count as covered.
template <class T>
bool covers(const PointTriangle& triangle, int px, int py, bool inclusive = false) {
  PointTriangle t = triangle;
  // Unsigned arithmetic wraps on overflow, like 32-bit edge functions in hardware.
  using U = std::conditional_t<std::is_same_v<T, int32_t>, uint32_t, T>;
  const auto cross = [](const Point& a, const Point& b, int32_t x, int32_t y) {
    return static_cast<T>((U(b.x) - U(a.x)) * (U(y) - U(a.y)) - (U(b.y) - U(a.y)) * (U(x) - U(a.x)));
  };
  const T area = cross(t[0], t[1], t[2].x, t[2].y);
  if (area == 0) return false;
  if (area < 0) std::swap(t[1], t[2]);
  for (std::size_t i = 0; i < 3; ++i) {
    const Point &a = t[i], &b = t[(i + 1) % 3];
    const T e = cross(a, b, px * 256 + 128, py * 256 + 128);
    const bool owned = inclusive || b.y < a.y || (b.y == a.y && b.x > a.x);
    if (e < 0 || (e == 0 && !owned)) return false;
  }
  return true;
}

// The method of a simple rasterizer, in floats: the area is in px², triangles with an area below 1 are dropped, and weights above −1e-4
// count as inside.
bool covers_in_floats(const PointTriangle& t, int px, int py) {
  const auto f = [](int32_t v) { return static_cast<float>(v) / 256.0f; };
  const float ax = f(t[0].x), ay = f(t[0].y), bx = f(t[1].x), by = f(t[1].y), cx = f(t[2].x), cy = f(t[2].y);
  const float area = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax);
  if (std::abs(area) < 1.0f) return false;
  const float x = static_cast<float>(px) + 0.5f, y = static_cast<float>(py) + 0.5f;
  const float v = ((x - ax) * (cy - ay) - (y - ay) * (cx - ax)) / area, w = ((bx - ax) * (y - ay) - (by - ay) * (x - ax)) / area;
  return v > -1e-4f && w > -1e-4f && 1.0f - v - w > -1e-4f;
}

struct Wrong {
  int64_t common = 0, ours = 0;
};

// Counts the pixels in which the common method and a pass differ from 128-bit integer arithmetic.
template <class Common, class Make>
Wrong wrong_pixels(int triangles, const Make& make, const Common& common) {
  Wrong wrong;
  Random random(7);
  for (int i = 0; i < triangles; ++i) {
    const PointTriangle t = make(random, i);
    Image<glm::vec4> drawn(kSize, kSize);
    const glm::vec4 white(1.0f);
    draw_colors(drawn, std::span(&t, 1), std::span(&white, 1), true);
    for (int y = 0; y < kSize; ++y) {
      for (int x = 0; x < kSize; ++x) {
        const bool truth = covers<Wide>(t, x, y);
        wrong.common += common(t, x, y) != truth;
        wrong.ours += (pixel(drawn, x, y).x != 0.0f) != truth;
      }
    }
  }
  return wrong;
}

TEST(Stability, CoverageIsExactForHugeCoordinates) {
  // Sizes from 2^-8 px to the guard band, ±16384 px: every power of two.
  const auto make = [](Random& r, int i) {
    const int size = 1 << (i % 23);  // in 1/256 px
    PointTriangle t;
    for (Point& p : t) p = {kSize * 128 + r.integer(-size, size), kSize * 128 + r.integer(-size, size)};
    return t;
  };
  const Wrong w = wrong_pixels(effort(1150), make, [](const PointTriangle& t, int x, int y) { return covers<int32_t>(t, x, y); });
  // Integer arithmetic is exact, so there is no tolerance.
  record_and_check(
      {6, "huge coordinates and the guard band", "triangles from 2^-8 px to 16384 px; 32-bit edge functions at 1/256 px vs. a pass",
       "pixels that differ from 128-bit arithmetic"},
      static_cast<double>(w.common), 1000, static_cast<double>(w.ours), 0);
}

TEST(Stability, CoverageIsExactForSlivers) {
  // Up to 60 px long and less than a pixel high, including triangles without area.
  const auto make = [](Random& r, int) {
    const Point a{r.integer(0, 1024), r.integer(0, 16383)}, b{a.x + r.integer(8192, 15360), r.integer(0, 16383)};
    const Point c{(a.x + b.x) / 2, (a.y + b.y) / 2 + r.integer(-10, 10)};
    return PointTriangle{a, b, c};
  };
  const Wrong w = wrong_pixels(effort(4000), make, covers_in_floats);
  record_and_check(
      {7, "slivers", "triangles 32 to 60 px long and 0 to 0.04 px high; float barycentrics that drop areas below 1 px² vs. a pass",
       "pixels that differ from 128-bit arithmetic"},
      static_cast<double>(w.common), effort(100), static_cast<double>(w.ours), 0);
}

// Draws a 64 px square as triangles to the left and right of a line. The triangles on the right share a vertex that is on the line, as
// closely as the 1/256 px grid allows. On the left, a conforming mesh also uses that vertex; with t_junction, it does not. Returns the
// number of pixels not drawn exactly once.
int64_t holes(Random& random, bool t_junction) {
  constexpr int kEdge = kSize * 256;
  const Point top{random.integer(6000, 10000), kEdge}, bottom{random.integer(6000, 10000), 0};
  const int y = random.integer(2000, 14000);
  const auto x = static_cast<int32_t>(std::lround(bottom.x + (top.x - bottom.x) * (static_cast<double>(y) / kEdge)));
  const Point m{x, y}, l0{0, 0}, l1{0, kEdge}, r0{kEdge, 0}, r1{kEdge, kEdge};
  // Left of the line: a fan around the lower left corner. It contains m as a vertex only in the conforming mesh.
  std::vector<PointTriangle> mesh{{l0, top, l1}};
  if (t_junction) {
    mesh.push_back({l0, bottom, top});
  } else {
    mesh.insert(mesh.end(), {{l0, bottom, m}, {l0, m, top}});
  }
  mesh.insert(mesh.end(), {{bottom, r0, m}, {m, r0, r1}, {m, r1, top}});
  Image<glm::vec4> count(kSize, kSize);
  draw_colors(count, mesh, std::vector<glm::vec4>(mesh.size(), glm::vec4(1.0f)), true);
  int64_t wrong = 0;
  for (const glm::vec4& c : count.texels()) wrong += c.x != 1.0f;
  return wrong;
}

TEST(Stability, ConformingMeshesHaveNoHoles) {
  int64_t common = 0, ours = 0;
  for (int seed = 0; seed < effort(1500); ++seed) {
    Random a(static_cast<uint64_t>(seed)), b(static_cast<uint64_t>(seed));
    common += holes(a, true);
    ours += holes(b, false);
  }
  // No fill rule can close a mesh with edges that do not match. If the edges match, the fill rule alone closes the mesh.
  record_and_check({8, "T-junctions", "1,500 squares with a vertex on an inner edge; used by the triangles on one side vs. on both sides",
                    "pixels not drawn exactly once"},
                   static_cast<double>(common), effort(20), static_cast<double>(ours), 0);
}

TEST(Stability, SharedEdgesAreDrawnOnce) {
  int64_t common = 0, ours = 0;
  for (int seed = 0; seed < effort(2000); ++seed) {
    Random r(static_cast<uint64_t>(seed) + 1);
    // A fan over the whole target around a vertex at a pixel center. Its inner edges pass through many pixel centers.
    const Point center{r.integer(8, 55) * 256 + 128, r.integer(8, 55) * 256 + 128};
    constexpr int kFar = kSize * 256 + 128;
    std::vector<Point> ring;
    for (int i = 0; i < 4; ++i) {
      const int along = r.integer(1, 62) * 256 + 128;
      const Point corners[4] = {{-128, -128}, {kFar, -128}, {kFar, kFar}, {-128, kFar}};
      const Point sides[4] = {{along, -128}, {kFar, along}, {along, kFar}, {-128, along}};
      ring.insert(ring.end(), {corners[i], sides[i]});
    }
    std::vector<PointTriangle> fan;
    for (std::size_t i = 0; i < ring.size(); ++i) fan.push_back({center, ring[i], ring[(i + 1) % ring.size()]});
    Image<glm::vec4> count(kSize, kSize);
    draw_colors(count, fan, std::vector<glm::vec4>(fan.size(), glm::vec4(1.0f)), true);
    for (int y = 0; y < kSize; ++y) {
      for (int x = 0; x < kSize; ++x) {
        ours += pixel(count, x, y).x != 1.0f;
        if (seed >= 100) continue;
        int times = 0;
        for (const PointTriangle& t : fan) times += covers<int64_t>(t, x, y, true);
        common += times != 1;
      }
    }
  }
  record_and_check(
      {9, "shared edges drawn twice", "fans through pixel centers; inclusive edges (100 fans) vs. the top-left rule (2,000 fans)",
       "pixels not drawn exactly once"},
      static_cast<double>(common), 500, static_cast<double>(ours), 0);
}

// ---- w <= 0 -------------------------------------------------------------------------------------------------------------

using ClipTriangle = std::array<glm::vec4, 3>;

// Evaluates homogeneous edge functions (Olano and Greer 1997) at a window position, in long double. Inside, the result is the distance to
// the nearest edge in px. Outside, it is negative: minus the largest distance to an edge that excludes the point. There is no division by w
// and no clipping.
long double inside_by(const ClipTriangle& t, double x_px, double y_px) {
  using V = glm::vec<3, long double>;
  const V p(2.0L * x_px / kSize - 1, 2.0L * y_px / kSize - 1, 1);
  const auto row = [&](std::size_t i) { return V(t[i].x, t[i].y, t[i].w); };
  const long double volume = glm::dot(row(0), glm::cross(row(1), row(2)));
  if (volume == 0) return -1e30L;
  long double min_distance = 1e30L, sum = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const V edge = glm::cross(row((i + 1) % 3), row((i + 2) % 3)) / volume;
    const long double e = glm::dot(edge, p);
    sum += e;
    min_distance = std::min(min_distance, e / (std::hypot(edge.x, edge.y) * 2 / kSize));
  }
  return sum > 0 ? min_distance : -1e30L;  // 1/w, positive in front of the eye
}

ClipTriangle random_across_the_eye(Random& r) {
  ClipTriangle t;
  for (glm::vec4& p : t) p = {r.real(-3.0f, 3.0f), r.real(-3.0f, 3.0f), 0.0f, r.real(0.2f, 3.0f)};
  t[static_cast<std::size_t>(r.integer(0, 2))].w *= -1.0f;
  return t;
}

TEST(Stability, ClippingHandlesVerticesBehindTheEye) {
  Wrong wrong;
  Random random(3);
  for (int i = 0; i < effort(1500); ++i) {
    const ClipTriangle t = random_across_the_eye(random);
    PointTriangle divided;
    for (std::size_t k = 0; k < 3; ++k)
      divided[k] = {static_cast<int32_t>(std::lround((t[k].x / t[k].w + 1.0f) * 128.0f * kSize)),
                    static_cast<int32_t>(std::lround((t[k].y / t[k].w + 1.0f) * 128.0f * kSize))};
    Image<glm::vec4> count(kSize, kSize);
    DrawState state;
    state.depth = {.test = false, .clip = ClipDepth::zero_to_one, .clamp = true};
    count_coverage(count, std::vector<glm::vec4>(t.begin(), t.end()), {0, 1, 2}, state);
    for (int y = 0; y < kSize; ++y) {
      for (int x = 0; x < kSize; ++x) {
        const long double inside = inside_by(t, x + 0.5, y + 0.5);
        if (std::abs(inside) < 1.0L / 128) continue;  // snapping moves an edge by up to 0.7/256 px
        wrong.common += covers<int64_t>(divided, x, y) != (inside > 0);
        wrong.ours += (pixel(count, x, y).x != 0.0f) != (inside > 0);
      }
    }
  }
  record_and_check(
      {5, "near plane, w <= 0", "1,500 triangles with a vertex behind the eye; division by w without clipping vs. clipping first",
       "wrong pixels more than 1/128 px from an edge"},
      static_cast<double>(wrong.common), 10000, static_cast<double>(wrong.ours), 0);
}

TEST(Stability, NonFiniteVerticesAreCulled) {
  const float wild[] = {std::numeric_limits<float>::quiet_NaN(),
                        std::numeric_limits<float>::infinity(),
                        -std::numeric_limits<float>::infinity(),
                        3.4e38f,
                        -3.4e38f,
                        1e-40f};
  int64_t common = 0, ours = 0;
  for (const float x : wild) {
    for (std::size_t k = 0; k < 3; ++k) {
      for (int c = 0; c < 4; ++c) {
        std::vector<glm::vec4> t{{-0.5f, -0.5f, 0, 1}, {0.5f, -0.5f, 0, 1}, {0, 0.5f, 0, 1}};
        t[k][c] = x;
        Image<glm::vec4> count(kSize, kSize);
        const PassStatistics s = count_coverage(count, t, {0, 1, 2});
        for (const glm::vec4& p : count.texels()) ours += !(p.x == 0.0f || p.x == 1.0f);
        if (!std::isfinite(x)) {
          EXPECT_EQ(s.culled_non_finite, 1u) << x << " in component " << c;
        }
        const float window = (t[k].x / t[k].w + 1.0f) * 32.0f;  // input to the next stage of a common rasterizer
        common += !(std::abs(window) < 2147483648.0f);
      }
    }
  }
  record_and_check({5, "near plane, w <= 0", "NaN, infinities, 3e38 and 1e-40 in each component; an unchecked division by w vs. a pass",
                    "common: invalid window coordinates; ours: pixels that are neither drawn once nor left unchanged"},
                   static_cast<double>(common), 10, static_cast<double>(ours), 0);
}

}  // namespace
}  // namespace halfspace::stability
