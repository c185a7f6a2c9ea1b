// SPDX-License-Identifier: Apache-2.0
//
// Draws every row of the matrix once. Rows with opaque triangles and one sample are compared with double-precision references;
// peers_test.cpp compares the others with OpenGL.
#include "matrix/matrix.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "workloads/picture_errors.h"
#include "workloads/workload_assets.h"

namespace halfspace {

void PrintTo(const MatrixRow& row, std::ostream* out) { *out << row.name; }

namespace {

constexpr WorkloadSize kMatrixSize{320, 180};

const WorkloadKind& workload_of(const MatrixRow& row) { return matrix_workloads()[static_cast<std::size_t>(&row - matrix_rows().data())]; }

class MatrixPictures : public testing::TestWithParam<const MatrixRow*> {};

TEST_P(MatrixPictures, MatchDoublePrecision) {
  WorkloadAssets assets;
  const std::unique_ptr<Workload> workload = workload_of(*GetParam()).prepare(kMatrixSize, assets);
  workload->frame(Workers(1));
  const Image<glm::u8vec4> first = *workload->picture().color;
  workload->frame(Workers(3));
  EXPECT_TRUE(*workload->picture().color == first) << "depends on the number of threads";
  if (!workload->has_truth()) return;
  // At this size, triangles are smaller than a pixel. A vertex that is snapped differently in double precision can change which triangle
  // covers a pixel center.
  const PictureErrors errors = picture_errors(workload->picture(), workload->truth(), 1e-4);
  EXPECT_GT(errors.covered, kMatrixSize.width * kMatrixSize.height / 5);
  EXPECT_LE(errors.colors_off, errors.covered / 500) << "worst " << errors.worst_color << "/255";
  EXPECT_LE(errors.depths_off, errors.covered / 500) << "worst " << errors.worst_depth;
}

std::vector<const MatrixRow*> all_rows() {
  std::vector<const MatrixRow*> rows;
  for (const MatrixRow& row : matrix_rows()) rows.push_back(&row);
  return rows;
}

std::string name_of_row(const testing::TestParamInfo<const MatrixRow*>& info) { return std::string(info.param->name); }

INSTANTIATE_TEST_SUITE_P(All, MatrixPictures, testing::ValuesIn(all_rows()), name_of_row);

TEST(Matrix, NamesAreUnique) {
  for (const MatrixRow& row : matrix_rows()) {
    EXPECT_EQ(std::ranges::count(matrix_rows(), row.name, &MatrixRow::name), 1) << row.name;
    EXPECT_FALSE(row.what.empty()) << row.name;
  }
}

TEST(Matrix, ScissorLimitsTheRow) {
  WorkloadAssets assets;
  const auto row = std::ranges::find(matrix_rows(), "scissor", &MatrixRow::name);
  const std::unique_ptr<Workload> workload = workload_of(*row).prepare(kMatrixSize, assets);
  workload->frame(Workers(1));
  const Image<float>& depth = *workload->picture().depth;
  EXPECT_EQ(std::ranges::count_if(depth.texels(), [](float z) { return z < 1.0f; }), kMatrixSize.width / 2 * (kMatrixSize.height / 2));
}

}  // namespace

}  // namespace halfspace
