// SPDX-License-Identifier: Apache-2.0
//
// Tests render_frame(): AOVs with closed forms, transparent backgrounds, crops and 16-bit pictures.
#include "halfspace/render/frame/frame.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "halfspace/core/srgb_curve.h"
#include "halfspace/render/scene_assets.h"
#include "halfspace/scene/scene_file.h"
#include "support/workers.h"

namespace halfspace {
namespace {

constexpr int kFrameWidth = 120, kFrameHeight = 80;

PreparedScene frame_scene(const std::string& sections, const std::string& camera = R"("position": [0, 0, 5], "fov": 60)") {
  static SceneAssets assets(two_workers());
  const std::string text = R"({"version": 1, "cameras": {"c": {)" + camera + R"(, "near": 0.25}}, )" + sections + "}";
  return assets.prepare(SceneFile::parse(text, "test", ".").description(), kFrameWidth, kFrameHeight);
}

template <class T>
Image<T> frame_image() {
  return Image<T>(kFrameWidth, kFrameHeight);
}

struct AllValues {
  Image<float> depth = frame_image<float>(), distance = frame_image<float>();
  Image<glm::vec3> normal = frame_image<glm::vec3>(), camera_normal = frame_image<glm::vec3>(), albedo = frame_image<glm::vec3>(),
                   position = frame_image<glm::vec3>(), barycentrics = frame_image<glm::vec3>();
  Image<glm::vec2> uv = frame_image<glm::vec2>();
  Image<uint32_t> object = frame_image<uint32_t>(), instance = frame_image<uint32_t>(), triangle = frame_image<uint32_t>();

  FrameImages images() {
    return {.depth = &depth,
            .distance = &distance,
            .normal = &normal,
            .camera_normal = &camera_normal,
            .albedo = &albedo,
            .position = &position,
            .uv = &uv,
            .object = &object,
            .instance = &instance,
            .triangle = &triangle,
            .barycentrics = &barycentrics};
  }
  friend bool operator==(const AllValues&, const AllValues&) = default;
};

AllValues values_of(const PreparedScene& scene, int threads = 2) {
  AllValues v;
  render_frame(scene, v.images(), Workers(threads));
  return v;
}

// A square of 4x4 that faces the camera at a distance of 5, shifted so that it covers only a part of the image.
constexpr const char* kWall = R"("objects": {"other": {"shape": "cube", "visible": false},
  "wall": {"shape": "plane", "size": 4, "rotation": [90, 0, 0], "position": [1, 0, 0], "color": [0.5, 0.25, 1], "two_sided": true}})";

TEST(Frame, ValuesOfAPlaneAreKnown) {
  const AllValues v = values_of(frame_scene(kWall));
  const double tan_y = std::tan(30.0 * 3.14159265358979324 / 180.0), tan_x = tan_y * kFrameWidth / kFrameHeight;
  int covered = 0;
  for (int y = 0; y < kFrameHeight; ++y) {
    for (int x = 0; x < kFrameWidth; ++x) {
      const glm::dvec3 p(5 * tan_x * ((x + 0.5) / kFrameWidth * 2 - 1), 5 * tan_y * (1 - (y + 0.5) / kFrameHeight * 2), 0);
      const double to_edge = std::min(2 - std::abs(p.x - 1), 2 - std::abs(p.y));
      if (std::abs(to_edge) < 0.01) continue;
      if (to_edge < 0) {
        ASSERT_EQ(v.depth.at(x, y), std::numeric_limits<float>::infinity());
        ASSERT_EQ(v.distance.at(x, y), std::numeric_limits<float>::infinity());
        ASSERT_EQ(v.object.at(x, y), 0xffffffffu);
        ASSERT_EQ(v.instance.at(x, y), 0xffffffffu);
        ASSERT_EQ(v.triangle.at(x, y), 0xffffffffu);
        ASSERT_EQ(v.normal.at(x, y), glm::vec3(0.0f));
        ASSERT_EQ(v.position.at(x, y), glm::vec3(0.0f));
        ASSERT_EQ(v.uv.at(x, y), glm::vec2(0.0f));
        ASSERT_EQ(v.barycentrics.at(x, y), glm::vec3(0.0f));
        continue;
      }
      ++covered;
      ASSERT_NEAR(v.depth.at(x, y), 5.0, 2e-6);
      ASSERT_NEAR(v.distance.at(x, y), std::sqrt(25 + glm::dot(p, p)), 2e-4);  // positions are exact to 1/512 px, which is 1.4e-4
      ASSERT_LE(glm::distance(glm::dvec3(v.position.at(x, y)), p), 2e-4);
      ASSERT_LE(glm::distance(v.normal.at(x, y), glm::vec3(0, 0, 1)), 1e-6f);
      ASSERT_LE(glm::distance(v.camera_normal.at(x, y), glm::vec3(0, 0, 1)), 1e-6f);
      ASSERT_EQ(v.albedo.at(x, y), glm::vec3(0.5f, 0.25f, 1.0f));
      ASSERT_EQ(v.object.at(x, y), 1u);
      ASSERT_EQ(v.instance.at(x, y), 0u);
      ASSERT_LE(glm::distance(glm::dvec2(v.uv.at(x, y)), glm::dvec2(p.x + 1, 2 - p.y) / 4.0), 1e-4);
    }
  }
  EXPECT_GT(covered, 2500);
  AllValues other;
  FrameImages images = other.images();
  images.background_depth = 0.0f;
  render_frame(frame_scene(kWall), images, two_workers());
  EXPECT_EQ(other.depth.at(0, 0), 0.0f);
}

