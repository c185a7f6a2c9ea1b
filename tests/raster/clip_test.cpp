// SPDX-License-Identifier: Apache-2.0
//
// Tests the clip stage with hand-computed cases, by its invariants, and in whole passes against an exact homogeneous rasterizer (after
// Olano and Greer, "Triangle scan conversion using 2D homogeneous coordinates", 1997). The reference does not divide, clip or snap, and
// computes every sign in 128-bit integers.
#include "halfspace/raster/primitives/clip.h"

#include <algorithm>
#include <limits>
#include <optional>

#include "raster/raster_test.h"

namespace halfspace::raster_test {
namespace {

__extension__ using Wide = __int128;

const DepthState kGl{};                                       // −w ≤ z ≤ w
const DepthState kZeroToOne{.clip = ClipDepth::zero_to_one};  // 0 ≤ z ≤ w
const DepthState kClamped{.clip = ClipDepth::zero_to_one, .clamp = true};

using ClipTriangle = std::array<glm::vec4, 3>;

DrawState with(const DepthState& depth) {
  DrawState s;
  s.depth = depth;
  return s;
}

Viewport viewport_64() { return make_viewport({0, 0, 64, 64}, kGl); }  // guard planes slightly inside ±511·w

bool same_bits(const glm::dvec4& a, const glm::dvec4& b) { return std::memcmp(&a, &b, sizeof a) == 0; }

// ---- hand-computed cases ---------------------------------------------------------------------------------------

TEST(Clip, LeavesInsideTrianglesUnchanged) {
  const ClipTriangle t{{{-1, -1, 0, 1}, {2, 0, 0.5f, 2}, {0, 3, -0.5f, 4}}};
  const ClipPolygon p = clip_triangle(viewport_64(), kGl, t);
  ASSERT_EQ(p.count, 3);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_TRUE(same_bits(p.corners[i].pos_clip, glm::dvec4(t[i])));
}

TEST(Clip, NearPlaneCutOfOneVertexGivesAQuad) {
  // One vertex has z = −1 and the others have z = 1, so the near plane (z = 0) cuts both edges in the middle.
  const ClipPolygon p = clip_triangle(viewport_64(), kZeroToOne, {{{0, 0, -1, 2}, {2, 0, 1, 2}, {0, 2, 1, 4}}});
  ASSERT_EQ(p.count, 4);
  EXPECT_EQ(p.corners[0].pos_clip, glm::dvec4(1, 0, 0, 2));
  EXPECT_EQ(p.corners[0].weights, glm::dvec3(0.5, 0.5, 0));
  EXPECT_EQ(p.corners[1].pos_clip, glm::dvec4(2, 0, 1, 2));
  EXPECT_EQ(p.corners[2].pos_clip, glm::dvec4(0, 2, 1, 4));
  EXPECT_EQ(p.corners[3].pos_clip, glm::dvec4(0, 1, 0, 3));
  EXPECT_EQ(p.corners[3].weights, glm::dvec3(0.5, 0, 0.5));
}

TEST(Clip, NearPlaneCutOfTwoVerticesGivesATriangle) {
  // For OpenGL's near plane, z ≥ −w, vertex 0 is inside by 2 and the others are outside by 2.
  const ClipPolygon p = clip_triangle(viewport_64(), kGl, {{{0, 0, 1, 1}, {1, 0, -3, 1}, {0, 1, -3, 1}}});
  ASSERT_EQ(p.count, 3);
  EXPECT_EQ(p.corners[0].pos_clip, glm::dvec4(0, 0, 1, 1));
  EXPECT_EQ(p.corners[1].pos_clip, glm::dvec4(0.5, 0, -1, 1));
  EXPECT_EQ(p.corners[2].pos_clip, glm::dvec4(0, 0.5, -1, 1));
}

TEST(Clip, FarPlaneCutGivesAQuad) {
  for (const DepthState& depth : {kGl, kZeroToOne}) {
    const ClipPolygon p = clip_triangle(viewport_64(), depth, {{{0, 0, 0.5f, 1}, {1, 0, 1.5f, 1}, {0, 1, 0.5f, 1}}});
    ASSERT_EQ(p.count, 4);
    EXPECT_EQ(p.corners[1].pos_clip, glm::dvec4(0.5, 0, 1, 1));
    EXPECT_EQ(p.corners[2].pos_clip, glm::dvec4(0.5, 0.5, 1, 1));
  }
}

TEST(Clip, DepthClampDisablesNearAndFarClipping) {
  const ClipTriangle t{{{0, 0, -5, 1}, {1, 0, 7, 1}, {0, 1, 0.5f, 1}}};
  const ClipPolygon p = clip_triangle(viewport_64(), kClamped, t);
  ASSERT_EQ(p.count, 3);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_TRUE(same_bits(p.corners[i].pos_clip, glm::dvec4(t[i])));
}

TEST(Clip, TrianglesBehindTheEyeAreRemoved) {
  for (const DepthState& depth : {kGl, kZeroToOne, kClamped}) {
    EXPECT_EQ(clip_triangle(viewport_64(), depth, {{{0, 0, 0, -1}, {1, 0, 0, -1}, {0, 1, 0, -2}}}).count, 0);
    EXPECT_EQ(clip_triangle(viewport_64(), depth, {{{0, 0, 0, 0}, {1, 0, 0, 0}, {0, 1, 0, 0}}}).count, 0);
    EXPECT_EQ(clip_triangle(viewport_64(), depth, {{{-3, 1, 0, 0}, {2, 5, 0, -1}, {-1, -1, 0, -0.0f}}}).count, 0);
  }
}

TEST(Clip, TrianglesBeyondNearOrFarAreRemoved) {
  EXPECT_EQ(clip_triangle(viewport_64(), kZeroToOne, {{{0, 0, -1, 1}, {1, 0, -1, 1}, {0, 1, -0.5f, 1}}}).count, 0);
  EXPECT_EQ(clip_triangle(viewport_64(), kZeroToOne, {{{0, 0, 2, 1}, {1, 0, 2, 1}, {0, 1, 1.5f, 1}}}).count, 0);
  EXPECT_EQ(clip_triangle(viewport_64(), kGl, {{{0, 0, -2, 1}, {1, 0, -2, 1}, {0, 1, -1.5f, 1}}}).count, 0);
}

TEST(Clip, GuardBandCutsDistantVertices) {
  // With a viewport of 64 px, the right guard plane is at 16384 px, which is x/w = (16384 − 32) / 32 = 511.
  const ClipPolygon p = clip_triangle(viewport_64(), kGl, {{{0, 0, 0, 1}, {1022, 0, 0, 1}, {0, 1, 0, 1}}});
  ASSERT_EQ(p.count, 4);
  EXPECT_EQ(p.corners[1].pos_clip, glm::dvec4(511, 0, 0, 1));
  EXPECT_EQ(p.corners[2].pos_clip, glm::dvec4(511, 0.5, 0, 1));
  const ScreenVertex s = project_corner(viewport_64(), p.corners[1].pos_clip);
  EXPECT_EQ(s.x, 16384 * 256);
  EXPECT_EQ(s.y, 32 * 256);
  EXPECT_EQ(s.z, 0.5f);
  EXPECT_EQ(s.inv_w, 1.0f);
}

TEST(Clip, NegativeWIsCutAway) {
  // Without a near plane, edges from w = 1 to w = −1 pass through the eye. The remaining part ends at a guard plane.
  const ClipPolygon p = clip_triangle(viewport_64(), kClamped, {{{0, 0, 0, 1}, {1, 1, 0, -1}, {-1, 1, 0, -1}}});
  ASSERT_GE(p.count, 3);
  for (int i = 0; i < p.count; ++i) {
    const ClipCorner& c = p.corners[static_cast<std::size_t>(i)];
    EXPECT_GT(c.pos_clip.w, 0.0);
    const ScreenVertex s = project_corner(viewport_64(), c.pos_clip);
    EXPECT_LE(std::abs(s.x), 16384 * 256);
    EXPECT_LE(std::abs(s.y), 16384 * 256);
  }
}

TEST(Clip, InterpolatesVaryingsOfNewVertices) {
  // The new vertex is the clip-space midpoint of an edge from w = 1 to w = 3, so its own w is 2. Smooth varyings use the clip-space
  // weights, 1/2 each. Linear varyings are interpolated in window space, where the weights are 1/2 · 1/2 = 1/4 and 1/2 · 3/2 = 3/4.
  const std::array<Interpolation, 3> modes{Interpolation::smooth, Interpolation::linear, Interpolation::flat};
  const std::array<float, 3> a{0, 0, 5}, b{8, 8, 6}, c{1, 1, 7};
  std::array<float, 3> out{};
  interpolate_corner({glm::dvec4(0, 0, 0, 2), glm::dvec3(0.5, 0.5, 0)}, {1, 3, 1}, {a.data(), b.data(), c.data()}, 2, modes, out.data());
  EXPECT_EQ(out[0], 4.0f);
  EXPECT_EQ(out[1], 6.0f);
  EXPECT_EQ(out[2], 7.0f);
}

// ---- invariants ------------------------------------------------------------------------------------------------

float random_coordinate(Random& r) {
  const auto x = static_cast<float>(r.magnitude(1e-3, 1e3));
  return r.coin() ? x : -x;
}

glm::vec4 random_position(Random& r) { return {random_coordinate(r), random_coordinate(r), random_coordinate(r), random_coordinate(r)}; }

double determinant(const glm::dvec4& a, const glm::dvec4& b, const glm::dvec4& c) {
  return glm::dot(glm::dvec3(a.x, a.y, a.w), glm::cross(glm::dvec3(b.x, b.y, b.w), glm::dvec3(c.x, c.y, c.w)));
}

TEST(Clip, WeightsSumToOneAndReproduceThePosition) {
  Random r(1);
  int pieces = 0;
  for (int i = 0; i < effort(50000); ++i) {
    const ClipTriangle t{random_position(r), random_position(r), random_position(r)};
    const ClipPolygon p = clip_triangle(viewport_64(), i % 2 ? kGl : kZeroToOne, t);
    ASSERT_LE(p.count, 3 + kFixedPlanes);
    for (int k = 0; k < p.count; ++k) {
      ++pieces;
      const ClipCorner& c = p.corners[static_cast<std::size_t>(k)];
      // Each cut has a rounding error of about 2^-53, and a vertex is the result of at most two cuts.
      EXPECT_NEAR(c.weights.x + c.weights.y + c.weights.z, 1.0, 1e-14);
      const glm::dvec4 want = c.weights.x * glm::dvec4(t[0]) + c.weights.y * glm::dvec4(t[1]) + c.weights.z * glm::dvec4(t[2]);
      const glm::dvec4 size = glm::abs(glm::dvec4(t[0])) + glm::abs(glm::dvec4(t[1])) + glm::abs(glm::dvec4(t[2]));
      for (int n = 0; n < 4; ++n) EXPECT_NEAR(c.pos_clip[n], want[n], 1e-14 * size[n]);
    }
  }
  EXPECT_GT(pieces, effort(50000) / 4);
}

TEST(Clip, PreservesOrientation) {
  Random r(2);
  int polygons = 0;
  for (int i = 0; i < effort(50000); ++i) {
    const ClipTriangle t{random_position(r), random_position(r), random_position(r)};
    const ClipPolygon p = clip_triangle(viewport_64(), kZeroToOne, t);
    if (p.count == 0) continue;
    // If all w > 0, the sign of det(x, y, w) is the orientation in the window.
    const double whole = determinant(glm::dvec4(t[0]), glm::dvec4(t[1]), glm::dvec4(t[2]));
    for (std::size_t k = 2; k < static_cast<std::size_t>(p.count); ++k) {
      const glm::dvec4 &a = p.corners[0].pos_clip, &b = p.corners[k - 1].pos_clip, &c = p.corners[k].pos_clip;
      const double part = determinant(a, b, c);
      if (std::fabs(part) < 1e-12 * glm::length(a) * glm::length(b) * glm::length(c)) continue;  // too close to 0 for double
      EXPECT_GT(part * whole, 0.0) << i;
    }
    ++polygons;
  }
  EXPECT_GT(polygons, effort(50000) / 8);
}

// Returns all vertices of a polygon that are on the edge opposite to the given vertex of the triangle.
std::vector<glm::dvec4> corners_on_edge(const ClipPolygon& p, glm::length_t opposite) {
  std::vector<glm::dvec4> found;
  for (int k = 0; k < p.count; ++k) {
    const ClipCorner& c = p.corners[static_cast<std::size_t>(k)];
    if (c.weights[opposite] == 0.0) found.push_back(c.pos_clip);
  }
  std::sort(found.begin(), found.end(), [](const glm::dvec4& a, const glm::dvec4& b) { return std::memcmp(&a, &b, sizeof a) < 0; });
  found.erase(std::unique(found.begin(), found.end(), same_bits), found.end());
  return found;
}

TEST(Clip, AdjacentTrianglesGetIdenticalVertices) {
  Random r(3);
  int edges = 0;
  for (int i = 0; i < effort(100000); ++i) {
    const glm::vec4 a = random_position(r), b = random_position(r), c = random_position(r), d = random_position(r);
    const DepthState& depth = i % 3 == 0 ? kGl : i % 3 == 1 ? kZeroToOne : kClamped;
    const ClipPolygon left = clip_triangle(viewport_64(), depth, {a, b, c});
    const ClipPolygon right = clip_triangle(viewport_64(), depth, {{d, b, a}});
    const std::vector<glm::dvec4> of_left = corners_on_edge(left, 2), of_right = corners_on_edge(right, 0);
    // With fewer than two vertices, the edge has been cut away. One of the triangles may still have a vertex that only touches a plane.
    if (of_left.size() < 2 && of_right.size() < 2) continue;
    ++edges;
    ASSERT_EQ(of_left.size(), of_right.size()) << i;
    for (std::size_t k = 0; k < of_left.size(); ++k) ASSERT_TRUE(same_bits(of_left[k], of_right[k])) << i;
  }
  EXPECT_GT(edges, effort(100000) / 8);
}

// The clipper must not cut off a vertex that the vertex stage classifies as drawable: an adjacent triangle may be drawn unclipped, and the
// two triangles would then disagree about their shared edge.
TEST(Clip, AgreesWithTheVertexStageAboutInsideVertices) {
  Random r(4);
  for (const Rect& rect : {Rect{0, 0, 64, 64}, Rect{0, 0, 1920, 1080}, Rect{5, 7, 333, 77}}) {
    const Viewport v = make_viewport(rect, kZeroToOne);
    std::vector<glm::vec4> positions;
    for (int i = 0; i < effort(20000); ++i) {
      const auto w = static_cast<float>(r.magnitude(1e-3, 1e3));
      glm::vec4 p(0, 0, 0.5f * w, w);
      const int side = r.integer(0, 3);
      const std::array<float, 4> guards{v.guard_left, v.guard_right, v.guard_bottom, v.guard_top};
      float x = guards[static_cast<std::size_t>(side)] * w;  // on the plane, except for the rounding of the product
      for (int n = r.integer(-2, 2); n > 0; --n) x = std::nextafter(x, 1e30f);
      p[side / 2] = x;
      positions.push_back(p);
    }
    const ShadedVertices shaded = shade(ConstantShader{}, make_vertex_view(stream(positions)), rect, with(kZeroToOne));
    int inside = 0;
    for (std::size_t i = 0; i < positions.size(); ++i) {
      const glm::vec4& p = positions[i];
      const ClipPolygon polygon = clip_triangle(v, kZeroToOne, {{p, {0, 0, 0.5f, 1}, {0.01f, 0.02f, 0.5f, 1}}});
      const bool kept = polygon.count == 3 && same_bits(polygon.corners[0].pos_clip, glm::dvec4(p));
      ASSERT_EQ((shaded.outcodes[i] & kOutGuard) == 0, kept) << p.x << ' ' << p.y << ' ' << p.w;
      if (kept) ++inside;
    }
    EXPECT_GT(inside, effort(20000) / 4);
    EXPECT_LT(inside, effort(20000) * 3 / 4);
  }
}

// ---- whole passes compared with the exact reference ------------------------------------------------------------

struct LineFunction {
  Wide a, b, c;  // f(x, y) = a·x + b·y + c at the center of pixel (x, y); the visible part of the triangle has f ≥ 0
  Wide at(int x, int y) const { return a * x + b * y + c; }
};

/// The visible part of one triangle as five linear functions of the pixel position: three edges, near and far. Vertex coordinates are
/// integers up to 2^24 and viewport coordinates up to 2^9, so no product exceeds 2^98.
///
/// The sample s = (nx·H, ny·W, W·H) is the point (x, y, w) up to a positive factor, with nx = 2(x − vx) + 1 − W and ny likewise. Solving
/// λ0·v0 + λ1·v1 + λ2·v2 = s by Cramer's rule gives λi = s·(vj × vk) / D. The point is inside if all λi ≥ 0 (its w is then positive by the
/// choice of s), and its z is λ0·z0 + λ1·z1 + λ2·z2.
class ExactTriangle {
 public:
  ExactTriangle(const ClipTriangle& t, const Rect& viewport, const DepthState& depth) {
    std::array<std::array<Wide, 3>, 3> v;
    for (std::size_t i = 0; i < 3; ++i) v[i] = {to_wide(t[i].x), to_wide(t[i].y), to_wide(t[i].w)};
    std::array<std::array<Wide, 3>, 3> n;
    for (std::size_t i = 0; i < 3; ++i) n[i] = cross(v[(i + 1) % 3], v[(i + 2) % 3]);
    Wide det = n[0][0] * v[0][0] + n[0][1] * v[0][1] + n[0][2] * v[0][2];
    empty_ = det == 0;
    const Wide sign = det < 0 ? -1 : 1;
    det *= sign;
    const Wide w = viewport.width, h = viewport.height;
    LineFunction z{0, 0, 0};
    for (std::size_t i = 0; i < 3; ++i) {
      const LineFunction f{sign * n[i][0] * h * 2, sign * n[i][1] * w * 2,
                           sign * (n[i][0] * h * (1 - w - 2 * viewport.x) + n[i][1] * w * (1 - h - 2 * viewport.y) + n[i][2] * w * h)};
      lines_[i] = f;
      const Wide zi = to_wide(t[i].z);
      z = {z.a + f.a * zi, z.b + f.b * zi, z.c + f.c * zi};
    }
    const Wide one = w * h * det;
    count_ = depth.clamp ? 3 : 5;
    lines_[3] = {z.a, z.b, z.c + (depth.clip == ClipDepth::negative_one_to_one ? one : 0)};
    lines_[4] = {-z.a, -z.b, one - z.c};
  }

