// SPDX-License-Identifier: Apache-2.0
//
// Distances between surfaces are compared with closed forms. Simplified meshes must be within their error, and must have no gaps where the
// original has none.
#include "halfspace/model/detail/simplified_mesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <random>
#include <string>

#include "halfspace/model/geometry/position_ids.h"
#include "model/test_meshes.h"
#include "support/files.h"
#include "support/workers.h"

namespace halfspace {
namespace {

double length_of(const glm::dvec3& v) { return std::sqrt(glm::dot(v, v)); }

// ---- the distance to a triangle ----------------------------------------------------------------------------------

// The triangle (0, 0), (4, 0), (0, 3) in the plane z = 0. Each point is nearest to a different part of it.
TEST(TriangleTree, DistanceToEachPartOfATriangle) {
  const std::vector<glm::vec3> positions{{0, 0, 0}, {4, 0, 0}, {0, 3, 0}};
  const std::vector<uint32_t> indices{0, 1, 2};
  const TriangleTree tree(positions, indices);
  const auto distance = [&](const glm::dvec3& p) { return std::sqrt(tree.distance_squared(p, 0)); };
  EXPECT_EQ(distance({1, 1, 2}), 2.0) << "inside";
  EXPECT_EQ(distance({-3, -4, 0}), 5.0) << "first corner";
  EXPECT_EQ(distance({7, -4, 0}), 5.0) << "second corner";
  EXPECT_EQ(distance({-3, 7, 0}), 5.0) << "third corner";
  EXPECT_EQ(distance({2, -4, 3}), 5.0) << "first side";
  EXPECT_EQ(distance({-4, 2, 3}), 5.0) << "third side";
  EXPECT_NEAR(distance({2 + 3, 1.5 + 4, 0}), 5.0, 1e-15) << "long side, whose normal is (3, 4) / 5";
}

// A triangle without an area is a segment or a point.
TEST(TriangleTree, DistanceToThinTriangles) {
  const std::vector<glm::vec3> positions{{0, 0, 0}, {4, 0, 0}, {2, 0, 0}};
  const std::vector<uint32_t> indices{0, 1, 2, 1, 1, 1};
  const TriangleTree tree(positions, indices);
  EXPECT_EQ(tree.distance_squared({3, 2, 0}, 0), 4.0);
  EXPECT_EQ(tree.distance_squared({4, 2, 0}, 1), 4.0);
}

TEST(TriangleTree, FindsTheNearestOfAllTriangles) {
  std::mt19937 random(1);
  const auto coordinate = [&] { return static_cast<float>(random() % 1000) * 0.01f; };
  std::vector<glm::vec3> positions(300);
  for (glm::vec3& p : positions) p = {coordinate(), coordinate(), coordinate()};
  std::vector<uint32_t> indices(600);
  for (uint32_t& i : indices) i = static_cast<uint32_t>(random() % positions.size());
  const TriangleTree tree(positions, indices);
  for (int i = 0; i < 100; ++i) {
    const glm::dvec3 p(coordinate(), coordinate(), coordinate());
    double least = INFINITY;
    for (uint32_t t = 0; t < 200; ++t) least = std::min(least, tree.distance_squared(p, t));
    int64_t visits = 1000;
    const TriangleTree::Nearest found = tree.nearest(p, static_cast<uint32_t>(random() % 200), visits);
    EXPECT_EQ(found.squared, least);
    EXPECT_EQ(tree.distance_squared(p, found.triangle), least);
    int64_t few = 3;
    const TriangleTree::Nearest early = tree.nearest(p, 7, few);
    EXPECT_GE(early.squared, least);
    EXPECT_LE(early.squared, tree.distance_squared(p, 7));
    EXPECT_EQ(tree.distance_squared(p, early.triangle), early.squared);
    EXPECT_EQ(few, 0);
  }
}

// ---- the distance between surfaces -------------------------------------------------------------------------------

// A square of n² cells in the plane z = height.
ModelMesh square(uint32_t n, float height) {
  ModelMesh mesh;
  for (uint32_t y = 0; y <= n; ++y) {
    for (uint32_t x = 0; x <= n; ++x)
      mesh.positions.emplace_back(static_cast<float>(x) / static_cast<float>(n), static_cast<float>(y) / static_cast<float>(n), height);
  }
  for (uint32_t y = 0; y < n; ++y) {
    for (uint32_t x = 0; x < n; ++x) {
      const uint32_t i = y * (n + 1) + x;
      mesh.indices.insert(mesh.indices.end(), {i, i + 1, i + n + 2, i, i + n + 2, i + n + 1});
    }
  }
  return mesh;
}

double bound_of(const ModelMesh& from, const ModelMesh& to, double resolution) {
  return distance_bound({from.positions, from.indices}, TriangleTree(to.positions, to.indices), resolution, one_worker());
}

TEST(SurfaceDistance, OfParallelSquares) {
  for (const auto& [from, to] : {std::pair(1u, 13u), {13u, 1u}, {7u, 13u}}) {
    const double bound = bound_of(square(from, 0.0f), square(to, 0.25f), 0.0);
    EXPECT_GE(bound, 0.25);
    EXPECT_LE(bound, 1.5 * 0.25);
  }
}

TEST(SurfaceDistance, OfEqualSurfaces) {
  EXPECT_LE(bound_of(sphere(12, 7), sphere(12, 7), 0.0), 1e-15) << "rounding";
  EXPECT_LE(bound_of(square(5, 0.0f), square(7, 0.0f), 0.01), 0.01);
}

// The corners of the square lie on the tent, so the largest distance is inside of its two triangles. The foot of the peak (½, ½, h) is at
// h·cos a from the slopes, where tan a = 2h.
TEST(SurfaceDistance, InsideOfATriangle) {
  ModelMesh tent = square(1, 0.0f);
  tent.positions.emplace_back(0.5f, 0.5f, 0.25f);
  tent.indices = {0, 1, 4, 1, 3, 4, 3, 2, 4, 2, 0, 4};
  const double exact = 0.25 / std::sqrt(1.0 + 0.25);
  const double bound = bound_of(square(1, 0.0f), tent, 0.0);
  EXPECT_GE(bound, exact);
  EXPECT_LE(bound, 1.5 * exact);
}

// ---- simplified meshes -------------------------------------------------------------------------------------------

// For every edge between two positions, the number of triangles that use it in one direction minus those that use it in the other. Edges of
// which no side is left open are not listed, so the list of a mesh without gaps is empty.
std::map<std::pair<uint32_t, uint32_t>, int> open_edges(std::span<const glm::vec3> positions, std::span<const uint32_t> indices) {
  const std::vector<uint32_t> ids = position_ids(positions);
  std::map<std::pair<uint32_t, uint32_t>, int> open;
  for (std::size_t i = 0; i < indices.size(); i += 3) {
    for (std::size_t k = 0; k < 3; ++k) {
      const uint32_t a = ids[indices[i + k]], b = ids[indices[i + (k + 1) % 3]];
      if (a != b) open[std::minmax(a, b)] += a < b ? 1 : -1;
    }
  }
  std::erase_if(open, [](const auto& edge) { return edge.second == 0; });
  return open;
}

SimplifiedMesh simplified(const ModelMesh& mesh, int step, const Workers& workers = one_worker()) {
  return simplified(OriginalMesh({mesh.positions, mesh.indices}), step, workers);
}

// The vertices of both meshes lie on the unit sphere. A point of a triangle is 1 − |p| from the sphere, and the center of a triangle is
// farther from it than its corners.
TEST(SimplifiedMesh, ErrorOfASphere) {
  const ModelMesh original = sphere(64, 32);
  const auto depth = [&](std::span<const uint32_t> indices) {
    double deepest = 0.0;
    for (std::size_t i = 0; i < indices.size(); i += 3) {
      const auto corner = [&](std::size_t k) { return glm::dvec3(original.positions[indices[i + k]]); };
      const glm::dvec3 n = glm::cross(corner(1) - corner(0), corner(2) - corner(0));
      deepest = std::max(deepest, 1.0 - length_of((corner(0) + corner(1) + corner(2)) / 3.0));
      EXPECT_GT(glm::dot(n, corner(0)), 0.0) << "faces inwards";
    }
    return deepest;
  };
  for (const int step : {4, 6}) {
    const SimplifiedMesh simple = simplified(original, step);
    EXPECT_LT(simple.indices.size(), original.indices.size() / 2);
    const double deepest = depth(simple.indices), known = depth(original.indices);
    EXPECT_GE(simple.error, deepest - known) << step;
    EXPECT_LE(simple.error, 3.0 * detail_tolerance(2.0, step)) << "meshoptimizer aims at half of the tolerance";
  }
  EXPECT_GT(simplified(original, 6).indices.size(), simplified(original, 4).indices.size());
}

TEST(SimplifiedMesh, APlaneKeepsItsBorder) {
  const ModelMesh plane = square(16, 0.0f);
  const SimplifiedMesh simple = simplified(plane, 8);
  EXPECT_LE(simple.error, detail_tolerance(1.0, 8));
  EXPECT_LT(simple.indices.size(), plane.indices.size() / 3);
  EXPECT_EQ(open_edges(plane.positions, simple.indices), open_edges(plane.positions, plane.indices));
}

// Gives each group of triangles its own vertices.
template <class F>
ModelMesh split(const ModelMesh& mesh, const F& group_of) {
  ModelMesh out;
  std::map<std::pair<uint32_t, int>, uint32_t> vertices;
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
    const glm::vec3 sum = mesh.positions[mesh.indices[i]] + mesh.positions[mesh.indices[i + 1]] + mesh.positions[mesh.indices[i + 2]];
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [found, is_new] = vertices.try_emplace({mesh.indices[i + k], group_of(sum)}, static_cast<uint32_t>(out.positions.size()));
      if (is_new) out.positions.push_back(mesh.positions[mesh.indices[i + k]]);
      out.indices.push_back(found->second);
    }
  }
  return out;
}

