// SPDX-License-Identifier: Apache-2.0
//
// Tests environments in scenes: the shipped scene "environment", image files, backgrounds by direction, and blending.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "halfspace/image/image_io.h"
#include "halfspace/procedural/sky.h"
#include "halfspace/render/frame/frame.h"
#include "halfspace/render/scene_assets.h"
#include "halfspace/scene/scene_file.h"
#include "render/naive_picture.h"
#include "support/folder_test.h"

namespace halfspace {
namespace {

SceneDescription environment_with(const std::vector<std::string>& settings) {
  SceneFile scene = SceneFile::open("environment");
  scene.set(settings);
  return scene.description();
}

std::string error_of(const std::vector<std::string>& settings) {
  return input_error([&] {
    const Workers workers(1);
    SceneAssets assets(workers);
    assets.prepare(environment_with(settings), 16, 16);
  });
}

const EnvironmentSky& sky_of(const PreparedScene& scene) { return std::get<EnvironmentSky>(scene.draws.back().shader); }

TEST(EnvironmentScene, IsWithinOneLsbOfDoublePrecision) {
  for (const char* camera : {"camera=front", "camera=up"}) {
    // The image has no silhouettes or triangle edges. Pixels differ only at rounding ties, by 1/255.
    EXPECT_EQ(share_beyond_one_code<double>(environment_with({camera}), 320, 180), 0.0) << camera;
  }
}

TEST(EnvironmentScene, IsBitIdenticalForAnyThreadCount) {
  const SceneDescription scene = SceneFile::open("environment").at(1.0);
  const Image<glm::u8vec4> one = picture_of(scene, 160, 90, 1);
  EXPECT_EQ(picture_of(scene, 160, 90, 2), one);
  EXPECT_EQ(picture_of(scene, 160, 90, 7), one);
}

// Computes the ray of every pixel independently, converts it to (u, v) on the globe, and compares the pixel with the map.
TEST(EnvironmentScene, MapIsPlacedCorrectly) {
  constexpr int kWidth = 160, kHeight = 90;
  const SceneDescription scene = environment_with({"surface.width=256"});
  const Image<glm::vec4> image = light_of(scene, kWidth, kHeight);
  const Workers workers(2);
  SceneAssets assets(workers);
  const PreparedScene prepared = assets.prepare(scene, kWidth, kHeight);
  const EnvironmentMap& map = *sky_of(prepared).environment.first.map;
  const double tangent = std::tan(75.0 / 2 * std::numbers::pi / 180), turn = -110.0 * std::numbers::pi / 180;
  double worst = 0;
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const double a = ((x + 0.5) / kWidth * 2 - 1) * tangent * kWidth / kHeight, b = (1 - (y + 0.5) / kHeight * 2) * tangent;
      // (a, b, −1), rotated back about y. Its (u, v) on uv_sphere give a direction in the panorama.
      const glm::dvec3 d(a * std::cos(turn) + std::sin(turn), b, a * std::sin(turn) - std::cos(turn));
      const double u = std::atan2(-d.z, d.x), v = std::atan2(std::hypot(d.x, d.z), d.y);
      const glm::dvec3 on_map(-std::sin(v) * std::sin(u), std::cos(v), -std::sin(v) * std::cos(u));
      // The distance to the next pixel. In general this direction is not perpendicular to the ray.
      const double step = 2 * tangent / kHeight / std::hypot(a, b, 1.0);
      const double across = step * std::sqrt(1 - std::min(a * a, b * b) / (a * a + b * b + 1));
      const glm::dvec3 side = glm::normalize(glm::cross(on_map, glm::dvec3(0.1, 0.2, 1))) * across;
      const glm::dvec3 want = map.sample<double>(on_map, side, {});
      for (int k = 0; k < 3; ++k) worst = std::max(worst, std::abs(want[k] - static_cast<double>(image.at(x, y)[k])));
    }
  }
  RecordProperty("worst", std::to_string(worst));
  EXPECT_LT(worst, 1e-4) << "rounding error of float";
}

TEST(EnvironmentScene, UniformSkyHasOneValue) {
  for (const char* type : {"globe.type=globe", "globe.type=equirect"}) {
    const Image<glm::vec4> image = light_of(environment_with({type, "globe.map=[0.25, 3, 0.001]", "globe.brightness=2"}), 64, 48);
    for (const glm::vec4& c : image.texels()) ASSERT_EQ(c, glm::vec4(0.5f, 6.0f, 0.002f, 1.0f));
  }
}

