// SPDX-License-Identifier: Apache-2.0
//
// Compares interpolation with long double, evaluated from the input of the fragment stage: the snapped positions and the float 1/w of the
// vertices. Errors are relative to the largest |value| of the three vertices.
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "halfspace/raster/shade/plane_anchor.h"
#include "raster/raster_test.h"

namespace halfspace::raster_test {
namespace {

using Exact = long double;
static_assert(std::numeric_limits<Exact>::digits >= 64);

struct Corner {
  Exact x, y;  // 1/256 px
  Exact q;     // 1/w
  glm::vec4 value;
};

/// Interpolates a triangle in long double as specified in OpenGL 4.6, section 14.6.1.
class ExactPlane {
 public:
  explicit ExactPlane(const std::array<Corner, 3>& v) : v_(v) {
    area_ = cross(v[1].x - v[0].x, v[1].y - v[0].y, v[2].x - v[0].x, v[2].y - v[0].y);
  }
  Exact area() const { return area_; }

  std::array<Exact, 3> linear_weights(Exact x, Exact y) const {
    std::array<Exact, 3> b;
    for (std::size_t i = 0; i < 3; ++i) {
      const Corner &s = v_[(i + 1) % 3], &t = v_[(i + 2) % 3];
      b[i] = cross(t.x - s.x, t.y - s.y, x - s.x, y - s.y) / area_;
    }
    return b;
  }
  Exact linear(int k, Exact x, Exact y) const {
    const auto b = linear_weights(x, y);
    return b[0] * at(0, k) + b[1] * at(1, k) + b[2] * at(2, k);
  }
  Exact smooth(int k, Exact x, Exact y) const {
    const auto b = linear_weights(x, y);
    Exact sum = 0, weight = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      sum += b[i] * v_[i].q * at(i, k);
      weight += b[i] * v_[i].q;
    }
    return sum / weight;
  }
  Exact inv_w(Exact x, Exact y) const {
    const auto b = linear_weights(x, y);
    return b[0] * v_[0].q + b[1] * v_[1].q + b[2] * v_[2].q;
  }
  /// Returns d(smooth)/dx and d(smooth)/dy per pixel: (N'·D − N·D') / D² of the quotient above.
  std::array<Exact, 2> derivatives(int k, Exact x, Exact y) const {
    const auto b = linear_weights(x, y);
    std::array<Exact, 2> out;
    for (std::size_t axis = 0; axis < 2; ++axis) {
      Exact n = 0, d = 0, dn = 0, dd = 0;
      for (std::size_t i = 0; i < 3; ++i) {
        const Corner &s = v_[(i + 1) % 3], &t = v_[(i + 2) % 3];
        const Exact db = (axis == 0 ? -(t.y - s.y) : t.x - s.x) / area_ * 256;
        n += b[i] * v_[i].q * at(i, k);
        d += b[i] * v_[i].q;
        dn += db * v_[i].q * at(i, k);
        dd += db * v_[i].q;
      }
      out[axis] = (dn * d - n * dd) / (d * d);
    }
    return out;
  }
  Exact max_of(int k) const { return std::max({std::fabs(at(0, k)), std::fabs(at(1, k)), std::fabs(at(2, k))}); }

 private:
  static Exact cross(Exact ax, Exact ay, Exact bx, Exact by) { return ax * by - ay * bx; }
  Exact at(std::size_t i, int k) const { return static_cast<Exact>(v_[i].value[k]); }

  std::array<Corner, 3> v_;
  Exact area_;
};

using ValueShader = SmoothColorShader;
using LinearShader = LinearColorShader;

struct Scene {
  std::vector<glm::vec4> positions, values;
  int width, height;

  VertexView view() const { return make_vertex_view(stream(positions), stream(values)); }
  ExactPlane plane() const {
    const ShadedVertices v = shade(ValueShader{}, view(), {0, 0, width, height});
    std::array<Corner, 3> c;
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_EQ(v.outcodes[i] & (kOutNear | kOutFar | kOutGuard | kOutNonFinite), 0);
      c[i] = {static_cast<Exact>(v.screen[i].x), static_cast<Exact>(v.screen[i].y), static_cast<Exact>(v.screen[i].inv_w), values[i]};
    }
    return ExactPlane(c);
  }
};

