// SPDX-License-Identifier: Apache-2.0
#include "shading/lighting.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace halfspace {
namespace {

vec3<float> lit(const Light& light, const Reflectance& surface, const glm::vec3& n, const glm::vec3& v, const glm::vec3& p = {}) {
  return blinn_phong<float>(std::vector<Light>{light}, surface, glm::vec3(1.0f), n, v, p);
}

TEST(Lighting, LambertsCosine) {
  for (const float degrees : {0.0f, 30.0f, 60.0f, 89.0f, 90.0f, 120.0f}) {
    const float a = degrees * 3.14159265f / 180.0f;
    const Light light{.place_ew = {std::sin(a), 0, std::cos(a)}, .color = {1, 2, 3}};
    const vec3<float> c = lit(light, {}, {0, 0, 1}, {0, 0, 1});
    const float want = std::max(std::cos(a), 0.0f);
    EXPECT_EQ(c.x, std::max(light.place_ew.z, 0.0f));
    EXPECT_NEAR(c.y, 2 * want, 1e-6);
    EXPECT_NEAR(c.z, 3 * want, 1e-6);
  }
}

TEST(Lighting, AttenuationOfAPointLight) {
  const Light light{.is_point = true, .place_ew = {0, 0, 4}, .attenuation = {0.2f, 0.1f, 0.1f}};
  // Straight above, 4 units away: 1 / (0.2 + 0.4 + 1.6).
  EXPECT_NEAR(lit(light, {}, {0, 0, 1}, {0, 0, 1}).x, 1.0f / 2.2f, 1e-7);
}

TEST(Lighting, TheHighlightPeaksHalfWay) {
  const Reflectance mirror{.diffuse = glm::vec3(0.0f), .specular = glm::vec3(0.5f), .shininess = 50.0f};
  const Light light{.place_ew = {0.6f, 0, 0.8f}};
  // The eye in the mirror direction: h = n, the highlight is the factor itself.
  EXPECT_NEAR(lit(light, mirror, {0, 0, 1}, {-0.6f, 0, 0.8f}).x, 0.5f, 1e-6);
  // h at angle t from n: cos^50 t. Light and eye in one direction, 10° off the normal.
  const float t = 10.0f * 3.14159265f / 180.0f;
  const glm::vec3 d(std::sin(t), 0, std::cos(t));
  EXPECT_NEAR(lit({.place_ew = d}, mirror, {0, 0, 1}, d).x, 0.5 * std::pow(std::cos(10.0 * 3.14159265358979 / 180.0), 50.0), 2e-6);
}

TEST(Lighting, NoHighlightFromBehind) {
  const Reflectance mirror{.diffuse = glm::vec3(0.0f), .specular = glm::vec3(1.0f), .shininess = 0.0f};
  EXPECT_EQ(lit({.place_ew = {0.1f, 0, -0.995f}}, mirror, {0, 0, 1}, {0, 0, 1}).x, 0.0f);
  EXPECT_EQ(lit({.place_ew = {0, 0, 1}}, mirror, {0, 0, 1}, {0, 0, 1}).x, 1.0f) << "pow(1, 0)";
}

TEST(Lighting, NeverNaN) {
  const glm::vec3 zero(0.0f);
  for (const float shininess : {0.0f, 1.0f, 1e5f}) {
    const Reflectance s{.ambient = glm::vec3(0.1f), .specular = glm::vec3(1.0f), .shininess = shininess};
    for (const Light& light : {Light{}, Light{.is_point = true, .place_ew = zero}}) {  // the point light on the surface itself
      for (const glm::vec3& n : {zero, glm::vec3(0, 0, 1)}) {
        for (const glm::vec3& v : {zero, glm::vec3(0, 0, 1), glm::vec3(0, 0, -1)}) {
          const vec3<float> c = lit(light, s, n, v);
          EXPECT_TRUE(std::isfinite(c.x)) << shininess;
        }
      }
    }
  }
}

TEST(Lighting, NormalizeOrZero) {
  EXPECT_EQ(normalize_or_zero(glm::vec3(0.0f)), glm::vec3(0.0f));
  EXPECT_EQ(normalize_or_zero(glm::vec3(0, 3, 0)), glm::vec3(0, 1, 0));
}

TEST(Lighting, LightsAddUp) {
  const Light a{.place_ew = {0, 0, 1}, .color = {1, 0, 0}}, b{.place_ew = {0, 0, 1}, .color = {0, 1, 0}};
  const vec3<float> c =
      blinn_phong<float>(std::vector<Light>{a, b}, {}, glm::vec3(0.5f), glm::vec3(0, 0, 1), glm::vec3(0, 0, 1), glm::vec3(0.0f));
  EXPECT_EQ(c, glm::vec3(0.5f, 0.5f, 0));
  EXPECT_EQ(blinn_phong<float>({}, {.ambient = glm::vec3(0.25f)}, glm::vec3(0.5f), glm::vec3(0, 0, 1), glm::vec3(0, 0, 1), glm::vec3(0.0f)),
            glm::vec3(0.125f));
}

}  // namespace
}  // namespace halfspace