// Texture seams and hard edges: vertices with different attributes at the same position.
TEST(SimplifiedMesh, SeamsStayClosed) {
  const ModelMesh original = sphere(64, 32);
  const auto halves = [](const glm::vec3& p) { return p.x > 0.0f ? 1 : 0; };
  const auto eighths = [](const glm::vec3& p) { return (p.x > 0.0f ? 1 : 0) + (p.y > 0.0f ? 2 : 0) + (p.z > 0.0f ? 4 : 0); };
  for (const ModelMesh& mesh : {split(original, halves), split(original, eighths)}) {
    ASSERT_GT(mesh.positions.size(), original.positions.size());
    ASSERT_TRUE(open_edges(mesh.positions, mesh.indices).empty());
    for (const int step : {3, 5, 7}) {
      const SimplifiedMesh simple = simplified(mesh, step);
      EXPECT_LT(simple.indices.size(), mesh.indices.size());
      EXPECT_TRUE(open_edges(mesh.positions, simple.indices).empty()) << step;
    }
  }
}

// The parts of a model that have different materials are different meshes.
TEST(SimplifiedMesh, PartsStillMeet) {
  ModelMesh whole = sphere(64, 32), part = whole;
  part.indices.resize(whole.indices.size() / 3 / 2 * 3);
  const SimplifiedMesh simple = simplified(part, 4);
  EXPECT_LT(simple.indices.size(), part.indices.size() / 2);
  EXPECT_EQ(open_edges(part.positions, simple.indices), open_edges(part.positions, part.indices));
}

