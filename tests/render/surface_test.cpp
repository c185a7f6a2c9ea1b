// SPDX-License-Identifier: Apache-2.0
//
// Compares rendered surfaces with closed forms: lighting at every shading rate, transforms, two-sided surfaces, factors and their maps.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "halfspace/image/image_io.h"
#include "halfspace/render/frame/frame.h"
#include "halfspace/render/scene_assets.h"
#include "halfspace/scene/scene_file.h"
#include "render/naive_picture.h"
#include "support/errors.h"
#include "support/folder_test.h"

namespace halfspace {
namespace {

constexpr int kSize = 160;
constexpr double kHalf = 1.1;  // half the height of the view, in units

// The camera looks along -z at a square of 2.2 units.
std::string scene_text(const std::string& rest) {
  return R"({"version": 1, "cameras": {"c": {"type": "orthographic", "position": [0, 0, 10], "height": 2.2, "far": 30}}, )" + rest + "}";
}

SceneDescription parsed_at_root(const std::string& text) { return SceneFile::parse(text, "test.json", "/").description(); }

Image<glm::vec4> linear_picture(const SceneDescription& scene, int size = kSize) {
  const Workers workers(1);
  SceneAssets assets(workers);
  Image<glm::vec4> picture(size, size);
  render(assets.prepare(scene, size, size), picture, workers);
  return picture;
}
Image<glm::vec4> linear_picture(const std::string& rest, int size = kSize) {
  return linear_picture(parsed_at_root(scene_text(rest)), size);
}

struct Spot {
  double x, y;  // center of a pixel, in units
};
Spot spot_of(int x, int row, int size = kSize) { return {((x + 0.5) / size * 2 - 1) * kHalf, (1 - (row + 0.5) / size * 2) * kHalf}; }

void for_each_pixel(const std::function<void(int, int)>& f, int size = kSize) {
  for (int row = 0; row < size; ++row) {
    for (int x = 0; x < size; ++x) f(x, row);
  }
}

const glm::dvec3 kSun = glm::normalize(glm::dvec3(0.6, 0.5, 0.8));
const std::string kSunText = R"("lights": {"sun": {"direction": [0.6, 0.5, 0.8]}})";

TEST(Surface, LambertSphereMatchesAtEveryPixel) {
  const Image<glm::vec4> p = linear_picture(kSunText + R"(, "objects": {"a": {"latitudes": 256, "longitudes": 512}})");
  int checked = 0;
  for_each_pixel([&](int x, int row) {
    const Spot s = spot_of(x, row);
    const double r2 = s.x * s.x + s.y * s.y;
    if (r2 > 0.995) return;
    const glm::dvec3 n(s.x, s.y, std::sqrt(1 - r2));
    // A facet is up to (π/256)²/8 below the sphere in both directions of the grid, and snapping moves its vertices by up to 1/512 px, where
    // a pixel is 2.2/160 units. The surface point at a pixel is off by the sum of these divided by n.z, and so is the interpolated normal.
    const double slack = (3.8e-5 + 2.7e-5) / n.z + 1e-6;
    EXPECT_NEAR(p.at(x, row).x, std::max(glm::dot(n, kSun), 0.0), slack) << x << " " << row;
    ++checked;
  });
  EXPECT_GT(checked, 15000);
}

TEST(Surface, FalloffMatchesOnAPlane) {
  // A lamp 0.7 above a plane that faces the eye: the cosine 0.7/d times the falloff at distance d.
  for (const bool physical : {true, false}) {
    const std::string fall = physical ? R"("falloff": "physical")" : R"("attenuation": [0.2, 0.1, 0.1])";
    const Image<glm::vec4> p = linear_picture(R"("lights": {"lamp": {"type": "point", "position": [0.3, -0.2, 0.7], )" + fall +
                                              R"(}}, "objects": {"a": {"shape": "plane", "size": 4.4, "rotation": [90, 0, 0]}})");
    for_each_pixel([&](int x, int row) {
      const Spot s = spot_of(x, row);
      const double d = std::sqrt((s.x - 0.3) * (s.x - 0.3) + (s.y + 0.2) * (s.y + 0.2) + 0.49);
      const double want = 0.7 / d / (physical ? d * d : 0.2 + 0.1 * d + 0.1 * d * d);
      // The vertices are at integer pixel positions. Positions are floats about 10 units from the eye, with an error of 1e-6 relative to
      // distances of at least 0.7, in three powers of d.
      EXPECT_NEAR(p.at(x, row).x, want, 6e-6 * want) << x << " " << row;
    });
  }
}

TEST(Surface, RangeMatchesOnAPlaneAndKeepsTheShadowInside) {
  // The lamp of the test above with a range of 1.5: it reaches a circle on the plane, and the plane is black outside. A small board between
  // the lamp and the plane casts a shadow.
  const std::string plane = R"("a": {"shape": "plane", "size": 4.4, "rotation": [90, 0, 0]})";
  const std::string board = R"(, "b": {"shape": "plane", "size": 0.2, "rotation": [90, 0, 0], "position": [0.3, -0.2, 0.35]})";
  const auto lamp = [](const std::string& more) {
    return R"("lights": {"lamp": {"type": "point", "position": [0.3, -0.2, 0.7], "falloff": "physical")" + more + "}}, ";
  };
  const std::string hard = R"("shadow": {"method": "hard", "resolution": 512}, )";
  const Image<glm::vec4> p = linear_picture(lamp(R"(, "range": 1.5)") + "\"objects\": {" + plane + "}");
  const Image<glm::vec4> shadowed = linear_picture(hard + lamp(R"(, "range": 1.5)") + "\"objects\": {" + plane + board + "}");
  const Image<glm::vec4> unlimited = linear_picture(hard + lamp("") + "\"objects\": {" + plane + board + "}");
  int black = 0, dark = 0;
  for_each_pixel([&](int x, int row) {
    const Spot s = spot_of(x, row);
    const double d2 = (s.x - 0.3) * (s.x - 0.3) + (s.y + 0.2) * (s.y + 0.2) + 0.49, d = std::sqrt(d2);
    const double window = std::max(1 - d2 * d2 / (1.5 * 1.5 * 1.5 * 1.5), 0.0);
    // The error of the falloff (test above), plus that of (d / range)⁴: at most 4 times the relative error of d, 1.5e-6.
    EXPECT_NEAR(p.at(x, row).x, 0.7 / d / d2 * window, 6e-6 * 0.7 / d / d2 * (window + 1)) << x << " " << row;
    if (d > 1.50001) {
      EXPECT_EQ(p.at(x, row).x, 0.0f) << x << " " << row;
      ++black;
    }
    // The board covers |x - 0.3|, |y + 0.2| < 0.1 and its shadow twice that, which is within the range. The shadow map with the shorter
    // depth range has the same edges, up to a texel, which is less than a pixel.
    const double from_edge = std::max(std::fabs(s.x - 0.3), std::fabs(s.y + 0.2)) - 0.2;
    if (from_edge > -0.08 && from_edge < -0.03) {
      EXPECT_EQ(shadowed.at(x, row).x, 0.0f) << x << " " << row;
      EXPECT_EQ(unlimited.at(x, row).x, 0.0f) << x << " " << row;
      ++dark;
    }
    if (from_edge > 0.03) {
      EXPECT_EQ(shadowed.at(x, row).x, p.at(x, row).x) << x << " " << row;
    }
  });
  EXPECT_GT(black, 3000);
  EXPECT_GT(dark, 100);
}

TEST(Surface, SpotLightMatchesOnAPlane) {
  const Image<glm::vec4> p = linear_picture(R"("lights": {"lamp": {"type": "spot", "position": [0, 0, 1], "direction": [0, 0, 1],
    "inner": 20, "outer": 30}}, "objects": {"a": {"shape": "plane", "size": 4.4, "rotation": [90, 0, 0]}})");
  const double degree = std::numbers::pi / 180, inner = std::cos(20 * degree), outer = std::cos(30 * degree);
  for_each_pixel([&](int x, int row) {
    const Spot s = spot_of(x, row);
    const double cosine = 1 / std::sqrt(1 + s.x * s.x + s.y * s.y);  // cosine of the angle to the normal and to the spot axis
    const double t = std::clamp((cosine - outer) / (inner - outer), 0.0, 1.0);
    // Cosines are floats; the error of t is 1e-6, times a slope of 2.
    EXPECT_NEAR(p.at(x, row).x, cosine * t * t, 1e-5) << x << " " << row;
  });
}

