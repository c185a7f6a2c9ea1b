// SPDX-License-Identifier: Apache-2.0
//
// Light near the terminator of coarse meshes, compared with the surfaces that they stand for.
#include <algorithm>
#include <cmath>

#include "halfspace/reference/validation.h"
#include "halfspace/render/frame/frame.h"
#include "halfspace/render/scene_assets.h"
#include "halfspace/scene/scene_file.h"
#include "stability/regime.h"

namespace halfspace::stability {
namespace {

constexpr int kBallWidth = 320, kBallHeight = 180;

// A frame of a scene whose light is white, with the ray hits and shading normals of its pixels.
struct LitFrame {
  LitFrame(const SceneDescription& description, const Workers& workers)
      : assets(workers), scene(assets.prepare(description, kBallWidth, kBallHeight)), rays(scene.meshes, scene.view.eye_ws) {
    FrameImages images;
    images.light = &light;
    images.normal = &normal;
    render_frame(scene, images, workers);
    hits = primary_hits(rays, scene.view, kBallWidth, kBallHeight, workers);
  }
  glm::dvec3 to_light() const { return glm::dvec3(scene.lights.at(0).light.position_rws); }
  double shading_l(int x, int y) const { return glm::dot(glm::dvec3(normal.at(x, y)), to_light()); }
  double face_l(int x, int y) const { return glm::dot(hits.at(x, y)->face_normal_ws, to_light()); }  // the meshes are closed

  SceneAssets assets;
  PreparedScene scene;
  RayScene rays;
  Image<glm::vec4> light{kBallWidth, kBallHeight};
  Image<glm::vec3> normal{kBallWidth, kBallHeight};
  Image<std::optional<RayHit>> hits;
};

template <class F>
void for_each_hit(const LitFrame& frame, const F& visit) {
  for (int y = 0; y < kBallHeight; ++y)
    for (int x = 0; x < kBallWidth; ++x)
      if (frame.hits.at(x, y)) visit(x, y);
}

TEST(Stability, TheTerminatorOfASmoothBallHasNoSteps) {
  const Workers workers(2);
  double common = 0.0, ours = 0.0;
  for (const char* resolution : {"512", "2048", "4096"}) {
    SceneFile file = SceneFile::parse(R"({ "version": 1, "ambient": 0,
      "cameras": { "main": { "position": [0.4, 0.3, 2.2], "target": [0.1, 0, 0], "fov": 50, "near": 0.1, "far": 100 } },
      "lights": { "sun": { "direction": [1, 0.3, 0.1] } },
      "objects": { "ball": { "shape": "uv_sphere", "latitudes": 12, "longitudes": 24, "color": [1, 1, 1], "diffuse": 1, "specular": 0 } },
      "shadow": { "method": "pcf3" } })",
                                      "test", ".");
    file.set("shadow.resolution=" + std::string(resolution));
    const LitFrame frame(file.at(0.0), workers);
    for_each_hit(frame, [&](int x, int y) {
      // A ball shades no part of its lit side.
      const double shade = std::max(frame.shading_l(x, y), 0.0);
      ours = std::max(ours, std::abs(static_cast<double>(frame.light.at(x, y).x) - shade));
      if (frame.face_l(x, y) <= 0.0) common = std::max(common, shade);
    });
  }
  // Normals of adjacent vertices differ by 15 degrees, so that a triangle can face away where the cosine of the shading normal is 0.13. Our
  // bound is half of a code of an 8-bit image.
  record_and_check(
      {27, "shadow terminator",
       "a ball of 24 sectors, maps of 512 to 4096 texels; triangles that face away in shadow, as with rays, vs. lookups on the "
       "smooth surface",
       "largest difference from the shade of a smooth ball, where the light is 1"},
      common, 0.05, ours, 0.002);
}

// The fraction of the light in a scene's first shadow, looked up as is common: without the smooth surface, and with a bias that grows with
// the slope.
double common_lookup(const LitFrame& frame, int x, int y) {
  const Shadow& ours = *frame.scene.lights.at(0).light.shadow;
  Shadow shadow{ours.views, ours.settings};
  shadow.settings.bias = ShadowBias::slope;
  shadow.settings.max_slope = 1e4f;  // no limit
  const auto single = [](const glm::dvec3& v) { return vec3<float>(glm::vec3(v)); };
  const RayHit& hit = *frame.hits.at(x, y);
  return static_cast<double>(shadow_factor<float>(shadow, {single(hit.position_rws), single(hit.face_normal_ws),
                                                           vec3<float>(frame.normal.at(x, y)), single(frame.to_light()), 0.5f, 0.5f}));
}

TEST(Stability, NormalMapsReceiveNoLightThroughTheMesh) {
  const Workers workers(2);
  SceneFile file = SceneFile::open("moon");
  file.set(std::vector<std::string>{"camera=terminator", "ambient=0", "moon.color=[1,1,1]", "moon.specular=0", "moon.diffuse=1",
                                    "sun.intensity=1", "background.brightness=0", "relief.width=1024", "moon.latitudes=64",
                                    "moon.longitudes=128"});
  SceneFile fine_file = file;
  fine_file.set(std::vector<std::string>{"moon.latitudes=384", "moon.longitudes=768"});
  const LitFrame frame(file.at(0.0), workers), fine(fine_file.at(0.0), workers);
  const RayLight sun{frame.scene.lights.at(0).light, 0.0, 1};
  double common = 0.0, ours = 0.0;
  int pixels = 0;
  for_each_hit(frame, [&](int x, int y) {
    if (frame.face_l(x, y) > 0.0 || frame.shading_l(x, y) <= 0.0 || !fine.hits.at(x, y)) return;
    const RayHit& truth = *fine.hits.at(x, y);
    const bool lit = fine.face_l(x, y) > 0.0 && light_truth(fine.rays, sun, truth.position_rws, truth.face_normal_ws, 0).share > 0.0f;
    if (lit) return;
    ++pixels;
    common += frame.shading_l(x, y) * common_lookup(frame, x, y);
    ours += static_cast<double>(frame.light.at(x, y).x);
  });
  ASSERT_GT(pixels, 300);
  // Shadow edges are blurred over three texels, and a texel is a quarter of a pixel.
  record_and_check({27, "shadow terminator",
                    "a bumpy sphere of 128 sectors whose normals face the light and whose triangles do not, where the relief is in shadow; "
                    "a slope bias without a limit and the mapped normal vs. a pass",
                    "mean light at these pixels, where the light is 1"},
                   common / pixels, 0.01, ours / pixels, 0.005);
}

}  // namespace
}  // namespace halfspace::stability