TEST(EnvironmentScene, BlendsAndLoadsOnlyVisibleEnvironments) {
  const std::string text = R"({"version": 1,
    "environments": {"day": {"map": [1, 0.5, 0]}, "night": {"map": "/none.png"}, "dusk": {"map": 0.25}},
    "background": {"type": "environment", "environment": "day", "second": "night", "weight": 0}})";
  SceneFile scene = SceneFile::parse(text, "test.json", ".");
  EXPECT_EQ(light_of(scene.description(), 4, 4).at(1, 1), glm::vec4(1, 0.5f, 0, 1)) << "the missing file of night is not loaded";
  scene.set("background.weight=0.001");
  EXPECT_TRUE(reports(input_error([&] { light_of(scene.description(), 4, 4); }), "environments.night.map: /none.png", {"no such file"}));
  scene.set("background.second=dusk");
  scene.set("background.weight=0.5");
  EXPECT_EQ(light_of(scene.description(), 4, 4).at(1, 1), glm::vec4(0.625f, 0.375f, 0.125f, 1));
  scene.set("background.weight=1");
  scene.set("day.map=/none.png");
  EXPECT_EQ(light_of(scene.description(), 4, 4).at(1, 1), glm::vec4(0.25f, 0.25f, 0.25f, 1)) << "the missing file of day is not loaded";
  scene.set("background.second=");
  scene.set("background.environment=dusk");
  EXPECT_EQ(light_of(scene.description(), 4, 4).at(1, 1), glm::vec4(0.25f, 0.25f, 0.25f, 1))
      << "without a second environment the weight is 0";
}

TEST(EnvironmentScene, IsBehindAllObjects) {
  SceneFile scene = SceneFile::open("environment");
  SceneDescription d = scene.description();
  ObjectDescription ball;
  ball.placement.position = {0, 0, -3};
  ball.surface.color = Color{glm::dvec3(1.0)};
  d.head.ambient.linear = glm::dvec3(1.0);
  d.objects.emplace_back("ball", ball);
  const Image<glm::vec4> image = light_of(d, 64, 64), sky = light_of(scene.description(), 64, 64);
  EXPECT_EQ(image.at(32, 32), glm::vec4(1.0f));
  EXPECT_EQ(image.at(2, 2), sky.at(2, 2));
}

// ---- reflections -------------------------------------------------------------------------------------------------------