TEST(Surface, HighlightsPeakAtTheMirrorDirection) {
  for (const char* model : {"phong", "blinn_phong"}) {
    // Eye and lamp are mirror images in the plane x = 0 above the floor, so the center of the image reflects the lamp.
    const std::string text = std::string(R"({"version": 1, "cameras": {"c": {"position": [1, 1, 0], "target": [0, 0, 0]}},
      "lights": {"lamp": {"type": "point", "position": [-1, 1, 0], "intensity": 0.5}},
      "objects": {"a": {"shape": "plane", "size": 9, "diffuse": 0, "specular": 0.8, "shininess": 200, "model": ")") +
                             model + "\"}}}";
    const Image<glm::vec4> p = linear_picture(parsed_at_root(text), 161);
    glm::ivec2 peak(0);
    for_each_pixel([&](int x, int row) { peak = p.at(x, row).x > p.at(peak.x, peak.y).x ? glm::ivec2(x, row) : peak; }, 161);
    EXPECT_EQ(peak, glm::ivec2(80, 80)) << model;
    EXPECT_NEAR(p.at(80, 80).x, 0.4f, 1e-5f) << model;
  }
}

// ---- shading rates -----------------------------------------------------------------------------------------------

std::string ball(const char* rate, int latitudes, const std::string& more = "") {
  return R"("objects": {"a": {"latitudes": )" + std::to_string(latitudes) + R"(, "longitudes": )" + std::to_string(2 * latitudes) +
         R"(, "specular": 0.5, "shininess": 10, "shading": ")" + rate + "\"" + more + "}}";
}

// Returns the mean difference from Phong shading on the same mesh, away from the rim.
double distance_from_phong(const char* rate, int latitudes) {
  const Image<glm::vec4> a = linear_picture(kSunText + ", " + ball(rate, latitudes)),
                         b = linear_picture(kSunText + ", " + ball("phong", latitudes));
  double sum = 0;
  int count = 0;
  for_each_pixel([&](int x, int row) {
    const Spot s = spot_of(x, row);
    if (s.x * s.x + s.y * s.y > 0.8) return;
    sum += std::abs(static_cast<double>(a.at(x, row).x) - static_cast<double>(b.at(x, row).x));
    ++count;
  });
  return sum / count;
}

TEST(Rates, GouraudAndFlatConvergeToPhong) {
  // Linear interpolation of a smooth function has an error quadratic in the facet size. At the terminator, where the function has a kink,
  // the error is linear but confined to a strip with the width of a facet, so the mean is of order 2 overall. A constant per facet has an
  // error of order 1. The tolerance of 10% of an order, over two doublings, allows for the alignment of facets and pixels.
  const auto order = [](const char* rate) {
    const double coarse = distance_from_phong(rate, 16), fine = distance_from_phong(rate, 64);
    EXPECT_GT(coarse, fine);
    return std::log2(coarse / fine) / 2;
  };
  const double gouraud = order("gouraud"), flat = order("flat"), provoking = order("provoking");
  RecordProperty("gouraud", std::to_string(gouraud));
  RecordProperty("flat", std::to_string(flat));
  RecordProperty("provoking", std::to_string(provoking));
  EXPECT_NEAR(gouraud, 2.0, 0.2);
  EXPECT_NEAR(flat, 1.0, 0.1);
  EXPECT_NEAR(provoking, 1.0, 0.1);
}

TEST(Rates, EachRateEvaluatesLightAtItsOwnPoints) {
  // A plane of two triangles that faces the eye, with corners at ±1, and a lamp above one corner.
  const auto light_at = [](double x, double y) {
    const double d = std::sqrt((x - 1) * (x - 1) + (y - 1) * (y - 1) + 0.25);
    return 0.5 / d;
  };
  const auto picture = [](const char* rate) {
    return linear_picture(std::string(R"("lights": {"lamp": {"type": "point", "position": [1, 1, 0.5]}}, "objects": {"a": {"shape": "plane",
      "rotation": [90, 0, 0], "shading": ")") +
                          rate + "\"}}");
  };
  const Image<glm::vec4> none = picture("none"), flat = picture("flat"), provoking = picture("provoking"), gouraud = picture("gouraud"),
                         phong = picture("phong");
  // The diagonal runs from the upper left to the lower right. The triangles are (upper left, lower left, lower right) and (upper left,
  // lower right, upper right).
  for_each_pixel([&](int x, int row) {
    const Spot s = spot_of(x, row);
    if (std::max(std::abs(s.x), std::abs(s.y)) > 0.99 || std::abs(s.x + s.y) < 0.02) return;
    const bool upper = s.x + s.y > 0;
    EXPECT_EQ(none.at(x, row).x, 1.0f);
    EXPECT_NEAR(flat.at(x, row).x, upper ? light_at(1.0 / 3, 1.0 / 3) : light_at(-1.0 / 3, -1.0 / 3), 2e-6);
    EXPECT_NEAR(provoking.at(x, row).x, upper ? light_at(1, 1) : light_at(1, -1), 2e-6) << "light at the last vertex";
    const double across = std::abs(s.x + s.y) / 2, corner = upper ? light_at(1, 1) : light_at(-1, -1);
    const double along = (1 - across) / 2 + (s.x - s.y) / 4;  // weight of the lower right corner
    const double mixed = across * corner + along * light_at(1, -1) + (1 - across - along) * light_at(-1, 1);
    // Corners are snapped to 1/512 px, which is 2.7e-5 units, and light changes by up to 0.6 per unit.
    EXPECT_NEAR(gouraud.at(x, row).x, mixed, 1.6e-5);
    EXPECT_NEAR(phong.at(x, row).x, light_at(s.x, s.y), 1.6e-5);
  });
}

TEST(Rates, MapsAreSampledPerPixelAtEveryRate) {
  // Under uniform ambient light, a map looks the same at every rate.
  const auto picture = [](const char* rate) {
    return linear_picture(std::string(R"("ambient": 1, "textures": {"t": {"source": "earth_color", "width": 64}},
      "objects": {"a": {"latitudes": 8, "longitudes": 16, "color": "t", "shading": ")") +
                          rate + "\"}}");
  };
  const Image<glm::vec4> phong = picture("phong");
  for (const char* rate : {"none", "flat", "provoking", "gouraud"}) EXPECT_EQ(picture(rate), phong) << rate;
}

TEST(Rates, NonUniformScaleTransformsNormalsCorrectly) {
  // An ellipsoid, with and without mirroring, compared with its analytic normals (x/a², y/b², z/c²).
  for (const char* scale : {"[1, 0.6, 0.5]", "[-1, 0.6, 0.5]"}) {
    const auto errors = [&](const char* rate) {
      const Image<glm::vec4> p = linear_picture(kSunText + R"(, "objects": {"a": {"latitudes": 128, "longitudes": 256, "shading": ")" +
                                                rate + R"(", "scale": )" + scale + "}}");
      double worst = 0;
      for_each_pixel([&](int x, int row) {
        const Spot s = spot_of(x, row);
        const double r2 = s.x * s.x + s.y * s.y / 0.36;
        if (r2 > 0.9) return;
        const glm::dvec3 n = glm::normalize(glm::dvec3(s.x, s.y / 0.36, 0.5 * std::sqrt(1 - r2) / 0.25));
        worst = std::max(worst, std::abs(static_cast<double>(p.at(x, row).x) - std::max(glm::dot(n, kSun), 0.0)));
      });
      return worst;
    };
    // Facets are π/128 = 0.025 wide. Normals per pixel and light per vertex have errors of about the square of that, stretched by up to
    // (1/0.5)². At the terminator the error is the slope times a fraction of the facet. Light per face has an error of half the facet
    // width, stretched by the same factor.
    EXPECT_LT(errors("phong"), 2e-3) << scale;
    EXPECT_LT(errors("gouraud"), 1e-2) << scale;
    EXPECT_LT(errors("flat"), 5e-2) << scale;
  }
}