// Converts window coordinates (in pixels) and w to clip space.
glm::vec4 clip_at(const Scene& s, double x, double y, double w) {
  return {static_cast<float>((2 * x / s.width - 1) * w), static_cast<float>((2 * y / s.height - 1) * w), 0.0f, static_cast<float>(w)};
}

// Draws only the triangle of the scene. Uncovered pixels keep a NaN.
template <class S>
Image<glm::vec4> draw(const S& shader, const Scene& s, const DrawState& state = {}) {
  Image<glm::vec4> image(s.width, s.height);
  ColorTarget target = rgba32f_target(image);
  target.clear_value = glm::vec4(std::numeric_limits<float>::quiet_NaN());
  Pass pass(s.width, s.height, target, {});
  pass.draw(shader, s.view(), state);
  pass.run(one_worker());
  return image;
}

template <class F>
void for_each_covered(const Image<glm::vec4>& image, F f) {
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      const glm::vec4& p = pixel(image, x, y);
      if (!std::isnan(p.w)) f(x, y, p);
    }
  }
}

constexpr Exact center_of(int x) { return static_cast<Exact>(x * 256 + 128); }

struct Error {
  Exact max = 0, sum = 0;
  int64_t count = 0;
  void add(Exact e) {
    max = std::max(max, e);
    sum += e;
    ++count;
  }
  double mean() const { return static_cast<double>(sum / static_cast<Exact>(std::max<int64_t>(count, 1))); }
  void report(const char* name) const {
    std::printf("%-34s max %.3g mean %.3g over %lld values\n", name, static_cast<double>(max), mean(), static_cast<long long>(count));
    ::testing::Test::RecordProperty(std::string(name) + "_max", std::to_string(static_cast<double>(max) * 1e9) + "e-9");
  }
};

enum class Shape { small, medium, large, huge, sliver };
enum class Values { unit, symmetric, offset };

const char* name_of(Shape s) {
  switch (s) {
    case Shape::small: return "4 px";
    case Shape::medium: return "100 px";
    case Shape::large: return "1000 px";
    case Shape::huge: return "16k px";
    default: return "1000x1 sliver";
  }
}
const char* name_of(Values v) { return v == Values::unit ? "[0,1]" : v == Values::symmetric ? "[-1,1]" : "offset"; }

// Returns a random triangle of the given shape, and a small render target that can be anywhere on the triangle.
Scene random_scene(Random& r, Shape shape, Values values, double w_ratio) {
  Scene s;
  s.width = shape == Shape::small ? 8 : shape == Shape::sliver ? 1024 : 64;
  s.height = shape == Shape::sliver ? 16 : s.width;
  const double size = shape == Shape::small ? 4 : shape == Shape::medium ? 100 : shape == Shape::large ? 1000 : 15000;
  std::array<std::array<double, 2>, 3> p;
  if (shape == Shape::sliver) {
    const double y = r.real(4.0, 12.0), tilt = r.real(-4.0, 4.0), x = r.real(0.0, 24.0);
    p = {{{x, y}, {x + 1000, y + tilt}, {x + r.real(0.0, 1000.0), y + tilt * 0.5 + r.real(-1.0, 1.0)}}};
  } else {
    const double cx = s.width * 0.5, cy = s.height * 0.5;
    const double turn = r.real(0.0, 6.28);
    for (std::size_t i = 0; i < 3; ++i) {
      const double angle = turn + 2.0944 * static_cast<double>(i) + r.real(-0.6, 0.6), reach = size * r.real(0.2, 1.0);
      p[i] = {cx + reach * std::cos(angle), cy + reach * std::sin(angle)};
    }
    // Move a random point of the triangle to the center of the target.
    double a = r.real(0.0, 1.0), b = r.real(0.0, 1.0);
    if (a + b > 1) a = 1 - a, b = 1 - b;
    for (int axis = 0; axis < 2; ++axis) {
      const auto k = static_cast<std::size_t>(axis);
      const double at = p[0][k] + a * (p[1][k] - p[0][k]) + b * (p[2][k] - p[0][k]) - (axis ? cy : cx);
      for (auto& q : p) q[k] = std::clamp(q[k] - at, -16000.0, 16000.0);
    }
  }
  const double w0 = r.magnitude(1e-3, 1e3);
  const glm::vec4 base(r.real(-1000.0f, 1000.0f));
  const int near = r.integer(0, 2), far = (near + r.integer(1, 2)) % 3;  // the ratio of these two vertices is w_ratio
  for (int i = 0; i < 3; ++i) {
    const double w = w0 * (i == near ? 1.0 : i == far ? w_ratio : r.magnitude(1.0, std::max(w_ratio, 1.0 + 1e-9)));
    const auto at = static_cast<std::size_t>(i);
    s.positions.push_back(clip_at(s, p[at][0], p[at][1], w));
    glm::vec4 v;
    for (int k = 0; k < 4; ++k) {
      v[k] = values == Values::unit ? r.real(0.0f, 1.0f) : values == Values::symmetric ? r.real(-1.0f, 1.0f) : base[k] + r.real(0.0f, 1.0f);
    }
    s.values.push_back(v);
  }
  return s;
}

