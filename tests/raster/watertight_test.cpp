// SPDX-License-Identifier: Apache-2.0
//
// Meshes with shared vertices must cover every interior sample exactly once: additive blending must give 1 everywhere, without holes or
// overlaps. The reference counts crossings of the mesh outline in integer arithmetic. The result for samples on the outline is therefore
// also well-defined, and there is no tolerance.
#include <algorithm>
#include <cmath>

#include "raster/raster_test.h"

namespace halfspace::raster_test {
namespace {

struct FixedMesh {
  std::vector<Point> points;
  std::vector<uint32_t> indices;
  std::vector<Point> outline;  // closed, without self-intersections; if empty, the mesh covers the whole target
};

int64_t cross(const Point& a, const Point& b, const Point& c) {
  return (int64_t{b.x} - a.x) * (int64_t{c.y} - a.y) - (int64_t{b.y} - a.y) * (int64_t{c.x} - a.x);
}

/// Returns which pixel centers of a row are inside, after nudging them by an infinitesimal step to the right and a far smaller one up. For
/// each center, counts how often the outline crosses the ray to the right. An edge straddles the ray if exactly one endpoint is above it
/// (the upward nudge breaks ties for endpoints on the ray). The ray crosses such an edge if the edge passes strictly to the right of the
/// center (the nudge to the right breaks ties for edges through the center).
std::vector<bool> inside_outline(const std::vector<Point>& outline, int y, int width) {
  std::vector<bool> toggles(static_cast<std::size_t>(width) + 1);
  const int64_t sy = int64_t{y} * 256 + 128;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    Point a = outline[i], b = outline[(i + 1) % outline.size()];
    if ((a.y > sy) == (b.y > sy)) continue;
    if (a.y > b.y) std::swap(a, b);
    // Toggles the centers x with (256·x + 128 − a.x)·(b.y − a.y) < (b.x − a.x)·(sy − a.y). These are all x below a bound.
    const int64_t dy = int64_t{b.y} - a.y, divisor = 256 * dy;
    const int64_t bound = (int64_t{b.x} - a.x) * (sy - a.y) + (int64_t{a.x} - 128) * dy;
    const int64_t below = bound / divisor + (bound % divisor > 0 ? 1 : 0);  // rounded up
    const auto end = static_cast<std::size_t>(std::clamp<int64_t>(below, 0, width));
    toggles[end] = !toggles[end];
  }
  std::vector<bool> inside(static_cast<std::size_t>(width));
  bool now = false;
  for (std::size_t x = static_cast<std::size_t>(width); x-- > 0;) {
    now = now != toggles[x + 1];
    inside[x] = now;
  }
  return inside;
}

class WatertightCheck {
 public:
  void check(const FixedMesh& mesh, int width, int height, int batch = 0) {
    std::vector<glm::vec4> positions;
    for (const Point& p : mesh.points) positions.push_back(clip_position(p, width, height));
    Image<glm::vec4> image(width, height);
    count_coverage(image, positions, mesh.indices, {}, {.tuning = {.tile_size = 8 << (batch % 4)}});
    for (int y = 0; y < height; ++y) {
      const std::vector<bool> inside_row = inside_outline(mesh.outline, y, width);
      for (int x = 0; x < width; ++x) {
        const bool want = mesh.outline.empty() || inside_row[static_cast<std::size_t>(x)];
        const float count = pixel(image, x, y).x;
        ++samples_;
        inside_ += want;
        if (count == (want ? 1.0f : 0.0f)) continue;
        ++(count < 1.0f ? holes_ : doubles_);
        if (holes_ + doubles_ < 10) ADD_FAILURE() << "pixel " << x << ", " << y << " drawn " << count << " times; expected " << want;
      }
    }
  }

  int64_t inside() const { return inside_; }
  void report() const {
    std::printf("%lld samples, %lld inside, %lld holes, %lld double hits\n", static_cast<long long>(samples_),
                static_cast<long long>(inside_), static_cast<long long>(holes_), static_cast<long long>(doubles_));
    ::testing::Test::RecordProperty("inside", std::to_string(inside_));
    ::testing::Test::RecordProperty("holes", std::to_string(holes_));
    ::testing::Test::RecordProperty("double_hits", std::to_string(doubles_));
  }