TEST(Rates, TwoSidedSurfacesAreLitOnTheVisibleSide) {
  for (const char* rate : {"flat", "provoking", "gouraud", "phong"}) {
    const auto middle = [&](const char* turn, const char* sun) {
      return linear_picture(std::string(R"("lights": {"sun": {"direction": )") + sun +
                                R"(}}, "objects": {"a": {"shape": "plane", "rotation": [)" + turn + R"(, 0, 0], "shading": ")" + rate +
                                "\"}}",
                            8)
          .at(4, 4)
          .x;
    };
    EXPECT_EQ(middle("90", "[0, 0, 1]"), 1.0f) << rate;
    EXPECT_EQ(middle("90", "[0, 0, -1]"), 0.0f) << rate;
    EXPECT_EQ(middle("-90", "[0, 0, 1]"), 1.0f) << rate << " from behind";
    EXPECT_EQ(middle("-90", "[0, 0, -1]"), 0.0f) << rate << " from behind";
  }
  // The near plane cuts off the front of a closed mesh. The inside is invisible if the mesh is one-sided, and lit if it is two-sided.
  const auto inside = [](const char* sides) {
    return linear_picture(
               parsed_at_root(std::string(R"({"version": 1, "cameras": {"c": {"type": "orthographic", "position": [0, 0, 1], "near": 0.9,
      "height": 1}}, "lights": {"sun": {}}, "objects": {"a": {"two_sided": )") +
                              sides + "}}}"),
               8)
        .at(4, 4)
        .x;
  };
  EXPECT_EQ(inside("false"), 0.0f);
  EXPECT_NEAR(inside("true"), 1.0f, 1e-2f);
}

