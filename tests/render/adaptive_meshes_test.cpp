// SPDX-License-Identifier: Apache-2.0
//
// Spheres whose mesh adapts to the view (mesh_error). tests/geometry/adaptive_mesh_test.cpp tests the meshes themselves,
// tests/reference/max_error_test.cpp compares outlines.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <thread>

#include "halfspace/render/frame/frame.h"
#include "halfspace/render/scene_assets.h"
#include "halfspace/scene/scene_file.h"
#include "support/errors.h"
#include "support/workers.h"

namespace halfspace {
namespace {

using Settings = std::vector<std::string>;

// A moon with a radius of 1 and mountains of up to 0.01, seen from z = 3.
SceneDescription adaptive_moon(const Settings& settings) {
  SceneFile file = SceneFile::parse(R"({ "version": 1,
    "cameras": { "main": { "position": [0, 0, 3], "fov": 40 } },
    "lights": { "sun": { "type": "directional", "direction": [1, 0.2, 0.5] } },
    "textures": { "relief": { "source": "moon_height", "width": 512, "wrap_t": "clamp" } },
    "objects": { "moon": { "shape": "uv_sphere", "height": "relief", "height_scale": 0.02, "mesh_error": 0.1, "instances": [{}] } } })",
                                    "test", ".");
  file.set(settings);
  return file.at(0.0);
}

struct AdaptedMoon {
  std::size_t triangles;
  SimplifiedObject report;
  PreparedScene scene;
};

AdaptedMoon adapted_moon(const Settings& settings, int width = 320, int height = 180) {
  SceneAssets assets(two_workers());
  PreparedScene scene = assets.prepare(adaptive_moon(settings), width, height);
  return {scene.draws[0].indices->size() / 3, scene.simplified.at(0), std::move(scene)};
}

TEST(AdaptiveMeshes, DependOnTheAllowedErrorAndTheDistance) {
  const AdaptedMoon tenth = adapted_moon({});
  EXPECT_EQ(tenth.report.drawn, tenth.triangles);
  EXPECT_EQ(tenth.scene.meshes[0].indices, tenth.scene.draws[0].indices) << "shadows";
  EXPECT_LE(tenth.report.error_px, 0.1);
  EXPECT_LT(tenth.triangles, tenth.report.triangles / 4);
  EXPECT_GT(adapted_moon({"moon.mesh_error=0.025"}).triangles, 2 * tenth.triangles);
  EXPECT_LT(adapted_moon({"main.position=0,0,12"}).triangles, tenth.triangles / 4);
  EXPECT_GT(adapted_moon({}, 640, 360).triangles, 3 * tenth.triangles / 2);
}

TEST(AdaptiveMeshes, ReplaceTheRegularMesh) {
  SceneAssets assets(two_workers());
  const PreparedScene regular = assets.prepare(adaptive_moon({"moon.mesh_error=0"}), 320, 180);
  EXPECT_TRUE(regular.simplified.empty());
  EXPECT_EQ(regular.draws[0].indices->size(), 6u * 128 * 63);
  EXPECT_EQ(adapted_moon({"moon.latitudes=4", "moon.longitudes=8"}).triangles, adapted_moon({}).triangles);
}

TEST(AdaptiveMeshes, CopiesAreFineEnough) {
  const std::size_t one = adapted_moon({"main.position=0,0,12"}).triangles;
  const AdaptedMoon two = adapted_moon({"main.position=0,0,12", "moon.instances.0.position=0,0,9"});
  EXPECT_GT(two.triangles, 2 * one) << "the copy is seen from 3 radii";
  EXPECT_LE(two.report.error_px, 0.1);
}

// Returns the number of vertices on the far side.
std::ptrdiff_t far_side(const AdaptedMoon& m) {
  return std::ranges::count_if(m.scene.meshes[0].positions, [](const glm::vec3& p) { return p.z < -0.3f; });
}

