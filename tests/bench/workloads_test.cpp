// SPDX-License-Identifier: Apache-2.0
//
// Compares the image of every workload with a double-precision reference: a closed form for clear, fill and points_100k, and the naive
// pipeline for all others (followed by the tone curve for hdr_200k and tonemap, layer by layer for blend_10, and sample by sample for
// msaa4_200k). No test depends on timing.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <ostream>
#include <string>

#include "workloads/picture_errors.h"
#include "workloads/workload.h"
#include "workloads/workload_assets.h"

namespace halfspace {

// Printed by GoogleTest if a case fails.
void PrintTo(const WorkloadKind& kind, std::ostream* out) { *out << kind.name; }

namespace {

// The default size is odd and gives partial tiles at both edges. HALFSPACE_BENCH_SIZE=1920x1080 selects a different size.
WorkloadSize size_of_pictures() {
  WorkloadSize size{223, 149};
  const char* given = std::getenv("HALFSPACE_BENCH_SIZE");
  if (given != nullptr) {
    EXPECT_EQ(std::sscanf(given, "%dx%d", &size.width, &size.height), 2) << given;
  }
  return size;
}

// Window depths are close to 1, where the spacing of floats is 6e-8. A position error of about 1e-7 affects depth through the slope of a
// surface seen edge-on. Where the near plane clips, a vertex can be snapped to a different 1/256 px, and depth is steep there.
double depth_tolerance(std::string_view workload) { return workload == "near_clip" ? 1e-4 : 1e-5; }

class WorkloadPictures : public testing::TestWithParam<WorkloadKind> {};

TEST_P(WorkloadPictures, MatchDoublePrecision) {
  const WorkloadSize size = size_of_pictures();
  WorkloadAssets assets;
  const std::unique_ptr<Workload> workload = GetParam().prepare(size, assets);
  const WorkloadTruth truth = workload->truth();
  workload->frame(Workers(1));
  const Image<glm::u8vec4> first = *workload->picture().color;
  const PictureErrors errors = picture_errors(workload->picture(), truth, depth_tolerance(GetParam().name));
  EXPECT_GT(errors.covered, size.width * size.height / 5);
  EXPECT_LE(errors.colors_off, errors.covered / 1000) << "worst " << errors.worst_color << "/255";
  EXPECT_LE(errors.depths_off, errors.covered / 1000) << "worst " << errors.worst_depth;
  EXPECT_EQ(errors.background_off, 0);
  RecordProperty("covered", errors.covered);
  RecordProperty("colors_off", errors.colors_off);
  RecordProperty("depths_off", errors.depths_off);

  // Every frame is identical to the first one, for any thread count.
  workload->frame(Workers(3));
  EXPECT_TRUE(*workload->picture().color == first);
}

// At this size, corners of the floor are more than 2^20 px from the picture, beyond the range of snapped positions.
TEST(LargeWorkloadPictures, FloorMatchesDoublePrecision) {
  WorkloadAssets assets;
  const auto floor = std::ranges::find(workloads(), std::string_view("aniso_floor"), &WorkloadKind::name);
  const std::unique_ptr<Workload> workload = floor->prepare({512, 512}, assets);
  workload->frame(Workers(1));
  const PictureErrors errors = picture_errors(workload->picture(), workload->truth(), depth_tolerance(floor->name));
  EXPECT_GT(errors.covered, 512 * 512 / 5);
  EXPECT_LE(errors.colors_off, errors.covered / 1000) << "worst " << errors.worst_color << "/255";
}

std::string name_of(const testing::TestParamInfo<WorkloadKind>& info) { return std::string(info.param.name); }

INSTANTIATE_TEST_SUITE_P(All, WorkloadPictures, testing::ValuesIn(workloads().begin(), workloads().end()), name_of);

TEST(WorkloadTable, NamesAreUnique) {
  EXPECT_EQ(workloads().size(), 25u);
  for (const WorkloadKind& kind : workloads()) {
    EXPECT_EQ(std::ranges::count(workloads(), kind.name, &WorkloadKind::name), 1) << kind.name;
    EXPECT_FALSE(kind.what.empty());
  }
}

TEST(WorkloadMeshes, SpheresHaveTheExpectedTriangleCount) {
  EXPECT_EQ(sphere_mesh(51, 200).indices.size(), 3u * 20'000);
  EXPECT_EQ(sphere_mesh(201, 500).indices.size(), 3u * 200'000);
  EXPECT_EQ(sphere_mesh(501, 2000).indices.size(), 3u * 2'000'000);
}

TEST(WorkloadMeshes, SphereFacesOutward) {
  const SphereMesh mesh = sphere_mesh(7, 12);
  EXPECT_EQ(mesh.vertices.size(), 8u * 13);
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
    const glm::vec3 a = mesh.vertices[mesh.indices[i]].position, b = mesh.vertices[mesh.indices[i + 1]].position,
                    c = mesh.vertices[mesh.indices[i + 2]].position;
    EXPECT_GT(glm::dot(glm::cross(b - a, c - a), a + b + c), 0.0f) << i / 3;
  }
}

TEST(WorkloadTexture, MipLevelsAreAveragesOf8BitValues) {
  const Texture2D texture = checker_texture();
  EXPECT_EQ(texture.levels(), 12);
  EXPECT_EQ(texture.texel(0, 64, 0), glm::u8vec4(230, 230, 230, 255));
  EXPECT_EQ(texture.texel(0, 63, 0), glm::u8vec4(40, 90, 160, 255));
  EXPECT_EQ(texture.texel(6, 1, 0), glm::u8vec4(230, 230, 230, 255));  // a square is one texel
  EXPECT_EQ(texture.texel(7, 3, 3), glm::u8vec4(135, 160, 195, 255));  // the average of two texels of each color
  EXPECT_EQ(texture.texel(11, 0, 0), glm::u8vec4(135, 160, 195, 255));
}

}  // namespace

}  // namespace halfspace
