// SPDX-License-Identifier: Apache-2.0
//
// Checks the choices of SceneAssets::choose_within_error rule by rule. tests/reference/max_error_test.cpp checks the accuracy of the
// resulting images.
#include "halfspace/render/error_budget/approximation_choice.h"

#include <gtest/gtest.h>

#include <map>

#include "halfspace/core/check.h"
#include "halfspace/render/prepared_scene.h"
#include "halfspace/render/scene_assets.h"
#include "halfspace/scene/scene_file.h"
#include "halfspace/scene/shapes.h"
#include "support/errors.h"

namespace halfspace {
namespace {

constexpr int kViewWidth = 640, kViewHeight = 360;

SceneWithinError chosen(const std::string& sections, const AllowedError& allowed) {
  static const Workers team(2);
  SceneAssets assets(team);
  const std::string text = R"({"version": 1, "cameras": {"c": {"position": [0, 0, 6], "fov": 40}}, )"
                           R"("lights": {"l": {"direction": [1, 1, 1]}}, )" +
                           sections + "}";
  return assets.choose_within_error(SceneFile::parse(text, "test", ".").description(), kViewWidth, kViewHeight, allowed);
}

std::map<std::string, std::string> choices(const std::string& sections, const AllowedError& allowed) {
  std::map<std::string, std::string> out;
  for (const ApproximationChoice& c : chosen(sections, allowed).choices) out[c.key] = c.value;
  return out;
}

const AllowedError kHalfPixel{0.5, std::nullopt};

// Makes a sphere require a mesh.
const std::string kMirror = R"("reflection": 0.1)";

std::string objects(const std::string& keys) { return R"("objects": {"a": {)" + keys + "}}"; }

// The chosen number of bands must have a chord error, in pixels, below the limit. The next smaller number must not.
TEST(ApproximationChoice, UsesTheFewestSufficientBands) {
  const SceneWithinError f = chosen(objects(R"("latitudes": 4, "longitudes": 8, )" + kMirror), kHalfPixel);
  const ObjectDescription& o = f.scene.objects.front().second;
  const View view = make_view(f.scene.cameras.front().second, kViewWidth, kViewHeight);
  const double per_unit = silhouette_pixels_per_unit(view, {0, 0, 0}, 1.0);
  EXPECT_LE(chord_error(o) * per_unit, 0.5);
  const int fewer = o.latitudes == part_step(o.latitudes * 3 / 4) ? o.latitudes / 2 : o.latitudes * 3 / 4;
  EXPECT_GT(chord_error(with_parts(o, fewer, false)) * per_unit, 0.5) << o.latitudes;
  EXPECT_EQ(f.choices.size(), 2u) << "only latitudes and longitudes change";
}

// The scale of a parent can turn a sphere into an ellipsoid, which is not ray-traced.
TEST(ApproximationChoice, KeepsTheMeshOfSpheresWithUnevenlyScaledParents) {
  const auto shape_with = [](const std::string& scale) {
    const std::string objects = R"("objects": {"b": {"shape": "cube", "scale": )" + scale + R"(}, "m": {"parent": "b", "shape": "cube"},
                                   "a": {"shape": "uv_sphere", "parent": "m"}})";
    return chosen(objects, kHalfPixel).scene.objects[2].second.shape;
  };
  EXPECT_EQ(shape_with("[1, 2, 1]"), Shape::uv_sphere);
  EXPECT_EQ(shape_with("[2, 2, 2]"), Shape::sphere);
}

TEST(ApproximationChoice, KeepsIntendedSettings) {
  EXPECT_TRUE(choices(objects(R"("normal_lines": 0.1, "latitudes": 99, "longitudes": 200)"), kHalfPixel).empty()) << "a line per vertex";
  EXPECT_TRUE(choices(objects(R"("shading": "flat", "latitudes": 5, "longitudes": 7)"), kHalfPixel).empty()) << "facets are intended";
  EXPECT_TRUE(choices(objects(R"("shading": "gouraud", "latitudes": 99, "longitudes": 200)"), kHalfPixel).empty())
      << "per-vertex lighting depends on the mesh";
  const std::string hills = R"("textures": {"h": {"source": "hills_height"}}, )";
  EXPECT_TRUE(choices(hills + objects(R"("shape": "plane", "segments": 512, "height": "h", "height_scale": 0.1)"), kHalfPixel).empty())
      << "normals follow from the displacement";
}