  bool empty() const { return empty_; }
  bool inside(int x, int y) const {
    for (int i = 0; i < count_; ++i) {
      if (lines_[static_cast<std::size_t>(i)].at(x, y) < 0) return false;
    }
    return !empty_;
  }

  /// Returns the distance in pixels from the center of pixel (x, y) to the boundary of the visible part; infinite if there is none.
  long double distance_to_boundary(int x, int y) const {
    std::vector<Corner> polygon{{-4e4L, -4e4L}, {4e4L, -4e4L}, {4e4L, 4e4L}, {-4e4L, 4e4L}};
    for (int i = 0; i < count_ && !polygon.empty(); ++i) polygon = intersect(polygon, lines_[static_cast<std::size_t>(i)], x, y);
    long double nearest = std::numeric_limits<long double>::infinity();
    for (std::size_t i = 0; i < polygon.size(); ++i) nearest = std::min(nearest, to_segment(polygon[i], polygon[(i + 1) % polygon.size()]));
    return nearest;
  }

 private:
  struct Corner {
    long double x, y;
  };

  static Wide to_wide(float x) {
    const auto i = static_cast<int64_t>(x);
    EXPECT_EQ(static_cast<float>(i), x);
    return i;
  }
  static std::array<Wide, 3> cross(const std::array<Wide, 3>& a, const std::array<Wide, 3>& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
  }

