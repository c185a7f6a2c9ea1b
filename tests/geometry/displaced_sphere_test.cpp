// SPDX-License-Identifier: Apache-2.0
#include "halfspace/geometry/displaced_sphere.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <map>
#include <set>
#include <utility>

#include "geometry/rough_map.h"
#include "halfspace/geometry/shapes.h"
#include "support/constants.h"
#include "support/workers.h"

namespace halfspace {
namespace {

constexpr float kRadius = 2.5f;
constexpr double kScale = 0.4, kZero = 0.3;

Image<float> constant_map(float value) {
  Image<float> map(8, 4);
  for (int y = 0; y < 4; ++y) {
    for (float& t : map.row(y)) t = value;
  }
  return map;
}

const HeightField& rough_field() {
  static const HeightField field(rough_map(32, 16, 99), 0.7, two_workers());
  return field;
}

glm::dvec3 normal_os(double u, double v) {
  return {std::sin(kPi * v) * std::cos(2 * kPi * u), std::cos(kPi * v), -std::sin(kPi * v) * std::sin(2 * kPi * u)};
}

// Returns the displaced position P', computed in double with libm.
glm::dvec3 surface(double u, double v) {
  return (static_cast<double>(kRadius) + kScale * (rough_field().at(u, v).value - kZero)) * normal_os(u, v);
}

// Returns normalize(P'v × P'u) from central differences. Their error is P'''·h²/6 + 1e-16·|P'|/h, where P''' is at most 1e4 (half a texel
// is 1/64). With h = 1e-5 that is below 1e-6, and the lengths are at least 2πr·sin πv, so the direction is accurate to 1e-6 / sin πv.
glm::dvec3 difference_normal(double u, double v) {
  const double h = 1e-5;
  return glm::normalize(glm::cross(surface(u, v + h) - surface(u, v - h), surface(u + h, v) - surface(u - h, v)));
}

struct Place {
  double u, v;
};

// Returns the exact (u, v) of a vertex, whose texture coordinates are rounded to float.
Place place(const Mesh& m, std::size_t i, int latitudes, int longitudes) {
  const double v = std::round(static_cast<double>(m.uvs[i].y) * latitudes) / latitudes;
  return {std::round(static_cast<double>(m.uvs[i].x) * 2 * longitudes) / (2 * longitudes), v};
}

bool at_pole(const Mesh& m, std::size_t i) { return m.uvs[i].y == 0.0f || m.uvs[i].y == 1.0f; }

TEST(DisplacedSphere, SlopesMatchTheSurfaceNormal) {
  for (double u = 0.003; u < 1; u += 0.037) {
    for (const double v : {0.02, 0.1, 0.37, 0.5, 0.81, 0.97}) {
      const glm::dvec3 s = slopes_at(rough_field(), u, v, static_cast<double>(kRadius), kScale, kZero);
      const glm::dvec3 e(-std::sin(2 * kPi * u), 0, -std::cos(2 * kPi * u));
      const glm::dvec3 m = glm::cross(normal_os(u, v), e);
      const glm::dvec3 n = glm::normalize(s.z * normal_os(u, v) - s.x * e - s.y * m);
      EXPECT_LT(glm::length(n - difference_normal(u, v)), 1e-6 / std::sin(kPi * v));
      // The analytic derivatives give the same normal up to rounding, because they do not divide by sin πv.
      const HeightSample h = rough_field().at(u, v);
      const double r = static_cast<double>(kRadius), g = kScale * (h.value - kZero);
      const glm::dvec3 pu = 2 * kPi * std::sin(kPi * v) * (r + g) * e + kScale * h.du * normal_os(u, v);
      const glm::dvec3 pv = -kPi * (r + g) * m + kScale * h.dv * normal_os(u, v);
      EXPECT_LT(glm::length(n - glm::normalize(glm::cross(pv, pu))), 1e-14 / std::sin(kPi * v));
      EXPECT_GT(glm::dot(n, normal_os(u, v)), 0.0);
      EXPECT_LT(glm::dot(glm::cross(pu, pv), normal_os(u, v)), 0.0) << "Pu × Pv points inward";
    }
  }
}

// Vertices are rounded to float: 6e-8 per unit of length, and 1e-7 for all three components.
TEST(DisplacedSphere, VerticesAndNormalsMatchTheSurface) {
  const int latitudes = 24, longitudes = 48;
  const Mesh m = displaced_uv_sphere(latitudes, longitudes, kRadius, rough_field(), kScale, kZero, two_workers());
  for (std::size_t i = 0; i < m.positions.size(); ++i) {
    if (at_pole(m, i)) continue;
    const auto [u, v] = place(m, i, latitudes, longitudes);
    EXPECT_LT(glm::length(glm::dvec3(m.positions[i]) - surface(u, v)), 3e-7 * static_cast<double>(kRadius));
    EXPECT_LT(glm::length(glm::dvec3(m.normals[i]) - difference_normal(u, v)), 1e-7 + 1e-6 / std::sin(kPi * v));
    EXPECT_GT(glm::dot(glm::dvec3(m.normals[i]), normal_os(u, v)), 0.0);
    const glm::dvec3 tangent(m.tangents[i].x, m.tangents[i].y, m.tangents[i].z);
    EXPECT_NEAR(glm::dot(tangent, glm::dvec3(m.normals[i])), 0.0, 2e-7);
    EXPECT_GT(glm::dot(tangent, surface(u + 1e-5, v) - surface(u - 1e-5, v)), 0.0);
    EXPECT_NEAR(glm::length(tangent), 1.0, 1e-6);
    EXPECT_EQ(m.tangents[i].w, 1.0f);
  }
}

// The tangent has the direction of P'u; the bitangent is the component of −P'v perpendicular to it. The tolerances are those from above:
// 1e-6 of central differences divided by |P'u| = 2πr·sin πv, and rounding to float.
TEST(DisplacedSphere, TangentsFollowTheTextureCoordinates) {
  const int latitudes = 24, longitudes = 48;
  const Mesh m = displaced_uv_sphere(latitudes, longitudes, kRadius, rough_field(), kScale, kZero, two_workers());
  for (std::size_t i = 0; i < m.positions.size(); ++i) {
    if (at_pole(m, i)) continue;
    const auto [u, v] = place(m, i, latitudes, longitudes);
    const double h = 1e-5, tolerance = 4e-7 + 1e-6 / std::sin(kPi * v);
    const glm::dvec3 along_u = glm::normalize(surface(u + h, v) - surface(u - h, v));
    const glm::dvec3 up = surface(u, v - h) - surface(u, v + h);
    const glm::dvec3 tangent(m.tangents[i].x, m.tangents[i].y, m.tangents[i].z);
    const glm::dvec3 bitangent = static_cast<double>(m.tangents[i].w) * glm::cross(glm::dvec3(m.normals[i]), tangent);
    EXPECT_LT(glm::length(tangent - along_u), tolerance);
    EXPECT_LT(glm::length(bitangent - glm::normalize(up - glm::dot(up, along_u) * along_u)), 2 * tolerance);
  }
}

// Every triangle has the same winding as in uv_sphere.
TEST(DisplacedSphere, TrianglesFaceOutward) {
  const Mesh m = displaced_uv_sphere(48, 96, kRadius, rough_field(), kScale, kZero, two_workers());
  const Mesh sphere = uv_sphere(48, 96, kRadius);
  EXPECT_EQ(m.indices, sphere.indices);
  EXPECT_EQ(m.uvs, sphere.uvs);
  for (std::size_t i = 0; i < m.indices.size(); i += 3) {
    const uint32_t a = m.indices[i], b = m.indices[i + 1], c = m.indices[i + 2];
    const glm::vec3 face = glm::cross(m.positions[b] - m.positions[a], m.positions[c] - m.positions[a]);
    EXPECT_GT(glm::dot(face, m.normals[a] + m.normals[b] + m.normals[c]), 0.0f);
  }
}

// (r + 0)·n is the expression that uv_sphere evaluates in double, so positions are bit-identical. Normals are normalized once more; n has
// length 1 to within 1e-16, so a component changes by less than half an ulp of float and can differ by one ulp on a tie.
TEST(DisplacedSphere, WithoutHeightItEqualsUvSphere) {
  const Mesh sphere = uv_sphere(24, 48, kRadius);
  for (const double scale : {0.0, 0.7}) {
    const HeightField field = scale == 0.0 ? rough_field() : HeightField(constant_map(0.25f), 0.0, two_workers());
    const Mesh m = displaced_uv_sphere(24, 48, kRadius, field, scale, 0.25, two_workers());
    EXPECT_EQ(m.positions, sphere.positions);
    for (std::size_t i = 0; i < m.normals.size(); ++i) {
      for (int c = 0; c < 3; ++c) {
        EXPECT_FLOAT_EQ(m.normals[i][c], sphere.normals[i][c]);
        EXPECT_FLOAT_EQ(m.tangents[i][c], sphere.tangents[i][c]);
      }
    }
  }
}

TEST(DisplacedSphere, ConstantHeightGivesALargerSphere) {
  const HeightField field(constant_map(0.75f), 0.0, two_workers());
  const Mesh m = displaced_uv_sphere(24, 48, kRadius, field, 0.5, 0.25, two_workers());
  const Mesh sphere = uv_sphere(24, 48, kRadius + 0.25f);
  EXPECT_EQ(m.positions, sphere.positions);
  for (std::size_t i = 0; i < m.normals.size(); ++i) {
    for (int c = 0; c < 3; ++c) EXPECT_FLOAT_EQ(m.normals[i][c], sphere.normals[i][c]);
  }
}

TEST(DisplacedSphere, PolesHaveASingleHeightAndUndisplacedNormals) {
  const Mesh m = displaced_uv_sphere(24, 48, kRadius, rough_field(), kScale, kZero, two_workers());
  const Mesh sphere = uv_sphere(24, 48, kRadius);
  for (const float pole : {0.0f, 1.0f}) {
    std::set<float> heights;
    double lowest = 1, highest = 0;
    for (std::size_t i = 0; i < m.positions.size(); ++i) {
      if (m.uvs[i].y != pole) continue;
      heights.insert(m.positions[i].y);
      EXPECT_EQ(m.positions[i].x, 0.0f);
      EXPECT_EQ(m.positions[i].z, 0.0f);
      EXPECT_EQ(m.normals[i], sphere.normals[i]);
      EXPECT_EQ(m.tangents[i], sphere.tangents[i]);
      const double h = rough_field().at(static_cast<double>(m.uvs[i].x), static_cast<double>(pole)).value;
      lowest = std::min(lowest, h);
      highest = std::max(highest, h);
    }
    ASSERT_EQ(heights.size(), 1u);
    const double h = (std::fabs(static_cast<double>(*heights.begin())) - static_cast<double>(kRadius)) / kScale + kZero;
    EXPECT_GT(h, lowest - 1e-6);
    EXPECT_LT(h, highest + 1e-6);
  }
}

TEST(DisplacedSphere, BothSidesOfTheSeamAreBitIdentical) {
  const Mesh m = displaced_uv_sphere(24, 46, kRadius, rough_field(), kScale, kZero, two_workers());
  std::map<float, std::size_t> west;  // by v
  int pairs = 0;
  for (std::size_t i = 0; i < m.positions.size(); ++i) {
    if (m.uvs[i].x == 0.0f) west[m.uvs[i].y] = i;
  }
  for (std::size_t i = 0; i < m.positions.size(); ++i) {
    if (m.uvs[i].x != 1.0f) continue;
    const std::size_t j = west.at(m.uvs[i].y);
    EXPECT_EQ(std::memcmp(&m.positions[i], &m.positions[j], sizeof m.positions[i]), 0);
    EXPECT_EQ(std::memcmp(&m.normals[i], &m.normals[j], sizeof m.normals[i]), 0);
    EXPECT_EQ(std::memcmp(&m.tangents[i], &m.tangents[j], sizeof m.tangents[i]), 0);
    ++pairs;
  }
  EXPECT_EQ(pairs, 23);
}

TEST(DisplacedSphere, CanKeepTheNormalsOfTheSphere) {
  const Mesh m = displaced_uv_sphere(24, 48, kRadius, rough_field(), kScale, kZero, two_workers(), ReliefNormals::undisplaced);
  const Mesh displaced = displaced_uv_sphere(24, 48, kRadius, rough_field(), kScale, kZero, two_workers());
  const Mesh sphere = uv_sphere(24, 48, kRadius);
  EXPECT_EQ(m.positions, displaced.positions);
  EXPECT_EQ(m.normals, sphere.normals);
  EXPECT_EQ(m.tangents, sphere.tangents);
  EXPECT_NE(displaced.normals, sphere.normals);
}

TEST(SlopeMap, StoresTheSlopesAtTexelCenters) {
  const double r = static_cast<double>(kRadius);
  const Image<glm::vec4> map = slope_map(rough_field(), 64, 32, r, kScale, kZero, two_workers());
  for (int y = 0; y < 32; ++y) {
    for (int x = 0; x < 64; ++x) {
      const glm::vec3 s(slopes_at(rough_field(), (x + 0.5) / 64, (y + 0.5) / 32, r, kScale, kZero));
      EXPECT_EQ(map.at(x, y), glm::vec4(s, 0.0f));
    }
  }
  EXPECT_TRUE(map == slope_map(rough_field(), 64, 32, r, kScale, kZero, Workers(5)));
}

// Closed form: the height falls by one unit over the distance πr from the north pole to the south pole.
TEST(SlopeMap, SignsAndUnitsAreCorrect) {
  Image<float> map(32, 16);
  for (int y = 0; y < 16; ++y) {
    for (float& t : map.row(y)) t = 1.0f - 0.0625f * static_cast<float>(y);  // higher in the north
  }
  const HeightField field(map, 0.0, two_workers());
  const glm::dvec3 s = slopes_at(field, 0.2, 0.5, 1000.0, 80.0, 0.0);
  EXPECT_NEAR(s.x, 0.0, 1e-15);
  EXPECT_NEAR(s.y, 80.0 / (1000.0 * kPi), 1e-12);
  EXPECT_NEAR(s.z, 1.0 + 80.0 * (1.0 - 0.0625 * 7.5) / 1000.0, 1e-12);
  const HeightField wave(rough_map(32, 16, 99), 0.0, two_workers());
  const double step = 1e-6, sine = std::sin(kPi * 0.4);
  const double rise = 80.0 * (wave.at(0.3 + step, 0.4).value - wave.at(0.3 - step, 0.4).value);
  EXPECT_NEAR(slopes_at(wave, 0.3, 0.4, 1000.0, 80.0, 0.0).x, rise / (2 * step * 2 * kPi * 1000.0 * sine), 1e-6);
}

}  // namespace
}  // namespace halfspace
