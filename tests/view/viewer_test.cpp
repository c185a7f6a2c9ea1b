// SPDX-License-Identifier: Apache-2.0
#include "view/viewer.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "halfspace/scene/scene_paths.h"
#include "view/enclosing_object.h"
#include "view/window_times.h"

namespace halfspace {
namespace {

Viewer viewer_of(const std::string& scene) { return Viewer({SceneFile::open(scene), {}, nullptr, {}}, 0.0); }

const CameraDescription& camera_of(const Viewer& viewer) {
  const SceneDescription& d = viewer.scene().description();
  return *find_named(d.cameras, d.head.camera);
}

TEST(Viewer, XResetsTheCameraAndThenSelectsTheNextOne) {
  Viewer viewer = viewer_of("earth");
  const glm::dvec3 original = camera_of(viewer).position;
  viewer.move(Action::left, 0.2);
  viewer.orbit(10, 5);
  EXPECT_NE(camera_of(viewer).position, original);
  viewer.press(Action::reset_camera);
  EXPECT_EQ(camera_of(viewer).position, original);
  EXPECT_EQ(viewer.scene().description().head.camera, "equator");
  viewer.press(Action::reset_camera);
  EXPECT_EQ(viewer.scene().description().head.camera, "inside");
  viewer.press(Action::reset_camera);
  viewer.press(Action::reset_camera);
  EXPECT_EQ(viewer.scene().description().head.camera, "equator");
}

TEST(Viewer, XNamesTheObjectThatTheCameraIsInside) {
  Viewer viewer = viewer_of("earth");
  viewer.press(Action::reset_camera);
  EXPECT_TRUE(viewer.message().starts_with("camera inside: inside of 'earth', whose inner side is not drawn;")) << viewer.message();
  viewer.press(Action::reset_camera);
  EXPECT_EQ(viewer.message(), "camera north");
}

TEST(EnclosingObject, SpheresAndCubesContainPoints) {
  const SceneFile file = SceneFile::parse(R"({ "version": 1, "objects": {
    "ball": { "shape": "sphere", "radius": 2, "position": [10, 0, 0] },
    "box": { "shape": "cube", "size": 2, "rotation": [0, 45, 0], "instances": [{}, { "position": [0, 5, 0], "scale": [3, 1, 1] }] },
    "hidden": { "shape": "uv_sphere", "radius": 50, "visible": false } } })",
                                          "test", {});
  const SceneDescription scene = file.at(0.0);
  const std::pair<glm::dvec3, const char*> cases[] = {
      {{11.9, 0, 0}, "ball"}, {{12.1, 0, 0}, ""},   {{0, 0.9, 0}, "box"},    {{1.3, 0, 0}, "box"}, {{0.9, 0, 0.9}, ""},
      {{0, 1.1, 0}, ""},      {{0, 5.9, 0}, "box"}, {{1.9, 5, -1.9}, "box"}, {{1.9, 5, 1.9}, ""},  {{0, -20, 0}, ""}};
  for (const auto& [point, name] : cases) EXPECT_EQ(enclosing_object(scene, point), name) << point.x << ' ' << point.y << ' ' << point.z;
}

TEST(Viewer, MovingAnAnimatedCameraAddsAFreeCamera) {
  SceneFile scene = SceneFile::open("earth");
  scene.merge(R"({"animations": {"fly": {"type": "rate", "target": "equator.position", "rate": [0, 1, 0]}}})", "test");
  Viewer viewer({scene, {}, nullptr, {}}, 0.0);
  viewer.advance(0.5);
  viewer.zoom(1.0);
  EXPECT_EQ(viewer.scene().description().head.camera, "free");
  EXPECT_EQ(camera_of(viewer).position, glm::dvec3(0, 1.05, 2.75)) << "it starts where the animation was";
  viewer.move(Action::forward, 0.1);
  EXPECT_EQ(viewer.scene().description().cameras.size(), 4u) << "there is only one free camera";
  viewer.press(Action::reset_camera);
  EXPECT_EQ(viewer.scene().description().head.camera, "equator");
  EXPECT_EQ(viewer.scene().description().cameras.size(), 3u);
}

