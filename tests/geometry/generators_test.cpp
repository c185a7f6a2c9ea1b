// SPDX-License-Identifier: Apache-2.0
//
// Compares the generators other than uv_sphere, with and without displacement, with their formulas, evaluated in double with libm.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "geometry/mesh_checks.h"
#include "geometry/rough_map.h"
#include "halfspace/geometry/shapes.h"
#include "support/constants.h"
#include "support/workers.h"

namespace halfspace {
namespace {

// A face of a shape: position and unit normal as functions of (u, v), and the factor that fades out the displacement.
struct Face {
  std::function<glm::dvec3(double, double)> position, normal;
  std::function<double(double, double)> fade = [](double, double) { return 1.0; };
};

struct ShapeCase {
  std::string name;
  Mesh (*make)(int n, const Displacement* d);
  MapEdges edges;
  double area, volume;  // closed forms; a volume of 0 marks an open surface
  std::vector<Face> faces;
  std::size_t (*face_of)(const glm::vec3& normal);  // maps a normal of the undisplaced mesh to an index into `faces`
};
void PrintTo(const ShapeCase& s, std::ostream* os) { *os << s.name; }

double smooth(double x) {
  const double s = std::min(x / 0.125, 1.0);
  return s * s * (3 - 2 * s);
}
double fade_in_v(double, double v) { return smooth(std::min(v, 1 - v)); }
double fade_in_both(double u, double v) { return smooth(std::min(u, 1 - u)) * smooth(std::min(v, 1 - v)); }
double fade_in_radius(double u, double v) { return smooth(1 - std::hypot(2 * u - 1, 2 * v - 1)); }

glm::dvec3 out(double u) { return {std::cos(2 * kPi * u), 0, -std::sin(2 * kPi * u)}; }
const glm::dvec3 kX(1, 0, 0), kY(0, 1, 0), kZ(0, 0, 1);

// Returns a flat face. The center of the map is at `center`; u spans `size` along `right`, and v spans `size` along −`up`.
Face flat(const glm::dvec3& center, const glm::dvec3& right, const glm::dvec3& up, double size, double (*fade)(double, double)) {
  return {[=](double u, double v) { return center + size * ((u - 0.5) * right + (0.5 - v) * up); },
          [=](double, double) { return glm::cross(right, up); }, fade};
}
double no_fade(double, double) { return 1.0; }

std::size_t first_face(const glm::vec3&) { return 0; }
std::size_t by_caps(const glm::vec3& n) { return n.y == 1.0f ? 1 : n.y == -1.0f ? 2 : 0; }
std::size_t by_base(const glm::vec3& n) { return n.y == -1.0f ? 1 : 0; }
std::size_t by_axis(const glm::vec3& n) {
  for (int k = 0; k < 3; ++k) {
    if (n[k] != 0) return static_cast<std::size_t>(2 * k + (n[k] > 0 ? 0 : 1));
  }
  return 6;
}

std::vector<Face> cube_faces(double size) {
  const double h = 0.5 * size;
  return {flat(h * kX, -kZ, kY, size, fade_in_both), flat(-h * kX, kZ, kY, size, fade_in_both), flat(h * kY, kX, -kZ, size, fade_in_both),
          flat(-h * kY, kX, kZ, size, fade_in_both), flat(h * kZ, kX, kY, size, fade_in_both),  flat(-h * kZ, -kX, kY, size, fade_in_both)};
}

glm::dvec3 sphere_normal(double u, double v) { return std::sin(kPi * v) * out(u) + std::cos(kPi * v) * kY; }
glm::dvec3 torus_normal(double u, double v) { return -std::cos(2 * kPi * v) * out(u) + std::sin(2 * kPi * v) * kY; }
glm::dvec3 knot(double u) {
  const double ring = 1.5 + 0.6 * std::cos(6 * kPi * u);
  return ring * out(2 * u) + 0.6 * std::sin(6 * kPi * u) * kY;
}
double knot_length() {
  constexpr int kSteps = 20000;  // the relative error of the chord lengths is about 1e-7
  double length = 0.0;
  for (int i = 0; i < kSteps; ++i) length += glm::distance(knot(static_cast<double>(i) / kSteps), knot((i + 1.0) / kSteps));
  return length;
}
glm::dvec3 knot_normal(double u, double v) {
  constexpr double h = 1e-5;
  const glm::dvec3 n = std::cos(6 * kPi * u) * out(2 * u) + std::sin(6 * kPi * u) * kY;
  const glm::dvec3 b = glm::cross(glm::normalize(knot(u + h) - knot(u - h)), n);
  return std::cos(2 * kPi * v) * n + std::sin(2 * kPi * v) * b;
}
const double kSlant = std::sqrt(1.5 * 1.5 + 2.5 * 2.5);

std::vector<ShapeCase> shape_cases() {
  return {
      {"Icosphere",
       [](int n, const Displacement* d) { return icosphere(static_cast<int>(std::log2(n)), 1.5f, d); },
       MapEdges::sphere,
       4 * kPi * 2.25,
       4 * kPi / 3 * 3.375,
       {{[](double u, double v) { return 1.5 * sphere_normal(u, v); }, sphere_normal}},
       first_face},
      {"Cylinder",
       [](int n, const Displacement* d) { return cylinder(1.5f, 2.5f, n, 2 * n, d); },
       MapEdges::cylinder,
       2 * kPi * 1.5 * (1.5 + 2.5),
       kPi * 2.25 * 2.5,
       {{[](double u, double v) { return 1.5 * out(u) + 2.5 * (0.5 - v) * kY; }, [](double u, double) { return out(u); }, fade_in_v},
        flat(1.25 * kY, kX, -kZ, 3, fade_in_radius),
        flat(-1.25 * kY, kX, kZ, 3, fade_in_radius)},
       by_caps},
      {"Cone",
       [](int n, const Displacement* d) { return cone(1.5f, 2.5f, n, 2 * n, d); },
       MapEdges::cylinder,
       kPi * 1.5 * (1.5 + kSlant),
       kPi * 2.25 * 2.5 / 3,
       {{[](double u, double v) { return 1.5 * v * out(u) + 2.5 * (0.5 - v) * kY; },
         [](double u, double) { return (2.5 * out(u) + 1.5 * kY) / kSlant; }, fade_in_v},
        flat(-1.25 * kY, kX, kZ, 3, fade_in_radius)},
       by_base},
      {"Torus",
       [](int n, const Displacement* d) { return torus(1.5f, 0.5f, 2 * n, 4 * n, d); },
       MapEdges::torus,
       4 * kPi * kPi * 1.5 * 0.5,
       2 * kPi * kPi * 1.5 * 0.25,
       {{[](double u, double v) { return 1.5 * out(u) + 0.5 * torus_normal(u, v); }, torus_normal}},
       first_face},
      {"TorusKnot",  // tube around a closed curve: circumference (or cross-section) times the length of the curve
       [](int n, const Displacement* d) { return torus_knot(1.5f, 0.2f, 2 * n, 24 * n, d); },
       MapEdges::torus,
       2 * kPi * 0.2 * knot_length(),
       kPi * 0.04 * knot_length(),
       {{[](double u, double v) { return knot(u) + 0.2 * knot_normal(u, v); }, knot_normal}},
       first_face},
      {"Plane",
       [](int n, const Displacement* d) { return plane(3.0f, n, d); },
       MapEdges::sheet,
       9,
       0,
       {flat({0, 0, 0}, kX, -kZ, 3, no_fade)},
       first_face},
      {"Cube", [](int n, const Displacement* d) { return cube(3.0f, n, d); }, MapEdges::sheet, 54, 27, cube_faces(3), by_axis},
  };
}

class Generator : public testing::TestWithParam<ShapeCase> {};
INSTANTIATE_TEST_SUITE_P(Shapes, Generator, testing::ValuesIn(shape_cases()), [](const auto& p) { return p.param.name; });

// Returns whether ∂P/∂u is zero: at the poles of a sphere and the apex of a cone.
bool is_pole(const ShapeCase& s, const Face& face, double u, double v) {
  return (s.name == "Icosphere" || s.name == "Cone") && glm::length(face.position(u + 0.1, v) - face.position(u - 0.1, v)) < 1e-5;
}

TEST_P(Generator, IsValidClosedAndFacesOutward) {
  for (const int n : {2, 3, 8, 16}) {
    const Mesh m = GetParam().make(n, nullptr);
    expect_sound(m);
    expect_outward(m);
    if (GetParam().volume != 0) expect_closed(m);
  }
}

// Texture coordinates are rounded to float, which moves the point given by the formula by up to 2π·1.5·2^-25, or twice that where u exceeds
// 1.
TEST_P(Generator, MatchesTheFormula) {
  const ShapeCase& s = GetParam();
  const Mesh m = s.make(8, nullptr);
  for (std::size_t i = 0; i < m.positions.size(); ++i) {
    const Face& face = s.faces.at(s.face_of(m.normals[i]));
    const double u = static_cast<double>(m.uvs[i].x), v = static_cast<double>(m.uvs[i].y);
    EXPECT_LT(glm::length(glm::dvec3(m.positions[i]) - face.position(u, v)), 1e-6) << u << " " << v;
    EXPECT_LT(glm::length(glm::dvec3(m.normals[i]) - face.normal(u, v)), 1e-6) << u << " " << v;
  }
}

// Central differences with h = 1e-5 have a relative error of (2πh)²/6 and a rounding error of 1e-16/h. The remaining tolerance
// is for rounding to float.
TEST_P(Generator, TangentsFollowTheTextureCoordinates) {
  const ShapeCase& s = GetParam();
  const Mesh m = s.make(8, nullptr);
  const double h = 1e-5;
  for (std::size_t i = 0; i < m.positions.size(); ++i) {
    const Face& face = s.faces.at(s.face_of(m.normals[i]));
    const double u = static_cast<double>(m.uvs[i].x), v = static_cast<double>(m.uvs[i].y);
    if (!is_pole(s, face, u, v)) {
      EXPECT_LT(glm::length(tangent_of(m, i) - glm::normalize(face.position(u + h, v) - face.position(u - h, v))), 1e-6) << u << " " << v;
    }
    // The bitangent is the component of −∂P/∂v perpendicular to the tangent; the u and v lines of a tube need not be orthogonal.
    const glm::dvec3 upwards = glm::normalize(face.position(u, v - h) - face.position(u, v + h)), t = tangent_of(m, i);
    EXPECT_LT(glm::length(bitangent_of(m, i) - glm::normalize(upwards - t * glm::dot(t, upwards))), 1e-6) << u << " " << v;
  }
}

std::pair<double, double> area_and_volume(const Mesh& m) {
  double area = 0, volume = 0;
  for (std::size_t i = 0; i < m.indices.size(); i += 3) {
    const glm::dvec3 a(corner(m, i).position), b(corner(m, i + 1).position), c(corner(m, i + 2).position);
    area += 0.5 * glm::length(glm::cross(b - a, c - a));
    volume += glm::dot(a, glm::cross(b, c)) / 6;
  }
  return {area, volume};
}

// Flat faces are exact up to rounding. On curved faces, the error of a chord is quadratic in its angle, so doubling the resolution divides
// the error by four (a first-order error would be halved, a third-order one divided by eight).
TEST_P(Generator, AreaAndVolumeConvergeToTheClosedForm) {
  const ShapeCase& s = GetParam();
  const bool is_flat = s.edges == MapEdges::sheet;
  const auto [coarse_area, coarse_volume] = area_and_volume(s.make(16, nullptr));
  const auto [fine_area, fine_volume] = area_and_volume(s.make(32, nullptr));
  if (is_flat) {
    EXPECT_NEAR(fine_area, s.area, 1e-5);
    if (s.volume != 0) {
      EXPECT_NEAR(fine_volume, s.volume, 1e-5);
    }
    return;
  }
  EXPECT_NEAR((s.area - coarse_area) / (s.area - fine_area), 4, 0.4);
  EXPECT_NEAR((s.volume - coarse_volume) / (s.volume - fine_volume), 4, 0.4);
  EXPECT_LT(s.volume - fine_volume, 0.01 * s.volume);
  EXPECT_GT(s.volume - fine_volume, 0);
}

// ---- displaced -------------------------------------------------------------------------------------------------

constexpr double kReliefScale = 0.2, kReliefZero = 0.3;

// Returns a rough height field whose opposite edges differ.
HeightField rough_field(MapEdges edges) { return HeightField(rough_map(12, 7, 7), 0.5, one_worker(), edges); }

TEST_P(Generator, DisplacedMeshStaysClosed) {
  const ShapeCase& s = GetParam();
  const HeightField field = rough_field(s.edges);
  const Displacement d{&field, kReliefScale, kReliefZero};
  for (const int n : {2, 8, 32}) {
    const Mesh m = s.make(n, &d);
    if (s.volume != 0) expect_closed(m);
    const Mesh flat = s.make(n, nullptr);
    EXPECT_EQ(m.uvs, flat.uvs);
    EXPECT_EQ(m.indices, flat.indices);
    float moved = 0;
    for (std::size_t i = 0; i < m.positions.size(); ++i) moved = std::max(moved, glm::distance(m.positions[i], flat.positions[i]));
    if (n > 2) {
      EXPECT_GT(moved, 0.05f) << "the displacement moves some vertices";
    }
  }
}

// Compares with P' = P + n·g·fade, its tangent P'u and its normal P'v × P'u. The derivatives are central differences with step h = 1e-6
// and have an error of P'''·h²/6. P''' reaches kReliefScale·4·12³ = 1400 for the splines, and a similar value for the fades. The second
// derivative of a fade is discontinuous, which adds h·6/0.125²·kReliefScale = 8e-5. The total is below 1e-4. The shortest |P'u| away from
// the poles is 0.2.
TEST_P(Generator, DisplacedNormalsAndTangentsMatchTheSurface) {
  const ShapeCase& s = GetParam();
  const HeightField field = rough_field(s.edges);
  const Displacement d{&field, kReliefScale, kReliefZero};
  const Mesh base = s.make(16, nullptr), m = s.make(16, &d);
  const double h = 1e-6;
  int compared = 0;
  for (std::size_t i = 0; i < m.positions.size(); ++i) {
    const Face& face = s.faces.at(s.face_of(base.normals[i]));
    const double u = static_cast<double>(m.uvs[i].x), v = static_cast<double>(m.uvs[i].y);
    if (is_pole(s, face, u, v)) {
      EXPECT_EQ(m.normals[i], base.normals[i]);
      continue;
    }
    const auto surface = [&](double a, double b) {
      return face.position(a, b) + kReliefScale * (field.at(a, b).value - kReliefZero) * face.fade(a, b) * face.normal(a, b);
    };
    EXPECT_LT(glm::length(glm::dvec3(m.positions[i]) - surface(u, v)), 2e-6);
    const glm::dvec3 du = surface(u + h, v) - surface(u - h, v), dv = surface(u, v + h) - surface(u, v - h);
    EXPECT_LT(glm::length(glm::dvec3(m.normals[i]) - glm::normalize(glm::cross(dv, du))), 1e-4) << u << " " << v;
    EXPECT_LT(glm::length(tangent_of(m, i) - glm::normalize(du)), 1e-4) << u << " " << v;
    EXPECT_GT(glm::dot(bitangent_of(m, i), -dv), 0.0);
    ++compared;
  }
  EXPECT_GT(compared, 100);
}

TEST(Generators, BrokenPreconditionsAbort) {
  EXPECT_DEATH(icosphere(-1, 1), "level is negative");
  EXPECT_DEATH(cylinder(1, 1, 0, 8), "too few bands");
  EXPECT_DEATH(cone(1, 0, 1, 8), "length is not positive");
  EXPECT_DEATH(torus(1, 1, 8, 8), "tube closes the hole");
  EXPECT_DEATH(plane(1, 0), "segments is not positive");
}

TEST(Icosphere, TrianglesHaveSimilarAreasAndDoNotSpanTheMap) {
  const Mesh m = icosphere(4, 1.0f);
  EXPECT_EQ(m.indices.size(), 3u * 20u * 256u);
  double min_area = 1e9, max_area = 0;
  for (std::size_t i = 0; i < m.indices.size(); i += 3) {
    const Corner a = corner(m, i), b = corner(m, i + 1), c = corner(m, i + 2);
    const double area = 0.5 * static_cast<double>(glm::length(glm::cross(b.position - a.position, c.position - a.position)));
    min_area = std::min(min_area, area);
    max_area = std::max(max_area, area);
    const float low = std::min({a.uv.x, b.uv.x, c.uv.x}), high = std::max({a.uv.x, b.uv.x, c.uv.x});
    EXPECT_LT(high - low, 0.21f) << "a face of the icosahedron spans a fifth of a turn";
  }
  EXPECT_LT(max_area / min_area, 2.0) << "in a comparable uv_sphere the ratio is 20";
}

}  // namespace
}  // namespace halfspace