template <class S>
Error measure(uint64_t seed, int triangles, Shape shape, Values values, double w_ratio, bool linear, const S& shader) {
  Random r(seed);
  Error e;
  for (int i = 0; i < triangles; ++i) {
    const Scene s = random_scene(r, shape, values, w_ratio);
    const ExactPlane exact = s.plane();
    if (exact.area() == 0) continue;
    for_each_covered(draw(shader, s), [&](int x, int y, const glm::vec4& p) {
      for (int k = 0; k < 4; ++k) {
        const Exact want = linear ? exact.linear(k, center_of(x), center_of(y)) : exact.smooth(k, center_of(x), center_of(y));
        e.add(std::fabs(static_cast<Exact>(p[k]) - want) / exact.max_of(k));
      }
    });
  }
  return e;
}

// Errors are relative to the largest |value|, with u = 2^-24. A weight near 1 has an error of u, because it and its complement are rounded.
// A weight near 1/2 has an error of up to 2u, because three terms are rounded. The difference from the value of v0 can be twice the largest
// value and is itself rounded (u). The result is also rounded (u/2). The total is 5u = 3e-7.
constexpr Exact kTolerance = 3e-7L;

TEST(Interpolation, SmoothValuesStayWithinTolerance) {
  int row = 0;
  for (const Shape shape : {Shape::small, Shape::medium, Shape::large, Shape::huge, Shape::sliver}) {
    const int triangles = effort(shape == Shape::small ? 2000 : shape == Shape::sliver ? 200 : 75);
    for (const Values values : {Values::unit, Values::symmetric, Values::offset}) {
      Error all;
      for (const double ratio : {1.0, 2.0, 100.0, 1e4}) {
        const Error e = measure(static_cast<uint64_t>(100 + row++), triangles, shape, values, ratio, false, ValueShader{});
        EXPECT_GT(e.count, triangles * 8);
        EXPECT_LE(e.max, kTolerance) << name_of(shape) << ' ' << name_of(values) << " w ratio " << ratio;
        all.max = std::max(all.max, e.max);
        all.sum += e.sum;
        all.count += e.count;
      }
      all.report((std::string(name_of(shape)) + ' ' + name_of(values)).c_str());
    }
  }
}

TEST(Interpolation, LinearValuesStayWithinTolerance) {
  int row = 0;
  for (const Shape shape : {Shape::small, Shape::medium, Shape::large, Shape::huge, Shape::sliver}) {
    const int triangles = effort(shape == Shape::small ? 2000 : shape == Shape::sliver ? 200 : 75);
    for (const Values values : {Values::unit, Values::symmetric, Values::offset}) {
      const Error e = measure(static_cast<uint64_t>(300 + row++), triangles, shape, values, 100.0, true, LinearShader{});
      EXPECT_LE(e.max, kTolerance) << name_of(shape) << ' ' << name_of(values);
      e.report((std::string("linear ") + name_of(shape) + ' ' + name_of(values)).c_str());
    }
  }
}

