// SPDX-License-Identifier: Apache-2.0
//
// Runs every program in apps/examples and checks pixels whose expected values follow from its source.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "halfspace/core/image.h"
#include "halfspace/core/srgb.h"
#include "halfspace/image/image_io.h"
#include "support/files.h"
#include "support/program.h"
#include "support/temporary_folder.h"

namespace halfspace {
namespace {

using Picture = Image<glm::u8vec4>;

// Runs example-NAME and returns the image it writes.
Picture run_example(const std::string& name) {
  const TemporaryFolder folder;
  const std::filesystem::path out = folder.path() / (name + ".png");
  const std::string command =
      std::string(HALFSPACE_EXAMPLES_DIR) + "/example-" + name + " '" + out.string() + "' > '" + out.string() + ".txt'";
  EXPECT_EQ(std::system(command.c_str()), 0) << command;
  return read_image(out);
}

uint8_t srgb(float linear) { return static_cast<uint8_t>(linear_to_srgb(linear)); }

// Returns the share of pixels for which is_one returns true.
template <class F>
double share(const Picture& picture, F is_one) {
  std::size_t n = 0;
  for (const glm::u8vec4& c : picture.texels()) n += is_one(c) ? 1 : 0;
  return static_cast<double>(n) / static_cast<double>(picture.texels().size());
}

TEST(Examples, TriangleInterpolatesColors) {
  const Picture p = run_example("triangle");
  ASSERT_EQ(p.width(), 640);
  EXPECT_EQ(p.at(0, 0), glm::u8vec4(srgb(0.01f), srgb(0.01f), srgb(0.02f), 255));
  // The center of pixel (320, 240) is (1/640, -1/480) in NDC. The weights of red, green and blue there are 1/4, 1/4 and 1/2 to within
  // 0.003, which is at most 2/255 after sRGB encoding.
  const glm::u8vec4 c = p.at(320, 240);
  EXPECT_NEAR(c.x, srgb(0.25f), 2);
  EXPECT_NEAR(c.y, srgb(0.25f), 2);
  EXPECT_NEAR(c.z, srgb(0.5f), 2);
}

TEST(Examples, TexturedCubeShowsBothColorsEqually) {
  const Picture p = run_example("textured_cube");
  EXPECT_EQ(p.at(0, 0), glm::u8vec4(0));
  const auto is_bright = [](const glm::u8vec4& c) { return c == glm::u8vec4(230, 180, 60, 255); };
  const auto is_dark = [](const glm::u8vec4& c) { return c == glm::u8vec4(40, 60, 120, 255); };
  // The two colors cover equal parts of each face; the remaining pixels of the cube are blends of both, due to filtering.
  EXPECT_GT(share(p, is_bright), 0.05);
  EXPECT_NEAR(share(p, is_bright), share(p, is_dark), 0.01);
}

TEST(Examples, OwnShaderDiscardsAndUsesFlatVaryings) {
  const Picture p = run_example("own_shader");
  EXPECT_EQ(p.at(10, 240).w, 0);  // |x| > 0.9 is discarded
  EXPECT_EQ(p.at(30, 240).w, 255);
  // The quad's two triangles differ in the flat varying by a factor of 1/2. Pixels mirrored across the diagonal from the lower left to the
  // upper right have the same distance from the center.
  const glm::u8vec4 lower = p.at(300, 400), upper = p.at(479 - 400, 479 - 300);
  EXPECT_NEAR(srgb_to_linear<float>(int32_t{lower.x}) * 2.0f, srgb_to_linear<float>(int32_t{upper.x}), 0.01f);  // 2/255 in sRGB
}

TEST(Examples, RenderToTextureReadsAllLevels) {
  const Picture p = run_example("render_to_texture");
  // At the center of the disk, all four levels contain (4, 2, 1), which the Reinhard operator maps to 4/5, 2/3 and 1/2. Far from the disk
  // they contain 0. The disk is in the upper left, 0.35 from the left edge and 0.3 from the top, so that a flip would move it.
  EXPECT_EQ(p.at(90, 77), glm::u8vec4(srgb(0.8f), srgb(2.0f / 3.0f), srgb(0.5f), 255));
  for (const auto& [x, y] : {std::pair(90, 255 - 77), {255 - 90, 77}, {255 - 90, 255 - 77}, {2, 2}})
    EXPECT_EQ(p.at(x, y), glm::u8vec4(0, 0, 0, 255)) << x << ' ' << y;
}

TEST(Examples, ShadowMapDarkensTheGround) {
  const Picture p = run_example("shadow_map");
  // The ground's normal is (0, 1, 0), and its cosine with the light direction is 4/sqrt(29). In shadow, 0.2 of the color remains.
  const auto code = [](float color, float light) { return int{srgb(color * light)}; };
  const float lit = 0.8f * 4.0f / std::sqrt(29.0f) + 0.2f;
  const auto is_near = [&](const glm::u8vec4& c, float light) {  // within 1/255, because the normal is rounded
    return std::abs(c.x - code(0.7f, light)) <= 1 && std::abs(c.y - code(0.65f, light)) <= 1 && std::abs(c.z - code(0.6f, light)) <= 1;
  };
  EXPECT_GT(share(p, [&](const glm::u8vec4& c) { return is_near(c, lit); }), 0.3);
  EXPECT_GT(share(p, [&](const glm::u8vec4& c) { return is_near(c, 0.2f); }), 0.02);
  EXPECT_GT(share(p, [](const glm::u8vec4& c) { return c == glm::u8vec4(0); }), 0.05) << "share of the background";
}

TEST(Examples, InstancesCoverTheImage) {
  const Picture p = run_example("instances");
  EXPECT_EQ(p.at(320, 10), glm::u8vec4(0));
  EXPECT_GT(share(p, [](const glm::u8vec4& c) { return c.w == 255; }), 0.2);
}

TEST(Examples, MsaaSmoothsEdges) {
  const Picture p = run_example("msaa");
  const auto grays = [&](int x0) {
    int n = 0;
    for (int y = 0; y < 256; ++y)
      for (int x = x0; x < x0 + 256; ++x) n += p.at(x, y).x != 0 && p.at(x, y).x != 255 ? 1 : 0;
    return n;
  };
  EXPECT_EQ(grays(0), 0);      // one sample: fully inside or outside
  EXPECT_GT(grays(256), 500);  // four samples: edge pixels are partially covered
}

TEST(Examples, ReadDepthShowsDistances) {
  const Picture p = run_example("read_depth");
  EXPECT_EQ(p.at(2, 2).x, 0);        // the far plane
  EXPECT_EQ(p.at(128, 128).x, 255);  // the front of the sphere, 3 units away
  // At the silhouette the distance is between 3.5 and 4 units, slightly less than at the center of the sphere.
  EXPECT_NEAR(p.at(128, 66).x, 255.0 * (4.0 - 3.33), 40.0);
}

TEST(Examples, NormalsLeaveTheBallAtItsCorners) {
  const Picture p = run_example("normals");
  // The lines start on the ball, whose silhouette is 0.30 of the picture from its center, and end 1.3 times as far away.
  const auto drawn_between = [&](double low, double high) {
    int n = 0;
    for (int y = 0; y < 480; ++y) {
      for (int x = 0; x < 480; ++x) {
        const double r = std::hypot(x - 239.5, y - 239.5) / 480.0;
        n += r >= low && r < high && p.at(x, y).w != 0 ? 1 : 0;
      }
    }
    return n;
  };
  EXPECT_GT(drawn_between(0.0, 0.33), 1500);
  EXPECT_GT(drawn_between(0.36, 0.40), 100);
  EXPECT_EQ(drawn_between(0.48, 1.0), 0);
}

TEST(Examples, CurvedPatchIsRoundAndPassesThroughItsCorners) {
  const Picture p = run_example("curved_patch");
  EXPECT_GT(share(p, [](const glm::u8vec4& c) { return c.w == 255; }), 0.2);
  // Blue and red are the coordinates in the patch. Both reach from 0 to 1.
  EXPECT_GT(share(p, [](const glm::u8vec4& c) { return c.x > 240 && c.w == 255; }), 0.003);
  EXPECT_GT(share(p, [](const glm::u8vec4& c) { return c.x < 100 && c.w == 255; }), 0.003);
  EXPECT_GT(share(p, [](const glm::u8vec4& c) { return c.z > 240 && c.w == 255; }), 0.003);
}

TEST(Examples, SkinOnceDrawsTwelveEqualShapes) {
  const Picture p = run_example("skin_once");
  // The shapes are 0.5 of the view apart, which are 120 px, and 0.65 of it, which are 156 px.
  for (int y = 0; y < 480; ++y) {
    for (int x = 0; x + 120 < 470; ++x) ASSERT_EQ(p.at(x, y), p.at(x + 120, y)) << x << ' ' << y;
  }
  for (int y = 0; y + 156 < 480; ++y) {
    for (int x = 0; x < 480; ++x) ASSERT_EQ(p.at(x, y), p.at(x, y + 156)) << x << ' ' << y;
  }
  EXPECT_GT(share(p, [](const glm::u8vec4& c) { return c.w == 255; }), 0.3);
}

// In the shadow, and on the sides that face away from the light, there is only the ambient light of 0.02, which has the code 39.
TEST(Examples, ShadowCubeShadesTheFloorBehindTheCube) {
  const Picture p = run_example("shadow_cube");
  const auto is_ambient = [](const glm::u8vec4& c) { return c == glm::u8vec4(39, 39, 39, 255); };
  EXPECT_TRUE(is_ambient(p.at(130, 245)));
  EXPECT_TRUE(is_ambient(p.at(190, 270)));
  EXPECT_GT(p.at(390, 250).x, 170);  // the floor next to the light
  EXPECT_GT(p.at(250, 200).x, 120);  // the top of the cube
}

TEST(Examples, CustomResolveAveragesToneMappedSamples) {
  const Picture p = run_example("custom_resolve");
  // A fully covered sample has the tone 40 / 41. The mean of k of 4 such samples is 10 k / (10 k + 1) if it is tone-mapped last, which is
  // at least 0.909, and k / 4 of 40 / 41 if it is tone-mapped first.
  const auto code = [](double linear) { return static_cast<int>(std::lround(255 * (1.055 * std::pow(linear, 1 / 2.4) - 0.055))); };
  for (int y = 0; y < 256; ++y) {
    for (int x = 0; x < 256; ++x) {
      bool is_known = p.at(x, y).x == 0;
      for (int k = 1; k <= 4; ++k) {
        const double tone = x < 128 ? 10.0 * k / (10.0 * k + 1) : k / 4.0 * 40 / 41;
        is_known |= std::abs(static_cast<int>(p.at(x, y).x) - code(tone)) <= 1;  // half floats, and rounding to codes
      }
      ASSERT_TRUE(is_known) << x << ' ' << y << ' ' << static_cast<int>(p.at(x, y).x);
    }
  }
  const auto partly = [&](const glm::u8vec4& c) { return c.x > 100 && c.x < 230; };
  EXPECT_GT(share(p, partly), 0.003);
}

// README.md and docs/reference/api.md promise this.
TEST(Examples, HaveFewerThan60LinesEach) {
  int examples = 0;
  for (const auto& entry : std::filesystem::directory_iterator(HALFSPACE_EXAMPLES_SOURCE_DIR)) {
    const std::string source = read_bytes(entry.path());
    EXPECT_LT(std::ranges::count(source, '\n'), 60) << entry.path();
    ++examples;
  }
  EXPECT_EQ(examples, 13);  // README.md: triangle and twelve more
}

TEST(Examples, ReportAnOutputFileThatCannotBeWritten) {
  const std::string program = std::string(HALFSPACE_EXAMPLES_DIR) + "/example-triangle ";
  const ProgramOutput format = run_command(program + "x.foo 2>&1"), folder = run_command(program + "/proc/x.png 2>&1");
  EXPECT_EQ(format.exit_code, 1);
  EXPECT_EQ(format.text, "x.foo: unknown image format; expected a file name ending in .png, .jpg or .tif\n");
  EXPECT_EQ(folder.exit_code, 1);
  EXPECT_TRUE(folder.text.starts_with("/proc/x.png: ")) << folder.text;
  EXPECT_EQ(std::ranges::count(folder.text, '\n'), 1) << folder.text;
}

}  // namespace
}  // namespace halfspace