  // Positions are relative to the center of pixel (px, py), where f is exact. The rounding error of long double is negligible.
  static std::vector<Corner> intersect(const std::vector<Corner>& polygon, const LineFunction& f, int px, int py) {
    const auto a = static_cast<long double>(f.a), b = static_cast<long double>(f.b), c = static_cast<long double>(f.at(px, py));
    std::vector<Corner> kept;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Corner &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
      const long double dp = a * p.x + b * p.y + c, dq = a * q.x + b * q.y + c;
      if (dp >= 0) kept.push_back(p);
      if ((dp >= 0) != (dq >= 0)) {
        const long double s = dp / (dp - dq);
        kept.push_back({p.x + s * (q.x - p.x), p.y + s * (q.y - p.y)});
      }
    }
    return kept;
  }

  static long double to_segment(const Corner& p, const Corner& q) {
    const long double dx = q.x - p.x, dy = q.y - p.y, l2 = dx * dx + dy * dy;
    const long double s = l2 > 0 ? std::clamp(-(p.x * dx + p.y * dy) / l2, 0.0L, 1.0L) : 0.0L;
    return std::hypot(p.x + s * dx, p.y + s * dy);
  }

  std::array<LineFunction, 5> lines_;
  int count_ = 5;
  bool empty_ = false;
};

// Draws random triangles in one pass each and records the distances of all samples that differ from the exact reference.
class ClipComparison {
 public:
  void compare(const ClipTriangle& t, int size, const Rect& viewport, const DrawState& state) {
    Image<glm::vec4> image(size, size);
    const PassStatistics s = count_coverage(image, {t[0], t[1], t[2]}, {0, 1, 2}, state);
    statistics_ += s;
    const ExactTriangle exact(t, viewport, state.depth);
    for (int y = 0; y < size; ++y) {
      for (int x = 0; x < size; ++x) {
        const float count = pixel(image, x, y).x;
        const bool in_viewport = x >= viewport.x && x < viewport.x + viewport.width && y >= viewport.y && y < viewport.y + viewport.height;
        const bool want = in_viewport && exact.inside(x, y);
        covered_ += want;
        ++samples_;
        if (count == (want ? 1.0f : 0.0f)) continue;
        // The triangles of a clipped polygon meet without gaps or overlaps, so no sample is drawn twice.
        EXPECT_LE(count, 1.0f) << describe(t, x, y);
        EXPECT_TRUE(in_viewport) << describe(t, x, y);
        add(exact.distance_to_boundary(x, y), t, x, y);
      }
    }
  }

