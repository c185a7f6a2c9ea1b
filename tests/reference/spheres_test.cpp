// SPDX-License-Identifier: Apache-2.0
//
// Compares visibility and shadows with Embree in scenes that contain both exact spheres and meshes.
#include <gtest/gtest.h>

#include <cmath>

#include "halfspace/reference/numbered_mesh.h"
#include "halfspace/reference/ray_scene.h"
#include "halfspace/render/frame/frame.h"
#include "halfspace/render/scene_assets.h"
#include "halfspace/scene/scene_file.h"
#include "halfspace/shading/sphere/sphere_impostor.h"
#include "support/workers.h"

namespace halfspace {
namespace {

constexpr int kSpheresWidth = 320, kSpheresHeight = 240;

PreparedScene prepared(const std::string& sections, const std::vector<std::string>& settings = {}) {
  const std::string head = R"({ "version": 1, "cameras": { "main": { "position": [0, 1.5, 6], "target": [0, 0, 0], "fov": 50 } },)";
  SceneFile file = SceneFile::parse(head + sections + "}", "test", {});
  file.set(settings);
  SceneAssets assets(two_workers());
  return assets.prepare(file.description(), kSpheresWidth, kSpheresHeight);
}

// Returns an ID per pixel: 1, 2, … for spheres, −1, −2, … for meshes, 0 for the background.
Image<glm::vec4> numbers_of(const PreparedScene& scene) {
  Image<glm::vec4> image(kSpheresWidth, kSpheresHeight);
  DepthTarget depth{.format = DepthFormat::d32f, .clear_value = 0.0f};
  Pass pass(kSpheresWidth, kSpheresHeight, rgba32f_target(image), depth);
  std::vector<glm::vec3> numbers;
  for (std::size_t i = 0; i < scene.spheres.at(0).particles->radii.size(); ++i) numbers.emplace_back(static_cast<float>(i + 1));
  for (const PreparedDraw& draw : scene.draws) {
    const auto* sprite = std::get_if<SphereImpostor<true>>(&draw.shader);
    if (sprite == nullptr) continue;
    SphereImpostor<true> numbered = *sprite;
    numbered.lights = {};
    numbered.ambient = glm::vec3(1.0f);
    VertexView view = draw.vertices;
    view.streams[2] = stream(numbers);
    pass.draw(numbered, view, *draw.indices, draw.state);
  }
  for (std::size_t m = 0; m < scene.meshes.size(); ++m) {
    const PlacedMesh& mesh = scene.meshes[m];
    pass.draw(NumberedMesh{{glm::mat4(scene.view.clip_from_world * mesh.world_from_object)}, -1.0f - static_cast<float>(m)},
              make_vertex_view(stream(mesh.positions)), *mesh.indices, opaque_state(CullMode::none, false));
  }
  pass.run(two_workers());
  return image;
}

glm::vec3 direction_of(const View& v, double x, double row) {
  return glm::vec3(v.forward_ws + v.right_ws * (v.tan_x * (2.0 * x / kSpheresWidth - 1.0)) +
                   v.up_ws * (v.tan_y * (1.0 - 2.0 * row / kSpheresHeight)));
}

float number_of(const RayScene& rays, const View& v, double x, double row) {
  const auto hit = rays.nearest(glm::vec3(0.0f), direction_of(v, x, row), 0.1f, 1000.0f);
  return !hit ? 0.0f : hit->mesh < 0 ? static_cast<float>(hit->triangle + 1) : -1.0f - static_cast<float>(hit->mesh);
}

// Balls and a thousand spheres that intersect the balls, the ground and each other. A pixel may differ only if a ray within 1/256 px of its
// center hits the object that the image shows. This happens next to silhouettes and where two surfaces intersect.
TEST(Spheres, VisibilityMatchesEmbree) {
  const PreparedScene scene = prepared(R"("particles": { "sprite": "exact", "count": 1000, "arrangement": "ball", "radius": 0.15 },
      "objects": { "ball": { "shape": "uv_sphere", "position": [0.4, 0.2, 0.5], "scale": [0.8, 0.8, 0.8] },
                   "ground": { "shape": "plane", "position": [0, -0.7, 0], "scale": [8, 8, 8] } })");
  ASSERT_EQ(scene.meshes.size(), 2u);
  const RayScene rays(scene.meshes, scene.view.eye_ws, false, scene.spheres);
  const Image<glm::vec4> picture = numbers_of(scene);
  int same = 0, beside = 0, wrong = 0, spheres = 0, meshes = 0;
  for (int row = 0; row < kSpheresHeight; ++row) {
    for (int x = 0; x < kSpheresWidth; ++x) {
      const float seen = picture.at(x, row).x;
      spheres += seen > 0.0f;
      meshes += seen < 0.0f;
      if (seen == number_of(rays, scene.view, x + 0.5, row + 0.5)) {
        ++same;
        continue;
      }
      bool near = false;
      for (int k = 0; k < 16 && !near; ++k) {
        const double angle = k * 0.39269908169872414, reach = (k % 2 == 0 ? 1.0 : 0.5) / 256.0;
        near = seen == number_of(rays, scene.view, x + 0.5 + reach * std::cos(angle), row + 0.5 + reach * std::sin(angle));
      }
      (near ? beside : wrong) += 1;
    }
  }
  RecordProperty("same", std::to_string(same));
  RecordProperty("beside", std::to_string(beside));
  EXPECT_EQ(wrong, 0);
  EXPECT_GT(spheres, 10000);
  EXPECT_GT(meshes, 15000);
  EXPECT_LT(beside, kSpheresWidth * kSpheresHeight / 100);
}

// ---- shadows -------------------------------------------------------------------------------------------------------

constexpr const char* kShaded = R"("ambient": 0.1,
    "particles": { "sprite": "exact", "count": 60, "arrangement": "ball", "radius": 0.2, "ambient": 0.0 },
    "objects": { "ground": { "shape": "plane", "position": [0, -1.6, 0], "scale": [8, 8, 8] } },
    "shadow": { "method": "hard", "resolution": 2048 },
    "lights": { "sun": )";
constexpr const char* kSun = R"({ "type": "directional", "direction": [1, 2, 1.5] } })";
constexpr const char* kLamp = R"({ "type": "point", "position": [2, 4, 3] } })";
constexpr const char* kSpot = R"({ "type": "spot", "position": [2, 5, 3], "direction": [2, 5, 3], "inner": 40, "outer": 45 } })";

Image<glm::vec4> rendered(const PreparedScene& scene) {
  Image<glm::vec4> image(kSpheresWidth, kSpheresHeight);
  render(scene, image, two_workers());
  return image;
}

glm::vec3 to_light(const LightDescription& l, const glm::dvec3& at_ws) {
  return glm::vec3(l.type == LightType::directional ? l.direction * 100.0 : l.position - at_ws);
}

struct ShadowErrors {
  int shadowed = 0, lit = 0, wrong = 0, on_spheres = 0;
};

// The ray to the light must be occluded exactly where the image with shadows is darker than the image without. Pixels whose neighbors
// disagree are within a pixel of a shadow edge. They are skipped, because the result depends on the texels of the map.
ShadowErrors shadow_errors(const std::string& light) {
  const PreparedScene with = prepared(kShaded + light), without = prepared(kShaded + light, {"shadow.method=none"});
  const Image<glm::vec4> dark = rendered(with), bright = rendered(without);
  const RayScene rays(with.meshes, with.view.eye_ws, false, with.spheres);
  const LightDescription& l = with.lights.at(0).description;
  ShadowErrors e;
  const auto is_shaded = [&](double x, double row, bool& sphere) {
    const auto hit = rays.nearest(glm::vec3(0.0f), direction_of(with.view, x, row), 0.1f, 1000.0f);
    if (!hit) return -1;
    sphere = hit->mesh < 0;
    const glm::dvec3 n = glm::dot(hit->face_normal_ws, hit->position_rws) < 0.0 ? hit->face_normal_ws : -hit->face_normal_ws;
    const glm::vec3 way = to_light(l, hit->position_rws + with.view.eye_ws);
    if (glm::dot(n, glm::dvec3(way)) < 0.15 * static_cast<double>(glm::length(way))) return -1;  // facing away or at a grazing angle
    return rays.occluded(glm::vec3(hit->position_rws + 1e-3 * n), way, 0.0f, 1.0f) ? 1 : 0;
  };
  for (int row = 1; row < kSpheresHeight - 1; ++row) {
    for (int x = 1; x < kSpheresWidth - 1; ++x) {
      bool sphere = false, other = false;
      const int truth = is_shaded(x + 0.5, row + 0.5, sphere);
      bool certain = truth >= 0 && bright.at(x, row).y > 1e-3f;
      for (int k = 0; k < 8 && certain; ++k) {
        certain = is_shaded(x + 0.5 + std::array{1, 1, 0, -1, -1, -1, 0, 1}[static_cast<std::size_t>(k)],
                            row + 0.5 + std::array{0, 1, 1, 1, 0, -1, -1, -1}[static_cast<std::size_t>(k)], other) == truth &&
                  other == sphere;
      }
      if (!certain) continue;
      const bool shaded = dark.at(x, row).y < 0.999f * bright.at(x, row).y;
      e.wrong += shaded != (truth == 1);
      (truth == 1 ? e.shadowed : e.lit) += 1;
      e.on_spheres += sphere && truth == 1;
    }
  }
  return e;
}

TEST(Spheres, CastAndReceiveShadowsOfEveryLightType) {
  for (const char* light : {kSun, kLamp, kSpot}) {
    const ShadowErrors e = shadow_errors(light);
    EXPECT_GT(e.lit, 3000) << light;
    EXPECT_GT(e.shadowed, 500) << light;
    EXPECT_GT(e.on_spheres, 20) << light;
    // A texel is at most one pixel wide. A few pixels remain wrong where two shadows nearly touch.
    EXPECT_LE(e.wrong * 1000, e.lit + e.shadowed) << light;
  }
}

int differs(const Image<glm::vec4>& a, const Image<glm::vec4>& b) {
  int n = 0;
  for (int i = 0; i < kSpheresWidth * kSpheresHeight; ++i) n += a.data()[i] != b.data()[i];
  return n;
}

TEST(Spheres, SkipsSpheresThatNeitherCastNorReceive) {
  const std::string scene = std::string(kShaded) + kSun;
  const Image<glm::vec4> none = rendered(prepared(scene, {"shadow.method=none"}));
  const Image<glm::vec4> neither = rendered(prepared(scene, {"particles.casts_shadow=false", "particles.receives_shadow=false"}));
  const Image<glm::vec4> casting = rendered(prepared(scene, {"particles.receives_shadow=false"}));
  const Image<glm::vec4> receiving = rendered(prepared(scene, {"particles.casts_shadow=false"}));
  EXPECT_EQ(differs(none, neither), 0);  // the ground does not shadow itself
  EXPECT_GT(differs(none, casting), 500);
  EXPECT_EQ(differs(none, receiving), 0);
}

// The ground does not shadow itself for any choice of casting faces, so all visible shadows are cast by spheres.
TEST(Spheres, CastShadowsFromTheirFrontForAnyFaces) {
  const std::string scene = std::string(kShaded) + kSun;
  const Image<glm::vec4> none = rendered(prepared(scene, {"shadow.method=none"}));
  const Image<glm::vec4> front = rendered(prepared(scene, {"shadow.faces=front"}));
  EXPECT_GT(differs(none, front), 500);
  for (const char* faces : {"shadow.faces=back", "shadow.faces=both"})
    EXPECT_EQ(differs(front, rendered(prepared(scene, {faces}))), 0) << faces;
}

}  // namespace
}  // namespace halfspace
