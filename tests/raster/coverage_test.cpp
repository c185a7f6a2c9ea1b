// SPDX-License-Identifier: Apache-2.0
//
// Coverage is exact: a pass must cover the same samples as edge functions evaluated in 128-bit integers at every pixel. There is no
// tolerance, because all positions are multiples of 1/256 px, which the vertex stage does not round.
//
// Each triangle has a random weight in each channel. In the blended (immediate) draw, a pixel must contain the sum of the weights of all
// triangles that cover it, so that errors cannot cancel. In the replacing (deferred) draw, it must contain the weight of the last one. All
// sums stay below 2^24, where float addition of integers is exact.
#include "raster/raster_test.h"

#include <algorithm>

namespace halfspace::raster_test {
namespace {

__extension__ using Wide = __int128;

/// Calls covered(x, y) for every pixel of [x0, x1) × [y0, y1) whose center is owned by triangle t, and returns the number of pixels
/// examined. The orientation of the triangle does not matter.
///
/// A center on an edge is treated as if all centers were slightly further right and, by a far smaller amount, further up. No center is then
/// on an edge, and exactly one of two triangles that share an edge owns it. This is an independent formulation of the rule in
/// raster/pipeline/edge.h.
template <class F>
int64_t brute_force(const PointTriangle& t, int x0, int y0, int x1, int y1, F covered) {
  PointTriangle v = t;
  const auto cross = [](const Point& a, const Point& b, Wide x, Wide y) {
    return (Wide{b.x} - a.x) * (y - a.y) - (Wide{b.y} - a.y) * (x - a.x);
  };
  const Wide area = cross(v[0], v[1], v[2].x, v[2].y);
  if (area < 0) std::swap(v[1], v[2]);
  for (int y = y0; y < y1 && area != 0; ++y) {
    std::array<Wide, 3> e, step;
    std::array<bool, 3> owns;
    for (std::size_t i = 0; i < 3; ++i) {
      const Point &a = v[i], &b = v[(i + 1) % 3];
      e[i] = cross(a, b, Wide{x0} * 256 + 128, Wide{y} * 256 + 128);
      step[i] = (Wide{a.y} - b.y) * 256;
      // An edge owns the centers on it if its edge function increases to the right or, if it is horizontal, upwards.
      owns[i] = step[i] != 0 ? step[i] > 0 : b.x > a.x;
    }
    for (int x = x0; x < x1; ++x) {
      bool inside = true;
      for (std::size_t i = 0; i < 3; ++i) {
        inside = inside && (e[i] > 0 || (e[i] == 0 && owns[i]));
        e[i] += step[i];
      }
      if (inside) covered(x, y);
    }
  }
  return int64_t{x1 - x0} * (y1 - y0);
}

// Draws batches of triangles into one image and compares them with brute force.
class Comparison {
 public:
  Comparison(int width, int height, uint64_t seed) : width_(width), height_(height), random_(seed) {}

  Random& random() { return random_; }
  int64_t samples() const { return samples_; }
  int64_t covered() const { return covered_; }
  int64_t differences() const { return differences_; }

