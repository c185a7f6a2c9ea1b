// SPDX-License-Identifier: Apache-2.0
//
// Simplified meshes of models (model_error), where levels of detail commonly fail: borders between parts, changes of level, seams of
// texture coordinates and skins.
#include <meshoptimizer.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "halfspace/geometry/shapes.h"
#include "halfspace/model/detail/simplified_mesh.h"
#include "halfspace/model/geometry/position_ids.h"
#include "halfspace/reference/silhouettes.h"
#include "halfspace/render/assets/model_asset.h"
#include "halfspace/render/scene_assets.h"
#include "halfspace/scene/scene_file.h"
#include "model/test_meshes.h"
#include "stability/regime.h"
#include "support/workers.h"

namespace halfspace::stability {
namespace {

constexpr int kDetailFiner = 8;  // outlines are measured to an eighth of a pixel
constexpr double kDetailStep = 1.0 / kDetailFiner;

struct DetailSize {
  int width, height;
};

// A scene with one model, which is prepared for one camera after the other.
class ModelScene {
 public:
  explicit ModelScene(Model model) : model_(std::make_shared<const ModelAsset>(std::move(model))), assets_(two_workers()) {
    assets_.add_model("/made/in/memory.obj", model_);
  }

  // camera: keys of a camera. model_error: in pixels.
  PreparedScene prepared(const std::string& camera, double model_error, const DetailSize& size) {
    const SceneFile file = SceneFile::parse(R"({"version": 1, "ambient": 1, "cameras": {"c": {)" + camera + R"(}}, "objects": {"a":
        {"shape": "file", "file": "/made/in/memory.obj", "model_error": )" +
                                                std::to_string(model_error) + "}}}",
                                            "test.json", {});
    return assets_.prepare(file.at(0.0), size.width, size.height);
  }
  const ModelMesh& mesh(std::size_t i) const { return model_->model.meshes[i]; }