// ---- factors -----------------------------------------------------------------------------------------------------

// Returns the value at the center of a plane that fills the view and is lit and seen at normal incidence.
float shade_of(const std::string& surface, const std::string& light = "", const std::string& head = "") {
  return linear_picture(head + R"("lights": {"sun": {)" + light +
                            R"(}}, "objects": {"a": {"shape": "plane", "size": 4, "rotation": [90, 0, 0])" + surface + "}}",
                        8)
      .at(4, 4)
      .x;
}

TEST(Factors, CombineToTheColor) {
  EXPECT_EQ(shade_of(""), 1.0f);
  EXPECT_EQ(shade_of(R"(, "color": 0.5, "tint": 0.5)"), 0.25f);
  EXPECT_EQ(shade_of(R"(, "color": 0.5, "diffuse": 0.5)"), 0.25f);
  EXPECT_EQ(shade_of(R"(, "color": 0.5, "diffuse": 0, "specular": 0.75)"), 0.75f) << "the highlight does not depend on the color";
  EXPECT_EQ(shade_of(R"(, "diffuse": 0, "specular": 0.75, "model": "lambert")"), 0.0f);
  EXPECT_EQ(shade_of(R"(, "diffuse": 0, "emissive": 3)"), 3.0f);
  EXPECT_EQ(shade_of(R"(, "color": 0.5, "ambient": 0.5)", R"("diffuse": 0, "ambient": 0.25, "intensity": 2)", R"("ambient": 0.5, )"), 0.25f)
      << "0.5 · 0.5 · (0.5 + 2 · 0.25)";
  EXPECT_EQ(shade_of(R"(, "specular": 1)", R"("diffuse": 0.25, "specular": 0.5)"), 0.75f);
  EXPECT_EQ(shade_of(R"(, "color": 0.5, "emissive": 0.25, "specular": 1, "shading": "none")"), 0.75f) << "color plus emission";
  EXPECT_EQ(shade_of(R"(, "specular": 0.5, "specular_map": 0.5)"), 1.25f) << "a map of a single color is a constant";
}

