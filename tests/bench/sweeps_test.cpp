// SPDX-License-Identifier: Apache-2.0
//
// Tests the parameter sweeps, and the comparison of images with double-precision references.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "bench/program.h"
#include "workloads/picture_errors.h"
#include "workloads/sweeps.h"
#include "workloads/workload_assets.h"

namespace halfspace {

namespace {

const WorkloadKind& point_of(std::string_view name) {
  for (const Sweep& sweep : sweeps()) {
    for (const WorkloadKind& kind : sweep.kinds) {
      if (kind.name == name) return kind;
    }
  }
  ADD_FAILURE() << "no sweep point " << name;
  return workloads()[0];
}

class SweepPictures : public testing::TestWithParam<const char*> {};

TEST_P(SweepPictures, MatchDoublePrecision) {
  WorkloadAssets assets;
  const std::unique_ptr<Workload> workload = point_of(GetParam()).prepare({191, 127}, assets);
  workload->frame(Workers(1));
  const PictureErrors errors = picture_errors(workload->picture(), workload->truth(), 1e-5);
  EXPECT_GT(errors.covered, 191 * 127 / 5);
  EXPECT_LE(errors.colors_off, errors.covered / 1000) << "worst " << errors.worst_color << "/255";
  EXPECT_LE(errors.depths_off, errors.covered / 1000) << "worst " << errors.worst_depth;
  EXPECT_EQ(errors.background_off, 0);
}

INSTANTIATE_TEST_SUITE_P(All, SweepPictures,
                         testing::Values("triangle_size=64", "triangle_count=3200", "overdraw=64", "varyings=0", "varyings=4",
                                         "varyings=32"));

TEST(Sweeps, AreNamedByParameterAndValue) {
  EXPECT_EQ(sweeps().size(), 4u);
  EXPECT_EQ(sweeps()[0].kinds.front().name, "triangle_size=0.25");
  EXPECT_EQ(sweeps()[0].kinds.back().name, "triangle_size=1000000");
  EXPECT_EQ(sweeps()[1].kinds.front().name, "triangle_count=1000");
  EXPECT_EQ(sweeps()[1].kinds.back().name, "triangle_count=10000000");
  EXPECT_EQ(sweeps()[2].kinds.size(), kOverdraws.size());
  EXPECT_EQ(sweeps()[3].kinds.size(), kVaryings.size());
}

// Two covered pixels, one with a wrong color and depth, and two background pixels, one of them wrong.
TEST(PictureErrors, CountsWrongPixels) {
  WorkloadTruth truth(4, 1, vec4<double>(0.2), 1.0);
  truth.depth.at(0, 0) = truth.depth.at(1, 0) = 0.5;
  Image<glm::u8vec4> color(4, 1);
  std::fill_n(color.data(), 4, glm::u8vec4(51));
  Image<float> depth(4, 1);
  for (int x = 0; x < 4; ++x) depth.at(x, 0) = static_cast<float>(truth.depth.at(x, 0));
  const PictureErrors none = picture_errors({&color, &depth}, truth, 1e-5);
  EXPECT_EQ(none.covered, 2);
  EXPECT_EQ(none.colors_off + none.depths_off + none.background_off, 0);

  color.at(1, 0).y = 55;
  depth.at(1, 0) = 0.5001f;
  color.at(3, 0).x = 52;
  const PictureErrors some = picture_errors({&color, &depth}, truth, 1e-5);
  EXPECT_EQ(some.covered, 2);
  EXPECT_EQ(some.colors_off, 1);
  EXPECT_EQ(some.depths_off, 1);
  EXPECT_EQ(some.background_off, 1);
  EXPECT_NEAR(some.worst_color, 4.0, 1e-9);
  EXPECT_NEAR(some.rms_color, std::sqrt(16.0 / 8.0), 1e-9);
  EXPECT_NEAR(some.worst_depth, 1e-4, 1e-7);
}

TEST(PictureErrors, CachesReferences) {
  const TemporaryFolder directory;
  WorkloadAssets assets;
  const std::unique_ptr<Workload> workload = point_of("varyings=4").prepare({40, 30}, assets);
  const WorkloadTruth made = kept_truth(directory.path().string(), "some", *workload, {40, 30});
  EXPECT_TRUE(std::filesystem::exists(directory.path().string() + "/some.40x30.truth"));
  // The data that is read back comes from the file, regardless of the workload passed.
  const std::unique_ptr<Workload> other = point_of("overdraw=1").prepare({40, 30}, assets);
  const WorkloadTruth read = kept_truth(directory.path().string(), "some", *other, {40, 30});
  for (std::size_t i = 0; i < made.color.texels().size(); ++i) {
    ASSERT_NEAR(read.color.data()[i].x, made.color.data()[i].x, 1e-7);
    ASSERT_NEAR(read.depth.data()[i], made.depth.data()[i], 1e-7);
  }
}

}  // namespace

}  // namespace halfspace