  // in_box: examines only the pixels in each triangle's bounding box, which is faster for tiny triangles. No pixel outside the box can be
  // covered.
  void compare(const std::vector<PointTriangle>& triangles, bool in_box = false) {
    ASSERT_LE(triangles.size() * kMaxWeight, std::size_t{1} << 24);
    std::vector<glm::vec4> weights;
    for (std::size_t i = 0; i < triangles.size(); ++i) {
      weights.emplace_back(random_.integer(1, kMaxWeight), random_.integer(1, kMaxWeight), random_.integer(1, kMaxWeight), 1);
    }
    Image<glm::vec4> sum(width_, height_), last(width_, height_);
    int64_t covered_here = 0;
    for (std::size_t i = 0; i < triangles.size(); ++i) {
      const auto [x0, y0, x1, y1] = in_box ? box(triangles[i]) : std::array{0, 0, width_, height_};
      samples_ += brute_force(triangles[i], x0, y0, x1, y1, [&](int x, int y) {
        sum.at(x, height_ - 1 - y) += weights[i];
        last.at(x, height_ - 1 - y) = weights[i];
        ++covered_here;
      });
    }
    covered_ += covered_here;

    // The batches cycle through the tile sizes, since edge functions are set up again in each tile.
    const PassOptions options{.tuning = {.tile_size = 8 << (batch_ % 4)}};
    ++batch_;
    Image<glm::vec4> drawn(width_, height_);
    const PassStatistics blended = draw_colors(drawn, triangles, weights, true, options);
    count_differences(drawn, sum, "blended");
    EXPECT_EQ(blended.samples_tested, static_cast<uint64_t>(covered_here));
    EXPECT_EQ(blended.fragments_shaded, static_cast<uint64_t>(covered_here));
    const PassStatistics deferred = draw_colors(drawn, triangles, weights, false, options);
    count_differences(drawn, last, "deferred");
    EXPECT_EQ(deferred.samples_tested, static_cast<uint64_t>(covered_here));
  }

  void report() const {
    ::testing::Test::RecordProperty("samples", std::to_string(samples_));
    ::testing::Test::RecordProperty("covered", std::to_string(covered_));
    ::testing::Test::RecordProperty("differences", std::to_string(differences_));
    std::printf("%lld samples, %lld covered, %lld differences\n", static_cast<long long>(samples_), static_cast<long long>(covered_),
                static_cast<long long>(differences_));
  }

 private:
  static constexpr int kMaxWeight = 1023;

  std::array<int, 4> box(const PointTriangle& t) const {
    const auto [x_low, x_high] = std::minmax({t[0].x, t[1].x, t[2].x});
    const auto [y_low, y_high] = std::minmax({t[0].y, t[1].y, t[2].y});
    const int x0 = std::clamp((x_low >> 8) - 1, 0, width_), y0 = std::clamp((y_low >> 8) - 1, 0, height_);
    return {x0, y0, std::clamp((x_high >> 8) + 2, x0, width_), std::clamp((y_high >> 8) + 2, y0, height_)};
  }

  void count_differences(const Image<glm::vec4>& drawn, const Image<glm::vec4>& want, const char* path) {
    for (int y = 0; y < height_; ++y) {
      for (int x = 0; x < width_; ++x) {
        if (pixel(drawn, x, y) == pixel(want, x, y)) continue;
        if (differences_++ < 10) {
          ADD_FAILURE() << path << ": pixel " << x << ", " << y << " has weight " << pixel(drawn, x, y).x << "; expected "
                        << pixel(want, x, y).x;
        }
      }
    }
  }