 private:
  int64_t samples_ = 0, inside_ = 0, holes_ = 0, doubles_ = 0;
};

/// Returns a fan around the center. The ring is in counter-clockwise order, with angles below 180° between neighbors. Triangles have random
/// winding, because nothing may depend on it.
FixedMesh make_fan(Random& r, const Point& center, const std::vector<Point>& ring) {
  FixedMesh m{{center}, {}, ring};
  m.points.insert(m.points.end(), ring.begin(), ring.end());
  const auto n = static_cast<uint32_t>(ring.size());
  for (uint32_t i = 0; i < n; ++i) {
    std::array<uint32_t, 3> t{0, 1 + i, 1 + (i + 1) % n};
    std::rotate(t.begin(), t.begin() + r.integer(0, 2), t.end());
    if (r.coin()) std::swap(t[0], t[1]);
    m.indices.insert(m.indices.end(), t.begin(), t.end());
  }
  return m;
}

/// Sorts the candidates by angle around the center and keeps those that form a valid fan. Returns an empty ring if that is not possible.
std::vector<Point> make_ring(const Point& center, std::vector<Point> candidates) {
  const auto half = [&](const Point& p) { return p.y > center.y || (p.y == center.y && p.x > center.x) ? 0 : 1; };
  std::erase_if(candidates, [&](const Point& p) { return p == center; });
  std::sort(candidates.begin(), candidates.end(),
            [&](const Point& a, const Point& b) { return half(a) != half(b) ? half(a) < half(b) : cross(center, a, b) > 0; });
  std::vector<Point> ring;
  for (const Point& p : candidates) {
    if (ring.empty() || half(ring.back()) != half(p) || cross(center, ring.back(), p) > 0) ring.push_back(p);
  }
  for (std::size_t i = 0; i < ring.size(); ++i) {
    if (cross(center, ring[i], ring[(i + 1) % ring.size()]) <= 0) return {};
  }
  return ring;
}

Point on_center(int x, int y) { return {x * 256 + 128, y * 256 + 128}; }
Point snap_to(const Point& p, int grid) {  // grid 1: anywhere; 128: pixel centers and corners; 256: centers
  return grid == 256 ? Point{(p.x & ~255) + 128, (p.y & ~255) + 128} : Point{p.x - p.x % grid, p.y - p.y % grid};
}

TEST(Watertight, RandomFansAreWatertight) {
  Random r(1);
  WatertightCheck check;
  for (int i = 0; i < effort(1500); ++i) {
    const int grid = i % 3 == 0 ? 1 : i % 3 == 1 ? 128 : 256;
    const auto anywhere = [&](int reach) {
      return snap_to({r.integer(-reach * 256, (128 + reach) * 256), r.integer(-reach * 256, (128 + reach) * 256)}, grid);
    };
    const Point center = anywhere(0);
    std::vector<Point> candidates(static_cast<std::size_t>(r.integer(3, 40)));
    for (Point& p : candidates) p = anywhere(r.coin() ? 10 : 1 << r.integer(3, 13));
    const std::vector<Point> ring = make_ring(center, candidates);
    if (!ring.empty()) check.check(make_fan(r, center, ring), 128, 128, i);
  }
  check.report();
  EXPECT_GT(check.inside(), effort(1500) * 1000);
}

/// Returns a triangle strip that alternates between a lower and an upper row of vertices, from left to right.
FixedMesh make_strip(Random& r, const std::vector<Point>& lower, const std::vector<Point>& upper) {
  FixedMesh m;
  for (std::size_t i = 0; i < lower.size(); ++i) {
    m.points.push_back(lower[i]);
    m.points.push_back(upper[i]);
  }
  for (uint32_t i = 0; i + 2 < m.points.size(); ++i) {
    if (i % 2 == 0) {
      m.indices.insert(m.indices.end(), {i, i + 2, i + 1});
    } else {
      m.indices.insert(m.indices.end(), {i, i + 1, i + 2});
    }
    if (r.coin()) std::swap(m.indices[m.indices.size() - 1], m.indices[m.indices.size() - 2]);
  }
  m.outline = lower;
  m.outline.insert(m.outline.end(), upper.rbegin(), upper.rend());
  return m;
}

TEST(Watertight, RandomStripsAreWatertight) {
  Random r(2);
  WatertightCheck check;
  for (int i = 0; i < effort(1000); ++i) {
    const int grid = i % 3 == 0 ? 1 : i % 3 == 1 ? 128 : 256;
    std::vector<Point> lower, upper;
    // Columns are strictly ordered from left to right, so that no triangle folds over. The steps are between a sub-pixel and 40 px.
    for (int x = r.integer(-20 * 256, 0); x < 150 * 256;
         x += grid * r.integer(1, 1 << r.integer(0, 13 - static_cast<int>(std::bit_width(static_cast<unsigned>(grid)))))) {
      lower.push_back(snap_to({x, r.integer(-10 * 256, 60 * 256)}, grid));
      upper.push_back(snap_to({x, r.integer(61 * 256, 140 * 256)}, grid));
      if (lower.size() > 2000) break;
    }
    check.check(make_strip(r, lower, upper), 128, 128, i);
  }
  check.report();
  EXPECT_GT(check.inside(), effort(1000) * 1000);
}

TEST(Watertight, JitteredGridsCoverEverything) {
  Random r(3);
  WatertightCheck check;
  for (int i = 0; i < effort(300); ++i) {
    const int plane = 256 * (1 << r.integer(0, 5)) / (i % 5 == 0 ? 8 : 1);  // from 1/8 px to 32 px
    const int size = plane < 256 ? 16 : plane < 1024 ? 64 : 128;            // of the target
    const int n = size * 256 / plane + 3;
    FixedMesh m;
    for (int y = 0; y < n; ++y) {
      for (int x = 0; x < n; ++x) {
        // Less than a quarter of a cell, so that the triangles of a cell keep their orientation for either diagonal.
        const int jitter = i % 4 == 0 ? 0 : plane / 4 - 1;
        m.points.push_back({(x - 1) * plane + r.integer(-jitter, jitter) + (i % 2 ? 128 : 0),
                            (y - 1) * plane + r.integer(-jitter, jitter) + (i % 2 ? 128 : 0)});
      }
    }
    for (int y = 0; y + 1 < n; ++y) {
      for (int x = 0; x + 1 < n; ++x) {
        const auto a = static_cast<uint32_t>(y * n + x), b = a + 1, c = a + static_cast<uint32_t>(n), d = c + 1;
        if (r.coin()) {
          m.indices.insert(m.indices.end(), {a, b, c, b, d, c});
        } else {
          m.indices.insert(m.indices.end(), {a, b, d, a, d, c});
        }
      }
    }
    check.check(m, size, size, i);
  }
  check.report();
}

// ---- shared edges and vertices exactly on samples ----------------------------------------------------------------

// The quad from issue 9 of facebookresearch/DRTK, whose diagonal passes through samples. Each of its 6x6 samples must be drawn once, for
// either vertex order of the second triangle. Samples are at integer coordinates in DRTK and at half-integers here. 0.49993896484375 = 0.5
// - 2^-14 and 6.50006103515625 = 6.5 + 2^-14.
TEST(Watertight, QuadOfDrtkIssue9IsWatertight) {
  const std::array<glm::vec2, 4> corners{
      {{0.5f, 0.49993896484375f}, {0.5f, 6.5f}, {6.50006103515625f, 0.49993896484375f}, {6.50006103515625f, 6.5f}}};
  std::vector<glm::vec4> positions;
  for (const glm::vec2& c : corners) positions.emplace_back((c + 0.5f) / 4.0f - 1.0f, 0.0f, 1.0f);
  for (const std::vector<uint32_t>& triangles : {std::vector<uint32_t>{0, 1, 2, 3, 2, 1}, {0, 1, 2, 3, 1, 2}}) {
    Image<glm::vec4> image(8, 8);
    count_coverage(image, positions, triangles);
    for (int y = 0; y < 8; ++y) {
      for (int x = 0; x < 8; ++x) {
        const bool inside = x >= 1 && x <= 6 && y >= 1 && y <= 6;
        EXPECT_EQ(pixel(image, x, y).x, inside ? 1.0f : 0.0f) << x << ", " << y;
      }
    }
  }
}

// All spokes of the fan pass through pixel centers, because they start at a center and extend along multiples of small integer steps. With
// distant endpoints, the barycentric coordinates of samples on a spoke are quotients of large products, which float arithmetic may round to
// either side.
TEST(Watertight, SpokesThroughPixelCentersAreWatertight) {
  Random r(4);
  WatertightCheck check;
  for (int i = 0; i < effort(1500); ++i) {
    const Point center = on_center(r.integer(0, 127), r.integer(0, 127));
    std::vector<Point> candidates;
    for (int k = r.integer(3, 24); k > 0; --k) {
      const int dx = r.integer(-7, 7), dy = r.integer(-7, 7), times = 1 << r.integer(0, 11);
      candidates.push_back({center.x + dx * times * 256, center.y + dy * times * 256});
    }
    const std::vector<Point> ring = make_ring(center, candidates);
    if (!ring.empty()) check.check(make_fan(r, center, ring), 128, 128, i);
  }
  check.report();
  EXPECT_GT(check.inside(), effort(1500) * 1000);
}

// These edges also pass through pixel centers, but do not end at them. The endpoints are far outside the target, at different distances
// from the samples on the edge.
TEST(Watertight, DistantEdgesThroughPixelCentersAreWatertight) {
  Random r(5);
  WatertightCheck check;
  for (int i = 0; i < effort(600); ++i) {
    // Quads that cover the width and height of the target, split along diagonals through center q with odd steps.
    const Point q = on_center(r.integer(32, 96), r.integer(32, 96));
    const int dx = 2 * r.integer(0, 400) + 1, dy = 2 * r.integer(0, 400) + 1, sign = r.coin() ? 1 : -1;
    const int far = 40 * 256 / std::max(1, std::min(dx, dy) / 256 + 1);
    const int m = r.integer(1, far) + 64 * 256 / std::max(dx, dy), n = r.integer(1, far) + 64 * 256 / std::max(dx, dy);
    const Point a{q.x - m * dx, q.y - sign * m * dy}, b{q.x + n * dx, q.y + sign * n * dy};
    constexpr int kMaxCount = 16384 * 256;
    const auto reachable = [](const Point& p) { return std::abs(p.x) < kMaxCount && std::abs(p.y) < kMaxCount; };
    if (!reachable(a) || !reachable(b)) continue;
    const Point c{r.integer(-kMaxCount, kMaxCount), r.integer(-kMaxCount, kMaxCount)},
        d{r.integer(-kMaxCount, kMaxCount), r.integer(-kMaxCount, kMaxCount)};
    if ((cross(a, b, c) > 0) == (cross(a, b, d) > 0)) continue;
    FixedMesh mesh{{a, b, c, d}, {0, 1, 2, 1, 0, 3}, {a, c, b, d}};
    check.check(mesh, 128, 128, i);
  }
  check.report();
  EXPECT_GT(check.inside(), 10000);
}

// Horizontal, vertical and diagonal edges through pixel centers, at the far end of the largest target. A float barycentric has no bits left
// for rounding at coordinates such as 8191.5.
TEST(Watertight, AxisAlignedAndDiagonalEdgesAtLargeCoordinatesAreWatertight) {
  Random r(6);
  WatertightCheck check;
  constexpr int kLargestWidth = 16384, kFewRows = 16;
  for (int i = 0; i < effort(24); ++i) {
    FixedMesh m;
    // Rows and columns pass through pixel centers. A 45° diagonal through pixel centers splits each cell.
    const int step = 4 << (i % 3);
    const int columns = kLargestWidth / step + 2, rows = kFewRows / step + 3;
    for (int y = 0; y < rows; ++y) {
      for (int x = 0; x < columns; ++x) m.points.push_back(on_center((x - 1) * step, (y - 1) * step));
    }
    for (int y = 0; y + 1 < rows; ++y) {
      for (int x = 0; x + 1 < columns; ++x) {
        const auto a = static_cast<uint32_t>(y * columns + x), b = a + 1, c = a + static_cast<uint32_t>(columns), d = c + 1;
        if (r.coin()) {
          m.indices.insert(m.indices.end(), {a, b, c, b, d, c});
        } else {
          m.indices.insert(m.indices.end(), {a, d, b, a, d, c});
        }
      }
    }
    m.outline = {m.points[0], m.points[static_cast<std::size_t>(columns - 1)], m.points.back(),
                 m.points[m.points.size() - static_cast<std::size_t>(columns)]};
    check.check(m, kLargestWidth, kFewRows, i);
  }
  check.report();
}

// ---- perspective and clip planes -------------------------------------------------------------------------------

// A closed surface around the eye must cover every pixel exactly once, even if its triangles cross the near plane, guard planes and w = 0.
struct Surface {
  std::vector<glm::dvec3> points;
  std::vector<uint32_t> indices;
};

Surface octahedron() {
  return {{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}},
          {0, 2, 4, 2, 1, 4, 1, 3, 4, 3, 0, 4, 2, 0, 5, 1, 2, 5, 3, 1, 5, 0, 3, 5}};
}

