// SPDX-License-Identifier: Apache-2.0
//
// Compares images of particles with spheres, cones and Phong's formula, computed in double.
#include <cmath>

#include "halfspace/render/frame/frame.h"
#include "halfspace/render/prepared_scene.h"
#include "halfspace/render/scene_assets.h"
#include "halfspace/scene/scene_file.h"
#include "support/folder_test.h"

namespace halfspace {

namespace {

constexpr int kParticlesWidth = 640, kParticlesHeight = 360;
const double kTanY = std::tan(50.0 * std::acos(-1.0) / 180.0), kTanX = kTanY * kParticlesWidth / kParticlesHeight;

// Returns a scene of spheres with ambient light only. The camera is at the origin, looks along -z and has a vertical field of view of 100
// degrees.
SceneDescription scene_of(const std::filesystem::path& csv, const std::string& sprite, const std::string& more = "") {
  return SceneFile::parse(R"({ "version": 1, "ambient": 1,
      "cameras": { "main": { "position": [0, 0, 0], "target": [0, 0, -1], "fov": 100, "near": 0.1, "far": 100 } },
      "particles": { "sprite": ")" +
                              sprite + R"(", "file": ")" + csv.string() + "\" }" + more + "}",
                          "test", {})
      .description();
}

Image<glm::vec4> linear_picture_of(const SceneDescription& scene, int threads = 2, int width = kParticlesWidth,
                                   int height = kParticlesHeight) {
  const Workers workers(threads);
  SceneAssets assets(workers);
  Image<glm::vec4> image(width, height);
  render(assets.prepare(scene, width, height), image, workers);
  return image;
}

// Returns the depth along z at which the ray of a pixel enters a sphere, in double, or 0 if it misses. `squared` receives the square of the
// half chord, in radii.
double entry(const glm::dvec3& c, double r, int x, int row, double& squared) {
  const glm::dvec3 d((2 * (x + 0.5) / kParticlesWidth - 1) * kTanX, (1 - 2 * (row + 0.5) / kParticlesHeight) * kTanY, -1.0);
  const double a = glm::dot(d, d), b = glm::dot(d, c), discriminant = b * b - a * (glm::dot(c, c) - r * r);
  squared = discriminant / (a * r * r);
  return discriminant > 0.0 ? (b - std::sqrt(discriminant)) / a : 0.0;
}

class ParticlePictures : public FolderTest {};

// The original sprite is a circle whose size is computed at the center of the sphere. A distant sphere at the off-axis angle a projects to
// an ellipse whose major axis is 1/cos(a) times the diameter of that circle. The circle therefore misses a fraction 1 − cos(a) of the
// ellipse. For a near sphere, the center of the ellipse is also farther from the optical axis than the center of the circle, so the circle
// also covers pixels outside the ellipse.
TEST_F(ParticlePictures, SilhouetteErrorGrowsWithTheOffAxisAngle) {
  const struct {
    double degrees, min_wrong, max_wrong;  // wrong pixels of the original sprite, as a fraction of the sphere's pixels
  } cases[] = {{0, 0.0, 0.03}, {15, 0.034, 0.08}, {30, 0.134, 0.19}, {45, 0.293, 0.37}};
  for (const auto& c : cases) {
    const double angle = c.degrees * std::acos(-1.0) / 180.0, r = 0.5;
    const glm::dvec3 center = 3.0 * glm::dvec3(std::sin(angle), 0.0, -std::cos(angle));
    char row[200];
    std::snprintf(row, sizeof row, "%.17g,0,%.17g,%g\n", center.x, center.z, r);
    const std::filesystem::path csv = put("one.csv", row);
    const Image<glm::vec4> original = linear_picture_of(scene_of(csv, "original")), exact = linear_picture_of(scene_of(csv, "exact"));
    int inside = 0, original_wrong = 0, exact_wrong = 0;
    for (int y = 0; y < kParticlesHeight; ++y) {
      for (int x = 0; x < kParticlesWidth; ++x) {
        double squared = 0.0;
        const bool truth = entry(center, r, x, y, squared) > 0.0;
        inside += truth ? 1 : 0;
        original_wrong += (original.at(x, y).x > 0.0f) != truth ? 1 : 0;
        // The center is rounded to float, which moves the rim by about 1e-7 of the distance, or 1e-5 of the squared chord.
        if (std::fabs(squared) > 1e-5) exact_wrong += (exact.at(x, y).x > 0.0f) != truth ? 1 : 0;
      }
    }
    ASSERT_GT(inside, 1500);
    const double wrong = static_cast<double>(original_wrong) / inside;
    RecordProperty("original_wrong_at_" + std::to_string(static_cast<int>(c.degrees)), std::to_string(wrong));
    EXPECT_GE(wrong, c.min_wrong) << c.degrees;
    EXPECT_LE(wrong, c.max_wrong) << c.degrees;
    EXPECT_EQ(exact_wrong, 0) << c.degrees;
  }
}

// Intersecting spheres, some of them cut by the near plane. Each pixel must show the sphere that is nearest in double.
TEST_F(ParticlePictures, ExactSpheresIntersectCorrectly) {
  std::vector<std::pair<glm::dvec3, double>> spheres;
  std::string rows;
  for (int i = 0; i < 40; ++i) {
    const auto part = [&](int k) { return ((i * 37 + k * 101) % 97) / 97.0; };
    const bool near_one = i % 8 == 0;
    const double z = near_one ? 0.2 + 0.1 * part(0) : 2.0 + 2.0 * part(0), r = near_one ? 0.15 : 0.3 + 0.6 * part(1);
    const glm::dvec3 c(2.0 * kTanX * (part(2) - 0.5) * z * 0.9, 2.0 * kTanY * (part(3) - 0.5) * z * 0.9, -z);
    spheres.emplace_back(c, r);
    char row[200];
    std::snprintf(row, sizeof row, "%.17g,%.17g,%.17g,%.17g,%d,0,0\n", c.x, c.y, c.z, r, i + 1);
    rows += row;
  }
  const Image<glm::vec4> image = linear_picture_of(scene_of(put("many.csv", rows), "exact"));
  int compared = 0, shown = 0;
  for (int y = 0; y < kParticlesHeight; ++y) {
    for (int x = 0; x < kParticlesWidth; ++x) {
      double best = 1e9, second = 1e9;
      int id = 0;
      bool close_call = false;
      for (std::size_t i = 0; i < spheres.size(); ++i) {
        double squared = 0.0;
        const double t = entry(spheres[i].first, spheres[i].second, x, y, squared);
        close_call |= std::fabs(squared) < 1e-5 || std::fabs(t - 0.1) < 1e-6;
        if (t < 0.1) continue;
        second = std::min(second, std::max(t, best));
        if (t < best) {
          best = t;
          id = static_cast<int>(i) + 1;
        }
      }
      if (close_call || (id != 0 && second - best < 1e-5)) continue;  // float rounding of depths up to 4
      ++compared;
      shown += id != 0 ? 1 : 0;
      ASSERT_EQ(image.at(x, y).x, static_cast<float>(id)) << x << ' ' << y;
    }
  }
  EXPECT_GT(compared, kParticlesWidth * kParticlesHeight * 95 / 100);
  EXPECT_GT(shown, kParticlesWidth * kParticlesHeight / 4);
}

// A wall at z = -3 is in front of the center of a sphere, which is visible where its surface is nearer.
TEST_F(ParticlePictures, SpheresIntersectMeshes) {
  const glm::dvec3 center(0.7, 0.2, -3.4);
  const std::filesystem::path csv = put("one.csv", "0.7,0.2,-3.4,0.9,1,0,0\n");
  const Image<glm::vec4> image = linear_picture_of(scene_of(csv, "exact", R"(, "objects": { "wall": { "shape": "plane", "size": 60,
      "position": [0, 0, -3], "rotation": [90, 0, 0], "shading": "none", "color": [0, 1, 0] } })"));
  int red = 0;
  for (int y = 0; y < kParticlesHeight; ++y) {
    for (int x = 0; x < kParticlesWidth; ++x) {
      double squared = 0.0;
      const double t = entry(center, 0.9, x, y, squared);
      if (std::fabs(t - 3.0) < 1e-5) continue;  // float rounding of depths near 3
      const bool sphere = t > 0.0 && t < 3.0;
      red += sphere ? 1 : 0;
      ASSERT_EQ(image.at(x, y), sphere ? glm::vec4(1, 0, 0, 1) : glm::vec4(0, 1, 0, 1)) << x << ' ' << y;
    }
  }
  EXPECT_GT(red, 1000);
}

TEST(ParticlePicture, IsBitIdenticalForAnyThreadCount) {
  for (const char* sprite : {"original", "exact"}) {
    SceneFile file = SceneFile::open("particles");
    file.set(std::vector<std::string>{"particles.count=3000", "particles.arrangement=ball", std::string("particles.sprite=") + sprite});
    const Image<glm::vec4> one = linear_picture_of(file.description(), 1, 320, 180);
    for (const int threads : {2, 7}) {
      const Image<glm::vec4> image = linear_picture_of(file.description(), threads, 320, 180);
      for (int i = 0; i < 320 * 180; ++i) ASSERT_EQ(one.data()[i], image.data()[i]) << sprite << ' ' << threads << ": " << i;
    }
  }
}

// The original sprite has the depth of a cone, so a wall half a unit behind the center cuts the circle at half its radius, regardless of
// the radius.
TEST_F(ParticlePictures, OriginalSpritesHaveTheDepthOfACone) {
  const std::filesystem::path csv = put("one.csv", "0,0,-3,1.4,1,0,0\n");
  const Image<glm::vec4> image = linear_picture_of(scene_of(csv, "original", R"(, "objects": { "wall": { "shape": "plane", "size": 60,
      "position": [0, 0, -3.5], "rotation": [90, 0, 0], "shading": "none", "color": [0, 1, 0] } })"));
  const double radius = 0.5 * kParticlesWidth / kTanX * 1.4 / 3.0;
  int red = 0;
  for (int y = 0; y < kParticlesHeight; ++y) {
    for (int x = 0; x < kParticlesWidth; ++x) {
      const double from_middle = std::hypot(x + 0.5 - kParticlesWidth / 2, y + 0.5 - kParticlesHeight / 2) / radius;
      if (std::fabs(from_middle - 0.5) < 1e-3) continue;  // the square is snapped to 1/256 px and extends 70 px to each side
      red += from_middle < 0.5 ? 1 : 0;
      ASSERT_EQ(image.at(x, y), from_middle < 0.5 ? glm::vec4(1, 0, 0, 1) : glm::vec4(0, 1, 0, 1)) << x << ' ' << y;
    }
  }
  EXPECT_GT(red, 1000);
}

// Compares with Phong's formula in double, at the center of a sphere and at two other points. The light is to the right of and above the
// eye.
TEST_F(ParticlePictures, MatchPhongsFormula) {
  const std::filesystem::path csv = put("one.csv", "0,0,-3,1,0.5,0.25,1\n");
  const std::string light = R"(, "lights": { "lamp": { "type": "point", "position": [2, 1, 0], "color": [0.9, 0.8, 0.7] } })";
  const glm::dvec3 center(0, 0, -3), lamp(0.9, 0.8, 0.7), lamp_ws(2, 1, 0), own(0.5, 0.25, 1);
  // Radius of the original sprite. The image is 641 px wide so that a pixel is at the center.
  const double radius_px = 0.5 * 361 / kTanY / 3.0;
  for (const char* sprite : {"original", "exact"}) {
    const bool exact = std::string(sprite) == "exact";
    SceneDescription scene = scene_of(csv, sprite, light);
    scene.particles.ambient = Color{glm::dvec3(0.1)};
    scene.particles.specular = Color{glm::dvec3(0.4)};
    scene.particles.shininess = 5.0;
    const Image<glm::vec4> image = linear_picture_of(scene, 1, 641, 361);
    for (const glm::ivec2 px : {glm::ivec2(0, 0), glm::ivec2(12, 7), glm::ivec2(-20, -15)}) {  // offset from the center, y down
      // The original sprite evaluates light and view directions at its center.
      glm::dvec3 n(px.x / radius_px, -px.y / radius_px, 0), point = center;
      n.z = std::sqrt(1.0 - glm::dot(n, n));
      if (exact) {
        const glm::dvec3 d(px.x * 2 * kTanY / 361, -px.y * 2 * kTanY / 361, -1);
        const double a = glm::dot(d, d), b = glm::dot(d, center);
        point = d * ((b - std::sqrt(b * b - a * (9.0 - 1.0))) / a);
        n = point - center;
      }
      const glm::dvec3 l = glm::normalize(lamp_ws - point), v = glm::normalize(-point);
      const double n_l = glm::dot(n, l), r_v = glm::dot(2.0 * n_l * n - l, v);
      const glm::dvec3 expected =
          own * (0.1 + std::max(n_l, 0.0) * lamp) + (n_l > 0 ? 0.4 * std::pow(std::max(r_v, 0.0), 5.0) : 0.0) * lamp;
      const glm::vec4 seen = image.at(320 + px.x, 180 + px.y);
      // Float rounding. The square of the original sprite is snapped to 1/512 px, so its normals are off by twice that divided by its
      // radius, and its highlight by five times as much.
      const double tolerance = exact ? 5e-6 : 2.0 / 512 / radius_px * 7;
      for (int k = 0; k < 3; ++k) EXPECT_NEAR(static_cast<double>(seen[k]), expected[k], tolerance) << sprite << ' ' << px.x;
    }
  }
}

}  // namespace

}  // namespace halfspace
