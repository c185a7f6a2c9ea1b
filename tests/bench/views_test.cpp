// SPDX-License-Identifier: Apache-2.0
//
// Checks what the scenes of the views contain, and which objects they leave out. The towns and the sculptures are smaller than those of the
// benchmark. peers_test.cpp compares the pictures with OpenGL.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "scenes/mesh_order.h"
#include "scenes/scene_kinds.h"
#include "scenes/scene_plants.h"
#include "scenes/sculptures.h"
#include "scenes/shadow_map_use.h"
#include "scenes/street_parts.h"
#include "workloads/workload_assets.h"

namespace halfspace {

namespace {

constexpr WorkloadSize kFullSize{1920, 1080};
constexpr TownSize kSmallTown{8, 2};

std::size_t triangles(const SceneShape& shape) { return shape.indices.size() / 3; }

std::size_t triangles(const street::HouseShape& house) {
  return triangles(house.walls) + triangles(house.trim) + triangles(house.roof) + triangles(house.wood) + triangles(house.glass) +
         triangles(house.plants);
}

TEST(Views, HaveDifferentNames) {
  std::set<std::string> names;
  for (const SceneRow& row : view_rows()) names.insert(row.name);
  EXPECT_EQ(names.size(), view_rows().size());
}

TEST(Views, SculpturesHaveTheRequestedNumberOfTriangles) {
  constexpr int kTriangles = 20'000;
  for (const auto& sculpture : {statue, bust, vase, boulder, shell}) {
    // The sides of each grid are rounded.
    EXPECT_NEAR(static_cast<double>(triangles(sculpture(kTriangles))), kTriangles, 0.03 * kTriangles);
  }
}

// The numbers of triangles of the houses have a standard deviation of 12%, mainly because they have 3 to 5 floors. The mean of 20 houses
// therefore has one of 2.6%, half of the tolerance.
TEST(Views, TheTownHasTwoMillionTriangles) {
  constexpr uint32_t kSample = 20;
  double sum = 0;
  for (uint32_t i = 0; i < kSample; ++i) sum += static_cast<double>(triangles(street::house_shape(street::house_options(i))));
  EXPECT_NEAR(sum / kSample * kTownSize.columns * kTownSize.rows, 2e6, 0.05 * 2e6);
}

TEST(Views, DistantModelsAreSixtyPixelsHigh) {
  const Scene scene = make_far(2000);
  const SceneView view = scene_view(scene, scene.cameras[0], kFullSize);
  int models = 0;
  for (const SceneObject& object : scene.objects) {
    const SceneMesh& mesh = scene.mesh(object);
    if (mesh.count < 3000) continue;  // a terrace
    const auto row_of = [&](double y) {
      const glm::dvec3 middle = mesh.center();
      const glm::dvec4 p = glm::dmat4(view.clip_from_world) * object.world_from_object * glm::dvec4(middle.x, y, middle.z, 1.0);
      return 0.5 * kFullSize.height * p.y / p.w;
    };
    if (scene.material(object).surface != SceneSurface::opaque || mesh.high.y - mesh.low.y < 0.1) continue;  // the ground, the sky
    EXPECT_NEAR(row_of(mesh.high.y) - row_of(mesh.low.y), 60.0, 6.0) << "mesh " << object.mesh;
    ++models;
  }
  EXPECT_EQ(models, 40);
}

TEST(Views, TurnHasACircleOfCameras) {
  const Scene scene = make_turn(2000);
  ASSERT_EQ(scene.cameras.size(), 36u);
  for (std::size_t i = 0; i < scene.cameras.size(); ++i) {
    const glm::dvec3 a = scene.cameras[i].eye, b = scene.cameras[(i + 1) % scene.cameras.size()].eye;
    EXPECT_NEAR(glm::length(glm::dvec2(a.x, a.z)), 25.0, 1e-9);
    EXPECT_NEAR(glm::length(a - b), 50.0 * std::sin(std::numbers::pi / 36), 1e-9);
  }
}

bool is_inside(const glm::dvec4& p) { return glm::all(glm::lessThanEqual(glm::abs(glm::dvec3(p)), glm::dvec3(p.w))); }

// Returns the number of objects that are not in `drawn`, and checks that all their vertices are outside of the clip volume.
std::size_t check_left_out(const Scene& scene, const std::vector<std::size_t>& drawn, const glm::mat4& clip_from_world) {
  const std::set<std::size_t> kept(drawn.begin(), drawn.end());
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    if (kept.contains(i)) continue;
    const SceneMesh& mesh = scene.mesh(scene.objects[i]);
    const glm::dmat4 clip_from_object = glm::dmat4(clip_from_world) * scene.objects[i].world_from_object;
    for (uint32_t k = mesh.first; k < mesh.first + mesh.count; ++k) {
      const glm::dvec3 position(scene.vertices[scene.indices[k]].position);
      if (is_inside(clip_from_object * glm::dvec4(position, 1.0))) {
        ADD_FAILURE() << "object " << i << " is visible";
        break;
      }
    }
  }
  return scene.objects.size() - kept.size();
}

TEST(Views, LeaveOutOnlyObjectsOutsideOfTheView) {
  Scene scene = make_street(kSmallTown);
  scene.light.shadow_center = {-20, 4, 0};
  scene.light.shadow_radius = 20;
  const SceneView view = scene_view(scene, scene.cameras[0], kFullSize);
  EXPECT_GT(check_left_out(scene, view.order, view.clip_from_world), 6u);
  std::vector<std::size_t> casters = view.casters;
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    if (scene.material(scene.objects[i]).surface > SceneSurface::cutout) casters.push_back(i);
  }
  EXPECT_GT(check_left_out(scene, casters, view.light_from_world), 6u);
}

