// SPDX-License-Identifier: Apache-2.0
//
// Damaged and hostile OBJ files. Whatever a file contains, read_obj must return a model with valid indices or throw an InputError with a
// one-line message. Each file is read in a child process with limited memory and CPU time.
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>

#include "halfspace/core/check.h"
#include "model/obj_reading.h"
#include "support/sanitized.h"

namespace halfspace {
namespace {

namespace fs = std::filesystem;

bool is_unit(const glm::vec3& v) { return std::abs(glm::dot(v, v) - 1.0f) < 1e-3f; }

std::string problem_of(const ModelMesh& mesh, std::size_t materials) {
  const std::size_t count = mesh.positions.size();
  if (std::ranges::any_of(mesh.indices, [&](uint32_t i) { return i >= count; })) return "an index is out of range";
  if (mesh.topology == MeshTopology::triangles && mesh.indices.size() % 3 != 0) return "a triangle is not complete";
  if (mesh.topology == MeshTopology::triangles && mesh.normals.size() != count) return "normals are missing";
  if (!std::ranges::all_of(mesh.normals, is_unit)) return "a normal does not have unit length";
  if (!mesh.uvs[0].empty() && mesh.uvs[0].size() != count) return "texture coordinates are missing";
  if (!mesh.colors.empty() && mesh.colors.size() != count) return "colors are missing";
  if (std::ranges::any_of(mesh.positions, [](const glm::vec3& p) { return !std::isfinite(glm::dot(p, p)); }))
    return "a position is not finite";
  if (mesh.material < 0 || static_cast<std::size_t>(mesh.material) >= materials) return "the material is out of range";
  return "";
}

std::string problem_of(std::string_view text, const fs::path& file) {
  try {
    const Model model = read_obj_text(text, {}, file);
    if (model.scenes.empty() || model.nodes.empty()) return "there is no scene";
    if (model.warnings.size() > 1000) return "there are too many warnings";
    if (std::ranges::any_of(model.warnings, [](const std::string& w) { return w.find('\n') != w.npos; }))
      return "a warning has several lines";
    for (const ModelMesh& mesh : model.meshes) {
      if (const std::string problem = problem_of(mesh, model.materials.size()); !problem.empty()) return problem;
    }
    return "";
  } catch (const InputError& e) {
    const std::string message = e.what();
    return message.starts_with(file.string() + ":") && message.find('\n') == message.npos ? "" : "unexpected message: " + message;
  }
}

// Runs in the child.
[[noreturn]] void read_with_limits(std::string_view text, const fs::path& file) {
  const rlimit seconds = {kSanitized ? 100u : 10u, kSanitized ? 100u : 10u};
  ::setrlimit(RLIMIT_CPU, &seconds);
  const rlimit memory = {rlim_t{2} << 30, rlim_t{2} << 30};
  if (!kSanitized) ::setrlimit(RLIMIT_AS, &memory);  // sanitizers reserve terabytes of address space
  const std::string problem = problem_of(text, file);
  std::fprintf(stderr, "%s\n", problem.c_str());
  std::fflush(stderr);
  ::_exit(problem.empty() ? 0 : 1);
}

void expect_model_or_error(std::string_view text, const fs::path& file = "/none/a.obj") {
  EXPECT_EXIT(read_with_limits(text, file), testing::ExitedWithCode(0), "") << file;
}

TEST(ObjHostileDeathTest, ReadsAllSharedFiles) {
  const fs::path folder = shared_data("");
  if (!fs::exists(folder)) GTEST_SKIP() << absent(folder);
  std::size_t count = 0;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (!entry.is_regular_file() || entry.path().extension() != ".obj") continue;
    expect_model_or_error(read_bytes(entry.path()), entry.path());
    ++count;
  }
  EXPECT_GT(count, 0u);
}

std::string repeated(std::string_view text, std::size_t count) {
  std::string result;
  for (std::size_t i = 0; i < count; ++i) result += text;
  return result;
}

TEST(ObjHostileDeathTest, ReadsLargeRepetitions) {
  const std::string triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  constexpr std::size_t kMany = 100000;
  for (const std::string& text : {
           repeated(" ", 10 * kMany),
           repeated("\n", 10 * kMany),
           repeated("\\\n", kMany),
           repeated("g\n", kMany),
           repeated("/", kMany),
           std::string(10 * kMany, '\0'),
           triangle + "f" + repeated(" 1 2 3", kMany),
           triangle + "f" + repeated(" 1/1/1 2 -1//", kMany / 3),
           triangle + repeated("f 1 2 3\n", kMany),
           triangle + repeated("f 1 2 3 1\n", kMany / 2),
           triangle + repeated("g a\ng b\nusemtl c\ns 1\ns 2\nf 1 2 3\n", kMany / 4),
           triangle + repeated("vt 0\nvn 1 0 0\nf 1/-1/-1 2/-1/-1 3/-1/-1\n", 2 * kMany),
           triangle + repeated("x\n", kMany),
           triangle + repeated("mtllib a\nmtllib b c d\n", kMany / 10),
           repeated("v 1e18 -1e18 1e18\nv -1e18 1e-300 1\nv 5e-324 0 1e18\nf -1 -2 -3\nf -3 -2 -1 -2\n", kMany / 10),
           "v" + repeated(" 1", kMany),
           "v 0 0 " + repeated("1", kMany),
           "v 0 0 0." + repeated("0", kMany) + "1",
           "mtllib " + repeated("a ", kMany / 10),
       }) {
    SCOPED_TRACE(text.substr(0, 60));
    expect_model_or_error(text);
  }
}

TEST(ObjHostileDeathTest, ReadsManyMaterialNames) {
  std::string text = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  for (int i = 0; i < 300000; ++i) text += "usemtl m" + std::to_string(i) + "\nmtllib l" + std::to_string(i) + "\nf 1 2 3\n";
  expect_model_or_error(text);
}

// A polygon with its vertices in random order.
TEST(ObjHostileDeathTest, ReadsLargeTangledPolygons) {
  std::mt19937 random(5);
  std::string text;
  for (int i = 0; i < 1000; ++i) text += "v " + std::to_string(random() % 1000) + " " + std::to_string(random() % 1000) + " 0\n";
  text += "f";
  for (int i = 0; i < 300000; ++i) text += " " + std::to_string(random() % 1000 + 1);
  expect_model_or_error(text);
}

TEST(ObjHostileDeathTest, ReadsChangedFiles) {
  const std::string good =
      "mtllib a.mtl\no box\ns 1\nv 0 0 0 1 0 0\nv 1 0 0\nv 1 1e0 0\nv -0.5 1 0 0.5\nvt 0 1\nvt .5 .5\nvn 0 0 1\nusemtl a\nf 1/1/1 2/2/1 "
      "3/1/1 -1/1/1\n"
      "f 1 2 3\ns off\nl 1 2 3\np 1 \\\n2\nf 1//1 2//1 3//1\n# end\n";
  constexpr std::string_view kPieces[] = {"-", "1e999",       "/",  "\n", "\\\n", "\0", "nan",         " ",
                                          "f", "99999999999", "v ", "\r", "#",    ".",  "s 4294967296"};
  std::mt19937 random(11);
  for (int round = 0; round < 20000; ++round) {
    std::string text = good;
    for (int change = static_cast<int>(random() % 4); change >= 0; --change) {
      const std::size_t at = random() % text.size();
      switch (random() % 4) {
        case 0: text.erase(at, random() % 8); break;
        case 1: text.insert(at, kPieces[random() % std::size(kPieces)]); break;
        case 2: text[at] = static_cast<char>(random() % 256); break;
        default: text.insert(at, text.substr(random() % text.size(), random() % 40)); break;
      }
    }
    ASSERT_EQ(problem_of(text, "/none/a.obj"), "") << text;
  }
}

}  // namespace
}  // namespace halfspace