// A purely reflective ball under a globe with a known map. The test reflects the ray of each pixel itself.
TEST(Reflections, BallFollowsTheLawOfReflection) {
  constexpr int kSize = 200;
  SceneFile scene = SceneFile::parse(R"({"version": 1, "cameras": {"c": {"position": [0, 0, 4], "fov": 40}},
    "textures": {"surface": {"source": "earth_color", "width": 256}},
    "environments": {"sky": {"type": "globe", "map": "surface"}},
    "objects": {"ball": {"color": 0, "reflection": [0.9, 0.8, 0.7], "latitudes": 512, "longitudes": 1024}},
    "background": {"type": "environment"}})",
                                     "test.json", ".");
  const Workers workers(2);
  SceneAssets assets(workers);
  const PreparedScene prepared = assets.prepare(scene.description(), kSize, kSize);
  Image<glm::vec4> image(kSize, kSize);
  render(prepared, image, workers);
  const Environment& sky = sky_of(prepared).environment.first;
  const double tangent = std::tan(20 * std::numbers::pi / 180);
  // Returns the reflected ray of an image position, or zero if the ray misses the ball or hits it close to the rim.
  const auto thrown_back = [&](double x, double y) {
    const glm::dvec3 eye(0, 0, 4), d = glm::normalize(glm::dvec3((x / kSize * 2 - 1) * tangent, (1 - y / kSize * 2) * tangent, -1));
    const double b = glm::dot(eye, d), disc = b * b - 15;
    if (disc < 0.05) return glm::dvec3(0.0);
    const glm::dvec3 n = eye + d * (-b - std::sqrt(disc));
    return d - n * (2 * glm::dot(d, n));
  };
  double sum = 0, worst = 0;
  int count = 0;
  for (int y = 1; y + 1 < kSize; ++y) {
    for (int x = 1; x + 1 < kSize; ++x) {
      const glm::dvec3 r = thrown_back(x + 0.5, y + 0.5), right = thrown_back(x + 1.5, y + 0.5), up = thrown_back(x + 0.5, y - 0.5);
      if (r == glm::dvec3(0.0) || right == glm::dvec3(0.0) || up == glm::dvec3(0.0)) continue;
      const glm::dvec3 left = thrown_back(x - 0.5, y + 0.5), down = thrown_back(x + 0.5, y + 1.5);
      if (left == glm::dvec3(0.0) || down == glm::dvec3(0.0)) continue;
      const glm::dvec3 want = sky.light<double>(r, (right - left) * 0.5, (up - down) * 0.5) * glm::dvec3(0.9, 0.8, 0.7);
      for (int k = 0; k < 3; ++k) {
        const double error = std::abs(want[k] - static_cast<double>(image.at(x, y)[k]));
        worst = std::max(worst, error);
        sum += error;
        ++count;
      }
    }
  }
  ASSERT_GT(count, 20000);
  RecordProperty("mean", std::to_string(sum / count));
  RecordProperty("worst", std::to_string(worst));
  // Half the sagitta of a facet, (π/512)²/8 = 5e-6 of the radius, displaces the hit point, and the interpolated normals deviate by the same
  // amount: about 1e-4 texel. Finite differences have an error quadratic in the pixel step divided by the distance to the rim, about 1e-3
  // of a mip level. Adjacent texels differ by up to 0.3.
  EXPECT_LT(sum / count, 2e-4);
  EXPECT_LT(worst, 1e-2);
}

TEST(Reflections, UseTheSelectedEnvironment) {
  const auto middle = [](const std::vector<std::string>& settings) {
    SceneFile scene = SceneFile::parse(R"({"version": 1, "objects": {"ball": {"color": 0, "reflection": 0.5}},
      "environments": {"a": {"map": [1, 0.5, 0.25]}, "b": {"map": 3}},
      "background": {"type": "environment", "environment": "a", "second": "b"}})",
                                       "test.json", ".");
    scene.set(settings);
    return light_of(scene.description(), 9, 9).at(4, 4);
  };
  EXPECT_EQ(middle({}), glm::vec4(0.5f, 0.25f, 0.125f, 1)) << "the environment of the background";
  EXPECT_EQ(middle({"background.weight=1"}), glm::vec4(1.5f, 1.5f, 1.5f, 1)) << "blended like the background";
  EXPECT_EQ(middle({"reflections.environment=b"}), glm::vec4(1.5f, 1.5f, 1.5f, 1));
  EXPECT_EQ(middle({"background.type=color", "background.color=0.5"}), glm::vec4(0.25f, 0.25f, 0.25f, 1)) << "a uniform color";
  EXPECT_EQ(middle({"reflections.on=false"}), glm::vec4(0, 0, 0, 1));
  EXPECT_EQ(middle({"ball.reflection=0"}), glm::vec4(0, 0, 0, 1));
  EXPECT_TRUE(reports(input_error([&] { middle({"reflections.environment=c"}); }), "test.json: reflections.environment", {"'c'", "a, b"}));
}

// ---- ambient light -----------------------------------------------------------------------------------------------------

// Returns the light of the middle pixel, where the side of a surface is that no light reaches.
glm::vec4 dark_side(const std::string& things, const std::vector<std::string>& settings = {}) {
  SceneFile scene = SceneFile::parse(R"({"version": 1, "ambient": 0.25, "lights": {"back": {"direction": [0, 0, -1]}},
    "environments": {"other": {"map": 8}, "around": {"map": [1, 0.5, 0.125], "brightness": 2}}, "reflections": {"environment": "around"}, )" +
                                         things + "}",
                                     "test.json", ".");
  scene.set(settings);
  return light_of(scene.description(), 9, 9).at(4, 4);
}