// What is behind the horizon or outside of the view is coarse. It is finer if it can cast shadows.
TEST(AdaptiveMeshes, AreCoarseWhereNothingIsSeen) {
  const auto near_side = [](const AdaptedMoon& m) {
    const std::span<const glm::vec3> positions = m.scene.meshes[0].positions;
    return std::ranges::count_if(positions, [](const glm::vec3& p) { return p.z > 0.3f; });
  };
  const AdaptedMoon dark = adapted_moon({}), shaded = adapted_moon({"shadow.method=hard"});
  EXPECT_LT(4 * far_side(dark), near_side(dark));
  EXPECT_GT(far_side(shaded), far_side(dark));
  EXPECT_LT(far_side(shaded), near_side(shaded));
  EXPECT_EQ(near_side(dark), near_side(shaded));
  const AdaptedMoon away = adapted_moon({"main.target=0,0,9"});
  EXPECT_LE(away.triangles, 2u * 32 * 16);
  EXPECT_GT(far_side(adapted_moon({"moon.opacity=0.5"})), 2 * far_side(dark)) << "a translucent sphere hides nothing";
}

TEST(AdaptiveMeshes, SpheresWithoutReliefAdaptAsWell) {
  const AdaptedMoon smooth = adapted_moon({"moon.height=0"}), near = adapted_moon({"moon.height=0", "main.position=0,0,1.01"});
  EXPECT_LE(smooth.report.error_px, 0.1);
  EXPECT_LE(near.report.error_px, 0.1);
  EXPECT_GT(near.report.triangles, 16 * smooth.report.triangles) << "the finest part is near the eye";
  EXPECT_LT(near.triangles, near.report.triangles / 16);
}

// A landscape is coarse behind the eye.
TEST(AdaptiveMeshes, OtherShapesAdaptAsWell) {
  SceneFile file = SceneFile::parse(R"({ "version": 1, "ambient": 1,
    "cameras": { "main": { "position": [0, 0.3, 0], "target": [0, 0.1, -1], "fov": 40 } },
    "textures": { "relief": { "source": "rock_height", "width": 256 } },
    "objects": { "a": { "shape": "plane", "size": 2, "height": "relief", "height_scale": 0.1, "mesh_error": 0.5, "tiles_u": 3 } } })",
                                    "test", ".");
  SceneAssets assets(two_workers());
  const PreparedScene land = assets.prepare(file.at(0.0), 320, 180);
  EXPECT_LE(land.simplified.at(0).error_px, 0.5);
  EXPECT_LT(land.simplified[0].drawn, land.simplified[0].triangles / 4);
  const std::span<const glm::vec3> positions = land.meshes[0].positions;
  const auto behind = std::ranges::count_if(positions, [](const glm::vec3& p) { return p.z > 0.0f; });
  EXPECT_LT(4 * behind, std::ssize(positions));
  EXPECT_EQ(std::ranges::max(land.draws[0].source.streams.uvs, {}, &glm::vec2::x).x, 3.0f) << "tiles_u";
  for (const char* shape : {"torus", "torus_knot"}) {
    file.set(Settings{std::string("a.shape=") + shape, "a.height=0", "main.position=0,0,5"});
    const PreparedScene ring = assets.prepare(file.at(0.0), 320, 180);
    EXPECT_LE(ring.simplified.at(0).error_px, 0.5) << shape;
    EXPECT_LT(ring.simplified[0].drawn, ring.simplified[0].triangles) << shape;
  }
}

// The mesh of a view does not change because another view was drawn before, so that all processes make the same pictures.
TEST(AdaptiveMeshes, DoNotDependOnEarlierFrames) {
  SceneAssets used(two_workers());
  for (const char* setting : {"main.position=0,0,1.2", "main.position=0,0,8", "main.position=0,0,3", "moon.opacity=0.5",
                              "moon.casts_shadow=false", "main.type=orthographic", "moon.scale=1,2,1", "moon.mesh_error=1"}) {
    const PreparedScene scene = used.prepare(adaptive_moon({"shadow.method=hard", setting}), 160, 90);
    Image<glm::u8vec4> ours(160, 90), alone(160, 90);
    render(scene, ours, two_workers());
    const AdaptedMoon own = adapted_moon({"shadow.method=hard", setting}, 160, 90);
    render(own.scene, alone, Workers(5));
    EXPECT_EQ(scene.draws[0].indices->size(), 3 * own.triangles) << setting;
    EXPECT_EQ(ours, alone) << setting;
  }
}