  void report() const {
    std::printf(
        "%lld samples, %lld covered, %lld triangles clipped; %lld "
        "samples differ:",
        static_cast<long long>(samples_), static_cast<long long>(covered_), static_cast<long long>(statistics_.clipped),
        static_cast<long long>(differing_));
    for (std::size_t i = 0; i < histogram_.size(); ++i) std::printf(" %lld", static_cast<long long>(histogram_[i]));
    std::printf(" by eighths of 1/256 px; the farthest %.5f px = %.3f / 256\n", static_cast<double>(farthest_),
                static_cast<double>(farthest_ * 256));
    ::testing::Test::RecordProperty("differing", std::to_string(differing_));
    ::testing::Test::RecordProperty("farthest_256ths", std::to_string(static_cast<double>(farthest_ * 256)));
  }

  int64_t covered() const { return covered_; }
  const PassStatistics& statistics() const { return statistics_; }

 private:
  // Vertices are snapped to 1/256 px, which moves them by at most 1/512 px in x and in y. The drawn outline is therefore within
  // √2/512 px = 0.71/256 px of the exact one. A tolerance of 1/256 px also leaves room for the rounding of clipped vertices.
  static constexpr long double kTolerance = 1.0L / 256;

  void add(long double d, const ClipTriangle& t, int x, int y) {
    ++differing_;
    farthest_ = std::max(farthest_, d);
    ++histogram_[std::min(histogram_.size() - 1, static_cast<std::size_t>(std::min(d * 256 * 8, 1e6L)))];
    if (d > kTolerance && failures_++ < 5) ADD_FAILURE() << static_cast<double>(d) << " px from an edge: " << describe(t, x, y);
  }

