// SPDX-License-Identifier: Apache-2.0
//
// Conversion of specular-glossiness textures, checked against the definitions of both models.
#include "halfspace/render/assets/converted_images.h"

#include <gtest/gtest.h>

#include <cmath>

#include "halfspace/model/gltf/specular_glossiness.h"

namespace halfspace {
namespace {

using Picture = Image<glm::u8vec4>;

double decoded(int code) {
  const double v = code / 255.0;
  return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
}
double encoded(double x) { return 255.0 * (x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1.0 / 2.4) - 0.055); }

// A model with a diffuse and a specular-glossiness texture. An empty picture is no texture.
struct Case {
  Picture diffuse, specular;
  SpecularGlossiness source{};
  Sampler sampler{};

  ConvertedImages converted() const {
    Model model;
    SpecularGlossiness textures = source;
    const auto add = [&](const Picture& picture) {
      if (picture.empty()) return -1;
      model.images.push_back({.name = "picture", .file = {}, .bytes = nullptr, .pixels = std::make_shared<const ColorPicture>(picture)});
      model.textures.push_back({static_cast<int>(model.images.size()) - 1, sampler});
      return static_cast<int>(model.textures.size()) - 1;
    };
    textures.diffuse_texture = add(diffuse);
    textures.specular_texture = add(specular);
    return converted_images(model, textures, "test", Workers(2));
  }
};

Picture uniform(int width, int height, const glm::u8vec4& color) {
  Picture picture(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) picture.at(x, y) = color;
  }
  return picture;
}

// For gray colors, the conversion is exact: a material with the result has the same diffuse and specular color. In the specular-glossiness
// model, the diffuse reflectance is d·(1 − s); in the metallic-roughness model, it is b·(1 − 0.04)·(1 − m), and the specular reflectance is
// 0.04·(1 − m) + b·m.
TEST(ConvertedImages, GrayMaterialsKeepTheirReflectance) {
  for (double d = 0.0; d <= 1.0; d += 0.125) {
    for (double s = 0.05; s <= 1.0; s += 0.05) {
      const MetallicColor c = metallic_color(glm::dvec3(d), glm::dvec3(s));
      const double b = c.base.x, m = c.metallic;
      // Where the exact base color would exceed 1, it is clamped.
      if (b == 1.0) continue;
      EXPECT_NEAR(0.04 * (1 - m) + b * m, s, 1e-6) << d << " " << s;  // divisions by m or 1 − m are limited to 1e6
      EXPECT_NEAR(b * 0.96 * (1 - m), d * (1 - s), 1e-6) << d << " " << s;
    }
  }
}

