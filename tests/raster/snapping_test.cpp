// SPDX-License-Identifier: Apache-2.0
//
// Compares the window positions of the vertex stage with exact arithmetic: x/w·half + center, rounded to 1/256 px.
#include "raster/raster_test.h"

#include <cmath>
#include <limits>

namespace halfspace::raster_test {
namespace {

static_assert(std::numeric_limits<long double>::digits >= 64);

/// Returns the distance of k from the exact position, in 1/256 px. x·H and (k − C)·w are products of at most 24 and 25 bits, which long
/// double represents exactly. For positions within ±2^23, their difference divided by w has an error below 2^-38.
long double distance(int32_t k, float x, float w, double half, double center) {
  const auto h = static_cast<long double>(half * 256), c = static_cast<long double>(center * 256);
  const auto xl = static_cast<long double>(x), wl = static_cast<long double>(w);
  return (xl * h - (static_cast<long double>(k) - c) * wl) / wl;
}

struct Tally {
  int64_t positions = 0, off = 0;  // off: not rounded to the nearest
  long double excess = 0;          // the largest distance in excess of one half
  void add(long double d) {
    ++positions;
    const long double e = std::fabs(d) - 0.5L;
    if (e > 0) ++off;
    excess = std::max(excess, e);
  }
  void report(const char* name) const {
    ::testing::Test::RecordProperty(name, std::to_string(off) + " of " + std::to_string(positions));
    std::printf(
        "%-28s %lld of %lld positions not the nearest, by at most "
        "2^%.1f of 1/256 px\n",
        name, static_cast<long long>(off), static_cast<long long>(positions), off != 0 ? std::log2(static_cast<double>(excess)) : -99.0);
  }
};

// The remainder of the quotient has a relative error of 2^-23, or 2^-24 of the quotient, which is about 2^-24 at 2^22 sub-pixels. The last
// two sums add numbers below 2 and have a rounding error of 2^-24 each. 2^-22 is a safe bound.
constexpr long double kMaxExcess = 0x1p-22L;

Tally snap_many(const std::vector<glm::vec4>& positions, const Rect& viewport) {
  const ShadedVertices v = shade(ConstantShader{}, make_vertex_view(stream(positions)), viewport);
  const double half_x = 0.5 * viewport.width, half_y = 0.5 * viewport.height;
  Tally t;
  for (std::size_t i = 0; i < positions.size(); ++i) {
    if (v.outcodes[i] & (kOutGuard | kOutNonFinite)) continue;
    t.add(distance(v.screen[i].x, positions[i].x, positions[i].w, half_x, viewport.x + half_x));
    t.add(distance(v.screen[i].y, positions[i].y, positions[i].w, half_y, viewport.y + half_y));
  }
  return t;
}

const std::array<Rect, 5> kViewports{
    {{0, 0, 1920, 1080}, {0, 0, 1, 1}, {-16384, 16384, 16383, 16384}, {17, -5, 1001, 333}, {8000, 8000, 8191, 63}}};

TEST(Snapping, ViewportPositionsAreWithinErrorBound) {
  Random r(1);
  for (const Rect& viewport : kViewports) {
    std::vector<glm::vec4> positions(static_cast<std::size_t>(effort(200000)));
    for (glm::vec4& p : positions) {
      const float w = r.real(0.1f, 100.0f);
      p = {r.real(-1.5f, 1.5f) * w, r.real(-1.5f, 1.5f) * w, 0.0f, w};
    }
    const Tally t = snap_many(positions, viewport);
    t.report("viewport");
    EXPECT_GT(t.positions, 0);
    EXPECT_LE(t.excess, kMaxExcess);
  }
}

TEST(Snapping, GuardBandPositionsAreWithinErrorBound) {
  Random r(2);
  for (const Rect& viewport : kViewports) {
    std::vector<glm::vec4> positions(static_cast<std::size_t>(effort(200000)));
    for (glm::vec4& p : positions) {
      const double w = r.magnitude(0x1p-90, 0x1p100);
      const double px = r.real(-16384.0, 16384.0), py = r.real(-16384.0, 16384.0);
      p = {static_cast<float>((px - viewport.x - 0.5 * viewport.width) / (0.5 * viewport.width) * w),
           static_cast<float>((py - viewport.y - 0.5 * viewport.height) / (0.5 * viewport.height) * w), 0.0f, static_cast<float>(w)};
    }
    const Tally t = snap_many(positions, viewport);
    t.report("guard band");
    EXPECT_GT(t.positions, 2 * effort(190000));
    EXPECT_LE(t.excess, kMaxExcess);
  }
}

// Positions within a few ulps of the midpoint between two sub-pixels. Only these may round to the wrong side.
TEST(Snapping, NearTiesAreWithinErrorBound) {
  Random r(3);
  for (const Rect& viewport : kViewports) {
    std::vector<glm::vec4> positions(static_cast<std::size_t>(effort(200000)));
    for (glm::vec4& p : positions) {
      const double w = r.magnitude(1e-3, 1e3);
      const double px = (r.integer(-16384 * 256, 16384 * 256 - 1) + 0.5) / 256, py = (r.integer(-16384 * 256, 16384 * 256 - 1) + 0.5) / 256;
      const auto wf = static_cast<float>(w);
      p = {static_cast<float>((px - viewport.x - 0.5 * viewport.width) / (0.5 * viewport.width) * static_cast<double>(wf)),
           static_cast<float>((py - viewport.y - 0.5 * viewport.height) / (0.5 * viewport.height) * static_cast<double>(wf)), 0.0f, wf};
    }
    const Tally t = snap_many(positions, viewport);
    t.report("near ties");
    EXPECT_GT(t.positions, 2 * effort(190000));
    EXPECT_LE(t.excess, kMaxExcess);
  }
}

TEST(Snapping, MatchesHandComputedPositions) {
  // With a width of 256 px, x/w = 0 is at 128 px and one sub-pixel is 2^-15. Ties round to the even sub-pixel.
  const std::vector<glm::vec4> positions{{0, 0, 0, 1},
                                         {-1, 1, 0, 1},
                                         {0x1p-15f, -0x1p-15f, 0, 1},
                                         {0x1p-16f, 0x3p-16f, 0, 1},
                                         {-0x1p-16f, -0x3p-16f, 0, 1},
                                         {3, -3, 0, 6},
                                         {0x1.1p-16f, 0x0.fp-16f, 0, 1}};
  const ShadedVertices v = shade(ConstantShader{}, make_vertex_view(stream(positions)), {0, 0, 256, 256});
  const std::vector<Point> want{{32768, 32768}, {0, 65536}, {32769, 32767}, {32768, 32770}, {32768, 32766}, {49152, 16384}, {32769, 32768}};
  for (std::size_t i = 0; i < want.size(); ++i) EXPECT_EQ((Point{v.screen[i].x, v.screen[i].y}), want[i]) << i;
}

// Scaling a vertex by a power of two must not change any bit of its position.
TEST(Snapping, ScalingByPowersOfTwoChangesNothing) {
  Random r(4);
  std::vector<glm::vec4> positions;
  for (int i = 0; i < effort(20000); ++i) {
    const float w = r.real(0.5f, 2.0f);
    const glm::vec4 p(r.real(-3.0f, 3.0f) * w, r.real(-3.0f, 3.0f) * w, r.real(0.0f, 1.0f) * w, w);
    positions.push_back(p);
    positions.push_back(p * 0x1p60f);
    positions.push_back(p * 0x1p-60f);
  }
  const ShadedVertices v = shade(ConstantShader{}, make_vertex_view(stream(positions)), {0, 0, 1001, 777});
  for (std::size_t i = 0; i < positions.size(); i += 3) {
    for (const std::size_t k : {i + 1, i + 2}) {
      ASSERT_EQ(v.screen[i].x, v.screen[k].x);
      ASSERT_EQ(v.screen[i].y, v.screen[k].y);
      ASSERT_EQ(v.screen[i].z, v.screen[k].z);
    }
  }
}

}  // namespace
}  // namespace halfspace::raster_test