// color · ambient · A, where A is the ambient light of the scene plus the mean light of the environment. All factors are powers of two or
// their sums, so the products are exact.
TEST(EnvironmentLight, IsAmbientLightOfEveryKindOfShape) {
  const glm::vec4 expected(0.5f * glm::vec3(2.25f, 1.25f, 0.5f), 1.0f);
  for (const char* shading : {"phong", "gouraud", "flat", "provoking"})
    EXPECT_EQ(dark_side(R"("objects": {"ball": {"color": 0.5, "shading": ")" + std::string(shading) + R"("}})"), expected) << shading;
  EXPECT_EQ(dark_side(R"("objects": {"ball": {"shape": "sphere", "color": 0.5}})"), expected);
  EXPECT_EQ(dark_side(R"("objects": {"ball": {"color": 0.25, "ambient": 2}})"), expected);
  const std::string particle = R"("particles": {"count": 1, "radius": 1, "arrangement": "grid"})";  // its color depends on its position
  EXPECT_NEAR(dark_side(particle).x, 9.0f * dark_side(particle, {"reflections.on=false"}).x, 1e-6f);
}

TEST(EnvironmentLight, IsAmbientLightOnlyIfTheEnvironmentIsNamed) {
  const std::string ball = R"("objects": {"ball": {"color": 0.5}})";
  const glm::vec4 without(glm::vec3(0.125f), 1.0f);
  EXPECT_EQ(dark_side(ball, {"reflections.environment="}), without);
  EXPECT_EQ(dark_side(ball, {"reflections.environment=", "background.type=environment"}), without);
  EXPECT_EQ(dark_side(ball, {"reflections.on=false"}), without);
  EXPECT_EQ(dark_side(ball, {"ball.ambient=0"}), glm::vec4(0, 0, 0, 1));
  EXPECT_EQ(dark_side(ball, {"ball.shading=none"}), glm::vec4(0.5f, 0.5f, 0.5f, 1)) << "the color itself";
}

// The mean of the studio's light, integrated over a grid of directions. The filtered map has texels of up to 0.9 degrees, and its mean
// weights them by their solid angles.
TEST(EnvironmentLight, IsTheMeanOverAllDirections) {
  const Workers workers(2);
  const EnvironmentMap map(procedural_studio(256, workers), TexelFormat::rgba16f, &workers);
  constexpr int kRows = 200;
  double sum = 0.0, weights = 0.0;
  for (int i = 0; i < kRows; ++i) {
    const double theta = std::numbers::pi * (i + 0.5) / kRows;
    for (int j = 0; j < 2 * kRows; ++j) {
      const double phi = std::numbers::pi * j / kRows;
      const vec3<float> d(glm::vec3(std::sin(theta) * std::cos(phi), std::cos(theta), std::sin(theta) * std::sin(phi)));
      sum += static_cast<double>(map.sample_level<float>(d, 0.0f).x) * std::sin(theta);
      weights += std::sin(theta);
    }
  }
  SceneFile scene = SceneFile::parse(R"({"version": 1, "objects": {"ball": {}}, "environments": {"s": {"type": "studio", "size": 256}},
    "reflections": {"environment": "s"}})",
                                     "test.json", ".");
  EXPECT_NEAR(light_of(scene.description(), 9, 9).at(4, 4).x, sum / weights, 1e-3 * sum / weights);
}

// ---- shared environments -----------------------------------------------------------------------------------------------

// Returns the map that the first object of a scene reflects, or null.
const EnvironmentMap* reflected_map(const PreparedScene& scene) {
  const EnvironmentBlend* blend = std::visit(
      [](const auto& shader) -> const EnvironmentBlend* {
        if constexpr (requires { shader.reflected_environment; }) return shader.reflected_environment;
        return nullptr;
      },
      scene.draws.front().shader);
  return blend == nullptr ? nullptr : blend->first.map;
}

SceneDescription reflecting(const std::string& environment) {
  return SceneFile::parse(R"({"version": 1, "objects": {"ball": {"reflection": 1}}, "environments": {"e": )" + environment +
                              R"(}, "reflections": {"environment": "e"}})",
                          "test.json", ".")
      .description();
}

TEST(SharedEnvironments, AreMadeOncePerProcess) {
  const Workers workers(1);
  for (const char* environment :
       {R"({"type": "studio", "size": 32})", R"({"type": "day_sky", "size": 32})", R"({"type": "night_sky", "size": 32})"}) {
    SceneAssets first(workers), second(workers);
    const SceneDescription scene = reflecting(environment);
    const PreparedScene a = first.prepare(scene, 16, 16), b = second.prepare(scene, 16, 16);
    ASSERT_NE(reflected_map(a), nullptr);
    EXPECT_EQ(reflected_map(a), reflected_map(b)) << environment;
  }
}