TEST(ConvertedImages, TexelsAreConvertedInLinearLight) {
  Case c;
  c.diffuse = Picture(3, 1);
  c.specular = Picture(3, 1);
  c.diffuse.at(0, 0) = {200, 100, 50, 77};    // a dielectric: sRGB 30 is a reflectance of 0.013
  c.specular.at(0, 0) = {30, 30, 30, 255};    // glossiness 1
  c.diffuse.at(1, 0) = {0, 0, 0, 255};        // a metal
  c.specular.at(1, 0) = {250, 180, 60, 51};   // glossiness 0.2
  c.diffuse.at(2, 0) = {150, 150, 150, 255};  // between the two
  c.specular.at(2, 0) = {150, 150, 150, 0};
  const ConvertedImages out = c.converted();
  EXPECT_TRUE(out.problems.empty());
  // Results are rounded to the nearest code.
  const auto expect = [&](int x, const glm::dvec3& base, double metallic, double roughness) {
    SCOPED_TRACE(x);
    for (glm::length_t k = 0; k < 3; ++k) EXPECT_NEAR(out.base_color.at(x, 0)[k], encoded(base[k]), 0.501);
    EXPECT_NEAR(out.metallic_roughness.at(x, 0).z, 255 * metallic, 0.501);
    EXPECT_NEAR(out.metallic_roughness.at(x, 0).y, 255 * roughness, 0.501);
  };
  const double kept = (1 - decoded(30)) / 0.96;
  expect(0, {kept * decoded(200), kept * decoded(100), kept * decoded(50)}, 0.0, 0.0);
  EXPECT_EQ(out.base_color.at(0, 0).w, 77);
  // Without diffuse light, the metal's color is the specular color, if brightness² = Σ w·specular² gives a metalness of 1: the equation
  // 0.04 m² + (s − 0.08) m + 0.04 − s = 0 has the solution m = 1 for every s.
  expect(1, {decoded(250), decoded(180), decoded(60)}, 1.0, 0.8);
  // Gray: both reflectances are kept, 0.04 (1 − m) + b m = s and 0.96 b (1 − m) = d (1 − s). With d = s, b = (s − 0.04 (1 − m)) / m gives a
  // quadratic equation for m, solved here by bisection.
  const double s = decoded(150);
  double low = 1e-3, high = 1.0;
  for (int i = 0; i < 60; ++i) {
    const double m = 0.5 * (low + high);
    (0.96 * (s - 0.04 * (1 - m)) / m * (1 - m) > s * (1 - s) ? low : high) = m;
  }
  expect(2, glm::dvec3((s - 0.04 * (1 - low)) / low), low, 1.0);
}

TEST(ConvertedImages, FactorsMultiplyTexels) {
  Case c;
  c.diffuse = uniform(1, 1, {255, 255, 255, 128});
  c.source = {.diffuse = glm::vec3(0.5f, 0.25f, 0.0f), .specular = glm::vec3(0.02f), .glossiness = 0.75f};
  const ConvertedImages out = c.converted();
  for (glm::length_t k = 0; k < 3; ++k)
    EXPECT_NEAR(out.base_color.at(0, 0)[k], encoded(static_cast<double>(c.source.diffuse[k]) * 0.98 / 0.96), 0.501);
  EXPECT_EQ(out.base_color.at(0, 0).w, 128);
  EXPECT_EQ(out.metallic_roughness.at(0, 0), glm::u8vec4(0, 64, 0, 255)) << "roughness 0.25, which is 63.75 codes";
}

TEST(ConvertedImages, TexelsCanBeNumbers) {
  Image<glm::vec4> light(1, 1);
  light.at(0, 0) = {0.3f, 0.6f, 0.0f, 1.0f};
  Model model;
  model.images.push_back({.name = "light", .file = {}, .bytes = nullptr, .pixels = std::make_shared<const ColorPicture>(light)});
  model.textures.push_back({0, {}});
  const ConvertedImages out = converted_images(model, {.diffuse_texture = 0, .specular = glm::vec3(0.02f)}, "test", Workers(1));
  EXPECT_TRUE(out.problems.empty());
  for (glm::length_t k = 0; k < 3; ++k)
    EXPECT_NEAR(out.base_color.at(0, 0)[k], encoded(static_cast<double>(light.at(0, 0)[k]) * 0.98 / 0.96), 0.501);
}