TEST(ApproximationChoice, UsesTheCoarsestMeshForFlatOrInvisibleObjects) {
  EXPECT_EQ(choices(objects(R"("shape": "cube", "segments": 9)"), kHalfPixel).at("objects.a.segments"), "1");
  EXPECT_EQ(choices(objects(R"("position": [90, 0, 0], )" + kMirror), kHalfPixel).at("objects.a.latitudes"), "8");
  EXPECT_EQ(
      choices(objects(R"("position": [90, 0, 0], )" + kMirror) + R"(, "shadow": {"method": "pcf3"})", kHalfPixel).at("objects.a.latitudes"),
      "8")
      << "the size of its shadow in pixels is unknown";
}

TEST(ApproximationChoice, SampleCountFollowsTheAllowedEdgeError) {
  for (const auto& [px, samples] : {std::pair(1.0, 1), {0.5, 1}, {0.49, 2}, {0.3, 4}, {0.18, 8}, {0.05, 8}})
    EXPECT_EQ(chosen(objects(""), {px, std::nullopt}).scene.head.samples, samples) << px;
  EXPECT_EQ(chosen(R"("samples": 8, )" + objects(""), kHalfPixel).scene.head.samples, 1);
}

TEST(ApproximationChoice, SpritesAreExactWhereCirclesAreInaccurate) {
  const std::string sphere = R"("particles": {"count": 1, "arrangement": "grid", "radius": 0.5})";
  EXPECT_TRUE(choices(sphere, {3.0, std::nullopt}).empty()) << "circles are accurate near the center of the image";
  EXPECT_EQ(choices(sphere, {0.1, std::nullopt}).at("particles.sprite"), "exact");
}

TEST(ApproximationChoice, PlainSpheresAreRayTraced) {
  for (const AllowedError& allowed : {kHalfPixel, AllowedError{std::nullopt, 4.0}}) {
    const auto shape = [&](const std::string& keys) { return choices(objects(keys), allowed).contains("objects.a.shape"); };
    EXPECT_TRUE(shape(R"("color": [1, 0, 0], "specular": 0.5, "scale": [2, -2, 2])"));
    EXPECT_TRUE(shape(R"("shape": "icosphere", "instances": [{"scale": [2, 2, 2]}])"));
    EXPECT_FALSE(shape(R"("shape": "torus")"));
    EXPECT_FALSE(shape(R"("shape": "sphere")")) << "already a sphere";
    EXPECT_FALSE(shape(kMirror));
    EXPECT_FALSE(shape(R"("shading": "gouraud", "longitudes": 8)"));
    EXPECT_FALSE(shape(R"("scale": [1, 2, 1])"));
    EXPECT_FALSE(shape(R"("instances": [{"scale": [2, 2, 1]}])"));
  }
}

TEST(ApproximationChoice, GouraudIsChosenForDiffuseDirectionalLight) {
  const AllowedError colors{std::nullopt, 16.0};
  const auto shading = [&](const std::string& keys) { return choices(objects(keys), colors).contains("objects.a.shading"); };
  EXPECT_TRUE(shading(R"("shape": "cube")"));
  EXPECT_FALSE(shading(R"("shape": "cube", "specular": 0.5)"));
  EXPECT_FALSE(shading(R"("position": [0, 0, -300])")) << "more vertices than pixels";
}

TEST(ApproximationChoice, FiltersAndFormatsFollowTheAllowedColorError) {
  const std::string scene =
      R"("textures": {"t": {"source": "checkerboard", "anisotropy": 4}}, "post": {"hdr": true, "format": "rgba32f"}, )" +
      objects(R"("shape": "plane", "color": "t")");
  EXPECT_EQ(choices(scene, {std::nullopt, 4.0}).at("textures.t.anisotropy"), "16");
  EXPECT_EQ(choices(scene, {std::nullopt, 200.0}).at("textures.t.anisotropy"), "1");
  EXPECT_EQ(choices(scene, {std::nullopt, 4.0}).at("post.format"), "rgba16f");
}

TEST(ApproximationChoice, ReportsScenesThatAreTooLarge) {
  std::string copies;
  for (int i = 0; i < 3000; ++i) copies += R"({"position": [0, 0, 0]},)";
  copies.pop_back();
  const std::string error = input_error([&] { chosen(objects(kMirror + R"(, "instances": [)" + copies + "]"), {0.01, std::nullopt}); });
  EXPECT_TRUE(reports(error, "the cheapest model: objects", {"vertices"}));
}

}  // namespace
}  // namespace halfspace