 private:
  std::shared_ptr<const ModelAsset> model_;
  SceneAssets assets_;
};

// Returns a model with one node that has all meshes.
Model model_of(std::vector<ModelMesh> meshes) {
  Model model;
  ModelNode& node = model.nodes.emplace_back();
  for (std::size_t i = 0; i < meshes.size(); ++i) node.meshes.push_back(static_cast<int>(i));
  model.meshes = std::move(meshes);
  model.scenes.emplace_back().roots = {0};
  return model;
}

// Replaces the triangles of a mesh of a scene.
void set_triangles(PreparedScene& scene, std::size_t mesh, std::vector<uint32_t> list) {
  struct Owned {
    Owned(std::vector<uint32_t> l, std::size_t vertices) : list(std::move(l)), indices(list, vertices) {}
    std::vector<uint32_t> list;
    Indices indices;
  };
  const auto owned = std::make_shared<const Owned>(std::move(list), scene.meshes[mesh].positions.size());
  scene.meshes[mesh].indices = {owned, &owned->indices};
}

// Returns a simplified list, as meshoptimizer makes it by default: vertices on borders may move along them. `target` is a number of
// indices. `relative` limits the estimated error, in multiples of the longest side of the bounding box.
std::vector<uint32_t> commonly_simplified(const std::vector<glm::vec3>& positions, const std::vector<uint32_t>& indices, std::size_t target,
                                          double relative) {
  std::vector<uint32_t> list(indices.size());
  list.resize(meshopt_simplify(list.data(), indices.data(), indices.size(), &positions[0].x, positions.size(), sizeof(glm::vec3), target,
                               static_cast<float>(relative), 0, nullptr));
  return list;
}

double outline_distance(const PreparedScene& a, const PreparedScene& b) {
  return silhouette_distance(seen_objects(a, kDetailFiner, two_workers()), seen_objects(b, kDetailFiner, two_workers()), kDetailFiner).max;
}

// ---- cracks -----------------------------------------------------------------------------------------------------

// Waves over [−2, 2] x [near, far] in x and −z, as a grid of columns x rows squares.
ModelMesh waves(float near, float far, uint32_t columns, uint32_t rows) {
  ModelMesh mesh;
  for (uint32_t j = 0; j <= rows; ++j) {
    for (uint32_t i = 0; i <= columns; ++i) {
      const float x = -2.0f + 4.0f * static_cast<float>(i) / static_cast<float>(columns);
      const float z = j == rows ? far : near + (far - near) * static_cast<float>(j) / static_cast<float>(rows);
      const double height = 0.15 * std::sin(4.0 * static_cast<double>(x)) * std::cos(3.0 * static_cast<double>(z)) +
                            0.05 * std::sin(11.0 * static_cast<double>(x) + 7.0 * static_cast<double>(z));
      mesh.positions.emplace_back(x, static_cast<float>(height), -z);
      mesh.normals.emplace_back(0.0f, 1.0f, 0.0f);  // colors do not matter
    }
  }
  for (uint32_t j = 0; j < rows; ++j) {
    for (uint32_t i = 0; i < columns; ++i) {
      const uint32_t a = j * (columns + 1) + i, b = a + 1, c = a + columns + 1, d = c + 1;
      mesh.indices.insert(mesh.indices.end(), {a, b, c, b, d, c});
    }
  }
  return mesh;
}

int64_t background_samples(const PreparedScene& scene) {
  return std::ranges::count(seen_objects(scene, kDetailFiner, two_workers()).texels(), 0);
}

TEST(Stability, PartsAtDifferentLevelsHaveNoCracks) {
  // Two squares of 4 units, one behind the other. Together they cover the whole picture.
  constexpr DetailSize kCracksPicture{32, 64};
  constexpr double kAllowed = 1.4;
  const std::string camera = R"("position": [0, 5, 0], "target": [0, 0, -6.59], "fov": 25)";
  ModelScene models(model_of({waves(3.5f, 7.5f, 96, 96), waves(7.5f, 11.5f, 96, 96)}));
  ASSERT_EQ(background_samples(models.prepared(camera, 0.0, kCracksPicture)), 0);
  PreparedScene scene = models.prepared(camera, kAllowed, kCracksPicture);
  std::array<double, 2> share{};
  for (std::size_t i = 0; i < 2; ++i)
    share[i] = static_cast<double>(scene.meshes[i].indices->size()) / static_cast<double>(models.mesh(i).indices.size());
  EXPECT_LT(share[1], 0.8 * share[0]) << "the levels must differ";
  EXPECT_LT(share[0], 0.5);
  const int64_t ours = background_samples(scene);
  // Half of the error, at the nearest depth of a ball around the part.
  for (std::size_t i = 0; i < 2; ++i) {
    const double unit_px = pixels_per_unit(scene.view, {0.0, 0.0, i == 0 ? -5.5 : -9.5}, 2.0 * std::numbers::sqrt2);
    set_triangles(scene, i, commonly_simplified(models.mesh(i).positions, models.mesh(i).indices, 0, 0.5 * kAllowed / unit_px / 4.0));
  }
  // Both parts keep all vertices of the border, with the same positions, so each sample is on one side of it.
  record_and_check(
      {29, "cracks between levels of detail",
       "two parts of a landscape that share a border, at different levels, model_error 1.4 px; each part simplified alone with half "
       "of that error vs. with all vertices of its border",
       "samples between the parts that show the background, 64 per pixel"},
      static_cast<double>(background_samples(scene)), 20, static_cast<double>(ours), 0);
}

// ---- popping ----------------------------------------------------------------------------------------------------

TEST(Stability, LevelsOfDetailDoNotPop) {
  constexpr DetailSize kStonePicture{320, 180};
  constexpr double kAllowed = 0.25, kStart = 3.5, kTimes = 32.0;
  constexpr int kFrames = 61;
  ModelScene models(model_of({stone(80, 40)}));
  const ModelMesh& mesh = models.mesh(0);
  // Common levels: each has a quarter of the triangles of the one before, and is used from twice its distance on.
  const auto level_at = [](double distance) { return static_cast<int>(std::floor(std::log2(distance / kStart) + 1e-9)); };
  const auto common_triangles = [&](int level) {
    return level == 0 ? mesh.indices : commonly_simplified(mesh.positions, mesh.indices, mesh.indices.size() >> 2 * level, 1.0);
  };
  double common = 0.0, ours = 0.0;
  int changes = 0;
  PreparedScene before;
  for (int i = 0; i < kFrames; ++i) {
    const auto distance_in = [&](int frame) { return kStart * std::pow(kTimes, static_cast<double>(frame) / (kFrames - 1)); };
    PreparedScene scene = models.prepared("\"position\": [0, 0, " + std::to_string(distance_in(i)) + "]", kAllowed, kStonePicture);
    if (i > 0 && before.meshes[0].indices != scene.meshes[0].indices) {
      PreparedScene with_old = scene;
      with_old.meshes[0].indices = before.meshes[0].indices;
      ours = std::max(ours, outline_distance(with_old, scene));
      ++changes;
    }
    if (i > 0 && level_at(distance_in(i)) != level_at(distance_in(i - 1))) {
      PreparedScene with_old = scene, with_new = scene;
      set_triangles(with_old, 0, common_triangles(level_at(distance_in(i - 1))));
      set_triangles(with_new, 0, common_triangles(level_at(distance_in(i))));
      common = std::max(common, outline_distance(with_old, with_new));
    }
    before = std::move(scene);
  }
  EXPECT_GE(changes, 2) << "the level must change";
  // The outlines of both levels are within model_error of the exact one: the old level was so in a nearer view. They are
  // measured to 1/8 px.
  record_and_check(
      {30, "popping of levels of detail",
       "a stone that moves away to 32 times its distance in 61 frames, model_error 0.25 px; a quarter of the triangles at each "
       "doubling of the distance vs. levels chosen by their error",
       "largest distance, in pixels, between the outlines of a frame with its own triangles and with those of the frame before"},
      common, 0.75, ours, 2.0 * kAllowed + kDetailStep);
}

// ---- seams of texture coordinates --------------------------------------------------------------------------------

// Returns how far a texture is displaced on a unit sphere with the coordinates of uv_sphere: the largest distance on the sphere, within 30
// degrees of the equator and 15 degrees of the seam, between a point of a triangle and the point to which its texture coordinates belong.
double texture_drift(const Mesh& ball, const std::vector<uint32_t>& indices) {
  constexpr int kParts = 16;  // of the side of a triangle
  constexpr double kTurn = 2.0 * std::numbers::pi;
  double largest = 0.0;
  for (std::size_t t = 0; t + 2 < indices.size(); t += 3) {
    for (int i = 0; i <= kParts; ++i) {
      for (int j = 0; i + j <= kParts; ++j) {
        const std::array weights{static_cast<double>(i) / kParts, static_cast<double>(j) / kParts,
                                 static_cast<double>(kParts - i - j) / kParts};
        glm::dvec3 p(0.0);
        glm::dvec2 uv(0.0);
        for (std::size_t k = 0; k < 3; ++k) {
          p += weights[k] * glm::dvec3(ball.positions[indices[t + k]]);
          uv += weights[k] * glm::dvec2(ball.uvs[indices[t + k]]);
        }
        const double latitude = std::asin(p.y / glm::length(p)), longitude = std::atan2(-p.z, p.x);
        if (std::abs(latitude) > kTurn / 12 || std::abs(longitude) > kTurn / 24) continue;
        const double du = uv.x - longitude / kTurn, dv = uv.y - (0.5 - latitude / (0.5 * kTurn));
        const double east = kTurn * (du - std::round(du)) * std::cos(latitude), south = 0.5 * kTurn * dv;  // the texture repeats
        largest = std::max(largest, std::sqrt(east * east + south * south));
      }
    }
  }
  return largest;
}

TEST(Stability, TextureSeamsDoNotDrift) {
  constexpr DetailSize kGlobePicture{96, 96};
  constexpr double kAllowed = 0.5;
  const Mesh ball = uv_sphere(64, 128, 1.0f);
  ModelMesh mesh;
  mesh.positions = ball.positions;
  mesh.normals = ball.normals;
  mesh.uvs[0] = ball.uvs;
  mesh.indices = ball.indices;
  ModelScene models(model_of({mesh}));
  // The seam is at +x, in the middle of the picture.
  const PreparedScene scene = models.prepared(R"("position": [6, 0, 0], "fov": 45)", kAllowed, kGlobePicture);
  const Indices& drawn = *scene.meshes[0].indices;
  std::vector<uint32_t> list;
  for (std::size_t i = 0; i < drawn.size(); ++i) list.push_back(drawn[i]);
  ASSERT_LT(list.size(), ball.indices.size() / 2);
  // Common: the vertices of a position are joined, so that each has the texture coordinates of one side of the seam.
  const std::vector<uint32_t> ids = position_ids(ball.positions);
  std::vector<uint32_t> joined;
  for (const uint32_t i : ball.indices) joined.push_back(ids[i]);
  const double unit_px = pixels_per_unit(scene.view, glm::dvec3(0.0), 1.0);
  const double common = unit_px * texture_drift(ball, commonly_simplified(ball.positions, joined, 0, 0.25 * kAllowed / unit_px));
  // Along a great circle, the second derivative of latitude and longitude, as a displacement, is at most 2/√3·tan φ at the latitude φ. On a
  // triangle in a circle of the angle ρ, linear interpolation errs by at most ½ρ² times that (S. Waldron, "The error in linear
  // interpolation at the vertices of a simplex", 1998). The middle of the circle is ½ρ² below the sphere, which is at most the error of the
  // mesh. So the drift is at most 2/√3·tan φ times the error. Triangles that begin at 30 degrees end below 50 degrees,
  // where this is 1.4 times.
  record_and_check(
      {31, "drift of texture seams",
       "the seam of a globe of 16,128 triangles, model_error 0.5 px; simplified after the vertices of each position are joined vs. "
       "with both sides of the seam",
       "largest displacement of the texture near the seam, in pixels"},
      common, 10.0, unit_px * texture_drift(ball, list), 1.4 * kAllowed);
}

// ---- skins ------------------------------------------------------------------------------------------------------

// A tube of radius ½ around the y axis, from y = 0 to 4, with two joints that meet at y = 2.
Model bent_tube(double degrees) {
  constexpr uint32_t kColumns = 64, kRows = 64;
  ModelMesh mesh;
  for (uint32_t j = 0; j <= kRows; ++j) {
    const double y = 4.0 * j / kRows, t = std::clamp(y - 1.5, 0.0, 1.0);
    const auto second = static_cast<float>(t * t * (3.0 - 2.0 * t));
    for (uint32_t i = 0; i < kColumns; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / kColumns;
      mesh.positions.emplace_back(0.5 * std::cos(angle), y, -0.5 * std::sin(angle));
      mesh.normals.emplace_back(std::cos(angle), 0.0, -std::sin(angle));
      mesh.joints.push_back({0, 1, 0, 0});
      mesh.weights.emplace_back(1.0f - second, second, 0.0f, 0.0f);
      if (j == kRows) continue;
      const uint32_t a = j * kColumns + i, b = j * kColumns + (i + 1) % kColumns, c = a + kColumns, d = b + kColumns;
      mesh.indices.insert(mesh.indices.end(), {a, b, c, b, d, c});
    }
  }
  Model model = model_of({std::move(mesh)});
  ModelSkin& skin = model.skins.emplace_back();
  skin.joints = {1, 2};
  skin.joint_from_mesh = {glm::dmat4(1.0), glm::dmat4(1.0)};
  skin.joint_from_mesh[1][3] = {0, -2, 0, 1};
  model.nodes.resize(3);
  model.nodes[0].skin = 0;
  model.nodes[1].children = {2};
  model.nodes[2].transform.translation = {0, 2, 0};
  const double half = degrees * std::numbers::pi / 360.0;
  model.nodes[2].transform.rotation = glm::dquat(std::cos(half), 0.0, 0.0, std::sin(half));
  model.scenes[0].roots = {0, 1};
  return model;
}

TEST(Stability, SkinnedMeshesStayExact) {
  constexpr DetailSize kTubePicture{96, 54};
  constexpr double kAllowed = 0.5;
  const std::string camera = R"("position": [0, 2, 12], "target": [0, 2, 0], "fov": 30)";
  ModelScene models(bent_tube(100.0));
  const PreparedScene exact = models.prepared(camera, 0.0, kTubePicture), scene = models.prepared(camera, kAllowed, kTubePicture);
  EXPECT_TRUE(scene.meshes[0].deformed);
  // Common: a level whose error is at most that many pixels in the pose of the file, in which the tube is straight.
  const ModelMesh& mesh = models.mesh(0);
  const double unit_px = pixels_per_unit(scene.view, {0, 2, 0}, 2.2);
  const OriginalMesh original({mesh.positions, mesh.indices});
  SimplifiedMesh level;
  for (int step = kCoarsestDetail; step == kCoarsestDetail || level.error * unit_px > kAllowed; ++step)
    level = simplified(original, step, two_workers());
  PreparedScene common = scene;
  set_triangles(common, 0, std::move(level.indices));
  // All triangles are drawn, so the outlines are equal.
  record_and_check(
      {32, "levels of detail of skinned meshes",
       "a tube that a skin bends by 100 degrees, model_error 0.5 px; a level within that error before the skin is applied vs. all "
       "triangles",
       "largest distance to the outline of the exact mesh, in pixels"},
      outline_distance(common, exact), 2.0, outline_distance(scene, exact), 0);
}

}  // namespace
}  // namespace halfspace::stability