class FactorMaps : public FolderTest {
 protected:
  // Writes an image file of one texel and returns its quoted path.
  std::string texel(int code) const {
    Image<glm::u8vec4> image(1, 1);
    image.at(0, 0) = glm::u8vec4(code, code, code, 255);
    const std::filesystem::path path = directory / (std::to_string(code) + ".png");
    write_png(path, image);
    std::string text = "\"";
    text += path.string();
    return text += '"';
  }
};

TEST_F(FactorMaps, MultiplyTheirConstants) {
  const float half = kSrgbToLinear[188], third = kSrgbToLinear[128];
  const auto maps = [&](const std::string& factor) { return ", \"" + factor + "_map\": " + texel(188); };
  EXPECT_FLOAT_EQ(shade_of(R"(, "tint": 0.5, "color": )" + texel(188)), 0.5f * half);
  EXPECT_FLOAT_EQ(shade_of(R"(, "diffuse": 0.5)" + maps("diffuse")), 0.5f * half);
  EXPECT_FLOAT_EQ(shade_of(R"(, "diffuse": 0, "specular": 0.5)" + maps("specular")), 0.5f * half);
  EXPECT_FLOAT_EQ(shade_of(R"(, "diffuse": 0, "emissive": 0.5)" + maps("emissive")), 0.5f * half);
  EXPECT_FLOAT_EQ(shade_of(R"(, "diffuse": 0, "ambient": 0.5)" + maps("ambient"), "", R"("ambient": 1, )"), 0.5f * half);
  EXPECT_FLOAT_EQ(shade_of(R"(, "specular": 0.5, "specular_map": )" + texel(188) + R"(, "color": )" + texel(128)), third + 0.5f * half);
  EXPECT_FLOAT_EQ(shade_of(R"(, "specular": 0.5, "specular_map": )" + texel(128) + R"(, "color": )" + texel(128)), 1.5f * third)
      << "color and highlight share one map";
  EXPECT_FLOAT_EQ(shade_of(R"(, "textured": false, "tint": 0.5, "color": )" + texel(188)), 0.5f);
}

