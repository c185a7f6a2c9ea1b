// SPDX-License-Identifier: Apache-2.0
#include "view/frame_maker.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "halfspace/render/frame/frame.h"
#include "halfspace/render/model_file/opened_scene.h"
#include "halfspace/render/scene_assets.h"
#include "support/workers.h"
#include "view/save_view.h"

namespace halfspace {
namespace {

// Two squares that face the camera. The rear one is larger and fills the picture.
constexpr const char* kSquares = R"({
  "version": 1, "camera": "front",
  "cameras": { "front": { "type": "orthographic", "height": 2, "position": [0, 0, 5], "near": 1, "far": 10 } },
  "textures": { "checks": { "source": "checkerboard", "width": 256 } },
  "objects": {
    "back": { "shape": "plane", "size": 4, "rotation": [90, 0, 0], "position": [0, 0, -1], "shading": "none", "color": "checks" },
    "front": { "shape": "plane", "size": 1, "rotation": [90, 0, 0], "shading": "none", "color": [1, 0, 0] }
  }
})";

constexpr int kSize = 128;

struct Frame {
  const Workers& workers = two_workers();
  FrameMaker maker{workers, {}};
  SceneFile scene = SceneFile::parse(kSquares, "test", {});
  Image<glm::u8vec4> picture{kSize, kSize};

  Frame() { maker.open({scene, {}, nullptr, {}}); }
  void render(Overlay overlay, int divisor = 1) { maker.render(scene.at(0.0), {.divisor = divisor}, overlay, picture); }
};

TEST(CoarseControl, FramesAreCoarseOnlyWhileSomethingMovesAndFramesAreLong) {
  CoarseControl control;
  EXPECT_EQ(control.divisor(true), 1) << "nothing is known yet";
  control.add_frame(1, 49.0);
  EXPECT_EQ(control.divisor(true), 1);
  control.add_frame(1, 150.0);
  EXPECT_EQ(control.divisor(true), 2);
  EXPECT_EQ(control.divisor(false), 1);
  control.add_frame(2, 45.0);
  EXPECT_EQ(control.divisor(true), 2);
  control.add_frame(2, 10.0);
  EXPECT_EQ(control.divisor(true), 1);
  control.add_frame(1, 5000.0);
  EXPECT_EQ(control.divisor(true), CoarseControl::kCoarsest);
}

TEST(FrameMaker, AFullFrameEqualsThePictureOfRender) {
  Frame frame;
  frame.render(Overlay::none);
  SceneAssets assets(frame.workers);
  Image<glm::u8vec4> expected(kSize, kSize);
  render(assets.prepare(frame.scene.at(0.0), kSize, kSize), expected, frame.workers);
  EXPECT_EQ(frame.picture, expected);
}

TEST(FrameMaker, ACoarseFrameHasEnlargedPixels) {
  Frame frame;
  frame.render(Overlay::none, 4);
  for (int y = 0; y < kSize; ++y) {
    for (int x = 0; x < kSize; ++x) ASSERT_EQ(frame.picture.at(x, y), frame.picture.at(x / 4 * 4, y / 4 * 4)) << x << ' ' << y;
  }
}

// The overlays that cover all pixels of an object equal those of a full frame, and so do the edges of triangles.
TEST(FrameMaker, OverlaysOfACoarseFrameHaveFullResolution) {
  Frame frame;
  for (const Overlay overlay : {Overlay::overdraw, Overlay::normals}) {
    frame.render(overlay);
    const Image<glm::u8vec4> full = frame.picture;
    frame.render(overlay, 4);
    EXPECT_EQ(frame.picture, full) << name_of(overlay);
  }
  frame.scene.set("cameras.front.height=16");
  frame.scene.set("samples=4");
  const auto edges = [&](int divisor) {
    frame.render(Overlay::wireframe, divisor);
    std::vector<bool> green;
    for (const glm::u8vec4& c : frame.picture.texels()) green.push_back(c.y > 240 && c.x < 120);
    return green;
  };
  EXPECT_EQ(edges(1), edges(4));
  frame.render(Overlay::tiles, 4);
  EXPECT_NE(frame.maker.overlay_text().find("32x32"), std::string::npos) << "the tiles of a full frame with 4 samples";
}