// Large triangles with constant w are evaluated as planes, unless they are so thin that the rounding errors would be too large. The errors
// are largest if the values are 1 and −1.
TEST(Interpolation, PlanesStayWithinTolerance) {
  Random r(900);
  Error e;
  int cells = 0, planes = 0;
  for (int i = 0; i < effort(400); ++i) {
    Scene s{{}, {}, 192, 160};
    const double w = r.magnitude(1e-3, 1e3), size = r.magnitude(50, 2000);
    const double x = r.real(0.0, 192.0), y = r.real(0.0, 160.0), turn = r.real(0.0, 6.28), height = r.magnitude(1e-3, 1.0),
                 tilt = r.real(0.0, 6.28);
    for (int k = 0; k < 3; ++k) {
      const double angle = turn + 2.0944 * k + r.real(-0.9, 0.9), reach = size * r.real(0.3, 1.0);
      const double along = reach * std::cos(angle), across = reach * height * std::sin(angle);
      s.positions.push_back(
          clip_at(s, x + along * std::cos(tilt) - across * std::sin(tilt), y + along * std::sin(tilt) + across * std::cos(tilt), w));
    }
    s.values = {glm::vec4(1, 1, 1, -1), glm::vec4(1, 1, -1, 1), glm::vec4(1, -1, 1, 1)};
    const ExactPlane exact = s.plane();
    const ShadedVertices v = shade(ValueShader{}, s.view(), {0, 0, s.width, s.height});
    std::array<PlaneCorner, 3> corners;
    for (std::size_t k = 0; k < 3; ++k) corners[k] = {v.screen[k].x, v.screen[k].y, v.screen[k].inv_w};
    if (exact.area() < 0) std::swap(corners[1], corners[2]);
    std::optional<PlaneCell> cell;
    bool is_plane = false;
    for_each_covered(draw(ValueShader{}, s), [&](int px, int py, const glm::vec4& p) {
      if (cell != PlaneCell::of(px, py)) {
        cell = PlaneCell::of(px, py);
        is_plane = plane_anchor(corners, *cell).is_valid;
        ++cells;
        planes += is_plane ? 1 : 0;
      }
      for (int k = 0; is_plane && k < 4; ++k) e.add(std::fabs(static_cast<Exact>(p[k]) - exact.smooth(k, center_of(px), center_of(py))));
    });
  }
  e.report("planes");
  EXPECT_LE(e.max, kTolerance);
  EXPECT_GT(planes, cells / 10);
}

// The accuracy is only specified for ratios up to 1e4. No step suffers from cancellation, however, so the error does not grow for larger
// ratios. The printed table is the data for the chart in the documentation.
TEST(Interpolation, LargeRatiosOfWStayWithinTolerance) {
  for (const double ratio : {1e4, 1e5, 1e6, 1e7, 1e8, 1e10, 1e12}) {
    Error e;
    for (const Shape shape : {Shape::medium, Shape::huge, Shape::sliver}) {
      const Error part = measure(500, effort(150), shape, Values::symmetric, ratio, false, ValueShader{});
      e.max = std::max(e.max, part.max);
      e.sum += part.sum;
      e.count += part.count;
    }
    e.report(("w ratio " + std::to_string(static_cast<int64_t>(ratio))).c_str());
    EXPECT_LE(e.max, kTolerance);
  }
}

// A value that is equal at all three vertices must be bit-identical at every pixel.
TEST(Interpolation, ConstantsStayConstant) {
  Random r(4);
  for (int i = 0; i < effort(400); ++i) {
    Scene s = random_scene(r, static_cast<Shape>(i % 5), Values::offset, r.magnitude(1.0, 1e4));
    s.values[1] = s.values[2] = s.values[0];
    for_each_covered(draw(ValueShader{}, s), [&](int, int, const glm::vec4& p) { ASSERT_EQ(p, s.values[0]); });
    for_each_covered(draw(LinearShader{}, s), [&](int, int, const glm::vec4& p) { ASSERT_EQ(p, s.values[0]); });
  }
}