TEST(SimplifiedMesh, IsTheSameForAnyNumberOfThreads) {
  const ModelMesh original = sphere(64, 32);
  const SimplifiedMesh one = simplified(original, 5), two = simplified(original, 5, two_workers());
  EXPECT_EQ(one.indices, two.indices);
  EXPECT_EQ(one.error, two.error);
}

// Random points of a surface, by a search through all triangles, without the tree and without bounds.
void expect_within(const TriangleList& from, const TriangleList& to, double error, const std::string& name) {
  std::mt19937 random(1);
  const auto share = [&] { return static_cast<double>(random()) / 4294967296.0; };
  const TriangleTree tree(to.positions, to.indices);
  for (int sample = 0; sample < 20; ++sample) {
    const std::size_t i = random() % (from.indices.size() / 3) * 3;
    const double u = share(), v = share() * (1.0 - u);
    const auto corner = [&](std::size_t k) { return glm::dvec3(from.positions[from.indices[i + k]]); };
    const glm::dvec3 p = corner(0) + u * (corner(1) - corner(0)) + v * (corner(2) - corner(0));
    double squared = INFINITY;
    for (uint32_t t = 0; t < to.indices.size() / 3; ++t) squared = std::min(squared, tree.distance_squared(p, t));
    EXPECT_LE(std::sqrt(squared), error) << name;
  }
}

TEST(SimplifiedMesh, FilesStayWithinTheError) {
  for (const char* name : {"meshes/suzanne.obj", "meshes/cow.obj", "gltf/Duck/glTF-Binary/Duck.glb"}) {
    const std::filesystem::path file = shared_data(name);
    if (!std::filesystem::exists(file)) GTEST_SKIP() << absent(file);
    for (const ModelMesh& mesh : read_model(file).meshes) {
      if (mesh.topology != MeshTopology::triangles || mesh.indices.empty()) continue;
      const TriangleList all{mesh.positions, mesh.indices};
      const SimplifiedMesh simple = simplified(mesh, 6);
      const TriangleList left{mesh.positions, simple.indices};
      EXPECT_LT(simple.indices.size(), mesh.indices.size()) << name;
      EXPECT_EQ(open_edges(mesh.positions, simple.indices), open_edges(mesh.positions, mesh.indices)) << name;
      expect_within(all, left, simple.error, name);
      expect_within(left, all, simple.error, name);
    }
  }
}

// ---- the version of the results ------------------------------------------------------------------------------------

// A cache must not return meshes of another version of the shared library.
TEST(SimplifiedMesh, VersionContainsTheSizeOfTheLibrary) {
  std::ifstream maps("/proc/self/maps");
  std::string path, line;
  while (path.empty() && std::getline(maps, line)) {
    const std::size_t start = line.find('/');
    if (start != std::string::npos && line.find("libmeshoptimizer", start) != std::string::npos) path = line.substr(start);
  }
  if (path.empty()) GTEST_SKIP() << "meshoptimizer is not a shared library";
  EXPECT_NE(detail_version().find(" " + std::to_string(std::filesystem::file_size(path)) + " "), std::string::npos) << detail_version();
}

}  // namespace
}  // namespace halfspace