Surface tetrahedron() { return {{{1, 1, 1}, {-1, -1, 1}, {-1, 1, -1}, {1, -1, -1}}, {0, 1, 2, 0, 3, 1, 0, 2, 3, 1, 3, 2}}; }

// Splits every triangle into four. Shared edges share their midpoints.
Surface subdivide(const Surface& s) {
  Surface out{s.points, {}};
  std::vector<std::pair<uint64_t, uint32_t>> middles;
  const auto middle = [&](uint32_t a, uint32_t b) {
    const uint64_t key = uint64_t{std::min(a, b)} << 32 | std::max(a, b);
    for (const auto& [k, i] : middles) {
      if (k == key) return i;
    }
    middles.emplace_back(key, static_cast<uint32_t>(out.points.size()));
    out.points.push_back(glm::normalize(s.points[a] + s.points[b]));
    return middles.back().second;
  };
  for (std::size_t i = 0; i < s.indices.size(); i += 3) {
    const uint32_t a = s.indices[i], b = s.indices[i + 1], c = s.indices[i + 2];
    const uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
    out.indices.insert(out.indices.end(), {a, ab, ca, ab, b, bc, ca, bc, c, ab, bc, ca});
  }
  return out;
}

glm::dmat3 random_rotation(Random& r) {
  const glm::dvec3 a = glm::normalize(glm::dvec3(r.real(-1.0, 1.0), r.real(-1.0, 1.0), r.real(-1.0, 1.0)));
  const glm::dvec3 b = glm::normalize(glm::cross(a, glm::dvec3(r.real(-1.0, 1.0), r.real(-1.0, 1.0), r.real(-1.0, 1.0))));
  return {a, b, glm::cross(a, b)};
}