// Copies of the assets share what has been measured, and may be used by several threads.
TEST(AdaptiveMeshes, ThreadsMayShareASurface) {
  SceneAssets first(two_workers());
  first.prepare(adaptive_moon({"main.position=0,0,4"}), 160, 90);
  std::array<std::size_t, 4> drawn{};
  std::vector<std::thread> threads;
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    threads.emplace_back([&, i] {
      const Workers workers(2);
      SceneAssets own(first, workers, {});
      drawn[i] = own.prepare(adaptive_moon({}), 160, 90).draws[0].indices->size();
    });
  }
  for (std::thread& t : threads) t.join();
  for (const std::size_t count : drawn) EXPECT_EQ(count, 3 * adapted_moon({}, 160, 90).triangles);
}

// Where the near plane cuts the front of a sphere off, its inside is seen.
TEST(AdaptiveMeshes, AreFineInsideOfASphereThatIsCut) {
  const Settings whole{"moon.two_sided=true"}, cut{"moon.two_sided=true", "main.near=3"};
  EXPECT_GT(far_side(adapted_moon(cut)), 2 * far_side(adapted_moon(whole)));
}

TEST(AdaptiveMeshes, LimitTheNumberOfCopies) {
  SceneDescription scene = adaptive_moon({});
  scene.objects[0].second.instances.resize(65);
  SceneAssets assets(two_workers());
  EXPECT_TRUE(reports(input_error([&] { assets.prepare(scene, 320, 180); }), "objects.moon.mesh_error: ", {"65 copies", "at most 64"}));
}

// The same view has the same mesh, so that shadow maps are kept.
TEST(AdaptiveMeshes, AreKeptWhileTheViewIsTheSame) {
  SceneAssets assets(two_workers());
  const auto mesh = [&](const Settings& settings) { return assets.prepare(adaptive_moon(settings), 160, 90).meshes[0].indices; };
  const auto first = mesh({});
  EXPECT_EQ(mesh({"sun.direction=0,1,1"}), first);
  EXPECT_NE(mesh({"main.position=0,0.01,3"}), first);
}

TEST(AdaptiveMeshes, AreChosenForAnAllowedErrorOnlyWhereShadingDoesNotDependOnThem) {
  const auto chosen = [](const Settings& settings, const AllowedError& allowed) {
    SceneAssets assets(two_workers());
    return assets.choose_within_error(adaptive_moon(settings), 160, 90, allowed).scene.objects[0].second;
  };
  EXPECT_EQ(chosen({"moon.mesh_error=0"}, {0.002, {}}).mesh_error, 0.002);
  EXPECT_EQ(chosen({}, {0.25, {}}).mesh_error, 0.0) << "a small regular mesh is enough";
  // The error of the scene is replaced also where a regular mesh is chosen.
  for (const char* setting : {"moon.normals=vertex", "moon.shading=gouraud", "moon.height=0", "main.target=0,0,9"})
    EXPECT_EQ(chosen({"moon.mesh_error=5", setting}, {0.002, {}}).mesh_error, 0.0) << setting;
  EXPECT_EQ(chosen({"moon.mesh_error=5"}, {0.002, 8.0}).mesh_error, 0.0);
  EXPECT_EQ(chosen({"moon.mesh_error=5", "moon.normal_lines=0.1"}, {0.002, {}}).mesh_error, 5.0) << "kept, like all such meshes";
}

}  // namespace
}  // namespace halfspace
