// SPDX-License-Identifier: Apache-2.0
//
// Tests the tessellator against closed forms of OpenGL 4.6, section 11.2.2, and by the invariance rules of section A.4. Coordinates are
// multiples of 2^-24 by contract. The tests convert them to integers, in which areas, sums and mirrored coordinates are exact. Most
// comparisons therefore have no tolerance.
#include "halfspace/raster/amplify/tessellator.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include "raster/raster_test.h"

namespace halfspace::raster_test {
namespace {

constexpr int64_t kPatchUnits = 1 << 24;  // coordinate 1
constexpr int64_t kShortestUnits = 3;     // the documented shortest segment
constexpr float kInfiniteLevel = std::numeric_limits<float>::infinity();
constexpr float kNanLevel = std::numeric_limits<float>::quiet_NaN();

using PatchLevels = TessellationLevels<float>;
using UnitPoint = std::array<int64_t, 3>;
using UnitTriangle = std::array<UnitPoint, 3>;  // with sorted vertices
constexpr auto kTriangleDomain = TessellationDomain::triangles;
constexpr auto kQuadDomain = TessellationDomain::quads;
constexpr auto kIsolineDomain = TessellationDomain::isolines;
constexpr auto kEqual = TessellationSpacing::equal;
constexpr auto kEven = TessellationSpacing::fractional_even;
constexpr auto kOdd = TessellationSpacing::fractional_odd;

std::size_t corner_count(TessellationDomain domain) { return domain == kTriangleDomain ? 3 : 4; }

PatchLevels uniform_levels(float level) { return {{level, level, level, level}, {level, level}}; }

Tessellation tessellated(const TessellatorOptions& options, const PatchLevels& levels) {
  Tessellation t;
  tessellate(options, levels, t);
  return t;
}

/// Returns a coordinate as an integer. Section A.4, rule 8: it is in [0, 1], and 1 − x is exact.
int64_t in_units(float x) {
  const float scaled = x * 0x1p24f;
  EXPECT_TRUE(x >= 0.0f && x <= 1.0f && scaled == std::floor(scaled)) << x;
  return static_cast<int64_t>(scaled);
}

UnitPoint unit_point(const glm::vec3& uvw) { return {in_units(uvw.x), in_units(uvw.y), in_units(uvw.z)}; }

std::vector<UnitPoint> unit_points(const Tessellation& t) {
  std::vector<UnitPoint> points;
  points.reserve(t.coordinates.size());
  for (const glm::vec3& uvw : t.coordinates) points.push_back(unit_point(uvw));
  return points;
}

/// A clamped level and its number of segments, in closed form.
struct ExpectedLevel {
  double level;
  int segments;
};
ExpectedLevel expected_level(TessellationSpacing spacing, double level) {
  const double low = spacing == kEven ? 2.0 : 1.0, high = spacing == kOdd ? 63.0 : 64.0;
  const double f = std::isnan(level) ? low : std::clamp(level, low, high);
  if (spacing == kEqual) return {std::ceil(f), static_cast<int>(std::ceil(f))};
  return {f, static_cast<int>(low) + 2 * static_cast<int>(std::ceil((f - low) / 2))};
}

/// The segments of all edges of a triangle or quad, with inner levels of 1 treated as 1 + ε.
struct ExpectedSegments {
  std::array<int, 4> outer{};
  std::array<int, 2> inner{};
  int outer_sum = 0;
};
ExpectedSegments expected_segments(const TessellatorOptions& options, const PatchLevels& levels) {
  ExpectedSegments e;
  const std::size_t corners = corner_count(options.domain), inner = corners - 2;
  bool undivided = true;
  for (std::size_t i = 0; i < corners; ++i) {
    e.outer[i] = expected_level(options.spacing, levels.outer[i]).segments;
    e.outer_sum += e.outer[i];
    undivided &= e.outer[i] == 1;
  }
  for (std::size_t i = 0; i < inner; ++i) undivided &= expected_level(options.spacing, levels.inner[i]).segments == 1;
  for (std::size_t i = 0; i < inner; ++i) {
    e.inner[i] = expected_level(options.spacing, levels.inner[i]).segments;
    if (e.inner[i] == 1 && !undivided) e.inner[i] = options.spacing == kOdd ? 3 : 2;
  }
  return e;
}

/// A level of any kind: an integer, a limit, a neighbor of an integer, or any number.
float random_level(Random& random) {
  const float integer = static_cast<float>(random.between(1, 64));
  switch (random.below(5)) {
    case 0: return integer;
    case 1: return random.pick({1e-30f, 0.5f, 1.0f, 2.0f, 63.0f, 64.0f, 65.0f, kInfiniteLevel});
    case 2: return std::nextafter(integer, random.coin() ? 0.0f : 100.0f);
    case 3: return static_cast<float>(random.magnitude(1.0, 64.0));
    default: return random.real(0.0f, 65.0f) + 0x1p-30f;
  }
}

PatchLevels random_levels(Random& random) {
  PatchLevels levels;
  for (float& level : levels.outer) level = random_level(random);
  for (float& level : levels.inner) level = random.once_in(8) ? random.pick({-1.0f, 0.0f, 1.0f, kNanLevel}) : random_level(random);
  return levels;
}

TessellatorOptions random_options(Random& random) {
  TessellatorOptions options;
  options.domain = random.pick({kTriangleDomain, kQuadDomain});
  options.spacing = random.pick({kEqual, kEven, kOdd});
  options.clockwise = random.coin();
  return options;
}

/// Returns whether a point is on edge i of the domain, in the order of the outer levels.
bool on_edge(TessellationDomain domain, const UnitPoint& p, std::size_t i) {
  if (domain == kTriangleDomain) return p[i] == 0;
  return p[i % 2] == (i < 2 ? 0 : kPatchUnits);
}

/// Returns the sorted positions of the vertices on edge i of the domain.
std::vector<int64_t> edge_positions(TessellationDomain domain, const Tessellation& t, std::size_t i) {
  std::vector<int64_t> positions;
  for (const UnitPoint& p : unit_points(t)) {
    if (on_edge(domain, p, i)) positions.push_back(domain == kTriangleDomain ? p[(i + 1) % 3] : p[1 - i % 2]);
  }
  std::ranges::sort(positions);
  return positions;
}

/// Returns the positions on an edge with the given level: those of a single isoline. All edges are the same (EdgesDependOnlyOnTheirLevel).
std::vector<int64_t> divided_edge(TessellationSpacing spacing, float level) {
  return edge_positions(kQuadDomain, tessellated({.domain = kIsolineDomain, .spacing = spacing}, {{1, level}}), 1);
}

// ---- counts ----------------------------------------------------------------------------------------------------

TEST(Tessellator, UniformTriangleHasClosedFormCounts) {
  // Ring i has 3(n − 2i) vertices. Between it and the next ring are 6(n − 2i) − 6 triangles. In the middle is a point or a triangle.
  for (std::size_t n = 1; n <= 64; ++n) {
    const Tessellation t = tessellated({}, uniform_levels(static_cast<float>(n)));
    const std::size_t k = n / 2;
    EXPECT_EQ(t.coordinates.size(), n % 2 == 0 ? 3 * k * (k + 1) + 1 : 3 * (k + 1) * (k + 1)) << n;
    EXPECT_EQ(t.indices.size(), 3 * (n % 2 == 0 ? 6 * k * k : 6 * k * (k + 1) + 1)) << n;
  }
}

TEST(Tessellator, UniformQuadHasClosedFormCounts) {
  for (std::size_t n = 1; n <= 64; ++n) {
    const Tessellation t = tessellated({.domain = kQuadDomain}, uniform_levels(static_cast<float>(n)));
    EXPECT_EQ(t.coordinates.size(), (n + 1) * (n + 1)) << n;
    EXPECT_EQ(t.indices.size(), 3 * 2 * n * n) << n;
  }
}

TEST(Tessellator, IsolinesHaveClosedFormCounts) {
  for (const auto spacing : {kEqual, kEven, kOdd}) {
    for (std::size_t lines = 1; lines <= 64; ++lines) {
      const float level = 65.5f - static_cast<float>(lines);
      const Tessellation t =
          tessellated({.domain = kIsolineDomain, .spacing = spacing}, {{static_cast<float>(lines), level, kNanLevel, 0}});
      const std::size_t segments = static_cast<std::size_t>(expected_level(spacing, level).segments);
      EXPECT_EQ(t.coordinates.size(), lines * (segments + 1));
      EXPECT_EQ(t.indices.size(), 2 * lines * segments);
    }
  }
}

TEST(Tessellator, RandomLevelsHaveClosedFormCounts) {
  // The inner levels determine what is inside the outer edges, as in a uniform patch. Each outer segment adds a vertex and a triangle.
  Random random(1);
  for (int i = 0; i < effort(1500); ++i) {
    const TessellatorOptions options = random_options(random);
    const PatchLevels levels = random_levels(random);
    const Tessellation t = tessellated(options, levels);
    const auto [outer, inner, sum] = expected_segments(options, levels);
    const int n = inner[0], k = n / 2, m = inner[1];
    int vertices = (n - 1) * (m - 1), triangles = 2 * n * m - 2 * n - 2 * m;
    if (options.domain == kTriangleDomain) {
      vertices = (n % 2 == 0 ? 3 * k * (k + 1) + 1 : 3 * (k + 1) * (k + 1)) - 3 * n;
      triangles = (n % 2 == 0 ? 6 * k * k : 6 * k * (k + 1) + 1) - 3 * n;
    }
    ASSERT_EQ(t.coordinates.size(), static_cast<std::size_t>(sum + vertices));
    ASSERT_EQ(t.indices.size(), static_cast<std::size_t>(3 * (sum + triangles)));
  }
}

TEST(Tessellator, PointModeEmitsTheVerticesOfTheOtherModesOnce) {
  Random random(2);
  for (int i = 0; i < effort(600); ++i) {
    TessellatorOptions options = random_options(random);
    if (random.once_in(3)) options.domain = kIsolineDomain;
    const PatchLevels levels = random_levels(random);
    const Tessellation others = tessellated(options, levels);
    options.point_mode = true;
    const Tessellation points = tessellated(options, levels);
    ASSERT_EQ(points.coordinates, others.coordinates);
    ASSERT_EQ(points.indices.size(), points.coordinates.size());
    for (uint32_t k = 0; k < points.indices.size(); ++k) ASSERT_EQ(points.indices[k], k);
  }
}

// ---- coverage --------------------------------------------------------------------------------------------------

int64_t twice_area(const UnitPoint& a, const UnitPoint& b, const UnitPoint& c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

/// Expects that the triangles cover the domain exactly once. This is the case if all have the same winding, each directed edge occurs once
/// and has an opposite edge unless it is on the outline, and the sum of the areas is the area of the domain.
void expect_exact_cover(const TessellatorOptions& options, const Tessellation& t) {
  const std::vector<UnitPoint> points = unit_points(t);
  std::vector<std::pair<uint32_t, uint32_t>> edges;
  int64_t sum = 0;
  for (std::size_t i = 0; i < t.indices.size(); i += 3) {
    const std::array<uint32_t, 3> v{t.indices[i], t.indices[i + 1], t.indices[i + 2]};
    const int64_t area = twice_area(points[v[0]], points[v[1]], points[v[2]]);
    EXPECT_GT(options.clockwise ? -area : area, 0);
    sum += std::abs(area);
    for (std::size_t k = 0; k < 3; ++k) edges.emplace_back(v[k], v[(k + 1) % 3]);
  }
  EXPECT_EQ(sum, (options.domain == kTriangleDomain ? 1 : 2) * kPatchUnits * kPatchUnits);  // exact, because all coordinates are integers
  std::ranges::sort(edges);
  EXPECT_EQ(std::ranges::adjacent_find(edges), edges.end());
  std::vector<bool> used(points.size());
  for (const auto& [a, b] : edges) {
    used[a] = true;
    if (std::ranges::binary_search(edges, std::pair{b, a})) continue;
    bool outline = false;
    for (std::size_t i = 0; i < corner_count(options.domain); ++i) {
      outline |= on_edge(options.domain, points[a], i) && on_edge(options.domain, points[b], i);
    }
    EXPECT_TRUE(outline);
  }
  EXPECT_EQ(std::ranges::count(used, false), 0);
}

TEST(Tessellator, TrianglesCoverTheDomainExactlyOnce) {
  Random random(3);
  for (int i = 0; i < effort(1000) && !HasFailure(); ++i) {
    const TessellatorOptions options = random_options(random);
    expect_exact_cover(options, tessellated(options, random_levels(random)));
  }
}

TEST(Tessellator, UniformLevelsCoverTheDomainExactlyOnce) {
  for (const auto domain : {kTriangleDomain, kQuadDomain}) {
    for (const auto spacing : {kEqual, kEven, kOdd}) {
      for (int n = 1; n <= 64; ++n) {
        for (const float level : {static_cast<float>(n), std::nextafter(static_cast<float>(n), 100.0f)}) {
          const TessellatorOptions options{.domain = domain, .spacing = spacing, .clockwise = n % 2 == 0};
          expect_exact_cover(options, tessellated(options, uniform_levels(level)));
        }
      }
    }
  }
}

TEST(Tessellator, VerticesAreDistinctAndTheirCoordinatesAddUpToOne) {
  Random random(4);
  for (int i = 0; i < effort(1000); ++i) {
    const TessellatorOptions options = random_options(random);
    const Tessellation t = tessellated(options, random_levels(random));
    std::vector<UnitPoint> points = unit_points(t);
    for (std::size_t k = 0; k < points.size(); ++k) {
      const glm::vec3& uvw = t.coordinates[k];
      if (options.domain == kTriangleDomain) {
        ASSERT_EQ(uvw.x + uvw.y + uvw.z, 1.0f);
      }
      if (options.domain == kQuadDomain) {
        ASSERT_EQ(uvw.z, 0.0f);
      }
    }
    std::ranges::sort(points);
    ASSERT_EQ(std::ranges::adjacent_find(points), points.end());
  }
}

// ---- edges -----------------------------------------------------------------------------------------------------

TEST(Tessellator, EdgesDependOnlyOnTheirLevel) {
  // Section A.4, rules 2 and 4. All edges of triangles and quads are compared with an isoline of the same level.
  Random random(5);
  for (int i = 0; i < effort(1000); ++i) {
    const TessellatorOptions options = random_options(random);
    const PatchLevels levels = random_levels(random);
    const Tessellation t = tessellated(options, levels);
    for (std::size_t e = 0; e < corner_count(options.domain); ++e) {
      ASSERT_EQ(edge_positions(options.domain, t, e), divided_edge(options.spacing, levels.outer[e]));
    }
  }
}

TEST(Tessellator, EdgesAreMirroredExactly) {
  // Section A.4, rule 3, with floats as a shader computes them.
  Random random(6);
  for (int i = 0; i < effort(1000); ++i) {
    const TessellatorOptions options = random_options(random);
    const Tessellation t = tessellated(options, random_levels(random));
    std::set<std::array<float, 3>> vertices;
    for (const glm::vec3& c : t.coordinates) vertices.insert({c.x, c.y, c.z});
    for (const glm::vec3& c : t.coordinates) {
      if (options.domain == kQuadDomain) {
        if (c.x == 0.0f || c.x == 1.0f) {
          ASSERT_TRUE(vertices.contains({c.x, 1.0f - c.y, 0.0f}));
        }
        if (c.y == 0.0f || c.y == 1.0f) {
          ASSERT_TRUE(vertices.contains({1.0f - c.x, c.y, 0.0f}));
        }
      } else {
        if (c.x == 0.0f) {
          ASSERT_TRUE(c.z == 1.0f - c.y && vertices.contains({0.0f, c.z, c.y}));
        }
        if (c.y == 0.0f) {
          ASSERT_TRUE(c.z == 1.0f - c.x && vertices.contains({c.z, 0.0f, c.x}));
        }
        if (c.z == 0.0f) {
          ASSERT_TRUE(c.y == 1.0f - c.x && vertices.contains({c.y, c.x, 0.0f}));
        }
      }
    }
  }
}

TEST(Tessellator, SegmentsHaveTheLengthsOfTheSpacing) {
  // Each position is rounded by at most 1/2 unit, so a segment differs from its exact length by at most 1 unit, and the first and last one
  // by 1/2 unit, because one of their ends is exact. Where these two are made longer, up to 3 units, their neighbors are shorter.
  Random random(7);
  for (int i = 0; i < effort(4000); ++i) {
    const TessellationSpacing spacing = random.pick({kEqual, kEven, kOdd});
    const float level = random_level(random);
    const auto [f, n] = expected_level(spacing, level);
    const std::vector<int64_t> p = divided_edge(spacing, level);
    ASSERT_EQ(p.size(), static_cast<std::size_t>(n) + 1);
    if (n == 1) continue;
    const double unit = static_cast<double>(kPatchUnits), exact = unit * (f - n + 2) / (2 * f);
    const double end = std::max(exact, double{kShortestUnits});
    EXPECT_NEAR(static_cast<double>(p[1] - p[0]), end, 0.5) << level;
    EXPECT_EQ(p[1] - p[0], p.back() - p[p.size() - 2]) << level;
    for (std::size_t k = 2; k < p.size() - 1; ++k) {
      EXPECT_NEAR(static_cast<double>(p[k] - p[k - 1]), unit / f, 1.0 + 2.0 * (end - exact)) << level;
    }
  }
}

TEST(Tessellator, FractionalSpacingsEqualEqualSpacingAtIntegers) {
  for (const auto domain : {kTriangleDomain, kQuadDomain}) {
    for (int n = 1; n <= 64; ++n) {
      const TessellationSpacing spacing = n % 2 == 0 ? kEven : kOdd;
      const Tessellation fractional = tessellated({.domain = domain, .spacing = spacing}, uniform_levels(static_cast<float>(n)));
      const Tessellation equal = tessellated({.domain = domain}, uniform_levels(static_cast<float>(n)));
      EXPECT_EQ(fractional.coordinates, equal.coordinates) << n;
      EXPECT_EQ(fractional.indices, equal.indices) << n;
    }
  }
  EXPECT_EQ(divided_edge(kEqual, 4.0f), (std::vector<int64_t>{0, kPatchUnits / 4, kPatchUnits / 2, kPatchUnits / 4 * 3, kPatchUnits}));
}

TEST(Tessellator, FractionalPointsMoveContinuously) {
  // The position (f − n + 2j) / (2f) has the derivative (n − 2j) / (2f²), which is less than 1/(2f), because n − 2 < f. Both positions are
  // rounded by at most 1/2 unit, or by 3 units next to an end. Where n changes, new points appear next to the ends.
  const auto expect_near = [](const std::vector<int64_t>& from, const std::vector<int64_t>& to, double tolerance) {
    for (const int64_t p : from) {
      const auto is_near = [&](int64_t q) { return static_cast<double>(std::abs(p - q)) <= tolerance; };
      EXPECT_TRUE(std::ranges::any_of(to, is_near)) << p;
    }
  };
  Random random(8);
  for (int i = 0; i < effort(4000); ++i) {
    const TessellationSpacing spacing = random.pick({kEven, kOdd});
    const float from = random.coin() ? static_cast<float>(random.between(1, 63)) : random.real(1.0f, 63.0f);
    const float to = from + static_cast<float>(random.magnitude(1e-7, 1e-3));
    const std::vector<int64_t> before = divided_edge(spacing, from), after = divided_edge(spacing, to);
    const double tolerance = static_cast<double>(kPatchUnits) * (to - from) / (2.0 * from) + 4.0;
    expect_near(before, after, tolerance);
    expect_near(after, before, tolerance);
  }
}

// ---- levels ----------------------------------------------------------------------------------------------------

TEST(Tessellator, DiscardsPatchesByTheirRelevantOuterLevels) {
  for (const auto domain : {kTriangleDomain, kQuadDomain, kIsolineDomain}) {
    const std::size_t relevant = domain == kIsolineDomain ? 2 : corner_count(domain);
    for (const bool point_mode : {false, true}) {
      for (std::size_t i = 0; i < 4; ++i) {
        for (const float bad : {0.0f, -0.0f, -1.0f, -kInfiniteLevel, kNanLevel}) {
          PatchLevels levels = uniform_levels(5.0f);
          const TessellatorOptions options{.domain = domain, .spacing = kOdd, .point_mode = point_mode};
          Tessellation t = tessellated(options, levels);
          const auto coordinates = t.coordinates;
          levels.outer[i] = bad;
          tessellate(options, levels, t);
          if (i < relevant) {
            EXPECT_TRUE(t.coordinates.empty() && t.indices.empty());
          }
          if (i >= relevant) {
            EXPECT_EQ(t.coordinates, coordinates);
          }
        }
      }
    }
  }
}

TEST(Tessellator, LevelsAreClamped) {
  for (const auto domain : {kTriangleDomain, kQuadDomain, kIsolineDomain}) {
    for (const auto spacing : {kEqual, kEven, kOdd}) {
      const TessellatorOptions options{.domain = domain, .spacing = spacing};
      const auto coordinates = [&](const PatchLevels& levels) { return tessellated(options, levels).coordinates; };
      const float low = spacing == kEven ? 2.0f : 1.0f;
      const float tiny = std::numeric_limits<float>::denorm_min();
      EXPECT_EQ(coordinates(uniform_levels(tiny)), coordinates({{domain == kIsolineDomain ? 1.0f : low, low, low, low}, {low, low}}));
      for (const float inner : {-kInfiniteLevel, -1.0f, 0.0f, kNanLevel}) {
        EXPECT_EQ(coordinates({{5, 4, 3, 2}, {inner, 6}}), coordinates({{5, 4, 3, 2}, {low, 6}}));
        EXPECT_EQ(coordinates({{5, 4, 3, 2}, {6, inner}}), coordinates({{5, 4, 3, 2}, {6, low}}));
      }
      for (const float large : {64.0f, 64.5f, 1e30f, kInfiniteLevel}) {
        EXPECT_EQ(coordinates(uniform_levels(large)), coordinates({{64, 64, 64, 64}, {64, 64}}));
      }
    }
  }
  EXPECT_EQ(divided_edge(kEqual, kInfiniteLevel).size(), 65u);
  EXPECT_EQ(divided_edge(kEven, kInfiniteLevel), divided_edge(kEqual, 64.0f));
  EXPECT_EQ(divided_edge(kOdd, kInfiniteLevel), divided_edge(kEqual, 63.0f));
}

TEST(Tessellator, UndividedPatchesAreNotDivided) {
  for (const auto spacing : {kEqual, kOdd}) {
    const Tessellation triangle = tessellated({.spacing = spacing}, {{1, 0.5f, 1, 9}, {1, 9}});
    EXPECT_EQ(triangle.coordinates, (std::vector<glm::vec3>{{0, 0, 1}, {1, 0, 0}, {0, 1, 0}}));
    EXPECT_EQ(triangle.indices, (std::vector<uint32_t>{0, 1, 2}));
    const Tessellation quad = tessellated({.domain = kQuadDomain, .spacing = spacing}, {});
    EXPECT_EQ(quad.coordinates, (std::vector<glm::vec3>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}));
    EXPECT_EQ(quad.indices, (std::vector<uint32_t>{0, 1, 2, 0, 2, 3}));
  }
}

TEST(Tessellator, InnerLevelsOfOneAreRoundedUpIfAnotherLevelIsGreater) {
  // Two segments with equal spacing: the inner polygon is a point or a line. Three with odd spacing: it is 3 units inside the outline.
  const Tessellation fan = tessellated({}, {{1, 2, 1}});
  EXPECT_EQ(fan.coordinates.size(), 5u);
  EXPECT_EQ(fan.indices.size(), 12u);
  const Tessellation cross = tessellated({.domain = kQuadDomain}, {{1, 1, 1, 2}});
  EXPECT_EQ(cross.coordinates.back(), glm::vec3(0.5f, 0.5f, 0.0f));
  EXPECT_EQ(cross.indices.size(), 15u);
  const Tessellation line = tessellated({.domain = kQuadDomain}, {{1, 1, 1, 1}, {1, 3}});
  EXPECT_EQ((std::vector<glm::vec3>(line.coordinates.begin() + 4, line.coordinates.end())),
            (std::vector<glm::vec3>{{0.5f, line.coordinates[4].y, 0}, {0.5f, 1.0f - line.coordinates[4].y, 0}}));
  EXPECT_EQ(unit_point(tessellated({.spacing = kOdd}, {{1, 1.5f, 1}}).coordinates[5]), (UnitPoint{2, 2, kPatchUnits - 4}));
  const Tessellation thin = tessellated({.domain = kQuadDomain, .spacing = kOdd}, {{1, 1, 1, 1}, {1, 3}});
  EXPECT_EQ(unit_point(thin.coordinates[4]), (UnitPoint{kShortestUnits, (kPatchUnits - 1) / 3, 0}));
}

// ---- interiors -------------------------------------------------------------------------------------------------

/// Returns the largest difference between the coordinates of p, rotated by `turn` places, and the expected ones.
double largest_difference(const UnitPoint& p, const std::array<double, 3>& expected, std::size_t turn) {
  double largest = 0;
  for (std::size_t c = 0; c < 3; ++c) largest = std::max(largest, std::abs(static_cast<double>(p[(c + turn) % 3]) - expected[c]));
  return largest;
}

TEST(Tessellator, InnerTrianglesAreAtThePerpendicularsOfTheEdgePoints) {
  // Let p be the positions that divide an edge by the inner level. On inner triangle i, at the barycentric distance c = 2/3·p[i] from an
  // edge, the perpendicular through p[j] ends at the coordinates (1 − p[j] − c/2, p[j] − c/2, c). The implementation moves p[j] by at most
  // 1 unit, to a multiple of 3, and c/2 by at most 1/3 unit. In the center, the difference is at most 2/3 unit. All are less than 2 units.
  Random random(9);
  for (int i = 0; i < effort(40); ++i) {
    const TessellationSpacing spacing = random.pick({kEqual, kEven, kOdd});
    const float level = random.real(2.0f, 40.0f);
    const std::vector<UnitPoint> points = unit_points(tessellated({.spacing = spacing}, {{1, 1, 1}, {level}}));
    const std::vector<int64_t> p = divided_edge(spacing, level);
    for (std::size_t ring = 1; 2 * ring < p.size(); ++ring) {
      for (std::size_t k = ring; k + ring < p.size(); ++k) {
        const double half = static_cast<double>(p[ring]) / 3.0, along = static_cast<double>(p[k]);
        const std::array<double, 3> expected{static_cast<double>(kPatchUnits) - along - half, along - half, 2 * half};
        for (std::size_t turn = 0; turn < 3; ++turn) {
          const auto is_near = [&](const UnitPoint& q) { return largest_difference(q, expected, turn) < 2.0; };
          EXPECT_TRUE(std::ranges::any_of(points, is_near)) << level << ", ring " << ring << ", point " << k;
        }
      }
    }
  }
}

TEST(Tessellator, InnerTrianglesHaveStraightEdges) {
  // All vertices of inner triangle i have exactly the same distance from the nearest edge: their smallest coordinate. There are 3(n − 2i)
  // of them, and the corners count twice, because two coordinates are the smallest. In the center, these are u and v.
  Random random(12);
  for (int i = 0; i < effort(300); ++i) {
    const TessellationSpacing spacing = random.pick({kEqual, kEven, kOdd});
    const float level = std::max(random_level(random), 1.5f);
    std::map<int64_t, int> found;  // by distance, so beginning with the outline
    for (const UnitPoint& p : unit_points(tessellated({.spacing = spacing}, {{1, 1, 1}, {level}}))) {
      found[std::ranges::min(p)] += static_cast<int>(std::ranges::count(p, std::ranges::min(p)));
    }
    std::vector<int> counts, expected{3 * expected_level(spacing, 1.0).segments + 3};
    for (const auto& [distance, count] : found) counts.push_back(count);
    for (int left = expected_level(spacing, level).segments - 2; left >= 0; left -= 2) expected.push_back(left > 0 ? 3 * left + 3 : 2);
    ASSERT_EQ(counts, expected) << level;
  }
}

TEST(Tessellator, InnerVerticesOfQuadsAreAGrid) {
  // The first inner level divides u, as in figure 11.3.
  Random random(10);
  for (int i = 0; i < effort(200); ++i) {
    const TessellationSpacing spacing = random.pick({kEqual, kEven, kOdd});
    const PatchLevels levels{{2, 2, 2, 2}, {random.real(1.1f, 64.0f), random.real(1.1f, 64.0f)}};
    const std::vector<int64_t> u = divided_edge(spacing, levels.inner[0]), v = divided_edge(spacing, levels.inner[1]);
    std::vector<UnitPoint> inner = unit_points(tessellated({.domain = kQuadDomain, .spacing = spacing}, levels)), expected;
    std::erase_if(inner, [](const UnitPoint& p) { return p[0] % kPatchUnits == 0 || p[1] % kPatchUnits == 0; });
    for (std::size_t x = 1; x + 1 < u.size(); ++x) {
      for (std::size_t y = 1; y + 1 < v.size(); ++y) expected.push_back({u[x], v[y], 0});
    }
    std::ranges::sort(inner);
    std::ranges::sort(expected);
    ASSERT_EQ(inner, expected);
  }
}

TEST(Tessellator, UniformQuadsAreHalvedSquares) {
  // No edge is longer than the diagonal of a square. Each of the two positions of an edge is rounded by at most 1/2 unit.
  for (int n = 2; n <= 64; ++n) {
    const Tessellation t = tessellated({.domain = kQuadDomain}, uniform_levels(static_cast<float>(n)));
    const std::vector<UnitPoint> points = unit_points(t);
    for (std::size_t i = 0; i < t.indices.size(); ++i) {
      const UnitPoint &a = points[t.indices[i]], &b = points[t.indices[i % 3 == 2 ? i - 2 : i + 1]];
      for (std::size_t c = 0; c < 2; ++c) ASSERT_LE(static_cast<double>(std::abs(a[c] - b[c])), static_cast<double>(kPatchUnits) / n + 1.0);
    }
  }
}

/// Returns the sorted triangles that are inside or that connect inner vertices with outer edge `edge`. A triangle with a single vertex on
/// the outline that is a corner can belong to two edges and is left out.
std::vector<UnitTriangle> inner_and_edge_triangles(TessellationDomain domain, const Tessellation& t, std::size_t edge) {
  const std::vector<UnitPoint> points = unit_points(t);
  std::vector<UnitTriangle> triangles;
  for (std::size_t i = 0; i < t.indices.size(); i += 3) {
    UnitTriangle triangle{points[t.indices[i]], points[t.indices[i + 1]], points[t.indices[i + 2]]};
    int on_edges = 0, on_other_edges = 0, corners = 0;
    for (const UnitPoint& p : triangle) {
      int touched = 0;
      for (std::size_t e = 0; e < corner_count(domain); ++e) touched += on_edge(domain, p, e);
      on_edges += touched > 0;
      corners += touched > 1;
      on_other_edges += touched > 0 && !on_edge(domain, p, edge);
    }
    std::ranges::sort(triangle);
    if (on_other_edges == 0 && !(on_edges == 1 && corners == 1)) triangles.push_back(triangle);
  }
  std::ranges::sort(triangles);
  return triangles;
}

TEST(Tessellator, TrianglesDependOnlyOnTheLevelsNextToThem) {
  // Section A.4, rules 5, 6 and 7: neither the winding nor the levels of the other outer edges change the triangles.
  Random random(11);
  for (int i = 0; i < effort(1000); ++i) {
    TessellatorOptions options = random_options(random);
    const std::size_t edge = static_cast<std::size_t>(random.below(static_cast<int>(corner_count(options.domain))));
    PatchLevels levels = random_levels(random);
    for (float& level : levels.inner) level = std::max(level, 1.5f);  // not 1, so that no other level changes its meaning
    const auto before = inner_and_edge_triangles(options.domain, tessellated(options, levels), edge);
    for (std::size_t e = 0; e < 4; ++e) {
      if (e != edge) levels.outer[e] = random_level(random);
    }
    options.clockwise = !options.clockwise;
    ASSERT_EQ(inner_and_edge_triangles(options.domain, tessellated(options, levels), edge), before);
  }
}

TEST(Tessellator, IsolinesAreEquallySpacedAndEndBelowOne) {
  for (const auto spacing : {kEqual, kEven, kOdd}) {
    for (const float level : {1.0f, 2.0f, 3.7f, 12.0f, 64.0f}) {
      const Tessellation t = tessellated({.domain = kIsolineDomain, .spacing = spacing}, {{4.5f, level}});
      const std::vector<int64_t> v = divided_edge(kEqual, 5.0f), u = divided_edge(spacing, level);
      std::vector<std::pair<UnitPoint, UnitPoint>> lines, expected;
      for (std::size_t i = 0; i < t.indices.size(); i += 2) {
        lines.emplace_back(unit_point(t.coordinates[t.indices[i]]), unit_point(t.coordinates[t.indices[i + 1]]));
      }
      for (std::size_t y = 0; y < 5; ++y) {
        for (std::size_t x = 1; x < u.size(); ++x) expected.push_back({{u[x - 1], v[y], 0}, {u[x], v[y], 0}});
      }
      EXPECT_EQ(lines, expected);
    }
  }
}

TEST(Tessellator, KeepsTheMemoryOfTheOutput) {
  Tessellation t = tessellated({.domain = kQuadDomain}, uniform_levels(64.0f));
  const glm::vec3* coordinates = t.coordinates.data();
  const uint32_t* indices = t.indices.data();
  tessellate({}, uniform_levels(0.0f), t);
  tessellate({.domain = kQuadDomain, .spacing = kEven}, uniform_levels(63.5f), t);
  EXPECT_EQ(t.coordinates.data(), coordinates);
  EXPECT_EQ(t.indices.data(), indices);
}

}  // namespace
}  // namespace halfspace::raster_test