  static std::string describe(const ClipTriangle& t, int x, int y) {
    std::ostringstream s;
    s.precision(9);
    s << "pixel " << x << ", " << y << " of";
    for (const glm::vec4& v : t) s << " (" << v.x << ", " << v.y << ", " << v.z << ", " << v.w << ")";
    return s.str();
  }

  int64_t samples_ = 0, covered_ = 0, differing_ = 0, failures_ = 0;
  std::array<int64_t, 9> histogram_{};
  long double farthest_ = 0;
  PassStatistics statistics_;
};

// Returns a random integer with a random magnitude of up to 2^bits.
float whole(Random& r, int bits) {
  const int limit = 1 << r.integer(0, bits);
  return static_cast<float>(r.integer(-limit, limit));
}

// Returns a random triangle with coordinates of all magnitudes and w of both signs, so that all planes are crossed.
ClipTriangle any_triangle(Random& r) {
  ClipTriangle t;
  for (glm::vec4& v : t) v = {whole(r, 24), whole(r, 24), whole(r, 24), whole(r, 24)};
  return t;
}

// Returns a random triangle with at least one vertex in the picture, so that more of it is visible. The other vertices can be up to 1e5 px
// away or behind the eye.
ClipTriangle seen_triangle(Random& r) {
  ClipTriangle t;
  for (std::size_t i = 0; i < 3; ++i) {
    const int bits = r.integer(4, 18);
    const float w = static_cast<float>(r.integer(1, 1 << bits));
    const bool seen = i == 0 || r.integer(0, 3) == 0;
    const double reach = seen ? 1.0 : r.magnitude(1.0, 3000.0);  // × 32 px
    const auto along = [&] {
      return static_cast<float>(std::lround(std::clamp(r.real(-reach, reach) * static_cast<double>(w), -16777216.0, 16777216.0)));
    };
    t[i] = {along(), along(), static_cast<float>(std::lround(r.real(seen ? -0.5 : -2.0, seen ? 1.0 : 2.0) * static_cast<double>(w))), w};
    if (!seen && r.integer(0, 2) == 0) t[i] = -t[i];  // behind the eye
  }
  if (r.coin()) std::swap(t[0], t[r.coin() ? 1 : 2]);
  return t;
}

DrawState state_of(int i) { return with(i % 3 == 0 ? kGl : i % 3 == 1 ? kZeroToOne : kClamped); }

TEST(ClippedCoverage, RandomTrianglesMatchTheExactReference) {
  Random r(11);
  ClipComparison c;
  for (int i = 0; i < effort(20000); ++i) c.compare(any_triangle(r), 32, {0, 0, 32, 32}, state_of(i));
  c.report();
  EXPECT_GT(c.statistics().clipped, static_cast<uint64_t>(effort(20000) / 5));
}

TEST(ClippedCoverage, VisibleTrianglesMatchTheExactReference) {
  Random r(12);
  ClipComparison c;
  for (int i = 0; i < effort(20000); ++i) c.compare(seen_triangle(r), 64, {0, 0, 64, 64}, state_of(i));
  c.report();
  EXPECT_GT(c.statistics().clipped, static_cast<uint64_t>(effort(20000) / 3));
  EXPECT_GT(c.covered(), effort(20000) * 64 * 64 / 20);
}

TEST(ClippedCoverage, ViewportPartlyOutsideOfTheTargetMatchesTheExactReference) {
  Random r(13);
  ClipComparison c;
  for (int i = 0; i < effort(2000); ++i) {
    const Rect viewport{r.integer(-100, 60), r.integer(-100, 60), r.integer(1, 300), r.integer(1, 300)};
    DrawState state = state_of(i);
    state.viewport = viewport;
    c.compare(seen_triangle(r), 64, viewport, state);
  }
  c.report();
}

TEST(ClippedCoverage, LargePicturesMatchTheExactReference) {
  Random r(14);
  ClipComparison c;
  for (int i = 0; i < effort(400); ++i) c.compare(seen_triangle(r), 256, {0, 0, 256, 256}, state_of(i));
  c.report();
}

// Some vertices have w = 0 or are the eye itself, and some are exactly on a plane.
TEST(ClippedCoverage, SpecialVerticesMatchTheExactReference) {
  Random r(15);
  ClipComparison c;
  for (int i = 0; i < effort(10000); ++i) {
    ClipTriangle t = seen_triangle(r);
    for (glm::vec4& v : t) {
      const int kind = r.integer(0, 9);
      if (kind == 0) v.w = 0;
      if (kind == 1) v.z = 0;
      if (kind == 2) v.z = v.w;
      if (kind == 3) v.z = -v.w;
      if (kind == 4) v.x = v.w;
      if (kind == 5) v = {0, 0, v.z, 0};
      if (kind == 6) v = {0, 0, 0, 0};
      if (kind == 7) v = {v.x, v.y, 0, 0};
    }
    const ExactTriangle exact(t, {0, 0, 64, 64}, state_of(i).depth);
    if (exact.empty()) {
      // The triangle has no area. At most a line remains, and it can be drawn one sub-pixel wide.
      Image<glm::vec4> image(64, 64);
      count_coverage(image, {t[0], t[1], t[2]}, {0, 1, 2}, state_of(i));
      float drawn = 0;
      for (const glm::vec4& p : image.texels()) drawn += p.x;
      EXPECT_LE(drawn, 4.0f) << i;
      continue;
    }
    c.compare(t, 64, {0, 0, 64, 64}, state_of(i));
  }
  c.report();
}

// Slivers, found by search, with clipped and snapped outlines that are concave or self-intersecting, so that a fan from their first vertex
// would draw some samples twice.
TEST(ClippedCoverage, ConcaveOutlinesDrawNoSampleTwice) {
  const std::vector<ClipTriangle> slivers{{{{2987, 7032, -3121, 10836}, {-12146, -2062, 7311, 7699}, {-24706, -9610, 15966, 5094}}},
                                          {{{-5948, -3375, -208, 6271}, {232, -2883, 713, 452}, {6371, -2394, 1628, -5329}}},
                                          {{{102, 5, -2, 286}, {-265176, -93781, 5456, 3854}, {-274604, -97114, 5649, 3983}}},
                                          {{{-410, 4877, 7596, 8380}, {1271, -300, -142, 404}, {-686, 5729, 8871, 9693}}},
                                          {{{232, -70, 306, 613}, {-50, 305, 16, 247}, {-251, 573, -192, -13}}},
                                          {{{-6433, 1508, 1637, 7184}, {6889, -13132, 14256, 7841}, {-18186, 14423, -9497, 6605}}},
                                          {{{6850, 6071, 1595, 7416}, {-26, -30, -3, 15}, {5049, 4473, 1175, 5476}}},
                                          {{{-9577, 6156, -102, 9712}, {14235, -3371, 1948, 981}, {28596, -9119, 3186, -4285}}},
                                          {{{-1, 0, 0, 1}, {2, 9, 2, 3}, {7, 18, 6, 3}}},
                                          {{{-2908, 1051, 2583, 7373}, {58358, -69219, -2450, 16349}, {-30280, 32446, 4831, 3362}}},
                                          {{{6848, -2137, -1164, 7060}, {-1012, 585, 266, 213}, {6561, -2039, -1113, 6807}}}};
  for (const ClipTriangle& t : slivers) {
    for (const bool reversed : {false, true}) {
      Image<glm::vec4> image(256, 256);
      const PassStatistics s = count_coverage(image, {t[0], t[1], t[2]},
                                              reversed ? std::vector<uint32_t>{0, 2, 1} : std::vector<uint32_t>{0, 1, 2}, with(kZeroToOne));
      EXPECT_EQ(s.clipped, 1u);
      float max_red = 0;
      for (const glm::vec4& p : image.texels()) max_red = std::max(max_red, p.x);
      EXPECT_LE(max_red, 1.0f) << t[0].x;
    }
  }
}

// ---- non-finite input ------------------------------------------------------------------------------------------

TEST(ClippedCoverage, NonFiniteVerticesDiscardTheTriangle) {
  constexpr float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
  for (const float bad : {nan, -nan, inf, -inf}) {
    for (int vertex = 0; vertex < 3; ++vertex) {
      for (int component = 0; component < 4; ++component) {
        std::vector<glm::vec4> positions{{-1, -1, 0, 1}, {1, -1, 0, 1}, {0, 1, 0, 1}, {-1, -1, 0, 1}, {1, -1, 0, 1}, {0, 1, 0, 1}};
        positions[static_cast<std::size_t>(vertex)][component] = bad;
        Image<glm::vec4> image(32, 32);
        const PassStatistics s = count_coverage(image, positions, {0, 1, 2, 3, 4, 5});
        EXPECT_EQ(s.culled_non_finite, 1u);
        EXPECT_EQ(s.triangles_binned,
                  1u);  // the second triangle is still drawn
        EXPECT_EQ(pixel(image, 16, 10).x, 1.0f);
      }
    }
  }
}

// Arbitrary values, including random bit patterns, must not crash, and the statistics must account for every triangle.
TEST(ClippedCoverage, RandomBitPatternsAreHandled) {
  Random r(16);
  constexpr std::array<float, 12> special{0.0f,     -0.0f, 1e-45f, -1e-40f, 0x1p-126f, 0x1p-97f,
                                          0x1p-96f, 1e30f, -1e30f, 3.4e38f, -3.4e38f,  1e5f};
  for (int batch = 0; batch < effort(60); ++batch) {
    std::vector<glm::vec4> positions(3 * 512);
    uint64_t bad_triangles = 0;
    for (std::size_t i = 0; i < positions.size(); ++i) {
      for (int k = 0; k < 4; ++k) {
        const int kind = r.integer(0, 8);
        float x = random_coordinate(r);
        if (kind == 0) x = std::bit_cast<float>(static_cast<uint32_t>(r.bits()));
        if (kind == 1 || kind == 2) x = special[static_cast<std::size_t>(r.integer(0, 11))];
        if (kind == 3) x = r.real(-1e5f, 1e5f);
        positions[i][k] = x;
      }
    }
    std::vector<uint32_t> indices(positions.size());
    for (std::size_t i = 0; i < indices.size(); ++i) indices[i] = static_cast<uint32_t>(i);
    for (std::size_t i = 0; i < positions.size(); i += 3) {
      bool finite = true;
      for (std::size_t k = 0; k < 3; ++k) {
        for (int n = 0; n < 4; ++n) finite = finite && std::isfinite(positions[i + k][n]);
      }
      bad_triangles += !finite;
    }
    DrawState state = state_of(batch);
    if (batch % 5 == 0) state.offset = {.slope = 1.0f, .constant = 2.0f};
    Image<glm::vec4> image(96, 40);
    Image<float> depth(96, 40);
    Pass pass(96, 40, rgba32f_target(image), d32f_target(depth));
    pass.draw(ConstantShader{}, make_vertex_view(stream(positions)), state);
    const PassStatistics s = pass.run(one_worker());
    EXPECT_EQ(s.primitives_in, 512u);
    EXPECT_EQ(s.culled_non_finite, bad_triangles);
    EXPECT_LE(s.culled_non_finite + s.culled_outside + s.culled_face + s.culled_degenerate + s.culled_no_sample, 512u);
    for (const float z : depth.texels()) ASSERT_TRUE(z >= 0.0f && z <= 1.0f) << z;
  }
}

}  // namespace
}  // namespace halfspace::raster_test