  int width_, height_;
  Random random_;
  int batch_ = 0;
  int64_t samples_ = 0, covered_ = 0, differences_ = 0;
};

Point random_point(Random& r, int width, int height, int margin) {
  return {r.integer(-margin * 256, (width + margin) * 256), r.integer(-margin * 256, (height + margin) * 256)};
}

// Moves a point to a pixel center, so that vertices and many edges pass exactly through pixel centers.
Point on_centers(const Point& p) { return {(p.x & ~255) + 128, (p.y & ~255) + 128}; }

TEST(Coverage, RandomTrianglesAreExact) {
  Comparison c(256, 256, 1);
  for (int batch = 0; batch < effort(100); ++batch) {
    std::vector<PointTriangle> triangles(16);
    for (PointTriangle& t : triangles) {
      for (Point& p : t) p = random_point(c.random(), 256, 256, 64);
    }
    c.compare(triangles);
  }
  c.report();
}

TEST(Coverage, VerticesOnPixelCentersAreExact) {
  Comparison c(256, 256, 2);
  for (int batch = 0; batch < effort(100); ++batch) {
    std::vector<PointTriangle> triangles(16);
    for (PointTriangle& t : triangles) {
      for (Point& p : t) p = on_centers(random_point(c.random(), 256, 256, 16));
      // Horizontal, vertical and 45° edges through pixel centers.
      const int kind = c.random().integer(0, 3);
      if (kind == 1) t[1].y = t[0].y;
      if (kind == 2) t[1].x = t[0].x;
      if (kind == 3) t[1] = {t[0].x + 256 * 40, t[0].y + (c.random().coin() ? 256 * 40 : -256 * 40)};
    }
    c.compare(triangles);
  }
  c.report();
}

TEST(Coverage, SliversAreExact) {
  Comparison c(256, 256, 3);
  for (int batch = 0; batch < effort(100); ++batch) {
    std::vector<PointTriangle> triangles(16);
    for (PointTriangle& t : triangles) {
      t[0] = random_point(c.random(), 256, 256, 64);
      t[1] = random_point(c.random(), 256, 256, 64);
      // The third vertex is at most one pixel, and usually only a few sub-pixels, away from the line through the other two.
      const double s = c.random().real(-0.5, 1.5);
      const int reach = 1 << c.random().integer(0, 8);
      t[2] = {static_cast<int32_t>(t[0].x + s * (t[1].x - t[0].x)) + c.random().integer(-reach, reach),
              static_cast<int32_t>(t[0].y + s * (t[1].y - t[0].y)) + c.random().integer(-reach, reach)};
      if (c.random().integer(0, 3) == 0) {  // the third vertex is next to the first one, which gives a needle
        t[2] = {t[0].x + c.random().integer(-2, 2), t[0].y + c.random().integer(-2, 2)};
      }
    }
    c.compare(triangles);
  }
  EXPECT_GT(c.covered(), effort(100) * 50);
  c.report();
}

TEST(Coverage, TinyTrianglesAreExact) {
  Comparison c(128, 128, 4);
  for (int batch = 0; batch < effort(64); ++batch) {
    std::vector<PointTriangle> triangles(8192);
    for (PointTriangle& t : triangles) {
      const int size = 1 << c.random().integer(0, 10);  // from 1/256 px to 4 px
      Point at = random_point(c.random(), 128, 128, 1);
      if (c.random().coin()) at = on_centers(at);  // so that even the smallest triangles touch a center
      t[0] = at;
      for (std::size_t i = 1; i < 3; ++i) t[i] = {at.x + c.random().integer(-size, size), at.y + c.random().integer(-size, size)};
      if (c.random().coin()) {
        const Point shift{c.random().integer(-size, size), c.random().integer(-size, size)};
        for (Point& p : t) p = {p.x + shift.x, p.y + shift.y};
      }
    }
    c.compare(triangles, true);
  }
  EXPECT_GT(c.covered(), effort(64) * 1000);
  c.report();
}

// The sizes are near the limit (63 px) at which setup switches from full 32-bit edge functions to shifted ones, and near the tile size.
TEST(Coverage, TileSizedTrianglesAreExact) {
  Comparison c(256, 256, 5);
  for (int batch = 0; batch < effort(40); ++batch) {
    std::vector<PointTriangle> triangles(16);
    for (PointTriangle& t : triangles) {
      const Point at = random_point(c.random(), 256, 256, 40);
      const int size = (c.random().coin() ? 63 : 64) * 256 + c.random().integer(-2, 2);
      t[0] = at;
      t[1] = {at.x + size, at.y + c.random().integer(0, size)};
      t[2] = {at.x + c.random().integer(0, size), at.y + size};
      if (c.random().coin()) std::swap(t[1], t[2]);
    }
    c.compare(triangles);
  }
  c.report();
}

TEST(Coverage, HugeTrianglesAreExact) {
  constexpr int kLimit = 16384 * 256;
  Comparison c(256, 256, 6);
  for (int batch = 0; batch < effort(100); ++batch) {
    std::vector<PointTriangle> triangles(16);
    for (PointTriangle& t : triangles) {
      for (Point& p : t) p = {c.random().integer(-kLimit, kLimit), c.random().integer(-kLimit, kLimit)};
      const int kind = c.random().integer(0, 3);
      if (kind == 1) t[0] = random_point(c.random(), 256, 256, 0);  // one vertex in the picture
      if (kind == 2) t[0] = on_centers(random_point(c.random(), 256, 256, 0));
      if (kind == 3) {  // an edge through many centers with both ends far away
        const Point center = on_centers(random_point(c.random(), 256, 256, 0));
        const Point step{c.random().integer(-5, 5) * 256, c.random().integer(-5, 5) * 256};
        t[0] = {center.x + step.x * 3000, center.y + step.y * 3000};
        t[1] = {center.x - step.x * 3000, center.y - step.y * 3000};
      }
    }
    // The corners of the guard band give the largest possible edge function values.
    triangles[0] = {{{-kLimit, -kLimit}, {kLimit, -kLimit}, {kLimit, kLimit}}};
    triangles[1] = {{{-kLimit, kLimit}, {kLimit, -kLimit}, {-kLimit + batch, -kLimit}}};
    c.compare(triangles);
  }
  c.report();
}

// At the far end of the largest render target, sample positions need 22 bits.
TEST(Coverage, WideTargetsAreExact) {
  constexpr int kWidth = 16384, kHeight = 32;
  Comparison c(kWidth, kHeight, 7);
  for (int batch = 0; batch < effort(8); ++batch) {
    std::vector<PointTriangle> triangles(24);
    for (PointTriangle& t : triangles) {
      for (Point& p : t) p = {c.random().integer(-256, kWidth * 256), c.random().integer(-256 * 8, (kHeight + 8) * 256)};
      if (c.random().coin()) t[0] = on_centers(t[0]);
      if (c.random().coin()) t[1] = on_centers(t[1]);
    }
    c.compare(triangles);
  }
  c.report();
}

TEST(Coverage, DegenerateTrianglesDrawNothing) {
  Random r(8);
  std::vector<PointTriangle> triangles;
  for (int i = 0; i < 3000; ++i) {
    const Point a = on_centers(random_point(r, 256, 256, 8)), b = random_point(r, 256, 256, 8);
    const Point step{r.integer(-300, 300), r.integer(-300, 300)};
    triangles.push_back({a, a, b});
    triangles.push_back({a, b, b});
    triangles.push_back({b, a, b});
    triangles.push_back({a, a, a});
    const int k1 = r.integer(-50, 50), k2 = r.integer(-50, 50);  // three points on a line through a pixel center
    triangles.push_back({a, {a.x + k1 * step.x, a.y + k1 * step.y}, {a.x + k2 * step.x, a.y + k2 * step.y}});
  }
  const std::vector<glm::vec4> colors(triangles.size(), glm::vec4(1.0f));
  for (const bool add_up : {true, false}) {
    Image<glm::vec4> drawn(256, 256);
    const PassStatistics s = draw_colors(drawn, triangles, colors, add_up);
    EXPECT_EQ(s.culled_degenerate + s.culled_outside, triangles.size());
    EXPECT_EQ(s.triangles_binned, 0u);
    for (const glm::vec4& p : drawn.texels()) ASSERT_EQ(p, glm::vec4(0.0f));
  }
}

// The fill rule in a minimal case: a square between pixel centers owns the samples on its left and bottom edges (y up), but not those on
// the other two.
TEST(Coverage, SquareOwnsLeftAndBottomEdges) {
  const Point a{128, 128}, b{128 + 2 * 256, 128}, c{128 + 2 * 256, 128 + 2 * 256}, d{128, 128 + 2 * 256};
  const std::vector<PointTriangle> triangles{{a, b, c}, {a, c, d}};
  const std::vector<glm::vec4> colors(2, glm::vec4(1.0f));
  Image<glm::vec4> drawn(4, 4);
  draw_colors(drawn, triangles, colors, true);
  for (int y = 0; y < 4; ++y) {
    for (int x = 0; x < 4; ++x) EXPECT_EQ(pixel(drawn, x, y).x, x < 2 && y < 2 ? 1.0f : 0.0f) << x << ", " << y;
  }
}

}  // namespace
}  // namespace halfspace::raster_test