TEST_F(FactorMaps, ShininessIsNotDecodedFromSrgb) {
  // The light is 60° off the normal, so the half vector is 30° off. The 8-bit value 128 scales the exponent by 128/255 at every rate.
  for (const char* rate : {"flat", "gouraud", "phong"}) {
    const float c = shade_of(std::string(R"(, "diffuse": 0, "specular": 1, "shininess": 20, "shininess_map": )") + texel(128) +
                                 R"(, "shading": ")" + rate + "\"",
                             R"("direction": [0.8660254037844386, 0, 0.5])");
    EXPECT_NEAR(c, std::pow(std::sqrt(3.0) / 2, 20 * 128 / 255.0), 1e-6) << rate;
  }
}

TEST_F(FactorMaps, AreLoadedOnlyIfTheyHaveAnEffect) {
  std::vector<std::string> warnings;
  const auto uses = [&](const std::string& surface) {
    const Workers workers(1);
    SceneAssets assets(workers, [&](const std::string& warning) {
      if (warning.starts_with("objects.")) warnings.push_back(warning);
    });
    const PreparedScene scene = assets.prepare(parsed_at_root(scene_text(R"("objects": {"a": {"shape": "plane")" + surface + "}}")), 8, 8);
    int maps = 0;
    for (const Factor& f : surface_of(scene.draws.front()).factors) maps += f.map != nullptr;
    return maps;
  };
  const std::string none = "\"/none.png\"";  // loading it would throw
  EXPECT_EQ(uses(""), 0);
  EXPECT_EQ(uses(R"(, "color": )" + texel(128)), 1);
  EXPECT_TRUE(warnings.empty());
  EXPECT_EQ(uses(R"(, "specular_map": )" + texel(128) + R"(, "emissive_map": )" + texel(128) + R"(, "shininess_map": )" + texel(128)), 0)
      << "their constants are 0";
  ASSERT_EQ(warnings.size(), 3u) << "a map that is multiplied by 0 is probably a mistake";
  EXPECT_TRUE(reports(warnings[0], "objects.a.specular_map", {"specular is 0"}));
  EXPECT_TRUE(reports(warnings[1], "objects.a.shininess_map", {"specular is 0"}));
  EXPECT_TRUE(reports(warnings[2], "objects.a.emissive_map", {"emissive is 0"}));
  for (const char* map : {"specular_map", "shininess_map", "emissive_map"})
    EXPECT_TRUE(
        reports(input_error([&] { uses(std::string(", \"") + map + "\": " + none); }), std::string("objects.a.") + map, {"/none.png"}));
  EXPECT_EQ(uses(R"(, "ambient_map": )" + none), 0) << "there is no ambient light";
  EXPECT_EQ(uses(R"(, "shading": "none", "diffuse_map": )" + none), 0);
  EXPECT_EQ(uses(R"(, "textured": false, "color": )" + none), 0);
  EXPECT_EQ(uses(R"(, "shading": "gouraud", "normal_map": )" + none), 0) << "per-vertex lighting ignores normal maps";
}

}  // namespace
}  // namespace halfspace
