// SPDX-License-Identifier: Apache-2.0
//
// Compares the values of a frame with rays through the pixel centers. Hits are computed in double precision.
#include "halfspace/render/frame/frame.h"

#include <gtest/gtest.h>

#include "halfspace/reference/ray_scene.h"
#include "halfspace/render/scene_assets.h"
#include "halfspace/scene/scene_file.h"
#include "support/workers.h"

namespace halfspace {
namespace {

constexpr int kValuesWidth = 240, kValuesHeight = 160;

constexpr const char* kSolids = R"({"version": 1, "samples": 4,
  "cameras": {"c": {"position": [3, 2.5, 5], "target": [0, 0.3, 0], "fov": 40, "near": 0.5}}, "lights": {"l": {"direction": [1, 2, 1]}},
  "objects": {"floor": {"shape": "plane", "size": 8, "position": [0, -1, 0]},
              "cubes": {"shape": "cube", "instances": [{"position": [-1.2, 0, 0], "rotation": [20, 30, 0]},
                                                       {"position": [0.2, 1.4, -1], "scale": [0.5, 0.7, -0.5]}]},
              "ball": {"shape": "uv_sphere", "latitudes": 24, "longitudes": 48, "position": [1.4, -0.2, 0.5], "scale": [0.8, 0.8, 0.8]},
              "knot": {"shape": "torus_knot", "position": [-2, 1.5, -3]},
              "round": {"shape": "sphere", "radius": 0.4, "instances": [{"position": [0.3, -0.5, 1.8]}, {"position": [0.4, 0.5, 1.2]}]}}})";

// The hit of a pixel's ray.
struct ValueTruth {
  RayHit hit;
  glm::dvec3 direction;
};

class FrameValues : public testing::Test {
 protected:
  FrameValues()
      : scene_(assets_.prepare(SceneFile::parse(kSolids, "test", ".").description(), kValuesWidth, kValuesHeight)),
        rays_(scene_.meshes, scene_.view.eye_ws, false, scene_.spheres) {
    render_frame(scene_,
                 {.depth = &depth_,
                  .distance = &distance_,
                  .normal = &normal_,
                  .camera_normal = &camera_normal_,
                  .position = &position_,
                  .object = &object_,
                  .instance = &instance_,
                  .triangle = &triangle_,
                  .barycentrics = &barycentrics_},
                 two_workers());
  }

  std::optional<ValueTruth> truth_at(int x, int y) const {
    const View& v = scene_.view;
    const double u = (x + 0.5) / kValuesWidth * 2 - 1, w = 1 - (y + 0.5) / kValuesHeight * 2;
    const glm::dvec3 d = v.ray_ws + u * v.ray_x_ws + w * v.ray_y_ws;
    const auto hit = rays_.nearest(glm::vec3(0.0f), glm::vec3(d), static_cast<float>(v.near), static_cast<float>(v.far));
    if (!hit) return std::nullopt;
    return ValueTruth{*hit, d};
  }

  SceneAssets assets_{two_workers()};
  PreparedScene scene_;
  RayScene rays_;
  Image<float> depth_{kValuesWidth, kValuesHeight}, distance_{kValuesWidth, kValuesHeight};
  Image<glm::vec3> normal_{kValuesWidth, kValuesHeight}, camera_normal_{kValuesWidth, kValuesHeight},
      position_{kValuesWidth, kValuesHeight}, barycentrics_{kValuesWidth, kValuesHeight};
  Image<uint32_t> object_{kValuesWidth, kValuesHeight}, instance_{kValuesWidth, kValuesHeight}, triangle_{kValuesWidth, kValuesHeight};
};

// Window positions of vertices are rounded to 1/256 px, so a point of a triangle is at most 1/512 px from the ray of its pixel, in each
// direction of the image. On a slanted surface this is magnified. The rest of the tolerance is for float rounding.
TEST_F(FrameValues, AgreeWithRays) {
  int compared = 0, other = 0, background = 0;
  double worst_px = 0.0, worst_sphere = 0.0, worst_weights = 0.0;
  for (int y = 0; y < kValuesHeight; ++y) {
    for (int x = 0; x < kValuesWidth; ++x) {
      const std::optional<ValueTruth> t = truth_at(x, y);
      if (!t || object_.at(x, y) == kNoId) {
        background += !t && object_.at(x, y) == kNoId && depth_.at(x, y) == std::numeric_limits<float>::infinity() ? 1 : 0;
        other += !t != (object_.at(x, y) == kNoId) ? 1 : 0;
        continue;
      }
      const glm::dvec3 p = glm::dvec3(position_.at(x, y)) - scene_.view.eye_ws, truth = t->hit.position_rws;
      const double size = glm::length(truth);
      ASSERT_NEAR(depth_.at(x, y), glm::dot(p, scene_.view.forward_ws), 1e-6 * size);
      ASSERT_NEAR(distance_.at(x, y), glm::length(p), 1e-6 * size);
      const glm::dvec3 n(normal_.at(x, y)), n_cs(camera_normal_.at(x, y));
      ASSERT_NEAR(glm::length(n), 1.0, 1e-6);
      ASSERT_LE(glm::distance(n, n_cs.x * scene_.view.right_ws + n_cs.y * scene_.view.up_ws - n_cs.z * scene_.view.forward_ws), 1e-6);
      if (t->hit.mesh < 0) {
        if (object_.at(x, y) != 4 || instance_.at(x, y) != t->hit.triangle) {
          ++other;
          continue;
        }
        ASSERT_EQ(triangle_.at(x, y), 0u);
        const glm::dvec3 center = scene_.spheres[0].particles->centers_ws[t->hit.triangle] - scene_.view.eye_ws;
        worst_sphere = std::max(worst_sphere, std::abs(glm::distance(p, center) - 0.4));
        ASSERT_LE(glm::distance(n, (p - center) / 0.4), 1e-5);
        continue;
      }
      const PlacedMesh& mesh = scene_.meshes[static_cast<std::size_t>(t->hit.mesh)];
      const bool same = object_.at(x, y) == static_cast<uint32_t>(mesh.object) && triangle_.at(x, y) == t->hit.triangle &&
                        (mesh.object != 1 || instance_.at(x, y) == static_cast<uint32_t>(t->hit.mesh - 1));
      if (!same) {
        ++other;
        continue;
      }
      ++compared;
      const double cosine = std::abs(glm::dot(t->hit.face_normal_ws, glm::normalize(t->direction)));
      worst_px = std::max(worst_px, glm::distance(p, truth) * cosine / pixel_width(scene_.view, truth));
      // The weights and the index of the triangle reproduce the position.
      glm::dvec3 again(0.0);
      for (int k = 0; k < 3; ++k) {
        const uint32_t vertex = (*mesh.indices)[std::size_t{3} * t->hit.triangle + static_cast<std::size_t>(k)];
        again += glm::dvec3(mesh.world_from_object * glm::dvec4(mesh.positions[vertex], 1.0)) * double{barycentrics_.at(x, y)[k]};
      }
      worst_weights = std::max(worst_weights, glm::distance(again - scene_.view.eye_ws, p) / size);
    }
  }
  EXPECT_GT(compared, 20000);
  EXPECT_GT(background, 2000);
  EXPECT_LE(other, kValuesWidth * kValuesHeight / 200);
  EXPECT_LE(worst_px, 0.003);
  EXPECT_LE(worst_sphere, 1e-6);
  EXPECT_LE(worst_weights, 1e-6);
}

}  // namespace
}  // namespace halfspace
