// SPDX-License-Identifier: Apache-2.0
//
// Compares the reflection model of metallic-roughness surfaces and its image-based lighting with integrals in double precision.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "halfspace/core/cube_map.h"
#include "halfspace/shading/environment/environment_light.h"
#include "halfspace/shading/light/ggx.h"
#include "halfspace/shading/surface/metallic_surface.h"

namespace halfspace {

namespace {

constexpr double kPi = std::numbers::pi;

// Calls f(direction, solid angle) for a grid of directions over the sphere.
template <class F>
void over_sphere(int rows, const F& f) {
  for (int i = 0; i < rows; ++i) {
    const double theta = kPi * (i + 0.5) / rows, solid = (kPi / rows) * (kPi / rows) * std::sin(theta);
    for (int j = 0; j < 2 * rows; ++j) {
      const double phi = kPi * (j + 0.5) / rows;
      f(glm::dvec3(std::sin(theta) * std::cos(phi), std::cos(theta), std::sin(theta) * std::sin(phi)), solid);
    }
  }
}

// Integrates the reflection over all light directions, in double. x is the factor of F0, y the factor of F90.
glm::dvec2 integrated(double roughness, double n_v) {
  const vec3<double> n(0, 1, 0), v(std::sqrt(1 - n_v * n_v), n_v, 0);
  glm::dvec2 sum(0.0);
  over_sphere(700, [&](const glm::dvec3& l, double solid) {
    if (l.y <= 0.0) return;
    const vec3<double> h = normalize(vec3<double>(l) + v);
    const double lobe = ggx_reflection(roughness * roughness, n, h, l.y, n_v) / kPi, w = schlick_weight(dot(v, h));
    sum += glm::dvec2(1.0 - w, w) * (lobe * solid);
  });
  return sum;
}

// The table has 32 entries per axis, each the mean of 1024 samples. The grid of the reference resolves lobes with a roughness of 0.15 or
// more.
TEST(Ggx, DirectionalReflectanceMatchesTheIntegral) {
  double largest = 0.0;
  for (const double roughness : {0.15, 0.3, 0.5, 0.7, 1.0}) {
    for (const double n_v : {0.1, 0.3, 0.5, 0.8, 0.99}) {
      const glm::dvec2 expected = integrated(roughness, n_v);
      const DirectionalReflectance<double> table = directional_reflectance(roughness, n_v);
      largest = std::max({largest, std::fabs(table.f0 - expected.x), std::fabs(table.f90 - expected.y)});
    }
  }
  std::printf("largest error of the table %.4f\n", largest);
  EXPECT_LT(largest, 0.02);
}

std::array<Image<glm::vec4>, 6> faces_of(int size, double (*light)(const glm::dvec3&)) {
  std::array<Image<glm::vec4>, 6> faces;
  for (int f = 0; f < 6; ++f) {
    faces[static_cast<std::size_t>(f)] = Image<glm::vec4>(size, size);
    for (int y = 0; y < size; ++y) {
      for (int x = 0; x < size; ++x) {
        const glm::dvec3 d = glm::normalize(cube_direction(f, (2.0 * x + 1.0) / size - 1.0, (2.0 * y + 1.0) / size - 1.0));
        faces[static_cast<std::size_t>(f)].at(x, y) = glm::vec4(glm::vec3(static_cast<float>(light(d))), 1.0f);
      }
    }
  }
  return faces;
}

// Calls f(normal) for a grid of points on the side of a sphere that faces +z. The grid covers `extent` of the radius.
template <class F>
void over_front_of_sphere(double extent, const F& f) {
  for (int iy = -4; iy <= 4; ++iy) {
    for (int ix = -4; ix <= 4; ++ix) {
      const double x = extent * ix / 4.0, y = extent * iy / 4.0, squared = x * x + y * y;
      if (squared <= 0.97) f(glm::dvec3(x, y, std::sqrt(1.0 - squared)));
    }
  }
}

double uniform(const glm::dvec3&) { return 1.0; }
// A sky with a bright lamp of about 20 degrees and a dark floor.
double lamp(const glm::dvec3& d) {
  const double t = std::clamp((glm::dot(d, glm::normalize(glm::dvec3(0.4, 0.8, 0.45))) - 0.93) / 0.03, 0.0, 1.0);
  return 0.3 + 0.4 * d.y + 6.0 * t * t * (3.0 - 2.0 * t);
}

// A surface without absorption reflects a uniform environment unchanged, with and without white sheen.
TEST(Ggx, WhiteFurnace) {
  const EnvironmentMap map(faces_of(64, uniform), TexelFormat::rgba32f);
  const Workers workers(2);
  const FilteredEnvironment filtered(map, 64, workers);
  const EnvironmentLightBlend environment{{&filtered, glm::mat3(1.0f), 1.0f}, {}, 0.0f};
  for (const float roughness : {0.05f, 0.2f, 0.4f, 0.6f, 0.8f, 1.0f}) {
    for (const auto& [metallic, sheen] : {std::pair(0.0f, 0.0f), std::pair(1.0f, 0.0f), std::pair(0.0f, 1.0f)}) {
      MetallicSurface<MetallicStreams::basic> surface{};
      surface.base_color = glm::vec4(1.0f);
      surface.metallic = metallic;
      surface.roughness = roughness;
      surface.sheen = sheen;
      surface.sheen_roughness = 0.5f;
      surface.environment = &environment;
      surface.to_eye_ws = glm::normalize(glm::vec3(0.6f, 0.8f, 0.0f));
      const Pixel<float> px{};
      MetallicSurface<MetallicStreams::basic>::Varyings<float> in{};
      in.normal_ws = vec3<float>(0, 1, 0);
      const Fragment<float> out = surface.fragment(in, px);
      EXPECT_NEAR(out.color.x, 1.0f, 0.01f) << "roughness " << roughness << ", metallic " << metallic << ", sheen " << sheen;
      if (metallic == 0.0f) continue;
      surface.base_color = glm::vec4(3.0f);  // by a texture of floats; a surface reflects at most all light
      EXPECT_EQ(surface.fragment(in, px).color.x, out.color.x) << "roughness " << roughness;
    }
  }
}

// Level 0 is not uniform, so that the map is filtered, but all lookups read the smaller levels, which are.
EnvironmentMap filtered_although_uniform(const glm::vec3& light) {
  std::vector<std::array<Image<glm::vec4>, 6>> levels;
  for (int size = 256; size >= 1; size /= 2) {
    levels.emplace_back();
    for (Image<glm::vec4>& face : levels.back()) {
      face = Image<glm::vec4>(size, size);
      std::fill_n(face.data(), face.texels().size(), glm::vec4(light, 1.0f));
    }
  }
  levels[0][0].at(7, 9).x += 1.0f;
  return EnvironmentMap(levels, TexelFormat::rgba32f);
}

// The closed form for uniform maps has the bits of the filter, for any type of uniform map.
TEST(Ggx, UniformMapsHaveTheBitsOfFilteredOnes) {
  const Workers workers(2);
  const glm::vec3 light(0.62f, 0.1f, 3.7f);
  const EnvironmentMap map = filtered_although_uniform(light);
  ASSERT_FALSE(map.is_uniform());
  const FilteredEnvironment expected(map, 64, workers);
  Image<glm::vec4> one(1, 1), many(8, 4);
  one.at(0, 0) = glm::vec4(light, 1.0f);
  std::fill_n(many.data(), many.texels().size(), glm::vec4(light, 1.0f));
  for (const Image<glm::vec4>& panorama : {one, many}) {
    const EnvironmentMap uniform_map(panorama, TexelFormat::rgba32f);
    ASSERT_TRUE(uniform_map.is_uniform());
    const FilteredEnvironment actual(uniform_map, 64, workers);
    EXPECT_EQ(actual.radiance.width(), 1);
    over_sphere(8, [&](const glm::dvec3& direction, double) {
      const vec3<float> d{glm::vec3(direction)};
      for (const float roughness : {0.0f, 0.1f, 0.2f, 0.45f, 0.8f, 1.0f}) {
        const vec3<float> a = actual.specular(d, roughness), b = expected.specular(d, roughness);
        EXPECT_TRUE(a.x == b.x && a.y == b.y && a.z == b.z) << roughness;
      }
      const vec3<float> a = actual.diffuse(d), b = expected.diffuse(d);
      EXPECT_TRUE(a.x == b.x && a.y == b.y && a.z == b.z);
      EXPECT_TRUE(a.x == light.x && a.y == light.y && a.z == light.z);
    });
  }
}

// Spheres seen from +z under the lamp. The reference is the integral of the environment times the reflection. The split-sum approximation
// prefilters for a view along the normal, so its error is largest at grazing views of rough surfaces.
TEST(Ggx, EnvironmentLightIsCloseToTheIntegralOnSpheres) {
  const EnvironmentMap map(faces_of(128, lamp), TexelFormat::rgba32f);
  const Workers workers(2);
  const FilteredEnvironment filtered(map, 128, workers);
  const EnvironmentLightBlend environment{{&filtered, glm::mat3(1.0f), 1.0f}, {}, 0.0f};
  const glm::dvec3 v(0, 0, 1);
  for (const double roughness : {0.2, 0.4, 0.6, 0.8, 1.0}) {
    double squared = 0.0, mean = 0.0;
    int count = 0;
    over_front_of_sphere(0.8, [&](const glm::dvec3& n) {
      double expected = 0.0;
      over_sphere(240, [&](const glm::dvec3& l, double solid) {
        const double n_l = glm::dot(n, l);
        if (n_l <= 0.0) return;
        const vec3<double> h = normalize(vec3<double>(l) + vec3<double>(v));
        expected += lamp(l) * solid * ggx_reflection(roughness * roughness, vec3<double>(n), h, n_l, n.z) / kPi;
      });
      const DirectionalReflectance<double> table = directional_reflectance(roughness, n.z);
      const double ours = environment.at<double>(vec3<double>(n), vec3<double>(v), roughness).specular.x * (table.f0 + table.f90);
      squared += (ours - expected) * (ours - expected);
      mean += expected;
      ++count;
    });
    const double relative = std::sqrt(squared / count) / (mean / count);
    std::printf("roughness %.1f: root mean square error %.3f of the mean\n", roughness, relative);
    EXPECT_LT(relative, 0.2);
  }
}

// The same for sheen, whose environment light is that of a diffuse surface times the integral of its reflection. Sheen receives more
// light from near the horizon than a diffuse surface does; the error is that difference. It is given relative to the mean light
// that a white diffuse surface reflects, of which it is 4% to 9%.
TEST(Ggx, SheenInAnEnvironmentIsCloseToTheIntegralOnSpheres) {
  const EnvironmentMap map(faces_of(128, lamp), TexelFormat::rgba32f);
  const FilteredEnvironment filtered(map, 128, Workers(2));
  const EnvironmentLightBlend environment{{&filtered, glm::mat3(1.0f), 1.0f}, {}, 0.0f};
  const glm::dvec3 v(0, 0, 1);
  for (const double roughness : {0.2, 0.4, 0.6, 0.8, 1.0}) {
    double squared = 0.0, diffuse = 0.0;
    int count = 0;
    over_front_of_sphere(8.0 / 9.0, [&](const glm::dvec3& n) {
      double expected = 0.0;
      over_sphere(240, [&](const glm::dvec3& l, double solid) {
        const double n_l = glm::dot(n, l);
        if (n_l <= 0.0) return;
        const double sine = glm::length(glm::cross(n, glm::normalize(l + v)));
        expected += lamp(l) * solid * sheen_reflection(roughness, sine, n_l, n.z) / kPi;
      });
      const double light = environment.at<double>(vec3<double>(n), vec3<double>(v), roughness).diffuse.x;
      const double error = light * directional_sheen(roughness, n.z) - expected;
      squared += error * error;
      diffuse += light;
      ++count;
    });
    const double relative = std::sqrt(squared / count) / (diffuse / count);
    std::printf("roughness %.1f: root mean square error %.3f of the diffuse light\n", roughness, relative);
    EXPECT_LT(relative, 0.12);
  }
}

// Nine spherical harmonics represent the irradiance of any environment within 9% of its maximum (Ramamoorthi and Hanrahan 2001, section 2).
TEST(Ggx, DiffuseEnvironmentLightMatchesTheIntegral) {
  const EnvironmentMap map(faces_of(64, lamp), TexelFormat::rgba32f);
  const FilteredEnvironment filtered(map, 64, Workers(1));
  double largest = 0.0, error = 0.0;
  over_sphere(6, [&](const glm::dvec3& n, double) {
    double expected = 0.0;
    over_sphere(200, [&](const glm::dvec3& l, double solid) { expected += std::max(glm::dot(n, l), 0.0) * lamp(l) * solid / kPi; });
    largest = std::max(largest, expected);
    error = std::max(error, std::fabs(filtered.diffuse(vec3<double>(n)).x - expected));
  });
  EXPECT_LT(error, 0.09 * largest);
}

// The half vector is zero if the light direction is exactly opposite to the view direction.
TEST(Ggx, ReflectionIsZeroForAZeroHalfVector) {
  for (const float roughness : {kMinRoughness, 0.5f, 1.0f}) {
    const float x = ggx_reflection(roughness * roughness, vec3<float>(0, 0, 1), vec3<float>(0, 0, 0), 1e-6f, 1.0f);
    EXPECT_EQ(x, 0.0f) << roughness;
  }
}

// The result is the same for any number of workers.
TEST(Ggx, FilteredEnvironmentsDoNotDependOnWorkers) {
  const EnvironmentMap map(faces_of(32, lamp), TexelFormat::rgba32f);
  const FilteredEnvironment one(map, 64, Workers(1)), three(map, 64, Workers(3));
  over_sphere(8, [&](const glm::dvec3& d, double) {
    const vec3<float> r{vec3<double>(d)};
    EXPECT_EQ(one.specular(r, 0.37f).x, three.specular(r, 0.37f).x);
  });
}

}  // namespace

}  // namespace halfspace