TEST(Frame, OrthographicDistancesAreAlongTheAxis) {
  const AllValues v = values_of(frame_scene(kWall, R"("type": "orthographic", "position": [0, 0, 5], "height": 6)"));
  EXPECT_NEAR(v.depth.at(70, 40), 5.0f, 2e-6f);
  EXPECT_NEAR(v.distance.at(70, 40), 5.0f, 2e-6f);
  EXPECT_LE(glm::distance(v.position.at(70, 40), glm::vec3((70.5f - 60) / 80 * 6, (40 - 40.5f) / 80 * 6, 0)), 2e-4f);
}

// Uses every kind of shader for generated surfaces, exact spheres, particles and classic sprites.
constexpr const char* kMixed = R"("lights": {"l": {"direction": [1, 2, 3]}},
  "objects": {"a": {"shape": "uv_sphere", "position": [-2.2, 1, 0], "shading": "flat"},
              "b": {"shape": "sphere", "radius": 0.8, "instances": [{"position": [0, 1, 0]}, {"position": [2, 1, 0]}]},
              "c": {"shape": "cube", "position": [-2, -1, 0], "rotation": [0, 30, 0], "shading": "gouraud", "color": [0.2, 0.4, 0.6]}},
  "particles": {"count": 5, "orbit_radius": 1, "radius": 0.3, "sprite": "exact"})";

TEST(Frame, ValuesDoNotDependOnSamplesThreadsOrTheSelection) {
  const AllValues first = values_of(frame_scene(kMixed), 1);
  EXPECT_EQ(values_of(frame_scene(kMixed), 8), first);
  std::string with_samples = R"("samples": 4, )";
  with_samples += kMixed;  // for operator+, GCC 12 gives a wrong warning
  EXPECT_EQ(values_of(frame_scene(with_samples)), first);
  Image<float> depth = frame_image<float>();
  Image<uint32_t> instance = frame_image<uint32_t>();
  Image<glm::u8vec4> picture = frame_image<glm::u8vec4>(), alone = frame_image<glm::u8vec4>();
  const PreparedScene scene = frame_scene(kMixed);
  render_frame(scene, {.picture = &picture, .depth = &depth, .instance = &instance}, two_workers());
  EXPECT_EQ(depth, first.depth);
  EXPECT_EQ(instance, first.instance);
  render(scene, alone, two_workers());
  EXPECT_EQ(picture, alone);
}

TEST(Frame, NamesObjectsAndInstances) {
  const AllValues v = values_of(frame_scene(kMixed));
  std::set<std::pair<uint32_t, uint32_t>> seen;
  for (int y = 0; y < kFrameHeight; ++y) {
    for (int x = 0; x < kFrameWidth; ++x) seen.emplace(v.object.at(x, y), v.instance.at(x, y));
  }
  for (const auto& id : std::vector<std::pair<uint32_t, uint32_t>>{{0, 0}, {1, 0}, {1, 1}, {2, 0}, {kNoId, kNoId}})
    EXPECT_TRUE(seen.contains(id));
  EXPECT_TRUE(std::ranges::any_of(seen, [](const auto& id) { return id.first == 3 && id.second > 0 && id.second < 5; }));  // particles
}

// With flat shading, each face of a sphere has a constant normal, unlike the same sphere with smooth shading.
TEST(Frame, FlatSurfacesHaveTheNormalsOfTheirTriangles) {
  const auto normals_of_one_triangle = [](const char* shading) {
    const std::string ball = R"("shape": "uv_sphere", "latitudes": 8, "longitudes": 12, "scale": [2, 2, 2], "shading": )";
    const AllValues v = values_of(frame_scene(R"("objects": {"a": {)" + ball + '"' + shading + "\"}}"));
    float spread = 0.0f;
    const uint32_t triangle = v.triangle.at(60, 35);
    for (int y = 0; y < kFrameHeight; ++y) {
      for (int x = 0; x < kFrameWidth; ++x) {
        if (v.triangle.at(x, y) == triangle) spread = std::max(spread, glm::distance(v.normal.at(x, y), v.normal.at(60, 35)));
      }
    }
    return spread;
  };
  EXPECT_LE(normals_of_one_triangle("flat"), 1e-5f);
  EXPECT_GT(normals_of_one_triangle("phong"), 0.02f);
}

