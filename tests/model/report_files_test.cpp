// SPDX-License-Identifier: Apache-2.0
//
// The meshes in ../shared/data/reports, with the values that its README gives. Other tests generate files of the same kinds.
#include <gtest/gtest.h>

#include <filesystem>

#include "halfspace/core/srgb.h"
#include "halfspace/model/model.h"
#include "halfspace/model/pose/pose.h"
#include "support/files.h"

namespace halfspace {
namespace {

struct ReportedMesh {
  Model model;
  const ModelMesh& mesh() const { return model.meshes.at(0); }

  double area() const {
    double area = 0.0;
    for_triangles(
        [&](const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) { area += 0.5 * glm::length(glm::cross(b - a, c - a)); });
    return area;
  }
  double volume() const {
    double volume = 0.0;
    for_triangles([&](const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) { volume += glm::dot(a, glm::cross(b, c)) / 6.0; });
    return volume;
  }

 private:
  template <class F>
  void for_triangles(const F& f) const {
    const auto corner = [&](std::size_t i) { return glm::dvec3(mesh().positions[mesh().indices[i]]); };
    for (std::size_t i = 0; i < mesh().indices.size(); i += 3) f(corner(i), corner(i + 1), corner(i + 2));
  }
};

class ReportedFiles : public testing::Test {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(shared_data("reports"))) GTEST_SKIP() << absent(shared_data("reports"));
  }
  static ReportedMesh read(const char* name) { return {read_model(shared_data("reports") / name)}; }
};

TEST_F(ReportedFiles, ColorsOfPlyAndStl) {
  const glm::vec4 expected(kSrgbToLinear[204], kSrgbToLinear[102], kSrgbToLinear[51], 1.0f);
  for (const char* name : {"float01.ply", "uchar.ply"}) EXPECT_EQ(read(name).mesh().colors, std::vector<glm::vec4>(4, expected)) << name;
  const ReportedMesh magics = read("magics.stl");
  const glm::vec4 orange(1.0f, kSrgbToLinear[128], 0.0f, 1.0f);
  const glm::vec4 colors[] = {{1, 0, 0, 1}, {0, 1, 0, 1}, {0, 0, 1, 1}, orange};
  for (std::size_t i = 0; i < 24; ++i) EXPECT_EQ(magics.mesh().colors.at(i), colors[i / 6]) << i;
}

TEST_F(ReportedFiles, ShapesOfFaces) {
  EXPECT_EQ(read("min.obj").area(), 2.5);
  EXPECT_EQ(read("blank_after_backslash.obj").area(), 1.0);
  EXPECT_EQ(read("OBJ_position.obj").area(), 1.0);
  EXPECT_EQ(read("OBJ_position.obj").model.warnings.size(), 1u);
  EXPECT_NEAR(read("payload_varies.stl").volume(), 1.0, 1e-12);
  const ReportedMesh trailing = read("trailing1.stl");
  EXPECT_EQ(trailing.mesh().indices.size(), 6u);
  EXPECT_EQ(trailing.model.warnings.size(), 1u);
}

TEST_F(ReportedFiles, BoundsOfUsedVertices) {
  const PosedModel posed = pose(read("stray.ply").model, {});
  EXPECT_EQ(posed.low, glm::dvec3(0.0));
  EXPECT_EQ(posed.high, glm::dvec3(1.0, 1.0, 0.0));
}

}  // namespace
}  // namespace halfspace