TEST(Interpolation, PerspectiveAndLinearDifferOnlyIfWVaries) {
  // A floor from w = 1 (bottom) to w = 9 (top). Halfway up, the affine value is 0.5, and the perspective-correct value is 0.1: with q = 1
  // and 1/9, (1/9)/2 / (1/2 + 1/18) = 0.1.
  Scene s{{}, {}, 64, 64};
  s.positions = {clip_at(s, -64, 0, 1), clip_at(s, 128, 0, 1), clip_at(s, 32, 64, 9)};
  s.values = {glm::vec4(0), glm::vec4(0), glm::vec4(1)};
  const Image<glm::vec4> perspective = draw(ValueShader{}, s), affine = draw(LinearShader{}, s);
  const float h = 31.5f / 64;
  EXPECT_NEAR(pixel(affine, 32, 31).x, h, 1e-6);
  EXPECT_NEAR(pixel(perspective, 32, 31).x, (h / 9) / (h / 9 + 1 - h), 1e-6);

  // If w is constant, both are the same function, within their rounding errors.
  Random r(5);
  for (int i = 0; i < effort(100); ++i) {
    const Scene flat = random_scene(r, Shape::medium, Values::symmetric, 1.0);
    const Image<glm::vec4> p = draw(ValueShader{}, flat), a = draw(LinearShader{}, flat);
    for_each_covered(p, [&](int x, int y, const glm::vec4& v) {
      for (int k = 0; k < 4; ++k) ASSERT_NEAR(v[k], pixel(a, x, y)[k], 6e-7);
    });
  }
}

// ---- clipped triangles -----------------------------------------------------------------------------------------

// The triangles of a clipped polygon interpolate between vertices with snapped positions and values rounded to float. The result is
// compared with the unsnapped plane of the whole triangle. The tolerance is a displacement of half a sub-pixel (√2/512 px) times the slope
// of the value, plus two roundings.
TEST(Interpolation, ClippedTrianglesKeepTheirValues) {
  Random r(6);
  int64_t compared = 0;
  Exact worst = 0;
  for (int i = 0; i < effort(300); ++i) {
    Scene s{{}, {}, 64, 64};
    for (int k = 0; k < 3; ++k) {
      const double w = k == 0 ? r.real(0.5, 2.0) : r.real(-3.0, 3.0);
      s.positions.push_back({r.real(-2.0f, 2.0f), r.real(-2.0f, 2.0f), r.real(-1.0f, 1.0f) * static_cast<float>(w), static_cast<float>(w)});
      s.values.push_back({r.real(-1.0f, 1.0f), r.real(-1.0f, 1.0f), r.real(-1.0f, 1.0f), r.real(0.0f, 1.0f)});
    }
    const auto& p = s.positions;
    const auto n = [&](std::size_t k) {  // homogeneous edge function opposite to vertex k, as in clip_test
      const glm::dvec3 a(p[(k + 1) % 3].x, p[(k + 1) % 3].y, p[(k + 1) % 3].w), b(p[(k + 2) % 3].x, p[(k + 2) % 3].y, p[(k + 2) % 3].w);
      return glm::cross(a, b);
    };
    const std::array<glm::dvec3, 3> edge{n(0), n(1), n(2)};
    const double det = glm::dot(edge[0], glm::dvec3(p[0].x, p[0].y, p[0].w));
    if (std::fabs(det) < 0.05) continue;
    const auto value_at = [&](double x, double y, int k) {
      const glm::dvec3 sample((2 * x / 64) - 1, (2 * y / 64) - 1, 1);
      double sum = 0, weight = 0;
      for (std::size_t v = 0; v < 3; ++v) {
        const double lambda = glm::dot(edge[v], sample);
        sum += lambda * static_cast<double>(s.values[v][k]);
        weight += lambda;
      }
      return sum / weight;
    };
    for_each_covered(draw(ValueShader{}, s), [&](int x, int y, const glm::vec4& got) {
      for (int k = 0; k < 4; ++k) {
        const double cx = x + 0.5, cy = y + 0.5, here = value_at(cx, cy, k), d = 1.0 / 64;
        const double slope = std::max({std::fabs(value_at(cx + d, cy, k) - here), std::fabs(value_at(cx - d, cy, k) - here),
                                       std::fabs(value_at(cx, cy + d, k) - here), std::fabs(value_at(cx, cy - d, k) - here)}) /
                             d;
        const double error = std::fabs(static_cast<double>(got[k]) - here);
        worst = std::max<Exact>(worst, static_cast<Exact>(error));
        ++compared;
        // Each vertex can be displaced by 1/512 px along both axes, in different directions; the effect is at most the slope times twice
        // √2/512 px.
        ASSERT_LE(error, slope * 2 * 1.4143 / 512 + 1e-6) << i << ": " << x << ", " << y;
      }
    });
  }
  EXPECT_GT(compared, effort(300) * 500);
  std::printf("%lld values compared, largest difference %.3g\n", static_cast<long long>(compared), static_cast<double>(worst));
}