struct Projection {
  double scale_x, scale_y, near;
  ClipDepth depth;
  double far = 1e5;

  glm::vec4 operator()(const glm::dvec3& p) const {  // p is in eye space, looking along −z
    const double w = -p.z;
    double z = near;  // reversed Z with an infinite far plane: z/w = near/w
    if (depth == ClipDepth::negative_one_to_one) z = (w * (far + near) - 2 * far * near) / (far - near);
    return {static_cast<float>(p.x * scale_x), static_cast<float>(p.y * scale_y), static_cast<float>(z), static_cast<float>(w)};
  }
};

Projection random_projection(Random& r, double near) {
  const double half_angle = r.real(0.01, 1.4);  // up to 160°
  const double s = 1 / std::tan(half_angle);
  return {s, s * r.real(0.5, 2.0), near, r.coin() ? ClipDepth::zero_to_one : ClipDepth::negative_one_to_one};
}

DrawState state_of(const Projection& p) {
  DrawState state;
  state.depth.clip = p.depth;
  return state;
}

struct Counts {
  int64_t samples = 0, holes = 0, doubles = 0;
  uint64_t clipped = 0;
  void add(float count, float want, int x, int y, int i, bool complain = true) {
    ++samples;
    if (count == want) return;
    ++(count < want ? holes : doubles);
    if (complain && holes + doubles < 10) ADD_FAILURE() << "mesh " << i << ", pixel " << x << ", " << y << " drawn " << count << " times";
  }
  void report() const {
    std::printf("%lld samples, %lld holes, %lld double hits, %llu triangles clipped\n", static_cast<long long>(samples),
                static_cast<long long>(holes), static_cast<long long>(doubles), static_cast<unsigned long long>(clipped));
    ::testing::Test::RecordProperty("samples", std::to_string(samples));
    ::testing::Test::RecordProperty("holes", std::to_string(holes));
    ::testing::Test::RecordProperty("double_hits", std::to_string(doubles));
  }
};

