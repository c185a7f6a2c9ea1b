// SPDX-License-Identifier: Apache-2.0
//
// Checks that the peer renderers draw the same images as Halfspace, and that the other benchmark programs run. These programs
// belong to the target `benchmarks`. The default target does not contain them, and some need libraries that may be missing. Tests of
// programs that are not built are skipped.
#include <gtest/gtest.h>

#include "bench/program.h"
#include "halfspace/geometry/shapes.h"
#include "halfspace/model/write_model.h"
#include "matrix/matrix.h"
#include "scenes/scene.h"
#include "support/errors.h"
#include "support/files.h"
#include "workloads/model_workload.h"
#include "workloads/sweeps.h"

namespace halfspace {

namespace {

using test::Outcome;

// Returns the path of a program, or an empty text if it is not built. In a build folder that is used repeatedly, it can be outdated; the
// target `benchmarks` renews it.
std::string built(const std::string& name) {
  const std::filesystem::path program = std::filesystem::path(HALFSPACE_BENCH_FOLDER) / name;
  return std::filesystem::exists(program) ? program.string() : "";
}

// Returns the names of all workloads except those with the largest meshes, which use the same code as the smaller ones.
std::string all_but_2m() {
  std::string names;
  for (const WorkloadKind& kind : workloads()) {
    if (!kind.name.ends_with("_2m")) names += (names.empty() ? "" : ",") + kind.name;
  }
  return names;
}

// Returns the allowed RMS error in units of 1/255. Rounding to 8 bits alone gives 0.29. llvmpipe computes the level of detail from
// differences between pixels with an approximate logarithm. At this small size, up to a tenth of the textured pixels are off by more than
// 1/255, but none by much more. llvmpipe also snaps points to a grid that is coarse for disks this small, and uses a different anisotropic
// footprint. At the edges of alpha-tested holes, a different layer may be visible. A wrong light, matrix, state or mesh gives an error of
// tens of units.
double allowed_rms(const std::string& workload) {
  if (workload == "aniso_floor") return 10.0;
  if (workload == "points_100k") return 5.0;
  if (workload == "shadow_200k") return 0.3;  // most of it is neither textured nor lit
  return workload == "alpha_test" ? 2.0 : 0.6;
}

TEST(BenchGl, DrawsTheSameImages) {
  const std::string program = built("halfspace-bench-gl");
  if (program.empty()) GTEST_SKIP() << "halfspace-bench-gl is not built";
  const TemporaryFolder truths;
  const Outcome outcome = test::run_program(
      program, "--only " + all_but_2m() + " --size 160x120 --threads 1 --seconds 0 --json --check " + truths.path().string());
  if (outcome.exit_code == 3) GTEST_SKIP() << outcome.text;
  ASSERT_EQ(outcome.exit_code, 0) << outcome.text;
  const std::vector<nlohmann::json> rows = test::json_lines_of(outcome.text);
  EXPECT_EQ(rows.size(), workloads().size() - 3);
  for (const nlohmann::json& row : rows) {
    const std::string name = row.at("workload");
    EXPECT_EQ(row.at("program"), "llvmpipe");
    const nlohmann::json& picture = row.at("picture");
    EXPECT_GT(picture.at("covered"), 160 * 120 / 5) << name;
    EXPECT_LT(picture.at("rms_color"), allowed_rms(name)) << name;
  }
}

// Draws the rows of a table with OpenGL and returns the JSON lines, or nothing if OpenGL is not available.
std::vector<nlohmann::json> drawn_by_gl(const std::string& table) {
  const std::string program = built("halfspace-bench-gl");
  if (program.empty()) return {};
  const TemporaryFolder truths;
  const Outcome outcome =
      test::run_program(program, table + " --size 320x180 --threads 2 --seconds 0 --json --check " + truths.path().string(), "2>/dev/null");
  if (outcome.exit_code == 3) return {};
  EXPECT_EQ(outcome.exit_code, 0) << outcome.text;
  return test::json_lines_of(outcome.text);
}

// Checks that at most the given fraction of the pixels away from edges differs from Halfspace's by more than 2/255.
void expect_same_picture(const nlohmann::json& row, double share) {
  const double compared = row.at("difference").at("compared"), off = row.at("difference").at("off");
  EXPECT_LE(off, compared * share) << row.dump();
}

// llvmpipe places points on a coarser grid, and it rounds intermediate sums of additive blending differently.
TEST(BenchGl, DrawsTheSameMatrix) {
  const std::vector<nlohmann::json> rows = drawn_by_gl("--matrix");
  if (rows.empty()) GTEST_SKIP() << "halfspace-bench-gl is not built, or there is no OpenGL";
  EXPECT_GE(rows.size(), matrix_rows().size() - 1);  // llvmpipe has at most 4 samples
  for (const nlohmann::json& row : rows) {
    const std::string name = row.at("workload");
    if (row.contains("difference")) expect_same_picture(row, name == "points" || name == "blend_additive" ? 0.02 : 0.01);
  }
}

// llvmpipe computes the level of detail with less precision.
TEST(BenchGl, DrawsTheSameScenes) {
  const std::vector<nlohmann::json> rows = drawn_by_gl("--scenes");
  if (rows.empty()) GTEST_SKIP() << "halfspace-bench-gl is not built, or there is no OpenGL";
  EXPECT_EQ(rows.size(), scene_rows().size());
  for (const nlohmann::json& row : rows) expect_same_picture(row, 0.01);
}

// Most triangles of these scenes are smaller than a pixel at this size.
TEST(BenchGl, DrawsTheSameViews) {
  const std::vector<nlohmann::json> rows = drawn_by_gl("--views");
  if (rows.empty()) GTEST_SKIP() << "halfspace-bench-gl is not built, or there is no OpenGL";
  EXPECT_EQ(rows.size(), view_rows().size());
  for (const nlohmann::json& row : rows) expect_same_picture(row, 0.01);
}

// Writes a model of spheres with different materials. The last sphere is mirrored and seen from inside.
void write_spheres(const std::filesystem::path& file, bool colored) {
  Model model;
  const Mesh sphere = uv_sphere(48, 96, 0.45f);
  ModelMesh mesh;
  mesh.positions = sphere.positions;
  mesh.normals = sphere.normals;
  mesh.indices = sphere.indices;
  if (colored) mesh.colors.assign(mesh.positions.size(), glm::vec4(0.5f));
  for (int i = 0; i < 6; ++i) {
    const auto step = static_cast<float>(i % 3);
    ModelMaterial material;
    material.base_color = {0.9f, 0.3f + 0.2f * step, 0.1f, 1.0f};
    material.metallic = i < 3 ? 0.0f : 1.0f - 0.25f * step;
    material.roughness = 0.1f + 0.4f * step;
    material.specular = i == 1 ? 0.5f : 1.0f;
    material.emissive = i == 2 ? glm::vec3(0.0f, 0.1f, 0.3f) : glm::vec3(0.0f);
    material.double_sided = i == 5;
    model.materials.push_back(material);
    mesh.material = i;
    if (i == 5) mesh.indices.resize(mesh.indices.size() / 2);
    model.meshes.push_back(mesh);
    ModelNode node;
    node.transform.translation = {i % 3, i / 3, 0};
    if (i == 5) node.transform.scale = {1, -1, 1};
    node.meshes = {i};
    model.nodes.push_back(node);
  }
  model.scenes = {{"", {0, 1, 2, 3, 4, 5}}};
  const std::vector<std::byte> bytes = written_model(model, file, ModelFormat::glb).files.at(0).bytes;
  write_bytes(file, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

TEST(BenchGl, DrawsTheSameModel) {
  const TemporaryFolder folder;
  write_spheres(folder.path() / "spheres.glb", false);
  const std::vector<nlohmann::json> rows = drawn_by_gl("--model " + (folder.path() / "spheres.glb").string());
  if (rows.empty()) GTEST_SKIP() << "halfspace-bench-gl is not built, or there is no OpenGL";
  EXPECT_EQ(rows.size(), model_rows().size());
  for (const nlohmann::json& row : rows) expect_same_picture(row, 0.01);
}

TEST(BenchGl, RefusesModelsThatItsShaderCannotDraw) {
  const std::string program = built("halfspace-bench-gl");
  const TemporaryFolder folder;
  const std::string plain = (folder.path() / "plain.glb").string(), colored = (folder.path() / "colored.glb").string();
  write_spheres(plain, false);
  write_spheres(colored, true);
  const std::string rest = " --size 16x16 --seconds 0 --threads 1";
  if (program.empty() || test::run_program(program, "--model " + plain + rest).exit_code != 0)
    GTEST_SKIP() << "halfspace-bench-gl is not built, or there is no OpenGL";
  const Outcome outcome = test::run_program(program, "--model " + colored + rest, "2>&1 >/dev/null");
  EXPECT_EQ(outcome.exit_code, 3);
  for (const char* words : {"colored.glb", "vertex colors"}) EXPECT_NE(outcome.text.find(words), std::string::npos) << outcome.text;
}

// Rays hit the same triangles, so only the outline and the edges of the checkerboard can differ. At this size the outline is 1.5% of the
// sphere, and snapping to 1/256 px changes only a few of its pixels.
TEST(BenchEmbree, DrawsTheSameImages) {
  const std::string program = built("halfspace-bench-embree");
  if (program.empty()) GTEST_SKIP() << "halfspace-bench-embree is not built";
  const TemporaryFolder truths;
  const Outcome outcome = test::run_program(program,
                                            "--only sphere_phong_20k,sphere_gouraud_20k,sphere_flat_20k,sphere_phong_200k --size 223x149 "
                                            "--threads 2 --seconds 0 --json --check " +
                                                truths.path().string());
  ASSERT_EQ(outcome.exit_code, 0) << outcome.text;
  const std::vector<nlohmann::json> rows = test::json_lines_of(outcome.text);
  EXPECT_EQ(rows.size(), 4u);
  for (const nlohmann::json& row : rows) {
    const nlohmann::json& picture = row.at("picture");
    EXPECT_LE(picture.at("colors_off").get<double>(), picture.at("covered").get<double>() / 200) << row.dump();
    // Rays intersect unsnapped triangles, so depth differs by the slope over 1/512 px, which is large near the outline.
    EXPECT_LE(picture.at("depths_off").get<double>(), picture.at("covered").get<double>() / 50) << row.dump();
  }
}

TEST(BenchGl, ListsTheAvailableDrivers) {
  const std::string program = built("halfspace-bench-gl");
  if (program.empty()) GTEST_SKIP() << "halfspace-bench-gl is not built";
  const Outcome outcome = test::run_program(program, "--driver llvm --only fill");
  EXPECT_EQ(outcome.exit_code, 2);
  ASSERT_TRUE(outcome.text.ends_with('\n')) << outcome.text;
  EXPECT_TRUE(reports(outcome.text.substr(0, outcome.text.size() - 1), "halfspace-bench-gl: --driver", {"'llvm'", "llvmpipe", "softpipe"}));
}

TEST(BenchPeers, SupportTheSweepsOfHalfspace) {
  bool any = false;
  for (const std::string& program : {built("halfspace-bench-gl"), built("halfspace-bench-embree")}) {
    if (program.empty()) continue;
    any = true;
    const Outcome list = test::run_program(program, "--sweep triangle_count --list");
    EXPECT_EQ(list.exit_code, 0);
    EXPECT_EQ(test::lines_of(list.text).size(), kTriangleCounts.size()) << list.text;
    const Outcome wrong = test::run_program(program, "--sweep triangle_cuont");
    EXPECT_EQ(wrong.exit_code, 2);
    for (const char* word : {"'triangle_cuont'", "'triangle_count'"}) EXPECT_NE(wrong.text.find(word), std::string::npos) << wrong.text;
  }
  if (!any) GTEST_SKIP() << "halfspace-bench-gl and halfspace-bench-embree are not built";
}

TEST(Limits, AreMeasured) {
  const std::string program = built("halfspace-limits");
  if (program.empty()) GTEST_SKIP() << "halfspace-limits is not built";
  const Outcome outcome = test::run_program(program, "--threads 2 --seconds 0.001 --json");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.text;
  const std::vector<nlohmann::json> rows = test::json_lines_of(outcome.text);
  EXPECT_EQ(rows.size(), 17u);
  for (const nlohmann::json& row : rows) EXPECT_GT(row.at("value"), 0.0) << row.dump();
  EXPECT_EQ(test::run_program(program, "--seconds 0").exit_code, 2);
}

TEST(Stages, RunAndReportResults) {
  const std::string program = built("halfspace-stages");
  if (program.empty()) GTEST_SKIP() << "halfspace-stages is not built";
  const Outcome outcome =
      test::run_program(program, "--benchmark_min_time=0.001 --benchmark_filter='clip|vertex_position|store_depth|nearest'");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.text;
  for (const char* name : {"clip/0", "vertex_position", "store_depth/d16", "look_up/rgba8_nearest"})
    EXPECT_NE(outcome.text.find(name), std::string::npos) << outcome.text;
}

}  // namespace

}  // namespace halfspace
