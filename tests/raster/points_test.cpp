// SPDX-License-Identifier: Apache-2.0
//
// Tests points and sprites: coverage, point coordinates, clipping by their footprint, and shader-written depth.
#include "raster/raster_test.h"

namespace halfspace {

namespace {

using namespace raster_test;

// A point of a given size that outputs its point coordinate.
struct CoordShader {
  float size = 1.0f;
  template <class R>
  using Attributes = PositionAttributes<R>;
  template <class R>
  using Varyings = NoVaryings<R>;
  template <class R>
  PerVertex<R> vertex(const Attributes<R>& in, Varyings<R>&) const {
    return {in.position, R(size), {}};
  }
  template <class R>
  Fragment<R> fragment(const Varyings<R>&, const Pixel<R>& px) const {
    const vec2<R> c = px.point_coord();
    return {vec4<R>(c.x, c.y, px.x, R(1.0f))};
  }
};

Image<glm::vec4> draw_points(const std::vector<glm::vec4>& p, float size, DrawState state = {}, int width = 32, int height = 16) {
  Image<glm::vec4> image(width, height);
  state.topology = Topology::points;
  Pass pass(width, height, rgba32f_target(image), {});
  pass.draw(CoordShader{size}, make_vertex_view(stream(p)), state);
  pass.run(one_worker());
  return image;
}

// OpenGL 4.6, section 14.4.1: a point covers the pixels whose centers are in the square. Centers on its left and bottom sides are included.
TEST(Points, CoverTheirSquare) {
  for (int i = 0; i < 400; ++i) {
    Random r(static_cast<uint64_t>(i));
    const Point center{r.integer(0, 32 * 256), r.integer(0, 16 * 256)};
    const int side = i % 3 == 0 ? 256 * r.integer(0, 12) : r.integer(1, 3000);
    const Image<glm::vec4> image = draw_points({clip_position(center, 32, 16)}, static_cast<float>(side) / 256.0f);
    const int x0 = center.x - side / 2, y0 = center.y - side / 2;
    for (int y = 0; y < 16; ++y) {
      for (int x = 0; x < 32; ++x) {
        const int sx = x * 256 + 128, sy = y * 256 + 128;
        const bool inside = sx >= x0 && sx < x0 + side && sy >= y0 && sy < y0 + side;
        ASSERT_EQ(pixel(image, x, y).w, inside ? 1.0f : 0.0f) << i << ": " << x << ' ' << y;
      }
    }
  }
}

// Section 14.4.1: s = 1/2 + (x − xw)/size, t = 1/2 ∓ (y − yw)/size.
TEST(Points, CoordinateSupportsBothOrigins) {
  const Point center{10 * 256, 8 * 256};
  for (const PointOrigin origin : {PointOrigin::upper_left, PointOrigin::lower_left}) {
    const Image<glm::vec4> image = draw_points({clip_position(center, 32, 16)}, 8.0f, {.point_origin = origin});
    for (int y = 4; y < 12; ++y) {
      for (int x = 6; x < 14; ++x) {
        const float t = 0.5f + (static_cast<float>(y) + 0.5f - 8.0f) / 8.0f;
        EXPECT_EQ(pixel(image, x, y).x, 0.5f + (static_cast<float>(x) + 0.5f - 10.0f) / 8.0f);
        EXPECT_EQ(pixel(image, x, y).y, origin == PointOrigin::upper_left ? 1.0f - t : t);
      }
    }
  }
}

// Each column shows a different point, so the values of the points are gathered: point c covers columns c − 2 to c + 1, and later points
// hide earlier ones.
TEST(Points, CoordinatesOfOverlappingPointsAreTheirOwn) {
  std::vector<glm::vec4> p;
  for (int c = 1; c <= 30; ++c) p.push_back(clip_position({c * 256, 8 * 256}, 32, 16));
  for (const PointOrigin origin : {PointOrigin::upper_left, PointOrigin::lower_left}) {
    const Image<glm::vec4> image = draw_points(p, 4.0f, {.point_origin = origin});
    for (int y = 6; y < 10; ++y) {
      for (int x = 0; x < 32; ++x) {
        const int c = std::min(x + 2, 30);
        const float t = (static_cast<float>(y) + 0.5f - 6.0f) / 4.0f;
        EXPECT_EQ(pixel(image, x, y).x, (static_cast<float>(x - c) + 2.5f) / 4.0f) << x << ' ' << y;
        EXPECT_EQ(pixel(image, x, y).y, origin == PointOrigin::upper_left ? 1.0f - t : t) << x << ' ' << y;
      }
    }
  }
}

TEST(Points, AreClippedByFootprintAndNotByCenter) {
  // The centers are outside on several sides. One is far outside the guard band, but its square reaches into the picture.
  const Image<glm::vec4> left = draw_points({clip_position({-3 * 256, 8 * 256}, 32, 16)}, 10.0f);
  for (int x = 0; x < 32; ++x) EXPECT_EQ(pixel(left, x, 8).w, x < 2 ? 1.0f : 0.0f) << x;
  const Image<glm::vec4> above = draw_points({clip_position({16 * 256, 20 * 256}, 32, 16)}, 12.0f);
  for (int y = 0; y < 16; ++y) EXPECT_EQ(pixel(above, 16, y).w, y >= 14 ? 1.0f : 0.0f) << y;
  const Image<glm::vec4> far = draw_points({{1250.0f, 0, 0, 1}}, 40000.0f);  // 20016 px to the right, with a half side of 20000 px
  for (int x = 0; x < 32; ++x) EXPECT_EQ(pixel(far, x, 3).w, x >= 16 ? 1.0f : 0.0f) << x;
  const Image<glm::vec4> behind = draw_points({{0, 0, 0, -1}, {0, 0, 2, 1}, {0, 0, -2, 1}}, 10.0f);
  for (int i = 0; i < 32 * 16; ++i) EXPECT_EQ(behind.data()[i].w, 0.0f);
}

TEST(Points, SupportSizesOf4096Pixels) {
  const Image<glm::vec4> image = draw_points({{0, 0, 0, 1}}, 4096.0f, {}, 4200, 33);
  for (int x = 0; x < 4200; ++x) ASSERT_EQ(pixel(image, x, 16).w, x >= 52 && x < 4148 ? 1.0f : 0.0f) << x;
  EXPECT_NEAR(pixel(image, 52, 16).x, 0.5f / 4096, 1e-9f);
  EXPECT_NEAR(pixel(image, 4147, 16).x, 4095.5f / 4096, 6e-8f);  // one ulp below 1
}

// A hemisphere over each point, with per-pixel depth from the visibility function.
struct BallShader {
  template <class R>
  struct Attributes {
    vec4<R> position;
    vec3<R> color;
  };
  template <class R>
  struct Varyings {
    vec3<R> color;
  };
  template <class R>
  PointSpriteVertex<R> vertex(const Attributes<R>& in, Varyings<R>& out) const {
    out.color = in.color;
    const R r(0.5f);
    return {vec2<R>(in.position.x - r, in.position.y - r), vec2<R>(in.position.x + r, in.position.y + r), in.position.z,
            in.position.w > R(0.0f)};
  }
  template <class R>
  Visibility<R> visibility(const Varyings<R>&, const Pixel<R>& px) const {
    const vec2<R> c = px.point_coord();
    const R x = c.x * R(2.0f) - R(1.0f), y = c.y * R(2.0f) - R(1.0f), h = R(1.0f) - x * x - y * y;
    return {h > R(0.0f), px.z() - R(0.1f) * h};
  }
  template <class R>
  DepthFragment<R> fragment(const Varyings<R>& in, const Pixel<R>& px) const {
    const Visibility<R> v = visibility(in, px);
    return {vec4<R>(in.color, R(1.0f)), v.keep, v.depth};
  }
};

TEST(Points, SpritesWithBoundsAndDepthAreShadedOnce) {
  const std::vector<glm::vec4> p{{-0.2f, 0, 0, 1}, {0.2f, 0, 0, 1}, {0, 0, 0.5f, 1}, {0.9f, 0.9f, -0.9f, -1}};
  const std::vector<glm::vec3> c{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}};
  Image<glm::vec4> images[2]{Image<glm::vec4>(64, 64), Image<glm::vec4>(64, 64)};
  for (const bool defer : {true, false}) {
    Pass pass(64, 64, rgba32f_target(images[defer]), {.format = DepthFormat::d32f}, {.tuning = {.defer = defer}});
    pass.draw(BallShader{}, make_vertex_view(stream(p), stream(c)), {.topology = Topology::points});
    const PassStatistics s = pass.run(one_worker());
    EXPECT_EQ(s.culled_outside, 1u);  // the fourth is marked as not drawn
    uint64_t covered = 0;
    for (int i = 0; i < 64 * 64; ++i) covered += images[defer].data()[i].w > 0.0f ? 1 : 0;
    if (defer) {
      EXPECT_EQ(s.fragments_shaded, covered);
    } else {
      EXPECT_GT(s.fragments_shaded, covered);
    }
  }
  for (int i = 0; i < 64 * 64; ++i) EXPECT_EQ(images[0].data()[i], images[1].data()[i]);
  // Two equal balls intersect in the plane between them.
  for (int y = 24; y < 40; ++y) {
    EXPECT_EQ(pixel(images[1], 31, y).x, 1.0f);
    EXPECT_EQ(pixel(images[1], 32, y).y, 1.0f);
  }
}

}  // namespace

}  // namespace halfspace
