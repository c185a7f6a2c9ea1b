// SPDX-License-Identifier: Apache-2.0
//
// Compares lighting at a point with closed-form results. Formulas are tested in double; robustness is also tested in float.
#include "halfspace/shading/light/lighting.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "support/constants.h"

namespace halfspace {
namespace {

template <class R>
Illumination<R> at(const Light& light, LightModel model, double shininess, const vec3<R>& n, const vec3<R>& v,
                   const vec3<R>& position = vec3<R>(R(0))) {
  return illuminate<R>(std::vector<Light>{light}, model, static_cast<R>(shininess), {position, n, v});
}

glm::dvec3 direction(double degrees) { return {std::sin(degrees * kPi / 180), 0, std::cos(degrees * kPi / 180)}; }

const glm::dvec3 kUp(0, 0, 1);

TEST(Lighting, DiffuseFollowsLambertsCosine) {
  for (const double degrees : {0.0, 30.0, 60.0, 89.0, 90.0, 120.0, 180.0}) {
    Light light;
    light.diffuse = {1, 2, 3};
    const vec3<double> d = at<double>(light, LightModel::lambert, 1, direction(degrees), kUp).diffuse;
    const double want = std::max(std::cos(degrees * kPi / 180), 0.0);
    EXPECT_NEAR(d.x, want, 1e-15);
    EXPECT_NEAR(d.y, 2 * want, 1e-15);
    EXPECT_NEAR(d.z, 3 * want, 1e-15);
  }
}

TEST(Lighting, PointLightsAttenuateWithDistance) {
  Light light{.type = LightType::point, .position_rws = {0, 0, 4}};
  light.attenuation = {0.2f, 0.1f, 0.1f};
  // The light is 4 units above the point, so the expected value is 1 / (0.2 + 0.4 + 1.6). The coefficients are floats, with an error of
  // 1e-7 each.
  const Illumination<double> i = at<double>(light, LightModel::phong, 1, kUp, kUp);
  EXPECT_NEAR(i.diffuse.x, 1 / 2.2, 1e-7);
  EXPECT_NEAR(i.specular.x, 1 / 2.2, 1e-7) << "the specular term has the same attenuation";
  light.attenuation = {0, 0, 1};
  EXPECT_EQ(at<double>(light, LightModel::lambert, 1, kUp, kUp).diffuse.x, 1.0 / 16) << "inverse square";
}

TEST(Lighting, ARangeFadesTheLightToZero) {
  for (const LightType type : {LightType::point, LightType::spot}) {
    Light light{.type = type, .position_rws = {0, 0, 0}, .attenuation = {0, 0, 1}, .cos_outer = -2.0f, .inverse_range = 0.5f};
    for (const double d : {0.125, 0.5, 1.0, 1.5, 1.875}) {
      const double window = 1 - std::pow(d / 2, 4);  // exact in double, like 1/d², except for the rounding of the quotient
      EXPECT_NEAR(light_at<double>(light, {0, 0, -d}).strength, window / (d * d), 1e-15 * window / (d * d)) << d;
    }
    for (const double d : {2.0, 2.5, 1e9}) EXPECT_EQ(light_at<double>(light, {0, 0, -d}).strength, 0.0) << d;
    light.inverse_range = 0.0f;
    EXPECT_EQ(light_at<double>(light, {0, 0, -4}).strength, 1.0 / 16) << "unlimited";
  }
  Light sun{.inverse_range = 0.5f};
  EXPECT_EQ(light_at<double>(sun, {0, 0, -9}).strength, 1.0) << "directional lights have no range";
}

TEST(Lighting, SpotFadesLikeKhrLightsPunctual) {
  Light spot{.type = LightType::spot, .position_rws = {0, 0, 2}};
  const double inner = std::cos(20 * kPi / 180), outer = std::cos(30 * kPi / 180);
  spot.cos_outer = static_cast<float>(outer);
  spot.cone_scale = static_cast<float>(1 / (inner - outer));
  const auto strength = [&](double degrees) {
    const glm::dvec3 d = direction(degrees);
    return light_at<double>(spot, {2 * d.x / d.z, 0, 0}).strength;
  };
  for (const double degrees : {0.0, 10.0, 19.9}) EXPECT_EQ(strength(degrees), 1.0) << degrees;
  for (const double degrees : {30.1, 60.0, 89.0}) EXPECT_EQ(strength(degrees), 0.0) << degrees;
  EXPECT_EQ(light_at<double>(spot, {1, 0, 5}).strength, 0.0) << "behind the spot light";
  for (double degrees = 20.5; degrees < 30; degrees += 0.5) {
    const double t = (std::cos(degrees * kPi / 180) - outer) / (inner - outer);
    EXPECT_NEAR(strength(degrees), t * t, 3e-6) << degrees;  // float cos_outer: 6e-8 of 0.07 is 1e-6 of t, times slope 2
  }
  // There is no step at either edge: 0.1 degrees past an edge, t has changed by at most 0.012, and its square by at most 0.024.
  EXPECT_LT(1 - strength(20.1), 0.024);
  EXPECT_LT(strength(29.9), 1.5e-4);
}

TEST(Lighting, HighlightsPeakInTheMirrorDirection) {
  // The eye moves around a surface lit from 40°. Phong's highlight peaks in the mirror direction with the value 1, and so does Blinn's,
  // because h = n there. At an angle t from the peak, the values are cos^s(t) and cos^s(t/2).
  const glm::dvec3 l = direction(40);
  Light light;
  light.position_rws = glm::vec3(l);
  const double s = 50;
  for (double degrees = -80; degrees <= 80; degrees += 5) {
    const glm::dvec3 v = direction(degrees);
    const double off = std::abs(degrees + 40) * kPi / 180;
    const double phong = at<double>(light, LightModel::phong, s, kUp, v).specular.x;
    const double blinn = at<double>(light, LightModel::blinn_phong, s, kUp, v).specular.x;
    // l is rounded to float. The power multiplies the error of its length, 6e-8, by 50. The error of its angle is also 6e-8 and is
    // multiplied by the slope of cos^50, which is at most 4.3.
    EXPECT_NEAR(phong, std::pow(std::max(std::cos(off), 0.0), s), 3.3e-6) << degrees;
    EXPECT_NEAR(blinn, std::pow(std::cos(off / 2), s), 3.3e-6) << degrees;
  }
}

TEST(Lighting, NoHighlightFromBehindOrWithoutASpecularModel) {
  for (const LightModel model : {LightModel::phong, LightModel::blinn_phong}) {
    for (const double shininess : {0.0, 1.0, 50.0}) {
      for (double degrees = 91; degrees < 270; degrees += 7) {
        Light light;
        light.position_rws = glm::vec3(direction(degrees));
        for (double eye = -80; eye <= 80; eye += 10) {
          EXPECT_EQ(at<double>(light, model, shininess, kUp, direction(eye)).specular.x, 0.0);
        }
      }
    }
    EXPECT_EQ(at<double>(Light{}, model, 0, kUp, kUp).specular.x, 1.0) << "pow(1, 0)";
    EXPECT_EQ(at<double>(Light{}, model, 0, kUp, direction(180)).specular.x, 1.0) << "pow(0, 0)";
  }
  EXPECT_EQ(at<double>(Light{}, LightModel::lambert, 10, kUp, kUp).specular.x, 0.0);
}

// Tests all combinations of unusual inputs: no result is NaN or negative, and no highlight exceeds the incident light.
template <class R>
void check_guards() {
  const R nan = std::numeric_limits<R>::quiet_NaN(), tiny = R(1e-30), zero(0), one(1);
  const std::vector<vec3<R>> vectors{{zero, zero, one}, {zero, zero, -one},     {zero, zero, zero}, {nan, nan, nan},
                                     {nan, zero, one},  {R(0.6), zero, R(0.8)}, {one, zero, zero},  {tiny, tiny, tiny}};
  std::vector<double> exponents{0, 1e-38, 1e-6, 0.5, 1, 2, 1e5};
  for (double e = 1e-3; e < 1e5; e *= 3.3) exponents.push_back(e);
  std::vector<Light> lights{Light{}, {.position_rws = {0, 0, -1}}, {.position_rws = {0, 0, 0}}};
  for (const LightType type : {LightType::point, LightType::spot}) {
    for (const glm::vec3& place : {glm::vec3(0.0f), glm::vec3(0, 0, 1e-20f), glm::vec3(0, 1, 2), glm::vec3(1e9f, 0, 0)}) {
      for (const glm::vec3& attenuation : {glm::vec3(1, 0, 0), glm::vec3(0, 0, 1), glm::vec3(0.2f, 0.1f, 0.1f)}) {
        Light light{.type = type, .position_rws = place};
        light.attenuation = attenuation;
        lights.push_back(light);
        light.inverse_range = 0.3f;
        lights.push_back(light);
      }
    }
  }
  int checked = 0;
  for (const Light& light : lights) {
    for (const LightModel model : {LightModel::lambert, LightModel::phong, LightModel::blinn_phong}) {
      for (const double exponent : exponents) {
        for (const vec3<R>& n : vectors) {
          for (const vec3<R>& v : vectors) {
            const Illumination<R> i = at<R>(light, model, exponent, n, v);
            const R max_light = R(1) / R(kMinAttenuation) * R(1.0001);
            ASSERT_TRUE(i.diffuse.x >= R(0) && i.diffuse.x <= max_light) << exponent;
            ASSERT_TRUE(i.specular.x >= R(0) && i.specular.x <= max_light) << exponent;
            ++checked;
          }
        }
      }
    }
  }
  EXPECT_GT(checked, 90000);
}

TEST(Lighting, IsNeverNaNInFloat) { check_guards<float>(); }
TEST(Lighting, IsNeverNaNInDouble) { check_guards<double>(); }

TEST(Lighting, ZeroNormalsAreUnlit) {
  for (const LightModel model : {LightModel::phong, LightModel::blinn_phong}) {
    const Illumination<float> i = at<float>(Light{}, model, 0, glm::vec3(0.0f), glm::vec3(0, 0, 1));
    EXPECT_EQ(i.diffuse, glm::vec3(0.0f));
    EXPECT_EQ(i.specular, glm::vec3(0.0f));
  }
}

TEST(Lighting, NormalizeOrZeroKeepsZeroVectors) {
  EXPECT_EQ(normalize_or_zero(vec3<float>(0.0f)), vec3<float>(0.0f));
  const glm::vec3 up = glm::vec3(normalize_or_zero(vec3<float>(0, 3, 0)));
  EXPECT_EQ(glm::vec3(up.x, 0.0f, up.z), glm::vec3(0.0f));
  EXPECT_NEAR(up.y, 1.0f, 0x1p-22f);  // three times 1/3, each with an error of 1.32 ulp of 2^-25, and a final rounding
}

TEST(Lighting, LightsAddUpAndNoLightsIsBlack) {
  Light a, b;
  a.diffuse = a.specular = {1, 0, 0};
  b.diffuse = b.specular = {0, 0.5f, 0};
  const SurfacePoint<float> p{glm::vec3(0.0f), glm::vec3(0, 0, 1), glm::vec3(0, 0, 1)};
  const Illumination<float> both = illuminate<float>(std::vector<Light>{a, b}, LightModel::phong, 3.0f, p);
  EXPECT_EQ(both.diffuse, glm::vec3(1, 0.5f, 0));
  EXPECT_EQ(both.specular, glm::vec3(1, 0.5f, 0));
  EXPECT_EQ(illuminate<float>({}, LightModel::phong, 3.0f, p).diffuse, glm::vec3(0.0f));
}

}  // namespace
}  // namespace halfspace