// Two copies of a triangle with different units. The first camera is fitted to the model, and the second is inside of it.
TEST(Viewer, SpeedsScaleWithAModel) {
  for (const bool inside : {false, true}) {
    std::vector<double> fractions;  // of the radius of the model
    for (const double scale : {1.0, 2000.0}) {
      const std::filesystem::path file = std::filesystem::path(testing::TempDir()) / "halfspace_view_triangle.obj";
      std::ofstream(file) << fmt::format("v 0 0 0\nv {0} 0 0\nv 0 {0} {0}\nf 1 2 3\n", scale);
      ModelView view;
      view.inside = inside;
      Viewer viewer(open_scene_or_model(file.string(), view), 0.0);
      ASSERT_GT(viewer.opened().model_radius, 0.5 * scale);
      for (int i = 0; i < 2; ++i) {
        const glm::dvec3 before = camera_of(viewer).position;
        viewer.move(Action::right, 0.5);
        fractions.push_back(glm::distance(camera_of(viewer).position, before) / viewer.opened().model_radius);
        viewer.zoom(1000.0);
      }
    }
    EXPECT_GT(fractions[0], 0.1);
    EXPECT_NEAR(fractions[1], 0.03, 1e-9) << "the smallest speed, for half a second";
    // The camera is fitted to vertices in float.
    EXPECT_NEAR(fractions[2] / fractions[0], 1.0, 1e-5) << "inside " << inside;
    EXPECT_NEAR(fractions[3] / fractions[1], 1.0, 1e-5) << "inside " << inside;
  }
}

TEST(Viewer, TimeStopsWhilePaused) {
  Viewer viewer = viewer_of("earth");
  viewer.advance(0.5);
  EXPECT_TRUE(viewer.is_running());
  viewer.press(Action::pause);
  viewer.advance(0.5);
  EXPECT_EQ(viewer.seconds(), 0.5);
  EXPECT_FALSE(viewer.is_running());
  viewer.press(Action::pause);
  viewer.advance(0.25);
  EXPECT_EQ(viewer.seconds(), 0.75);
}

// While a history is open, the picked object changes to the one behind the hidden object, or to none.
TEST(Viewer, VShowsTheHiddenObjectAgain) {
  Viewer viewer = viewer_of("three-lights");
  const auto is_visible = [&](const char* name) { return find_named(viewer.scene().description().objects, name)->visible; };
  for (const char* behind : {"globe", ""}) {
    viewer.set_picked_object("cube");
    viewer.press(Action::toggle_visibility);
    EXPECT_FALSE(is_visible("cube"));
    viewer.set_picked_object(behind);
    viewer.press(Action::toggle_visibility);
    EXPECT_EQ(viewer.message(), "visible: cube");
    EXPECT_TRUE(is_visible("cube") && is_visible("globe"));
  }
  viewer.set_picked_object("cube");
  viewer.press(Action::toggle_visibility);
  viewer.clear_picked_object();  // the history is closed
  viewer.press(Action::toggle_visibility);
  EXPECT_FALSE(is_visible("cube") || is_visible("globe")) << "all objects are hidden";
}

TEST(Viewer, ASceneWithoutAnimationsDoesNotChangeWithTime) {
  Viewer viewer = viewer_of("three-lights");
  viewer.press(Action::pause);
  EXPECT_EQ(viewer.message(), "this scene has no animation");
  viewer.press(Action::pause);
  viewer.advance(1.0);
  EXPECT_FALSE(viewer.is_running());
  EXPECT_EQ(viewer.animation_seconds(), 0.0);
}

TEST(Viewer, ARejectedValueLeavesTheSceneUnchangedAndSetsTheMessage) {
  Viewer viewer = viewer_of("earth");
  viewer.set({"earth.shininess=abc"});
  EXPECT_NE(viewer.message().find("shininess"), std::string::npos);
  EXPECT_EQ(viewer.scene().print(), SceneFile::open("earth").print());
}

TEST(WindowTimes, AtRestTheWindowIsIdleAndHasNoFrameRate) {
  EXPECT_EQ(frame_rate_text({.frame = 40.0}, 30.0), "  40.0 ms per frame, 25.0 frames per second");
  EXPECT_EQ(frame_rate_text({.frame = 200.0, .interface = 2.0, .present = 1.5, .idle = true}, 30.0),
            "  33.5 ms for the last frame; idle: nothing changes");
}

TEST(Viewer, OverlaysCycleInBothDirections) {
  Viewer viewer = viewer_of("earth");
  viewer.press(Action::next_overlay);
  EXPECT_EQ(viewer.overlay(), Overlay::wireframe);
  viewer.press(Action::next_overlay, true);
  EXPECT_EQ(viewer.overlay(), Overlay::none);
  viewer.press(Action::next_overlay, true);
  viewer.press(Action::next_overlay);
  EXPECT_EQ(viewer.overlay(), Overlay::none);
}

}  // namespace
}  // namespace halfspace
