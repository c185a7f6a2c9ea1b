// SPDX-License-Identifier: Apache-2.0
//
// Nothing in front of an eye that is inside of a scene or close to it vanishes, whatever the size of the scene.
#include <cmath>
#include <fstream>
#include <functional>

#include "cli/cli_run.h"
#include "halfspace/image/image_io.h"

namespace halfspace {
namespace {

class NearPlaneCli : public Cli {
 protected:
  void write(const std::string& name, const std::string& text) const { std::ofstream(directory / name) << text; }

  // Renders 200x200 pixels with a field of view of 60 degrees and returns the number of red ones.
  int red_pixels(const std::vector<std::string>& words) const {
    std::vector<std::string> all{"render"};
    all.insert(all.end(), words.begin(), words.end());
    all.insert(all.end(), {"--size", "200x200", "-o", "a.png"});
    const Outcome o = run(all);
    EXPECT_EQ(o.exit_code, 0) << o.err;
    const Image<glm::u8vec4> picture = read_image(directory / "a.png");
    int n = 0;
    for (const glm::u8vec4& c : picture.texels()) n += c.x > c.y + 30 ? 1 : 0;  // includes edges that are at least half red
    return n;
  }

  // A square of ground and a red square of 0.1 x 2.5 units that faces the eye at z = 0.05.
  static std::string street(double half) {
    const std::string s = std::to_string(half);
    return "mtllib m.mtl\nv -" + s + " 0 -" + s + "\nv -" + s + " 0 " + s + "\nv " + s + " 0 " + s + "\nv " + s + " 0 -" + s +
           "\nusemtl ground\nf 1 2 3 4\nv -0.05 0 0.05\nv 0.05 0 0.05\nv 0.05 2.5 0.05\nv -0.05 2.5 0.05\nusemtl post\nf 5 6 7 8\n";
  }
};

// The post has a width of 0.1 and is 0.1 in front of the eye: |x| < 0.05 / (0.1 · tan 30°) · 100 = 86.6 px, which are 174 columns.
constexpr int kPostPixels = 174 * 200;

TEST_F(NearPlaneCli, TheEyeCanBeCloseToASurfaceInAModelOfAnySize) {
  write("m.mtl", "newmtl ground\nKd 0.2 0.2 0.2\nnewmtl post\nKd 1 0 0\n");
  for (const double half : {2.0, 200.0, 5e4}) {
    write("street.obj", street(half));
    const std::vector<std::string> view{"street.obj", "--eye", "0,1.6,0.15", "--fov", "60", "--no-floor"};
    for (const std::vector<std::string>& more : {std::vector<std::string>{"--look-at", "0,1.6,0"}, {"--look-at", "0,1.6,-300"}}) {
      std::vector<std::string> words = view;
      words.insert(words.end(), more.begin(), more.end());
      EXPECT_EQ(red_pixels(words), kPostPixels) << half;
    }
  }
}

// Near the edge of a wide view, the depth of a point is much smaller than its distance.
TEST_F(NearPlaneCli, NothingAtTheEdgeOfAWideViewVanishes) {
  write("m.mtl", "newmtl m\nKd 1 0 0\n");
  write("wall.obj", "mtllib m.mtl\nusemtl m\nv 1 -1 -1\nv 1 -1 1\nv 1 1 1\nv 1 1 -1\nf 1 4 3 2\n");
  const auto red = [&](const std::string& eye, const std::string& target) {
    return red_pixels({"wall.obj", "--eye", eye, "--look-at", target, "--fov", "170", "--no-floor"});
  };
  // From (-4, 0, 0) the wall is 5 units away. Seen along z, it is at x/z > 5: from a distance of 5 it spans z = 0 to 1, and
  // tan 85° = 11.43 shows z > 5/11.43. It covers the columns x/z from 5 to 11.43, and |y/z| < 1/z there, but only in front of the eye.
  // In columns u px from the center, its half height is u/5 px: (100² − 43.7²) / 5 = 1617 px. The edges are 250 px long.
  EXPECT_NEAR(red("-4,0,0", "-4,0,9"), 1617, 60);
}

TEST_F(NearPlaneCli, ACameraOfASceneNeedsNoNearPlane) {
  const auto scene = [](const std::string& near) {
    return R"({"version": 1, "ambient": 1, "cameras": {"c": {"position": [0, 0, 0.001], "fov": 60, "far": 100000)" + near +
           R"(}}, "objects": {"a": {"shape": "plane", "size": 2, "rotation": [90, 0, 0], "color": "#ff0000", "shading": "none"}}})";
  };
  write("none.json", scene(""));
  write("zero.json", scene(R"(, "near": 0)"));
  write("given.json", scene(R"(, "near": 0.1)"));
  EXPECT_EQ(red_pixels({"none.json"}), 200 * 200);
  EXPECT_EQ(red_pixels({"zero.json"}), 200 * 200);
  EXPECT_EQ(red_pixels({"given.json"}), 0) << "a given near plane cuts off what is nearer";
}

// A plain of 100 km, seen from a height of 2 m: the distance of each row has a closed form.
TEST_F(NearPlaneCli, TheDepthOfATerrainOf100KilometersIsWithinOnePercent) {
  write("plain.obj", "v -50000 0 -50000\nv -50000 0 50000\nv 50000 0 50000\nv 50000 0 -50000\nf 1 2 3 4\n");
  const Outcome o = run({"render", "plain.obj", "--eye", "0,2,0", "--look-at", "0,2,-1", "--fov", "60", "--no-floor", "--size", "200x200",
                         "--crop", "0,100,200,100", "--aov", "depth", "--aov-separate", "-o", "a.png"});
  ASSERT_EQ(o.exit_code, 0) << o.err;
  const Image<float> depth = read_gray(directory / "a-depth.exr");
  // The scene has units of 10 km or so, because the model is large; the ratio is that of the last row.
  const double last = (2.0 * 199.5 / 200.0 - 1.0) * static_cast<double>(depth.at(100, 99));
  for (int row = 101; row < 200; ++row) {
    const double slope = 2.0 * (row + 0.5) / 200.0 - 1.0;
    // Snapping to 1/256 px moves the plain by up to 1/256 row. Interpolated positions have an error of up to 3e-7 of the largest coordinate
    // (raster/shade/plane_anchor.h), which is 15 mm of at least 3.4 m, here and in the last row.
    EXPECT_NEAR(static_cast<double>(depth.at(100, row - 100)) * slope / last, 1.0, 1.0 / 256.0 / (row - 99.5) + 2 * 0.015 / 3.4) << row;
  }
}

}  // namespace
}  // namespace halfspace