TEST(ConvertedImages, TexturesOfDifferentSizesAreResampled) {
  Case c;
  // Two texels of glossiness, 0 and 1, over four texels of color. Linear interpolation at the texel centers gives weights of 3/4 and 1/4
  // between the two, and the same across the border if the texture repeats.
  c.diffuse = uniform(4, 2, {90, 90, 90, 255});
  c.specular = Picture(2, 1);
  c.specular.at(0, 0) = {0, 0, 0, 0};
  c.specular.at(1, 0) = {0, 0, 0, 255};
  const auto roughness = [&](const Case& from, int y) {
    const ConvertedImages out = from.converted();
    EXPECT_EQ(out.metallic_roughness.width(), 4);
    EXPECT_EQ(out.metallic_roughness.height(), 2);
    std::vector<int> row;
    for (int x = 0; x < 4; ++x) row.push_back(out.metallic_roughness.at(x, y).y);
    return row;
  };
  for (const int y : {0, 1}) {
    c.sampler = {};
    EXPECT_EQ(roughness(c, y), (std::vector<int>{191, 191, 64, 64}));
    c.sampler.wrap_s = Wrap::clamp;
    EXPECT_EQ(roughness(c, y), (std::vector<int>{255, 191, 64, 0}));
    c.sampler.mag = Filter::nearest;
    EXPECT_EQ(roughness(c, y), (std::vector<int>{255, 255, 0, 0}));
  }
  // Colors are interpolated in linear light: half of white, which the exact mean of two texels is, is sRGB 188, and here 1/4 and 3/4.
  Case color;
  color.specular = uniform(4, 2, {0, 0, 0, 255});
  color.diffuse = Picture(2, 1);
  color.diffuse.at(0, 0) = {0, 0, 0, 255};
  color.diffuse.at(1, 0) = {150, 150, 150, 255};
  color.sampler.wrap_s = Wrap::clamp;
  const ConvertedImages out = color.converted();
  for (const auto& [x, share] : {std::pair(0, 0.0), std::pair(1, 0.25), std::pair(2, 0.75), std::pair(3, 1.0)})
    EXPECT_NEAR(out.base_color.at(x, 0).x, encoded(share * decoded(150) / 0.96), 0.501) << x;
  // A texture with more texels in one direction only is averaged in the other: the mean of alternating texels.
  Case tall;
  tall.diffuse = Picture(1, 8);
  for (int y = 0; y < 8; ++y) tall.diffuse.at(0, y) = glm::u8vec4(glm::u8vec3(100), y % 2 == 0 ? 0 : 255);
  tall.specular = uniform(5, 2, {0, 0, 0, 255});
  const ConvertedImages mean = tall.converted();
  ASSERT_EQ(mean.base_color.height(), 2);
  for (int y = 0; y < 2; ++y) EXPECT_NEAR(mean.base_color.at(4, y).w, 127.5, 0.501);
}

// A wide and a tall texture, whose size along one axis changes by a factor of 32768. Without separating the axes, every texel would be a
// mean of 65536, which takes more than 10 s.
TEST(ConvertedImages, ExtremeProportionsAreAveraged) {
  Case c;
  c.diffuse = Picture(32767, 1);
  for (int x = 0; x < 32767; ++x) c.diffuse.at(x, 0) = glm::u8vec4(glm::u8vec3(120), x % 2 == 0 ? 0 : 255);
  c.specular = uniform(1, 32768, {0, 0, 0, 255});
  const ConvertedImages out = c.converted();
  ASSERT_EQ(out.base_color.width(), 1);
  ASSERT_EQ(out.base_color.height(), 32768);
  // The mean of 32767 floats has an error of at most 32767 · 2^-24 = 0.2 %, or 0.3 codes.
  for (const int y : {0, 20000, 32767}) EXPECT_NEAR(out.base_color.at(0, y).w, 127.5, 0.81);
}

TEST(ConvertedImages, UnreadableSourcesAreWhite) {
  Model model;
  const auto bytes = std::make_shared<const std::vector<std::byte>>(10);
  model.images.push_back({.name = "bad", .file = {}, .bytes = bytes});
  model.textures.push_back({0, {}});
  SpecularGlossiness source{.diffuse_texture = 0, .specular_texture = -1};
  source.specular = glm::vec3(0.0f);
  const ConvertedImages out = converted_images(model, source, "test", Workers(1));
  ASSERT_EQ(out.problems.size(), 1u);
  EXPECT_NE(out.problems[0].find("test: bad"), std::string::npos) << out.problems[0];
  EXPECT_EQ(out.base_color.at(0, 0), glm::u8vec4(255));
}

}  // namespace
}  // namespace halfspace
