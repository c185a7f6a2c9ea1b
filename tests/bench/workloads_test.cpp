// SPDX-License-Identifier: Apache-2.0
//
// Every workload's picture, against the same picture in double precision: the closed form of clear, fill and points_100k, the
// naive pipeline of all others (hdr_200k, tonemap: and the curve; blend_10: a layer at a time). Nothing here depends on time.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <ostream>
#include <string>

#include "workload.h"
#include "workload_assets.h"

namespace halfspace {

// Shown by GoogleTest where a case fails.
void PrintTo(const WorkloadKind& kind, std::ostream* out) { *out << kind.name; }

namespace {

struct Count {
  int covered = 0, colors_off = 0, depths_off = 0;
  double worst_color = 0, worst_depth = 0;
};

double color_error(const glm::u8vec4& code, const vec4<double>& truth) {
  double worst = 0;
  for (int k = 0; k < 4; ++k) worst = std::max(worst, std::abs(code[k] / 255.0 - std::clamp(truth[k], 0.0, 1.0)));
  return worst;
}

// Over the pixels that either picture draws; over all where the workload draws none with depth.
Count compare(const WorkloadPicture& picture, const WorkloadTruth& truth, double depth_tolerance) {
  const auto drawn = [&](std::size_t i) {
    return truth.depth.data()[i] < 1.0 || (picture.depth != nullptr && picture.depth->data()[i] < 1.0f);
  };
  const std::size_t pixels = truth.color.texels().size();
  bool any_drawn = false;
  for (std::size_t i = 0; i < pixels && picture.depth != nullptr; ++i) any_drawn = any_drawn || drawn(i);
  Count count;
  for (std::size_t i = 0; i < pixels; ++i) {
    const double color = color_error(picture.color->data()[i], truth.color.data()[i]);
    const double depth = picture.depth == nullptr ? 0 : std::abs(static_cast<double>(picture.depth->data()[i]) - truth.depth.data()[i]);
    if (any_drawn && !drawn(i)) {
      EXPECT_LT(color, 0.51 / 255) << "beside what is drawn, pixel " << i;  // the background's code, correctly rounded
      continue;
    }
    ++count.covered;
    count.colors_off += color > 1.0 / 255 ? 1 : 0;
    count.depths_off += depth > depth_tolerance ? 1 : 0;
    count.worst_color = std::max(count.worst_color, color);
    count.worst_depth = std::max(count.worst_depth, depth);
  }
  return count;
}

// Odd, with a tile that is cut on either side. HALFSPACE_BENCH_SIZE=1920x1080 judges the pictures of another size.
WorkloadSize size_of_pictures() {
  WorkloadSize size{223, 149};
  const char* given = std::getenv("HALFSPACE_BENCH_SIZE");
  if (given != nullptr) {
    EXPECT_EQ(std::sscanf(given, "%dx%d", &size.width, &size.height), 2) << given;
  }
  return size;
}

// Window depths are near 1, where a float's step is 6e-8; a position's error of some 1e-7 reaches them through the slope of a
// surface seen edge-on. Where the near plane cuts, a corner may be snapped to the next 1/256 px, and depth falls steeply there.
double depth_tolerance(std::string_view workload) { return workload == "near_clip" ? 1e-4 : 1e-5; }

class WorkloadPictures : public testing::TestWithParam<WorkloadKind> {};

TEST_P(WorkloadPictures, AreThoseOfDoublePrecision) {
  const WorkloadSize size = size_of_pictures();
  WorkloadAssets assets;
  const std::unique_ptr<Workload> workload = GetParam().prepare(size, assets);
  const WorkloadTruth truth = workload->truth();
  workload->frame(Workers(1));
  const Image<glm::u8vec4> first = *workload->picture().color;
  const Count count = compare(workload->picture(), truth, depth_tolerance(GetParam().name));
  EXPECT_GT(count.covered, size.width * size.height / 5);
  EXPECT_LE(count.colors_off, count.covered / 1000) << "worst " << 255 * count.worst_color << "/255";
  EXPECT_LE(count.depths_off, count.covered / 1000) << "worst " << count.worst_depth;
  RecordProperty("covered", count.covered);
  RecordProperty("colors_off", count.colors_off);
  RecordProperty("depths_off", count.depths_off);

  // Every frame is the first again, by any number of threads.
  workload->frame(Workers(3));
  EXPECT_TRUE(*workload->picture().color == first);
}

std::string name_of(const testing::TestParamInfo<WorkloadKind>& info) { return std::string(info.param.name); }

INSTANTIATE_TEST_SUITE_P(All, WorkloadPictures, testing::ValuesIn(workloads().begin(), workloads().end()), name_of);

TEST(WorkloadTable, NamesEachOnce) {
  EXPECT_EQ(workloads().size(), 24u);
  for (const WorkloadKind& kind : workloads()) {
    EXPECT_EQ(std::ranges::count(workloads(), kind.name, &WorkloadKind::name), 1) << kind.name;
    EXPECT_FALSE(kind.what.empty());
  }
}

TEST(WorkloadMeshes, SpheresHaveTheirTriangles) {
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

TEST(WorkloadTexture, LevelsAreMeansInCodes) {
  const Texture2D texture = checker_texture();
  EXPECT_EQ(texture.levels(), 12);
  EXPECT_EQ(texture.texel(0, 64, 0), glm::u8vec4(230, 230, 230, 255));
  EXPECT_EQ(texture.texel(0, 63, 0), glm::u8vec4(40, 90, 160, 255));
  EXPECT_EQ(texture.texel(6, 1, 0), glm::u8vec4(230, 230, 230, 255));  // a square is one texel
  EXPECT_EQ(texture.texel(7, 3, 3), glm::u8vec4(135, 160, 195, 255));  // two of each, evenly
  EXPECT_EQ(texture.texel(11, 0, 0), glm::u8vec4(135, 160, 195, 255));
}

}  // namespace

}  // namespace halfspace