TEST(WatertightClipped, ClosedSurfacesAroundTheEyeCoverEverything) {
  Random r(7);
  Counts counts;
  const std::array<Surface, 4> surfaces{tetrahedron(), octahedron(), subdivide(octahedron()), subdivide(subdivide(octahedron()))};
  for (int i = 0; i < effort(3000); ++i) {
    const Surface& surface = surfaces[static_cast<std::size_t>(i % 4)];
    // The eye is well inside a convex body, and so is the near plane at 0.001.
    const glm::dmat3 turn = random_rotation(r);
    const glm::dvec3 eye(r.real(-0.15, 0.15), r.real(-0.15, 0.15), r.real(-0.15, 0.15));
    const double size = r.magnitude(1.0, 1000.0);
    const Projection project = random_projection(r, 0.001);
    std::vector<glm::vec4> positions;
    for (const glm::dvec3& p : surface.points) positions.push_back(project(turn * ((p - eye) * size)));
    Image<glm::vec4> image(128, 128);
    counts.clipped += count_coverage(image, positions, surface.indices, state_of(project)).clipped;
    for (int y = 0; y < 128; ++y) {
      for (int x = 0; x < 128; ++x) counts.add(pixel(image, x, y).x, 1.0f, x, y, i);
    }
  }
  counts.report();
  EXPECT_GT(counts.clipped, static_cast<uint64_t>(effort(3000)));
}

