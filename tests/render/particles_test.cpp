// SPDX-License-Identifier: Apache-2.0
//
// Tests the positions of a scene's particles, and particle files.
#include "halfspace/render/particles.h"

#include <cmath>

#include "halfspace/scene/scene_file.h"
#include "support/folder_test.h"

namespace halfspace {

namespace {

ParticlesDescription some(int count, ParticleArrangement arrangement) {
  ParticlesDescription p;
  p.count = count;
  p.arrangement = arrangement;
  return p;
}

TEST(Particles, HelixMatchesTheFormula) {
  for (const double seconds : {0.0, 1.0, 7.3}) {
    const SceneDescription scene = SceneFile::open("particles").at(seconds);
    const ParticlesDescription& p = scene.particles;
    ASSERT_EQ(p.count, 12);
    const Particles made = make_particles(p);
    ASSERT_EQ(made.centers_ws.size(), 12u);
    for (int i = 0; i < 12; ++i) {
      const double frame = 30.0 * seconds, y = -3.0 + 6.0 * i / 11.0, angle = frame / 30.0 + y;
      const glm::dvec3& c = made.centers_ws[static_cast<std::size_t>(i)];
      EXPECT_NEAR(c.x, 1.5 * std::cos(angle), 1e-14);  // a few ulp of angles up to 10
      EXPECT_NEAR(c.y, y, 1e-15 * 4);
      EXPECT_NEAR(c.z, 1.5 * std::sin(angle), 1e-14);
      EXPECT_FLOAT_EQ(made.radii[static_cast<std::size_t>(i)], 0.3f);
    }
  }
}

TEST(Particles, FillTheirVolume) {
  constexpr int kCount = 20000;
  const Particles grid = make_particles(some(1000, ParticleArrangement::grid));
  EXPECT_EQ(grid.centers_ws.front(), glm::dvec3(-1.5));
  EXPECT_EQ(grid.centers_ws.back(), glm::dvec3(1.5));
  EXPECT_NEAR(grid.centers_ws[1].x - grid.centers_ws[0].x, 3.0 / 9.0, 1e-15);

  const Particles ball = make_particles(some(kCount, ParticleArrangement::ball));
  int inner = 0, upper = 0;
  for (const glm::dvec3& c : ball.centers_ws) {
    ASSERT_LE(glm::dot(c, c), 1.5 * 1.5 * (1 + 1e-12));
    inner += glm::dot(c, c) < 0.75 * 0.75 ? 1 : 0;
    upper += c.y > 0.0 ? 1 : 0;
  }
  // Binomially distributed with probabilities 1/8 and 1/2. The tolerance is five standard deviations.
  EXPECT_NEAR(inner, kCount / 8.0, 5 * std::sqrt(kCount * 7.0 / 64));
  EXPECT_NEAR(upper, kCount / 2.0, 5 * std::sqrt(kCount / 4.0));

  const Particles galaxy = make_particles(some(kCount, ParticleArrangement::galaxy));
  for (const glm::dvec3& c : galaxy.centers_ws) {
    ASSERT_LE(std::hypot(c.x, c.z), 1.5 * (1 + 1e-12));
    ASSERT_LE(std::fabs(c.y), 0.06 * 1.5 * 1.5 * 1.5);
  }
  EXPECT_TRUE(make_particles(some(1, ParticleArrangement::helix)).centers_ws[0] == glm::dvec3(1.5, 0, 0));
}

TEST(Particles, DefaultRadiusPreservesTheTotalVolume) {
  for (const int count : {1, 12, 1000, 1000000}) {
    const double r = particle_radius(some(count, ParticleArrangement::ball));
    EXPECT_NEAR(r * r * r * count, 0.3 * 0.3 * 0.3 * 12, 1e-13) << count;  // a relative error of 3e-13 from rounding a cube root and a cube
  }
  ParticlesDescription given = some(1000, ParticleArrangement::ball);
  given.radius = 0.7;
  EXPECT_EQ(particle_radius(given), 0.7);
}

class ParticleFiles : public FolderTest {};

TEST_F(ParticleFiles, AreParsed) {
  ParticlesDescription p;
  p.radius = 0.25;
  const Particles s = read_particles(put("a.csv", "# x,y,z\n1,2,3\r\n\n -1.5e0 , 0 ,\t4,0.5\n7,8,9,1,0.1,0.2,0.3"), p);
  ASSERT_EQ(s.centers_ws.size(), 3u);
  EXPECT_EQ(s.centers_ws[0], glm::dvec3(1, 2, 3));
  EXPECT_EQ(s.centers_ws[1], glm::dvec3(-1.5, 0, 4));
  EXPECT_EQ(s.radii, (std::vector<float>{0.25f, 0.5f, 1.0f}));
  EXPECT_EQ(s.colors[1], glm::vec3(1.0f));
  EXPECT_EQ(s.colors[2], glm::vec3(0.1f, 0.2f, 0.3f));
}

TEST_F(ParticleFiles, ErrorsNameFileLineAndExpectedValue) {
  const struct {
    const char *text, *line;
    std::vector<std::string> keywords;
  } cases[] = {
      {"", "", {"no row", "x,y,z"}},
      {"# nothing\n\n", "", {"no row", "x,y,z"}},
      {"1,2,3\n1,2\n", ":2", {"has 2 numbers", "x,y,z"}},
      {"7\n", ":1", {"has 1 number", "x,y,z"}},
      {"1,2,3,4,5\n", ":1", {"has 5 numbers", "x,y,z"}},
      {"1,2,3,4,0,0\n", ":1", {"has 6 numbers", "x,y,z"}},
      {"\n\n1,2,3,4,0,0,0,8\n", ":3", {"more than 7 numbers", "x,y,z"}},
      {"x,y,z\n", ":1", {"'x'", "not a number"}},
      {"1,2,3m\n", ":1", {"'3m'", "not a number"}},
      {"1,,3\n", ":1", {"''", "not a number"}},
      {"1,2,3,\n", ":1", {"''", "not a number"}},
      {"1,2,nan\n", ":1", {"'nan'", "-1e9 to 1e9"}},
      {"1,2,inf\n", ":1", {"'inf'", "-1e9 to 1e9"}},
      {"1,2,1e10\n", ":1", {"'1e10'", "-1e9 to 1e9"}},
      {"1,2,3,0\n", ":1", {"radius", "0", "1e-6 to 1e6"}},
      {"1,2,3,-1\n", ":1", {"radius", "-1", "1e-6 to 1e6"}},
      {"1,2,3,1,0,-0.5,0\n", ":1", {"color", "-0.5", "0 to 1e9"}},
  };
  for (const auto& c : cases) {
    const std::filesystem::path file = put("bad.csv", c.text);
    EXPECT_TRUE(reports(input_error([&] { read_particles(file, {}); }), file.string() + c.line + ": ", c.keywords));
  }
  EXPECT_TRUE(
      reports(input_error([&] { read_particles(directory / "none.csv", {}); }), (directory / "none.csv").string(), {"no such file"}));
  EXPECT_TRUE(reports(input_error([&] { read_particles(directory, {}); }), directory.string(), {"regular file", ".csv"}));
}

TEST(Particles, RejectsKeysOfTheOtherSprite) {
  SceneFile file = SceneFile::open("particles");
  file.set(std::vector<std::string>{"particles.point_scale=900"});
  EXPECT_EQ(file.description().particles.point_scale, 900.0);
  file.set(std::vector<std::string>{"particles.sprite=exact"});
  EXPECT_NE(input_error([&] { file.set(std::vector<std::string>{"particles.point_scale=900"}); }), "(no error)");
  EXPECT_NE(input_error([&] { file.set(std::vector<std::string>{"particles.count=1000001"}); }), "(no error)");
}

}  // namespace

}  // namespace halfspace