TEST(SharedEnvironments, AreNotMadeForValuesAndStayInTheCache) {
  const Workers workers(1);
  SceneAssets assets(workers);
  const SceneDescription scene = reflecting(R"({"map": 0.5})");
  const PreparedScene before = assets.prepare(scene, 16, 16);
  EXPECT_EQ(reflected_map(assets.prepare_values(scene, 16, 16)), nullptr);
  EXPECT_EQ(reflected_map(assets.prepare(scene, 16, 16)), reflected_map(before));
}

TEST(Reflections, AreWithinOneLsbOfDoubleForEveryNormalDetail) {
  for (const char* detail : {R"("normals": "pixel", "height": "relief")", R"("bump_map": "relief")", R"("normal": "none")"}) {
    const std::string text = std::string(R"({"version": 1, "textures": {"relief": {"source": "moon_height", "width": 256}},
      "environments": {"sky": {"type": "day_sky", "size": 64}}, "background": {"type": "environment"},
      "objects": {"ball": {"color": 0.2, "reflection": 0.7, )") +
                             detail + "}}}";
    // The exceptions are pixels on silhouettes.
    EXPECT_LE(share_beyond_one_code<double>(SceneFile::parse(text, "test.json", ".").description(), 160, 100), 3e-3) << detail;
  }
}

// ---- files -------------------------------------------------------------------------------------------------------------

class EnvironmentFiles : public FolderTest {
 protected:
  static constexpr std::array<const char*, 6> kNames{"right", "left", "top", "bottom", "front", "back"};
  static constexpr std::array<glm::u8vec3, 6> kColors{{{255, 0, 0}, {0, 255, 0}, {0, 0, 255}, {255, 255, 0}, {255, 0, 255}, {0, 255, 255}}};

  void put_face(std::size_t f, int width, int height) const {
    Image<glm::u8vec4> image(width, height);
    std::fill_n(image.data(), width * height, glm::u8vec4(kColors[f], 255));
    write_png(directory / (std::string(kNames[f]) + ".png"), image);
  }
  void put_faces() const {
    for (std::size_t f = 0; f < 6; ++f) put_face(f, 4, 4);
  }
  std::vector<std::string> cube(std::vector<std::string> more = {}) const {
    std::vector<std::string> settings{"globe.type=cube", "globe.folder=" + directory.string(), "globe.rotation=0,0,0"};
    settings.insert(settings.end(), more.begin(), more.end());
    return settings;
  }
};

TEST_F(EnvironmentFiles, FacesAppearInTheDirectionOfTheirNames) {
  put_faces();
  const std::array<const char*, 6> targets{"1,0,0", "-1,0,0", "0,1,0", "0,-1,0", "0,0,-1", "0,0,1"};
  for (std::size_t f = 0; f < 6; ++f) {
    const Image<glm::u8vec4> image =
        picture_of(environment_with(cube({std::string("front.target=") + targets[f], "front.up=0.1,0.3,0.5", "front.fov=20"})), 8, 8);
    EXPECT_EQ(image.at(4, 4), glm::u8vec4(kColors[f], 255)) << kNames[f];
  }
  // After a rotation by 90°, the front face is on the left.
  const Image<glm::u8vec4> turned =
      picture_of(environment_with(cube({"globe.rotation=0,90,0", "front.target=-1,0,0", "front.fov=20"})), 8, 8);
  EXPECT_EQ(turned.at(4, 4), glm::u8vec4(kColors[4], 255));
}

TEST_F(EnvironmentFiles, FaceFilesTakePrecedenceOverTheFolder) {
  put_faces();
  std::filesystem::rename(directory / "front.png", directory / "other.png");
  EXPECT_TRUE(reports(error_of(cube()), "environments.globe: " + directory.string(), {"face front", "front.png"}));
  EXPECT_EQ(error_of(cube({"globe.front=" + (directory / "other.png").string()})), "(no error)");
}

TEST_F(EnvironmentFiles, ReportsErrorsInOneLine) {
  EXPECT_TRUE(reports(error_of({"globe.type=cube"}), "environments.globe", {"face right", "folder"}));
  EXPECT_TRUE(
      reports(error_of({"globe.type=cube", "globe.folder=/none"}), "environments.globe: /none", {"No such file or directory", "six"}));
  put_faces();
  const std::string bottom = "environments.globe: " + (directory / "bottom.png").string();
  put_face(3, 4, 5);
  EXPECT_TRUE(reports(error_of(cube()), bottom, {"4x5", "square"}));
  put_face(3, 8, 8);
  EXPECT_TRUE(reports(error_of(cube()), bottom + ": is 8x8, but " + (directory / "right.png").string() + " is 4x4;", {"same size"}));
  put_face(3, 4, 4);
  put_face(0, 8, 8);
  EXPECT_TRUE(reports(
      error_of(cube()),
      "environments.globe: " + (directory / "left.png").string() + ": is 4x4, but " + (directory / "right.png").string() + " is 8x8;",
      {"same size"}));
  put_face(0, 4, 4);
  put("left.jpg", "x");
  EXPECT_TRUE(reports(error_of(cube()), "environments.globe: " + directory.string(), {"two files", "face left"}));
  for (const std::string key : {"background.environment", "background.second"})
    EXPECT_TRUE(reports(error_of({key + "=glob"}), "scene environment: " + key, {"'glob'", "'globe'"}));
  EXPECT_TRUE(reports(input_error([] { SceneFile::parse(R"({"version": 1, "background": {"type": "environment"}})", "t.json", "."); }),
                      "t.json: background.type", {"environment"}));
}

TEST_F(EnvironmentFiles, PreservesValuesAboveOne) {
  Image<glm::vec4> bright(8, 4);
  std::fill_n(bright.data(), 32, glm::vec4(0.5f, 100.0f, 60000.0f, 1.0f));
  write_image(directory / "sky.exr", bright);
  const SceneDescription scene = environment_with({"globe.type=equirect", "globe.map=" + (directory / "sky.exr").string()});
  EXPECT_EQ(light_of(scene, 4, 4).at(2, 2), glm::vec4(0.5f, 100.0f, 60000.0f, 1.0f));
  std::fill_n(bright.data(), 32, glm::vec4(0.0f, 0.0f, 1e6f, 1.0f));
  write_image(directory / "sky.hdr", bright);
  const float blue = light_of(environment_with({"globe.type=equirect", "globe.map=" + (directory / "sky.hdr").string()}), 4, 4).at(2, 2).z;
  EXPECT_NEAR(blue, 1e6f, 1e6f / 256) << "values beyond the range of half are stored as floats";
}

// The faces of a skybox join without visible edges: across an edge, adjacent pixels differ at most twice as much as elsewhere.
TEST(EnvironmentScene, SkyBoxesHaveNoVisibleEdges) {
  for (const char* name : {"skybox_day", "skybox_night"}) {
    const std::filesystem::path folder = shared_data("sky") / name;
    if (!std::filesystem::exists(folder)) GTEST_SKIP() << absent(folder);
    const Workers workers(2);
    SceneAssets assets(workers);              // loads the files only once
    const auto steps_of = [&](double turn) {  // differences between adjacent columns in the middle of the image, summed over its rows
      const SceneDescription scene = environment_with(
          {"globe.type=cube", "globe.folder=" + folder.string(), "globe.rotation=0," + std::to_string(turn) + ",0", "front.fov=40"});
      const Image<glm::vec4> image = light_of(scene, 256, 256, assets, workers);
      std::vector<double> steps(60);
      for (std::size_t i = 0; i < 60; ++i) {
        const int x = 98 + static_cast<int>(i);
        for (int y = 0; y < 256; ++y) steps[i] += static_cast<double>(std::abs(image.at(x, y).y - image.at(x + 1, y).y));
      }
      return steps;
    };
    for (const double turn : {45.0, 135.0, 225.0, 315.0}) {  // an edge runs down the middle of the image
      const std::vector<double> steps = steps_of(turn);
      const double elsewhere = *std::max_element(steps.begin(), steps.begin() + 25);
      for (std::size_t i = 27; i < 32; ++i) EXPECT_LE(steps[i], 2.0 * elsewhere) << name << " " << turn;
    }
  }
}

}  // namespace
}  // namespace halfspace
