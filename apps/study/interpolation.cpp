// SPDX-License-Identifier: Apache-2.0
//
// Compares methods for perspective-correct interpolation of varyings, on triangles of different shapes and sizes.
#include <fmt/format.h>

#include <array>
#include <cmath>

#include "halfspace/core/lanes.h"
#include "halfspace/shading/pixel.h"
#include "study/study.h"

namespace halfspace {

namespace {

// A vertex of a triangle: window position in 1/256 px, q = 1/w, and the value to interpolate.
struct Corner {
  double x, y, q, value;
};
using Corners = std::array<Corner, 3>;

// Interpolates in long double from the snapped vertices.
long double exact(const Corners& c, double x, double y) {
  const auto cross = [](long double ax, long double ay, long double bx, long double by) { return ax * by - ay * bx; };
  std::array<long double, 3> e{};
  for (std::size_t i = 0; i < 3; ++i) {
    const Corner &a = c[(i + 1) % 3], &b = c[(i + 2) % 3];
    e[i] = cross(b.x - static_cast<long double>(a.x), b.y - static_cast<long double>(a.y), x - static_cast<long double>(a.x),
                 y - static_cast<long double>(a.y)) *
           c[i].q;
  }
  return (e[0] * c[0].value + e[1] * c[1].value + e[2] * c[2].value) / (e[0] + e[1] + e[2]);
}

template <class R>
TriangleLanes<R> lanes_of(const Corners& c) {
  const auto r = [](double d) { return R(static_cast<std::conditional_t<std::is_same_v<R, double>, double, float>>(d)); };
  const double e1x = c[1].x - c[0].x, e1y = c[1].y - c[0].y, e2x = c[2].x - c[0].x, e2y = c[2].y - c[0].y;
  return {r(c[0].x), r(c[0].y), r(e1x), r(e1y), r(e2x), r(e2y), r(e1x * e2y - e1y * e2x), r(c[0].q), r(c[1].q), r(c[2].q), r(1.0)};
}

// The numerator or denominator of value = (A x + B y + C)/(D x + E y + F), with (x, y) relative to (x0, y0). Rasterizers commonly store
// these coefficients per triangle, relative to the window origin.
struct Plane {
  float a, b, c;
};
Plane plane_of(const Corners& corners, const std::array<float, 3>& v, float x0, float y0) {
  const auto f = [](double d) { return static_cast<float>(d); };
  const float e1x = f(corners[1].x) - f(corners[0].x), e1y = f(corners[1].y) - f(corners[0].y), e2x = f(corners[2].x) - f(corners[0].x),
              e2y = f(corners[2].y) - f(corners[0].y), area = e1x * e2y - e1y * e2x;
  const float a = ((v[1] - v[0]) * e2y - (v[2] - v[0]) * e1y) / area, b = ((v[2] - v[0]) * e1x - (v[1] - v[0]) * e2x) / area;
  return {a, b, v[0] - a * (f(corners[0].x) - x0) - b * (f(corners[0].y) - y0)};
}

// The interpolation methods that are compared. The constructor performs the triangle setup. value(x, y) interpolates in all lanes at once;
// positions are in units of 1/256 px.
struct Affine {
  using R = Real;
  TriangleLanes<R> t;
  R v0, d1, d2;
  explicit Affine(const Corners& c)
      : t(lanes_of<R>(c)),
        v0(static_cast<float>(c[0].value)),
        d1(static_cast<float>(c[1].value - c[0].value)),
        d2(static_cast<float>(c[2].value - c[0].value)) {}
  HS_INLINE R value(R x, R y) const {
    const Weights<R> w = weights_at(t, x - t.x0, y - t.y0);
    return interpolate<Interpolation::linear>(w, v0, d1, d2);
  }
};
struct Planes {
  using R = Real;
  Plane n, d;
  float x0, y0;
  Planes(const Corners& c, bool from_corner)
      : x0(from_corner ? static_cast<float>(c[0].x) : 0.0f), y0(from_corner ? static_cast<float>(c[0].y) : 0.0f) {
    std::array<float, 3> q{}, v{};
    for (std::size_t i = 0; i < 3; ++i) {
      q[i] = static_cast<float>(c[i].q);
      v[i] = static_cast<float>(c[i].value) * q[i];
    }
    n = plane_of(c, v, x0, y0);
    d = plane_of(c, q, x0, y0);
  }
  HS_INLINE R value(R x, R y) const {
    const R dx = x - R(x0), dy = y - R(y0);
    return (R(n.a) * dx + R(n.b) * dy + R(n.c)) / (R(d.a) * dx + R(d.b) * dy + R(d.c));
  }
};
template <class T>
struct Products {
  using R = T;
  TriangleLanes<R> t;
  R v0, d1, d2;
  explicit Products(const Corners& c) : t(lanes_of<R>(c)) {
    using F = std::conditional_t<std::is_same_v<R, double>, double, float>;
    v0 = R(static_cast<F>(c[0].value));
    d1 = R(static_cast<F>(c[1].value - c[0].value));
    d2 = R(static_cast<F>(c[2].value - c[0].value));
  }
  HS_INLINE R value(R x, R y) const { return interpolate<Interpolation::smooth>(weights_at(t, x - t.x0, y - t.y0), v0, d1, d2); }
};

// A triangle and the positions inside it, in 1/256 px, at which all methods are evaluated.
struct Case {
  std::string name;
  Corners corners;
  std::vector<float> x, y;
};

Case make_case(const std::string& name, double length_px, double height_px) {
  const double turn = 0.6, c = std::cos(turn), s = std::sin(turn);
  const auto corner = [&](double along, double across, double q, double value) {
    return Corner{std::round(256.0 * (700.3 + along * c - across * s)), std::round(256.0 * (400.7 + along * s + across * c)), q, value};
  };
  // q = 1/w varies by a factor of 5.
  Case out{name, {corner(0, 0, 0.4, 0.2), corner(length_px, 0, 2.0, 1.0), corner(0.4 * length_px, height_px, 0.9, -0.7)}, {}, {}};
  constexpr int kPoints = 4096;
  for (int i = 0; i < kPoints; ++i) {  // uniform over the triangle (golden ratio sequence), snapped
    const double u = std::sqrt((i + 0.5) / kPoints), v = i * 0.6180339887498949 - std::floor(i * 0.6180339887498949);
    const std::array<double, 3> w{1.0 - u, u * (1.0 - v), u * v};
    double x = 0.0, y = 0.0;
    for (std::size_t k = 0; k < 3; ++k) {
      x += w[k] * out.corners[k].x;
      y += w[k] * out.corners[k].y;
    }
    out.x.push_back(static_cast<float>(std::round(x)));
    out.y.push_back(static_cast<float>(std::round(y)));
  }
  return out;
}

constexpr int kRepeats = 244;  // about a million values in total

template <class Method>
Variant evaluated(const std::string& name, const std::string& group, const Case& c, const Method& method, const StudyOptions& options) {
  using R = typename Method::R;
  constexpr int width = std::is_same_v<R, Real> ? kLanes : 1;
  std::vector<float> out(c.x.size());
  const auto all = [&] {
    for (std::size_t i = 0; i + width <= c.x.size(); i += width) {
      if constexpr (std::is_same_v<R, double>) {
        out[i] = static_cast<float>(method.value(static_cast<double>(c.x[i]), static_cast<double>(c.y[i])));
      } else {
        store(&out[i], method.value(load<R>(&c.x[i]), load<R>(&c.y[i])));
      }
    }
  };
  Variant v{
      .name = name + ", " + c.name,
      .group = group,
      .parameters = {{"length_px", (c.corners[1].x - c.corners[0].x) / 256.0}, {"values", kRepeats * static_cast<double>(c.x.size())}},
      .time = time_of(
          [&] {
            for (int i = 0; i < kRepeats; ++i) all();
          },
          options)};
  long double squares = 0.0L;
  for (std::size_t i = 0; i < c.x.size(); ++i) {
    const double x = static_cast<double>(c.x[i]), y = static_cast<double>(c.y[i]);
    double got = static_cast<double>(out[i]);
    if constexpr (std::is_same_v<R, double>) got = method.value(x, y);
    const long double e = std::abs(static_cast<long double>(got) - exact(c.corners, x, y));
    v.error = std::max(v.error, static_cast<double>(e));
    squares += e * e;
  }
  v.measures = {{"rms", static_cast<double>(std::sqrt(squares / static_cast<long double>(c.x.size())))}};
  return v;
}

}  // namespace

Study study_interpolation(const StudyOptions& options, const Workers&) {
  Study study{
      .name = "interpolation",
      .title = "Perspective-correct interpolation over a triangle",
      .setting = fmt::format("1/w varies by a factor of 5; {} lanes, double is scalar; labels: method, length x height in px", kLanes),
      .error_name = "largest error over the triangle, relative to the largest value",
      .time_name = "a million values on one thread, without setup",
      .truth = {"barycentric weights in long double", 0x1p-58, "a few roundings of 2^-64, amplified by cancellation"},
  };
  std::vector<Case> cases{make_case("16x14", 16, 14)};
  if (!options.quick) {
    cases.push_back(make_case("512x440", 512, 440));
    cases.push_back(make_case("1000x1", 1000, 1));
  }
  for (const Case& c : cases) {
    study.variants.push_back(evaluated("affine", "affine (no perspective)", c, Affine(c.corners), options));
    study.variants.push_back(evaluated("planes", "plane equations from the window origin", c, Planes(c.corners, false), options));
    study.variants.push_back(evaluated("vertex planes", "plane equations from a vertex", c, Planes(c.corners, true), options));
    study.variants.push_back(evaluated("products", "differences of products (used here)", c, Products<Real>(c.corners), options));
    study.variants.push_back(evaluated("double", "the same in double", c, Products<double>(c.corners), options));
  }
  return study;
}

}  // namespace halfspace