TEST(Frame, CropsEqualTheWhole) {
  const std::string post = R"("post": {"hdr": true, "auto_exposure": true, "dither": true}, )";
  for (const std::string& scene_text :
       {std::string(kMixed), R"("samples": 4, "background": {"type": "stars", "density": 1}, )" + std::string(kMixed), post + kMixed}) {
    const PreparedScene scene = frame_scene(scene_text);
    Image<glm::u8vec4> whole = frame_image<glm::u8vec4>(), part(37, 21);
    Image<glm::vec4> light = frame_image<glm::vec4>(), part_light(37, 21);
    Image<glm::vec3> normal = frame_image<glm::vec3>(), part_normal(37, 21);
    render_frame(scene, {.light = &light, .normal = &normal}, two_workers());
    const PassStatistics whole_statistics = render_frame(scene, {.picture = &whole}, two_workers());
    const ImageRect crop{41, 13, 37, 21};
    const PassStatistics statistics =
        render_frame(scene, {.picture = &part, .light = &part_light, .normal = &part_normal, .crop = crop}, two_workers());
    for (int y = 0; y < crop.height; ++y) {
      for (int x = 0; x < crop.width; ++x) {
        ASSERT_EQ(part.at(x, y), whole.at(crop.x + x, crop.y + y));
        ASSERT_EQ(part_light.at(x, y), light.at(crop.x + x, crop.y + y));
        ASSERT_EQ(part_normal.at(x, y), normal.at(crop.x + x, crop.y + y));
      }
    }
    // auto_exposure meters the whole view, so cropping does not reduce the number of fragments shaded for the picture.
    const uint64_t picture = scene.post.auto_exposure ? whole_statistics.fragments_shaded : 4u * 37u * 21u;
    EXPECT_LE(statistics.fragments_shaded, picture + 2u * 4u * 37u * 21u);
  }
}

// An opaque square and nothing else: alpha is the coverage of a pixel, and the color is that of the square wherever it is visible.
TEST(Frame, TransparentBackgroundsHaveStraightAlpha) {
  const std::string square =
      R"("objects": {"wall": {"shape": "plane", "size": 4, "rotation": [70, 0, 20], "shading": "none", "color": [0.5, 0.25, 1]}})";
  for (const char* post : {"", R"("post": {"hdr": true, "tone": "none"}, )"}) {
    const PreparedScene scene = frame_scene(std::string(post) + R"("samples": 4, "background": {"type": "transparent"}, )" + square);
    Image<glm::u8vec4> picture = frame_image<glm::u8vec4>();
    Image<glm::u16vec4> fine = frame_image<glm::u16vec4>();
    Image<glm::vec4> light = frame_image<glm::vec4>();
    render_frame(scene, {.picture = &picture, .fine_picture = &fine, .light = &light}, two_workers());
    std::set<int> alphas;
    for (int y = 0; y < kFrameHeight; ++y) {
      for (int x = 0; x < kFrameWidth; ++x) {
        const glm::vec4& c = light.at(x, y);
        const float quarters = c.w * 4;
        ASSERT_EQ(quarters, std::round(quarters));
        alphas.insert(static_cast<int>(quarters));
        ASSERT_EQ(picture.at(x, y).w, static_cast<uint8_t>(c.w * 255 + 0.5f));
        ASSERT_EQ(fine.at(x, y).w, static_cast<uint16_t>(c.w * 65535 + 0.5f));
        ASSERT_EQ(glm::vec3(c), c.w == 0 ? glm::vec3(0) : glm::vec3(0.5f, 0.25f, 1));
        if (c.w == 0) continue;
        ASSERT_EQ(picture.at(x, y).z, 255);
        ASSERT_EQ(picture.at(x, y).x, 188);  // 0.5 encoded in sRGB
        ASSERT_NEAR(fine.at(x, y).x, srgb_curve(0.5f) * 65535, 1.0);
        ASSERT_NEAR(fine.at(x, y).y, srgb_curve(0.25f) * 65535, 1.0);
      }
    }
    EXPECT_EQ(alphas, (std::set<int>{0, 1, 2, 3, 4}));
  }
}

TEST(Frame, SixteenBitsAgreeWithEight) {
  for (
      const char* post :
      {"", R"("post": {"hdr": true, "tone": "aces", "format": "rgba32f"}, )",
       R"("post": {"hdr": true, "auto_exposure": true, "encode": "gamma", "dither": false}, "background": {"color": [0.2, 0.3, 0.4]}, )"}) {
    const PreparedScene scene = frame_scene(std::string(post) + kMixed);
    Image<glm::u8vec4> picture = frame_image<glm::u8vec4>();
    Image<glm::u16vec4> fine = frame_image<glm::u16vec4>();
    render_frame(scene, {.picture = &picture, .fine_picture = &fine}, two_workers());
    int odd = 0;
    for (int y = 0; y < kFrameHeight; ++y) {
      for (int x = 0; x < kFrameWidth; ++x) {
        for (int k = 0; k < 4; ++k) {
          ASSERT_NEAR(fine.at(x, y)[k] / 257.0, picture.at(x, y)[k], 0.51);
          odd += fine.at(x, y)[k] % 257 != 0 ? 1 : 0;
        }
      }
    }
    EXPECT_GT(odd, 1000);  // there are more than 256 levels
  }
}

}  // namespace
}  // namespace halfspace