// The sky of the first frame is large. While only the camera moves, it is kept; when the Sun moves, the sky becomes small.
TEST(FrameMaker, OnlyASkyThatChangesIsSmall) {
  Frame frame;
  frame.scene = SceneFile::parse(R"({ "version": 1, "cameras": { "main": {} }, "environments": { "day": { "type": "day_sky" } },
    "background": { "type": "environment" } })",
                                 "test", {});
  frame.maker.open({frame.scene, {}, nullptr, {}});
  const FrameQuality coarse{.coarse_skies = true};
  const auto render = [&](const char* setting, const FrameQuality& quality) {
    frame.scene.set(setting);
    frame.maker.render(frame.scene.at(0.0), quality, Overlay::none, frame.picture);
    return frame.picture;
  };
  render("day.size=512", {});
  EXPECT_EQ(render("main.fov=50", coarse), render("main.fov=50", {})) << "the camera has moved";
  EXPECT_EQ(frame.maker.reduction_text(), "");
  const Image<glm::u8vec4> small = render("day.sun=1,0.5,0", coarse);
  EXPECT_EQ(frame.maker.reduction_text(), "reduced while moving: smaller sky");
  const Image<glm::u8vec4> full = render("day.sun=1,0.5,0", {});
  EXPECT_NE(small, full);
  EXPECT_EQ(frame.maker.reduction_text(), "");
  EXPECT_EQ(small, render("day.size=256", {})) << "a face has 256 texels";
}

TEST(FrameMaker, ACoarseFrameSaysSo) {
  Frame frame;
  frame.render(Overlay::none, 2);
  EXPECT_EQ(frame.maker.reduction_text(), "reduced while moving: 1/2 of the width and height, one sample, smaller shadow maps");
}

TEST(FrameMaker, ACoarseFrameHasSmallerShadowMaps) {
  Frame frame;
  frame.scene = SceneFile::open("shadow-plane");
  frame.maker.open({frame.scene, {}, nullptr, {}});
  const auto samples = [&](int divisor) {
    frame.render(Overlay::none, divisor);
    return frame.maker.statistics().samples_passed;
  };
  const uint64_t full = samples(1), coarse = samples(4);
  EXPECT_LT(coarse, full / 8) << "a quarter of the width and height, and some samples of primitives at edges";
  frame.scene.set(std::vector<std::string>{"shadow.resolution=256"});
  const uint64_t small = samples(1);
  EXPECT_GT(small, 256u * 256u / 2) << "a map is drawn";
  EXPECT_LT(samples(4), kSize * kSize) << "256 texels is the minimum, so the maps of the frame before are used again";
}

TEST(FrameMaker, OverdrawCountsTheSurfacesOfAPixel) {
  Frame frame;
  frame.render(Overlay::overdraw);
  EXPECT_EQ(frame.picture.at(4, 4), heat_color(1.0 / 8.0));
  EXPECT_EQ(frame.picture.at(kSize / 2, kSize / 2), heat_color(2.0 / 8.0));
}

TEST(FrameMaker, WireframeShowsEdgesAndKeepsTheRest) {
  Frame frame;
  frame.render(Overlay::none);
  const Image<glm::u8vec4> plain = frame.picture;
  frame.render(Overlay::wireframe);
  const auto is_green = [](const glm::u8vec4& c) { return c.y > 240 && c.x < 120; };
  int green = 0, other = 0;
  for (int y = 0; y < kSize; ++y) {
    for (int x = 0; x < kSize; ++x) {
      const glm::u8vec4 c = frame.picture.at(x, y);
      green += is_green(c);
      other += !is_green(c) && c != plain.at(x, y);
    }
  }
  EXPECT_GT(green, 4 * kSize / 2) << "the four edges of the small square, and the diagonals";
  EXPECT_EQ(other, 0);
}