// ---- derivatives and quads -------------------------------------------------------------------------------------

struct DerivativeShader {
  int what = 0;  // 0: ddx, 1: ddy, 2 to 5: the value at pixel (0,0), (1,0), (0,1), (1,1) of the quad; 6: 1/w, z, position;
                 // 7, 8: quad_ddx and quad_ddy of the value
  template <class R>
  using Attributes = ValueShader::Attributes<R>;
  template <class R>
  struct Varyings {
    Flat<R> first;  // ensures that the tested member is not the first one
    vec4<R> value;
  };
  template <class R>
  vec4<R> vertex(const Attributes<R>& in, Varyings<R>& out) const {
    out.first.value = R(7);
    out.value = in.color;
    return in.position;
  }
  template <class R>
  Fragment<R> fragment(const Varyings<R>&, const Pixel<R>& px) const {
    if (what == 0) return {px.ddx(&Varyings<R>::value)};
    if (what == 1) return {px.ddy(&Varyings<R>::value)};
    if (what == 6) return {vec4<R>(px.inv_w(), px.z(), px.x, px.y)};
    const auto value = [](const Varyings<R>& v) { return v.value; };
    if (what == 7) return {px.template quad_ddx<Varyings<R>>(value)};
    if (what == 8) return {px.template quad_ddy<Varyings<R>>(value)};
    return {px.template at_quad<Varyings<R>>((what - 2) & 1, (what - 2) >> 1).value};
  }
};

TEST(Derivatives, MatchTheExactDerivatives) {
  Random r(7);
  Error e;
  for (int i = 0; i < effort(400); ++i) {
    const Shape shape = static_cast<Shape>(i % 5);
    const Scene s = random_scene(r, shape, Values::symmetric, r.magnitude(1.0, 1e4));
    const ExactPlane exact = s.plane();
    const Image<glm::vec4> dx = draw(DerivativeShader{0}, s), dy = draw(DerivativeShader{1}, s);
    for_each_covered(dx, [&](int x, int y, const glm::vec4& got_x) {
      for (int k = 0; k < 4; ++k) {
        const auto want = exact.derivatives(k, center_of(x), center_of(y));
        // The derivative is a sum of terms that may cancel. The error is therefore relative to the steepest of the four components in both
        // directions, which approximates the magnitude of the terms.
        Exact scale = 0;
        for (int n = 0; n < 4; ++n) {
          const auto d = exact.derivatives(n, center_of(x), center_of(y));
          scale = std::max({scale, std::fabs(d[0]), std::fabs(d[1])});
        }
        e.add(std::fabs(static_cast<Exact>(got_x[k]) - want[0]) / scale);
        e.add(std::fabs(static_cast<Exact>(pixel(dy, x, y)[k]) - want[1]) / scale);
      }
    });
  }
  e.report("derivatives");
  // The derivative of each weight is a product of seven rounded factors without cancellation (5e-7). The two terms of a component may
  // cancel, which the scale of the four components does not fully account for.
  EXPECT_LE(static_cast<double>(e.mean()), 2e-7);
  EXPECT_LE(static_cast<double>(e.max), 3e-6);
}