// A plane that passes near the eye, drawn as a fan with its rim far behind and to the side. The near plane, w = 0 and the guard planes cut
// it. The fan must cover every sample whose ray intersects the plane between near and far. This is evaluated at 4 points 1/256 px from the
// sample; if they disagree, either result is accepted.
class PlaneFan {
 public:
  PlaneFan(Random& r, const Projection& projection, int spokes) : project_(projection) {
    const glm::dmat3 turn = random_rotation(r);
    const glm::dvec3 middle(r.real(-0.5, 0.5) / project_.scale_x, r.real(-0.5, 0.5) / project_.scale_y, -1.0);
    // Half of the fans have their center in view. For the others it is between the eye and the near plane, or behind the eye, so that the
    // near plane cuts narrow wedges.
    const double depth = (r.coin() ? r.magnitude(2.0, 200.0) : r.real(-5.0, 1.0)) * project_.near;
    normal_ = turn[2];
    offset_ = glm::dot(normal_, middle * depth);
    points_.push_back(middle * depth);
    const int n = spokes;
    const double start = r.real(0.0, 6.0);
    for (int i = 0; i < n; ++i) {
      // The rim is so far away that it is either beyond the far plane or practically on the horizon of the plane.
      const double angle = start + (i + r.real(0.0, 0.8)) * 2 * 3.14159265358979 / n;
      points_.push_back(middle * depth + r.magnitude(1e7, 1e9) * (std::cos(angle) * turn[0] + std::sin(angle) * turn[1]));
    }
    for (uint32_t i = 0; i < static_cast<uint32_t>(n); ++i)
      indices_.insert(indices_.end(), {0, 1 + i, 1 + (i + 1) % static_cast<uint32_t>(n)});
  }