// The renderer's tiles start at the lower left. The height is not a multiple of the tile size, so the tiles at the top are smaller.
TEST(FrameMaker, TilesAreThoseOfTheRenderer) {
  constexpr int kHeight = 100;
  constexpr glm::u8vec4 kWhite(255);
  Frame frame;
  frame.picture = Image<glm::u8vec4>(kSize, kHeight);
  frame.render(Overlay::tiles);
  for (int y = 0; y < kHeight; ++y) EXPECT_EQ(frame.picture.at(10, y) == kWhite, (kHeight - 1 - y) % 64 == 0) << y;
  for (int x = 0; x < kSize; ++x) EXPECT_EQ(frame.picture.at(x, 10) == kWhite, x % 64 == 0) << x;
  // One of the tiles overlaps both triangles of both squares.
  EXPECT_NE(frame.maker.overlay_text().find("64x64"), std::string::npos) << frame.maker.overlay_text();
  EXPECT_NE(frame.maker.overlay_text().find("largest 4"), std::string::npos) << frame.maker.overlay_text();
}

TEST(FrameMaker, MultisampledFramesHaveSmallerTiles) {
  Frame frame;
  frame.scene.set("samples=4");
  frame.render(Overlay::tiles);
  EXPECT_NE(frame.maker.overlay_text().find("32x32"), std::string::npos) << frame.maker.overlay_text();
}

TEST(FrameMaker, NormalsAreColors) {
  Frame frame;
  frame.render(Overlay::normals);
  EXPECT_EQ(frame.picture.at(4, 4), glm::u8vec4(128, 128, 255, 255)) << "both squares face +z";
}

// The large square is 256 pixels high and has a texture of 256 texels; at half the scale it selects level 1.
TEST(FrameMaker, MipLevelsFollowTheFootprint) {
  Frame frame;
  frame.scene.set("cameras.front.height=2");
  frame.render(Overlay::mip_levels);
  const glm::u8vec4 level0 = frame.picture.at(4, 4);
  EXPECT_GT(level0.x, level0.y) << "level 0 is red";
  EXPECT_EQ(frame.picture.at(kSize / 2, kSize / 2).x, frame.picture.at(kSize / 2, kSize / 2).y) << "no map: gray";
  frame.scene.set("cameras.front.height=16");
  frame.render(Overlay::mip_levels);
  const glm::u8vec4 level3 = frame.picture.at(52, 52);
  EXPECT_GT(level3.y, level3.x) << "level 3 is green";
}

TEST(FrameMaker, APickedPixelHasItsHistory) {
  Frame frame;
  frame.render(Overlay::none);
  const PickedPixel center = frame.maker.pick({kSize / 2, kSize / 2}, "squares");
  EXPECT_EQ(center.object, "front");
  EXPECT_TRUE(center.history.starts_with(fmt::format("squares, {0}x{0}, pixel {1},{1} ", kSize, kSize / 2))) << center.history;
  EXPECT_NE(center.history.find("2 fragments"), std::string::npos) << center.history;
  EXPECT_LT(center.history.find("1. back"), center.history.find("2. front")) << center.history;
  const glm::u8vec4 code = frame.picture.at(kSize / 2, kSize / 2);
  EXPECT_NE(center.history.find(fmt::format("{:>13}{:>13}{:>13}\n", code.x, code.y, code.z)), std::string::npos) << center.history;
  EXPECT_EQ(frame.maker.pick({0, 0}, "").object, "back");
}

TEST(FrameMaker, PickingLeavesTheFrameUnchanged) {
  Frame frame;
  frame.render(Overlay::none);
  const PickedPixel first = frame.maker.pick({10, 10}, "a");
  EXPECT_EQ(first.history, frame.maker.pick({10, 10}, "a").history);
}

TEST(SaveView, TheSavedSceneStartsAtTheTimeThatWasShown) {
  const SceneFile scene = SceneFile::open("day-night");
  for (const double seconds : {0.0, 3.25, 100.0}) {
    const SceneDescription saved = SceneFile::parse(scene_text_at(scene, seconds), "test", {}).at(0.0), shown = scene.at(seconds);
    // The time is divided by the length of a day, and later multiplied by it again.
    EXPECT_NEAR(saved.lights[0].second.direction.x, shown.lights[0].second.direction.x, 1e-12) << seconds;
    EXPECT_NEAR(saved.post.exposure, shown.post.exposure, 1e-12) << seconds;
  }
}

TEST(SaveView, ANegativeTimeIsRejected) {
  SceneFile scene = SceneFile::open("earth");
  scene.set("animation.speed=-1");
  EXPECT_THROW(scene_text_at(scene, 1.0), OutputError);
}

}  // namespace
}  // namespace halfspace