TEST(Derivatives, MatchFiniteDifferences) {
  Random r(8);
  for (int i = 0; i < effort(60); ++i) {
    const Scene s = random_scene(r, Shape::large, Values::symmetric, r.magnitude(1.0, 10.0));
    const ExactPlane exact = s.plane();
    const Image<glm::vec4> dx = draw(DerivativeShader{0}, s), dy = draw(DerivativeShader{1}, s);
    for_each_covered(dx, [&](int x, int y, const glm::vec4& got) {
      for (int k = 0; k < 4; ++k) {
        // Central differences over ±1/16 px. Their own error is of the order of the third derivative, far below 1e-6.
        const Exact cx = center_of(x), cy = center_of(y);
        const Exact fx = (exact.smooth(k, cx + 16, cy) - exact.smooth(k, cx - 16, cy)) * 8;
        const Exact fy = (exact.smooth(k, cx, cy + 16) - exact.smooth(k, cx, cy - 16)) * 8;
        ASSERT_NEAR(got[k], static_cast<double>(fx), 1e-6);
        ASSERT_NEAR(pixel(dy, x, y)[k], static_cast<double>(fy), 1e-6);
      }
    });
  }
}

TEST(Derivatives, QuadNeighborsMatchTheirOwnPixels) {
  Random r(9);
  int64_t compared = 0;
  for (int i = 0; i < effort(60); ++i) {
    const Scene s = random_scene(r, i % 2 ? Shape::large : Shape::medium, Values::symmetric, r.magnitude(1.0, 100.0));
    const Image<glm::vec4> direct = draw(ValueShader{}, s);
    for (int j = 0; j < 2; ++j) {
      for (int k = 0; k < 2; ++k) {
        const Image<glm::vec4> there = draw(DerivativeShader{2 + k + 2 * j}, s);
        for_each_covered(there, [&](int x, int y, const glm::vec4& got) {
          const glm::vec4& want = pixel(direct, (x & ~1) + k, (y & ~1) + j);
          if (std::isnan(want.w)) return;  // the triangle does not cover that neighbor
          ++compared;
          ASSERT_EQ(got, want) << x << ", " << y;  // the arithmetic is the same, so the bits are
        });
      }
    }
  }
  EXPECT_GT(compared, effort(60) * 4000);
}

TEST(Derivatives, DifferencesInTheQuadAreThoseOfItsPixels) {
  Random r(11);
  for (int i = 0; i < effort(20); ++i) {
    const Scene s = random_scene(r, i % 2 ? Shape::large : Shape::medium, Values::symmetric, r.magnitude(1.0, 100.0));
    const Image<glm::vec4> dx = draw(DerivativeShader{7}, s), dy = draw(DerivativeShader{8}, s);
    const Image<glm::vec4> first = draw(DerivativeShader{2}, s), right = draw(DerivativeShader{3}, s), up = draw(DerivativeShader{4}, s);
    for_each_covered(dx, [&](int x, int y, const glm::vec4& got) {
      ASSERT_EQ(got, pixel(right, x, y) - pixel(first, x, y));
      ASSERT_EQ(pixel(dy, x, y), pixel(up, x, y) - pixel(first, x, y));
    });
  }
}

TEST(Pixels, ProvidePositionDepthAndW) {
  Random r(10);
  Error inv_w;
  for (int i = 0; i < effort(200); ++i) {
    const Scene s = random_scene(r, static_cast<Shape>(i % 5), Values::unit, r.magnitude(1.0, 1e4));
    const ExactPlane exact = s.plane();
    for_each_covered(draw(DerivativeShader{6}, s), [&](int x, int y, const glm::vec4& got) {
      ASSERT_EQ(got.z, static_cast<float>(x) + 0.5f);
      ASSERT_EQ(got.w, static_cast<float>(y) + 0.5f);
      ASSERT_EQ(got.y, 0.5f);  // clip z is 0 everywhere
      const Exact want = exact.inv_w(center_of(x), center_of(y));
      inv_w.add(std::fabs(static_cast<Exact>(got.x) - want) / want);
    });
  }
  inv_w.report("1/w, relative error");
  EXPECT_LE(inv_w.max, 6e-7L);  // a sum of non-negative terms with at most ten roundings, for any ratio
}

}  // namespace
}  // namespace halfspace::raster_test