  std::vector<glm::vec4> positions() const {
    std::vector<glm::vec4> p;
    for (const glm::dvec3& q : points_) p.push_back(project_(q));
    return p;
  }
  const std::vector<uint32_t>& indices() const { return indices_; }

  // Returns whether the distance along the view direction is between near and far, at window position (x, y) of a size × size target.
  bool covers(double x, double y, double size) const {
    const glm::dvec3 ray((2 * x / size - 1) / project_.scale_x, (2 * y / size - 1) / project_.scale_y, -1.0);
    const double w = offset_ / glm::dot(normal_, ray);  // the end of the ray has w = 1
    return w >= project_.near && w <= project_.far;
  }

 private:
  Projection project_;
  glm::dvec3 normal_;
  double offset_;
  std::vector<glm::dvec3> points_;
  std::vector<uint32_t> indices_;
};

struct FanResult {
  Counts counts;
  int64_t inside = 0, undecided = 0, cut_in_view = 0;
};

FanResult draw_fans(uint64_t seed, int fans, double max_spokes, bool complain) {
  Random r(seed);
  FanResult result;
  constexpr int kSize = 128;
  for (int i = 0; i < fans; ++i) {
    Projection projection = random_projection(r, 0.1);
    projection.depth = ClipDepth::negative_one_to_one;  // the far plane hides the rim
    projection.far = 1e4;
    const PlaneFan fan(r, projection, static_cast<int>(r.magnitude(4.0, max_spokes)));  // with at least 4 spokes, no angle reaches 180°
    Image<glm::vec4> image(kSize, kSize);
    result.counts.clipped += count_coverage(image, fan.positions(), fan.indices(), state_of(projection)).clipped;
    bool any_inside = false, any_outside = false;
    for (int y = 0; y < kSize; ++y) {
      for (int x = 0; x < kSize; ++x) {
        constexpr double d = 1.0 / 256;
        const double cx = x + 0.5, cy = y + 0.5;
        const int votes = fan.covers(cx - d, cy - d, kSize) + fan.covers(cx + d, cy - d, kSize) + fan.covers(cx - d, cy + d, kSize) +
                          fan.covers(cx + d, cy + d, kSize);
        const float count = pixel(image, x, y).x;
        if (votes % 4 != 0) {
          ++result.undecided;
          EXPECT_LE(count, complain ? 1.0f : 3.0f);
          continue;
        }
        (votes != 0 ? any_inside : any_outside) = true;
        result.inside += votes != 0;
        result.counts.add(count, votes != 0 ? 1.0f : 0.0f, x, y, i, complain);
      }
    }
    result.cut_in_view += any_inside && any_outside;
  }
  result.counts.report();
  std::printf(
      "%lld inside, %lld within 1/256 px of near or far, %lld of %d "
      "fans cut in view\n",
      static_cast<long long>(result.inside), static_cast<long long>(result.undecided), static_cast<long long>(result.cut_in_view), fans);
  return result;
}

TEST(WatertightClipped, FansAcrossNearAndGuardPlanesAreWatertight) {
  const FanResult f = draw_fans(8, effort(1200), 60, true);
  EXPECT_EQ(f.counts.holes, 0);
  EXPECT_EQ(f.counts.doubles, 0);
  EXPECT_GT(f.cut_in_view, effort(1200) / 3);
  EXPECT_LT(f.undecided, f.inside / 100);
}

// With thousands of spokes, wedges become narrower than 1/256 px, and snapping can invert them, as it can any sliver. Adjacent triangles
// then overlap by less than a sub-pixel, and a sample in the overlap is drawn more than once. This is inherent to snapped positions, as in
// Direct3D. It is rare, and holes never occur.
TEST(WatertightClipped, SliverFansHaveNoHolesAndFewDoubleHits) {
  const FanResult f = draw_fans(9, effort(1200), 3000, false);
  EXPECT_EQ(f.counts.holes, 0);
  EXPECT_LE(f.counts.doubles, f.counts.samples / 1000000 + 2);
}

}  // namespace
}  // namespace halfspace::raster_test