TEST(Views, DrawOpaqueObjectsFromFrontToBack) {
  const Scene scene = make_street(kSmallTown);
  const SceneView view = scene_view(scene, scene.cameras[0], kFullSize);
  SceneSurface last_surface = SceneSurface::opaque;
  double last = 0;
  for (const std::size_t i : view.order) {
    const SceneObject& object = scene.objects[i];
    const SceneSurface surface = scene.material(object).surface;
    EXPECT_GE(surface, last_surface);
    if (surface != last_surface) last = 0;
    last_surface = surface;
    const glm::dvec3 center(object.world_from_object * glm::dvec4(scene.mesh(object).center(), 1.0));
    const double distance = glm::length(center - scene.cameras[0].eye);
    EXPECT_GE(distance, last - 1e-9);
    last = distance;
  }
}

TEST(Views, TrianglesAreOrderedByCells) {
  SceneShape shape = ground_plane(64.0, 64);
  const std::size_t count = shape.indices.size(), vertices = shape.vertices.size();
  order_by_cells(shape);
  ASSERT_EQ(shape.indices.size(), count);
  ASSERT_EQ(shape.vertices.size(), vertices);
  uint32_t next = 0;
  for (std::size_t k = 0; k < count; ++k) {
    EXPECT_LE(shape.indices[k], next);  // vertices are numbered by their first use
    if (shape.indices[k] == next) ++next;
    // In Morton order, each quarter of the triangles fills a quadrant.
    const glm::vec3 p = shape.vertices[shape.indices[k]].position;
    const std::size_t quarter = 4 * k / count;
    EXPECT_TRUE(quarter % 2 == 0 ? p.x <= 0 : p.x >= 0) << k;
    EXPECT_TRUE(quarter / 2 == 0 ? p.z <= 0 : p.z >= 0) << k;
  }
  EXPECT_EQ(next, vertices);
}

// The camera of `detail` sees the head of a statue with a million triangles, at most half of them from the front.
TEST(GeometryUse, OfAStatueThatFillsThePicture) {
  WorkloadAssets assets;
  const auto detail = std::ranges::find(view_workloads(), "detail", &WorkloadKind::name);
  const std::unique_ptr<Workload> workload = detail->prepare({192, 108}, assets);
  workload->frame(Workers(1));
  const GeometryUse use = workload->geometry_use().value();
  EXPECT_GT(use.triangles, 900'000u);
  EXPECT_GT(use.skipped_triangles, use.triangles / 2);
  EXPECT_GT(use.binned_triangles, 0u);
  EXPECT_LT(use.binned_triangles, use.triangles - use.skipped_triangles);
  EXPECT_GT(use.shaded_vertices, 0u);
  EXPECT_LT(use.shaded_vertices, use.vertices / 2);
  EXPECT_LT(use.vertices, use.triangles) << "a mesh has about half as many vertices as triangles";
}

// A picture of 4 x 4 pixels, seen by the light as by the camera, on a map of 256 x 256 texels. The center of the first pixel, at the top
// left, falls on texel (32, 31).
TEST(ShadowMapUse, CountsTheTexelsOfTheFilter) {
  const glm::dmat4 same(1.0);
  Image<float> depth(4, 4), map(256, 256);
  std::fill_n(depth.data(), depth.texels().size(), 0.5f);
  std::fill_n(map.data(), map.texels().size(), 1.0f);
  const ShadowMapUse all = shadow_map_use(depth, same, same, map);
  EXPECT_EQ(all.texels, 256 * 256);
  EXPECT_EQ(all.read_texels, 16 * 9);
  EXPECT_EQ(all.tiles, 16);
  EXPECT_EQ(all.read_tiles, 16);
  EXPECT_EQ(all.filled_tiles, 0);

  std::fill_n(depth.data(), depth.texels().size(), 1.0f);
  depth.at(0, 0) = 0.5f;
  map.at(10, 200) = 0.3f;  // another tile
  const ShadowMapUse first = shadow_map_use(depth, same, same, map);
  EXPECT_EQ(first.read_texels, 9);
  EXPECT_EQ(first.read_tiles, 1);
  EXPECT_EQ(first.filled_tiles, 1);
  EXPECT_EQ(first.read_filled_tiles, 0);
  map.at(10, 20) = 0.3f;
  EXPECT_EQ(shadow_map_use(depth, same, same, map).read_filled_tiles, 1);
}

// A filter at the edge reads only texels of the map.
TEST(ShadowMapUse, ClampsFiltersToTheMap) {
  Image<float> depth(1, 1), map(64, 64);
  depth.at(0, 0) = 0.5f;
  glm::dmat4 light_from_world(1.0);
  light_from_world[3] = {1.5, 0, 0, 1};
  EXPECT_EQ(shadow_map_use(depth, glm::dmat4(1.0), light_from_world, map).read_texels, 3);
}

}  // namespace

}  // namespace halfspace
