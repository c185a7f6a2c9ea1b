// SPDX-License-Identifier: Apache-2.0
//
// Tests lines, outlines and clip distances with hand-computed cases. (tests/property compares line coverage with the diamond-exit rule.)
#include "raster/raster_test.h"

namespace halfspace {

namespace {

using namespace raster_test;

// Counts fragments: each fragment adds one to its pixel.
Image<glm::vec4> draw_lines(const std::vector<Point>& points, DrawState state, const PassOptions& options = {}) {
  std::vector<glm::vec4> p;
  for (const Point& at : points) p.push_back(clip_position(at, 16, 16));
  Image<glm::vec4> image(16, 16);
  Pass pass(16, 16, rgba32f_target(image), {}, options);
  state.blend = kAdd;
  pass.draw(ConstantShader{}, make_vertex_view(stream(p)), state);
  pass.run(one_worker());
  return image;
}

int total(const Image<glm::vec4>& image) {
  float sum = 0.0f;
  for (int i = 0; i < 256; ++i) sum += image.data()[i].x;
  return static_cast<int>(sum);
}

constexpr int kCenter = 128;
Point center(int x, int y) { return {x * 256 + kCenter, y * 256 + kCenter}; }

TEST(Lines, SegmentsBetweenCentersOmitTheLastPixel) {
  for (const auto& [a, b] :
       {std::pair{Point{2, 3}, Point{9, 3}}, {Point{9, 3}, Point{2, 3}}, {Point{4, 2}, Point{4, 11}}, {Point{3, 3}, Point{8, 8}}}) {
    const Image<glm::vec4> image = draw_lines({center(a.x, a.y), center(b.x, b.y)}, {.topology = Topology::lines});
    EXPECT_EQ(total(image), std::max(std::abs(b.x - a.x), std::abs(b.y - a.y)));
    EXPECT_EQ(pixel(image, a.x, a.y).x, 1.0f);
    EXPECT_EQ(pixel(image, b.x, b.y).x, 0.0f);
  }
}

// A line does not cover the diamond in which it ends, so a strip draws no pixel twice at its joints, and a loop has no gap.
TEST(Lines, StripsAndLoopsDrawJointsOnce) {
  const std::vector<Point> square{center(2, 2), center(12, 2), center(12, 9), center(2, 9)};
  const Image<glm::vec4> strip = draw_lines(square, {.topology = Topology::line_strip});
  EXPECT_EQ(total(strip), 10 + 7 + 10);
  const Image<glm::vec4> loop = draw_lines(square, {.topology = Topology::line_loop});
  EXPECT_EQ(total(loop), 2 * (10 + 7));
  for (int i = 0; i < 256; ++i) EXPECT_LE(loop.data()[i].x, 1.0f);
}

TEST(Lines, WideLinesAreExtendedAlongTheMinorAxis) {
  for (const int width : {1, 2, 3, 6}) {
    const Image<glm::vec4> image =
        draw_lines({center(3, 8), center(9, 8)}, {.topology = Topology::lines, .line_width = static_cast<float>(width)});
    EXPECT_EQ(total(image), 6 * width);
    const int below = (width - 1) / 2 + (width % 2 == 0 ? 1 : 0);  // (w − 1)/2 px down, rounded up
    EXPECT_EQ(pixel(image, 5, 8 - below).x, 1.0f) << width;
    EXPECT_EQ(pixel(image, 5, 8 - below - 1).x, 0.0f) << width;
    EXPECT_EQ(pixel(image, 5, 8 - below + width).x, 0.0f) << width;
  }
}

// With several samples, a line is a rectangle. This one is aligned to pixels.
TEST(Lines, MultisampledLinesAreRectangles) {
  const Image<glm::vec4> image =
      draw_lines({{2 * 256, 8 * 256}, {10 * 256, 8 * 256}}, {.topology = Topology::lines, .line_width = 4.0f}, {.samples = 4});
  for (int y = 0; y < 16; ++y) {
    for (int x = 0; x < 16; ++x) EXPECT_EQ(pixel(image, x, y).x, x >= 2 && x < 10 && y >= 6 && y < 10 ? 1.0f : 0.0f) << x << ' ' << y;
  }
}

struct RampShader : ConstantShader {
  template <class R>
  struct Attributes {
    vec4<R> position;
    R value;
  };
  template <class R>
  struct Varyings {
    R smooth;
    NoPerspective<R> linear;
    Flat<R> flat;
  };
  template <class R>
  vec4<R> vertex(const Attributes<R>& in, Varyings<R>& out) const {
    out = {in.value, {in.value}, {in.value}};
    return in.position;
  }
  template <class R>
  Fragment<R> fragment(const Varyings<R>& in, const Pixel<R>& px) const {
    return {vec4<R>(in.smooth, in.linear.value, in.flat.value, px.z())};
  }
};

// OpenGL 4.6, equations 14.5 and 14.6, where t is the position along the line. For w = 1 and w = 3, the perspective-correct value is
// (t/3)/((1 − t) + t/3).
TEST(Lines, InterpolateAlongTheLine) {
  const glm::vec4 a = clip_position(center(1, 5), 16, 16), b = clip_position(center(13, 5), 16, 16, 0.5f);
  const std::vector<glm::vec4> p{a, b * 3.0f};
  const std::vector<float> values{0.0f, 1.0f};
  for (const ProvokingVertex provoking : {ProvokingVertex::first, ProvokingVertex::last}) {
    Image<glm::vec4> image(16, 16);
    Pass pass(16, 16, rgba32f_target(image), {.format = DepthFormat::d32f});
    pass.draw(RampShader{}, make_vertex_view(stream(p), stream(values)),
              {.topology = Topology::lines, .line_width = 3.0f, .provoking = provoking});
    pass.run(one_worker());
    for (int x = 1; x < 13; ++x) {
      for (int y = 4; y <= 6; ++y) {
        const float t = static_cast<float>(x - 1) / 12.0f;
        EXPECT_NEAR(pixel(image, x, y).x, (t / 3) / ((1 - t) + t / 3), 3e-7f);  // the bound documented in shading/pixel.h
        EXPECT_NEAR(pixel(image, x, y).y, t, 3e-7f);
        EXPECT_EQ(pixel(image, x, y).z, provoking == ProvokingVertex::first ? 0.0f : 1.0f);
        EXPECT_NEAR(pixel(image, x, y).w, 0.5f + 0.25f * t, 1e-7f);
      }
    }
  }
}

TEST(Lines, PolygonModesDrawOutlinesAndVertices) {
  const std::vector<Point> triangle{center(2, 2), center(12, 2), center(2, 12)};
  const Image<glm::vec4> outline = draw_lines(triangle, {.polygon_mode = PolygonMode::line});
  EXPECT_EQ(total(outline), 30);  // three sides of ten pixels
  EXPECT_EQ(pixel(outline, 4, 4).x, 0.0f);
  EXPECT_EQ(pixel(outline, 7, 2).x, 1.0f);
  const Image<glm::vec4> corners = draw_lines(triangle, {.point_size = 2.0f, .polygon_mode = PolygonMode::point});
  EXPECT_EQ(total(corners), 12);
  const Image<glm::vec4> culled = draw_lines(triangle, {.polygon_mode = PolygonMode::line, .cull = CullMode::front});
  EXPECT_EQ(total(culled), 0);
}

// One clip distance is the plane x = 3.25 px, the other y = 5 px.
struct TwoDistances : ConstantShader {
  template <class R>
  PerVertex<R, 2> vertex(const Attributes<R>& in, Varyings<R>&) const {
    const R x = (in.position.x + R(1.0f)) * R(8.0f), y = (in.position.y + R(1.0f)) * R(8.0f);
    return {in.position, R(1.0f), {x - R(3.25f), R(5.0f) - y}};
  }
};

TEST(Lines, ClipDistancesCutTrianglesLinesAndPoints) {
  const std::vector<glm::vec4> whole = full_screen();
  Image<glm::vec4> image(16, 16);
  Pass pass(16, 16, rgba32f_target(image), {});
  pass.draw(TwoDistances{}, make_vertex_view(stream(whole)), {.blend = kAdd});
  EXPECT_EQ(pass.run(one_worker()).clipped, 1u);
  for (int y = 0; y < 16; ++y) {
    for (int x = 0; x < 16; ++x) EXPECT_EQ(pixel(image, x, y).x, x >= 3 && y < 5 ? 1.0f : 0.0f) << x << ' ' << y;
  }
  const std::vector<glm::vec4> line{clip_position(center(0, 2), 16, 16), clip_position(center(15, 2), 16, 16)};
  Image<glm::vec4> lines(16, 16);
  Pass line_pass(16, 16, rgba32f_target(lines), {});
  line_pass.draw(TwoDistances{}, make_vertex_view(stream(line)), {.topology = Topology::lines});
  line_pass.run(one_worker());
  for (int x = 0; x < 16; ++x) EXPECT_EQ(pixel(lines, x, 2).x, x >= 3 && x < 15 ? 1.0f : 0.0f) << x;
  Image<glm::vec4> points(16, 16);
  Pass point_pass(16, 16, rgba32f_target(points), {});
  point_pass.draw(TwoDistances{}, make_vertex_view(stream(line)), {.topology = Topology::points});
  EXPECT_EQ(point_pass.run(one_worker()).samples_passed, 1u);
}

// Writes its clip distance to a varying, too.
struct DistanceVarying : ConstantShader {
  template <class R>
  struct Varyings {
    R distance;
  };
  template <class R>
  PerVertex<R, 1> vertex(const Attributes<R>& in, Varyings<R>& out) const {
    out.distance = in.position.x * R(0.5f) + in.position.y;
    return {in.position, R(1.0f), {out.distance}};
  }
  template <class R>
  Fragment<R> fragment(const Varyings<R>& in, const Pixel<R>&) const {
    return {vec4<R>(in.distance, R(0), R(0), R(1))};
  }
};

TEST(Lines, ClipDistancesReachTheFragmentFunction) {
  const std::vector<glm::vec4> whole = full_screen();
  Image<glm::vec4> image(16, 16);
  Pass pass(16, 16, rgba32f_target(image), {});
  pass.draw(DistanceVarying{}, make_vertex_view(stream(whole)));
  pass.run(one_worker());
  for (int y = 0; y < 16; ++y) {
    for (int x = 0; x < 16; ++x) {
      const float distance = 0.5f * ((static_cast<float>(x) + 0.5f) / 8 - 1) + (static_cast<float>(y) + 0.5f) / 8 - 1;
      const glm::vec4 c = pixel(image, x, y);
      if (std::fabs(distance) < 0.01f) continue;  // the edge is snapped to 1/256 px
      EXPECT_EQ(c.w, distance > 0.0f ? 1.0f : 0.0f);
      EXPECT_NEAR(c.x, c.w * distance, 1.4e-6f);  // 3e-7 of the largest value, which is 4.5
    }
  }
}

// The second and third values of a vertex are cull distances.
struct Culled : ConstantShader {
  template <class R>
  struct Attributes {
    vec4<R> position;
    vec2<R> distances;
  };
  template <class R>
  PerVertex<R, 1, 2> vertex(const Attributes<R>& in, Varyings<R>&) const {
    return {in.position, R(3.0f), {in.position.x + R(0.5f)}, {in.distances.x, in.distances.y}};
  }
};

// A primitive is culled if and only if one of the distances is negative at all its vertices.
TEST(Lines, CullDistancesRemoveWholePrimitives) {
  Random random(5);
  std::vector<glm::vec4> positions;
  std::vector<glm::vec2> distances, inside;
  const auto value = [&](double low, double high) { return static_cast<float>(random.real(low, high)); };
  for (int i = 0; i < 60; ++i) {
    positions.push_back({value(-1, 1), value(-1, 1), value(-0.9, 0.9), 1});
    distances.push_back({value(-0.6, 0.4), random.below(4) == 0 ? 0.0f : value(-0.4, 0.6)});
    inside.push_back({1, 1});
  }
  for (const int samples : {1, 4}) {
    for (const PolygonMode mode : {PolygonMode::fill, PolygonMode::line, PolygonMode::point}) {
      for (const auto& [topology, corners] : {std::pair(Topology::triangles, 3u), {Topology::lines, 2u}, {Topology::points, 1u}}) {
        std::vector<uint32_t> all, kept;
        for (uint32_t first = 0; first < 60; first += corners) {
          bool x_culls = true, y_culls = true;
          for (uint32_t i = first; i < first + corners; ++i) {
            x_culls &= distances[i].x < 0.0f;
            y_culls &= distances[i].y < 0.0f;
            all.push_back(i);
          }
          for (uint32_t i = first; i < first + corners && !x_culls && !y_culls; ++i) kept.push_back(i);
        }
        ASSERT_GT(kept.size(), 0u);
        ASSERT_LT(kept.size(), all.size());
        const DrawState state{.topology = topology, .polygon_mode = mode, .blend = kAdd};
        Image<glm::vec4> image(40, 30), expected(40, 30);
        Pass pass(40, 30, rgba32f_target(image), {}, {.samples = samples}),
            other(40, 30, rgba32f_target(expected), {}, {.samples = samples});
        pass.draw(Culled{}, make_vertex_view(stream(positions), stream(distances)), all, state);
        other.draw(Culled{}, make_vertex_view(stream(positions), stream(inside)), kept, state);
        const PassStatistics s = pass.run(one_worker()), t = other.run(one_worker());
        EXPECT_EQ(image, expected);
        EXPECT_EQ(s.samples_passed, t.samples_passed);
        EXPECT_EQ(s.culled_outside - t.culled_outside, (all.size() - kept.size()) / corners);
      }
    }
  }
}

// The x coordinate is the clip distance; the position itself is always in view.
struct DistanceFromX : ConstantShader {
  template <class R>
  PerVertex<R, 1> vertex(const Attributes<R>& in, Varyings<R>&) const {
    return {vec4<R>(select(in.position.y > R(0.5f), R(0.5f), R(-0.5f)), in.position.y, R(0), R(1)), R(1.0f), {in.position.x}};
  }
};

TEST(Lines, PrimitivesWithANonFiniteClipDistanceAreCulled) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity(), kNan = std::numeric_limits<float>::quiet_NaN();
  for (const float distance : {kInfinity, -kInfinity, kNan}) {
    for (const Topology topology : {Topology::triangles, Topology::lines, Topology::points}) {
      const std::vector<glm::vec4> corners{{1, -0.9f, 0, 1}, {-1, 0.9f, 0, 1}, {distance, 0.1f, 0, 1}};
      const std::vector<uint32_t> indices = topology == Topology::triangles ? std::vector<uint32_t>{0, 1, 2}
                                            : topology == Topology::lines   ? std::vector<uint32_t>{1, 2, 2, 0}
                                                                            : std::vector<uint32_t>{2};
      Image<glm::vec4> image(16, 16);
      const Indices list(indices, corners.size());
      Pass pass(16, 16, rgba32f_target(image), {});
      pass.draw(DistanceFromX{}, make_vertex_view(stream(corners)), list, {.topology = topology});
      const PassStatistics s = pass.run(one_worker());
      EXPECT_EQ(s.culled_non_finite, topology == Topology::lines ? 2u : 1u);
      EXPECT_EQ(s.samples_passed, 0u);
    }
  }
}

}  // namespace

}  // namespace halfspace
