// SPDX-License-Identifier: Apache-2.0
//
// Compares shadow maps with rays, on small images of the shipped scenes.
#include "halfspace/reference/validation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include <nlohmann/json.hpp>
#include "halfspace/reference/shadow_table.h"
#include "halfspace/render/scene_assets.h"
#include "halfspace/scene/scene_file.h"
#include "support/long_tests.h"
#include "support/workers.h"

namespace halfspace {
namespace {

Validation validated(const std::string& name, const std::vector<std::string>& settings, int width = 240, int height = 135, int rays = 64) {
  SceneFile scene = SceneFile::open(name);
  scene.set(settings);
  SceneAssets assets(two_workers());
  return validate(name, scene.at(0.0), {width, height, rays}, assets, two_workers());
}

ShadowScore score(const std::vector<std::string>& settings) { return validated("shadow-plane", settings).lights.at(0).score; }

TEST(Validation, VisibleTrianglesMatchRays) {
  const VisibilityScore v = validated("shadow-plane", {}).visibility;
  EXPECT_GT(v.pixels, 10000);
  EXPECT_EQ(v.unexplained, 0);
  EXPECT_EQ(v.pixels, v.same + v.near_edge + v.depth_tie);
  // The triangles of the sphere are about 2 px wide, so a point is within 1/256 px of an edge with a probability of about 1%.
  EXPECT_LT(static_cast<double>(v.near_edge + v.depth_tie), 0.01 * static_cast<double>(v.pixels));
}

TEST(Validation, AutomaticBiasIsCorrectBeyondATexelFromTheEdge) {
  const ShadowScore s = score({});
  EXPECT_GT(s.lit, 5000);
  EXPECT_GT(s.shadowed, 1000);
  EXPECT_LE(s.false_shadow.from_1_to_3 + s.false_shadow.beyond_3, 1e-4);  // guaranteed for the shipped scenes
  EXPECT_LE(s.false_light.from_1_to_3 + s.false_light.beyond_3, 1e-3);
  EXPECT_LT(s.edge_px.mean, 0.5);
}

// Guaranteed limits: 0.01% of the lit and 0.1% of the shadowed pixels, for angles from 0 to 85 degrees. One wrong pixel is always allowed.
TEST(Validation, AutomaticBiasIsCorrectInTheScenesOfTheTableAtEveryAngle) {
  SceneAssets assets(two_workers());
  int number = 0;
  for_each_shadow_case(false, [&](const ShadowCase& c) {
    if (c.factor != "angle" || (!runs_long_tests() && number++ % 3 != 0)) return;
    const ShadowScore s = validate(c.scene, c.description, {240, 135, 1}, assets, two_workers()).lights.at(0).score;
    const auto pixels = [](const DistanceShares& shares, int64_t of) {
      return (shares.from_1_to_3 + shares.beyond_3) * static_cast<double>(of);
    };
    EXPECT_LE(pixels(s.false_shadow, s.lit), std::max(1.0, 1e-4 * static_cast<double>(s.lit))) << c.scene << ' ' << c.angle;
    EXPECT_LE(pixels(s.false_light, s.shadowed), std::max(1.0, 1e-3 * static_cast<double>(s.shadowed))) << c.scene << ' ' << c.angle;
  });
}

// Tests a sphere and its shadow for every type of light: pixels more than a texel from the edge must be correct.
TEST(Validation, EveryLightTypeIsCorrectBeyondATexelFromTheEdge) {
  const std::string spot = "lamp.type=spot", towards = "lamp.direction=-3.5,6.4,3.5", inner = "lamp.inner=10";
  const std::vector<std::vector<std::string>> kinds{{"lamp.type=directional", towards},
                                                    {"lamp.type=directional", towards, "shadow.cascades=4"},
                                                    {"lamp.position=0.4,0.2,2.5"},  // the sphere covers several cube faces
                                                    {spot, towards, inner, "lamp.outer=40"},
                                                    {spot, towards, inner, "lamp.outer=60"},
                                                    {spot, towards, inner, "lamp.outer=95"},  // wider than a single plane can cover
                                                    {spot, towards, inner, "lamp.outer=179"},
                                                    {"shadow.resolution=0"}};
  for (const auto& settings : kinds) {
    const ShadowScore s = score(settings);
    std::string name;
    for (const std::string& setting : settings) name += setting + " ";
    EXPECT_GT(s.shadowed, 300) << name;
    EXPECT_LE(s.false_shadow.from_1_to_3 + s.false_shadow.beyond_3, 2e-4) << name;  // one or two of about 10,000 pixels
    EXPECT_LE(s.false_light.from_1_to_3 + s.false_light.beyond_3, 1e-3) << name;
  }
}

TEST(Validation, ACasterCloseToALightCastsItsShadow) {
  const ShadowScore s = validated("shadow-plane", {"lamp.position=[0,3,0]", "earth.position=[0,2.995,0]", "earth.scale=[0.002,0.002,0.002]",
                                                   "ground.size=200"})
                            .lights.at(0)
                            .score;
  EXPECT_GT(s.lit, 5000);
  EXPECT_GT(s.shadowed, 500);
  EXPECT_LE(s.false_shadow.from_1_to_3 + s.false_shadow.beyond_3, 1e-4);  // guaranteed for the shipped scenes
  EXPECT_LE(s.false_light.from_1_to_3 + s.false_light.beyond_3, 1e-3);
}

TEST(Validation, DetectsAcneWithoutBiasAndLeaksWithTooMuch) {
  const ShadowScore none = score({"shadow.bias=none", "shadow.method=hard"});
  EXPECT_GT(none.false_shadow.beyond_3, 0.1);
  const ShadowScore much = score({"shadow.bias=constant", "shadow.constant=400", "shadow.method=hard"});
  EXPECT_GT(much.false_light.from_1_to_3 + much.false_light.beyond_3, 0.01);
  EXPECT_LT(much.false_shadow.beyond_3, 1e-3);
}

// On average, the edges of the fitted map are within a texel of the true ones. Where no shadow is smaller than a texel, they are within
// half a texel, the rounding of the map. (On the Moon some shadows are smaller, because the Sun is low.)
TEST(Validation, HardEdgesAreWithinATexel) {
  for (const auto& [scene, camera, max_edge_texels] : {std::tuple{"shadow-plane", "main", 0.5},
                                                       {"shadow-plane", "low", 0.5},
                                                       {"shadow-contact", "main", 0.5},
                                                       {"shadow-contact", "close", 0.5},
                                                       {"shadow-knot", "main", 0.5},
                                                       {"moon", "terminator", 1.0}}) {
    const ShadowScore s = validated(scene, {"shadow.method=hard", std::string("camera=") + camera}, 320, 180).lights.at(0).score;
    EXPECT_GT(s.edge_texels, 0.0);
    EXPECT_LE(s.edge_texels, max_edge_texels) << scene << ' ' << camera;
  }
}

// A light with an angular radius of 3 degrees. With a disk of 128 texels, the visible fraction is accurate to about a hundredth.
TEST(Validation, SoftShadowsAreCloseToTheReference) {
  const ShadowScore s = validated("shadow-contact", {"shadow.method=pcss"}, 160, 90, 1024).lights.at(0).score;
  EXPECT_GT(s.penumbra_error, 0.0);
  EXPECT_LE(s.penumbra_error, 0.03);
  EXPECT_LE(s.error, 0.005);
  EXPECT_LE(s.truth_error, 0.5 / 32.0 + 1e-6);  // standard error of 1024 rays, if they were independent
  const ShadowScore hard = validated("shadow-contact", {"shadow.method=hard"}, 160, 90, 256).lights.at(0).score;
  EXPECT_GT(hard.penumbra_error, 0.1);
}

// For 95% of the visible points, a texel spans at most the requested number of pixels; half the resolution would not suffice.
TEST(Validation, ResolutionFollowsTheFootprint) {
  for (const double footprint : {0.5, 1.0, 3.0}) {
    SceneFile file = SceneFile::open("shadow-contact");
    file.set(std::vector<std::string>{"shadow.resolution=0", "shadow.footprint=" + std::to_string(footprint)});
    SceneAssets assets(two_workers());
    const PreparedScene scene = assets.prepare(file.at(0.0), 960, 540);
    const ShadowView& view = scene.lights.front().light.shadow->views.front();
    const RayScene rays(scene.meshes, scene.view.eye_ws);
    const Image<std::optional<RayHit>> hits = primary_hits(rays, scene.view, 192, 108, two_workers());
    std::vector<double> texels_px;
    for (const std::optional<RayHit>& hit : hits.texels())
      if (hit) texels_px.push_back(static_cast<double>(view.texel_per_w) / pixel_width(scene.view, hit->position_rws));
    std::ranges::sort(texels_px);
    const double percentile_95 = texels_px[texels_px.size() * 95 / 100];
    EXPECT_LE(percentile_95, 1.02 * footprint);  // the renderer examines fewer points
    EXPECT_GT(percentile_95, 0.4 * footprint);   // doubling the size halves a texel, and sizes have steps of 2^(1/4)
  }
}

TEST(Validation, WithoutAMethodThereIsNoShadowAndNoMap) {
  const Validation v = validated("shadow-plane", {"shadow.method=none"});
  EXPECT_EQ(v.lights.at(0).score.resolution, 0);
  EXPECT_GT(v.lights[0].score.false_light.within_1 + v.lights[0].score.false_light.from_1_to_3 + v.lights[0].score.false_light.beyond_3,
            0.1);
}

TEST(LightTruth, PenumbraOfAnEdgeMatchesTheAreaOfACutDisk) {
  // A half plane at height 2 above the ground. The light at x is the fraction of the disk beyond the edge.
  Mesh edge;
  edge.positions = {{-50, 2, -50}, {0, 2, -50}, {0, 2, 50}, {-50, 2, 50}};
  edge.indices = {0, 2, 1, 0, 3, 2};
  const std::vector<PlacedMesh> meshes{{edge.positions, edge.normals, std::make_shared<const Indices>(edge.indices, edge.positions.size()),
                                        glm::dmat4(1.0), true, true, true}};
  const RayScene casters(meshes, glm::dvec3(0.0), true);
  RayLight light{{}, 0.05, 4096};
  light.light.position_rws = {0, 1, 0};
  for (double x = -0.12; x <= 0.12; x += 0.02) {
    const LightTruth t = light_truth(casters, light, {x, 0, 0}, {0, 1, 0}, 1);
    const double c = std::clamp(x / 0.1, -1.0, 1.0);
    const double expected = 0.5 + (c * std::sqrt(1 - c * c) + std::asin(c)) / std::numbers::pi;
    EXPECT_NEAR(t.share, expected, 3.0 * std::max(1e-3, static_cast<double>(t.standard_error))) << x;
  }
}

TEST(Validation, ReportsContainAllFields) {
  const Validation v = validated("shadow-plane", {}, 64, 36);
  const Json rows = Json::parse(json_report(v));
  ASSERT_EQ(rows.size(), 1u);
  for (const char* key :
       {"scene", "light", "method", "bias", "resolution", "false_shadow", "false_light", "edge_px", "map_ms", "lookup_ms"})
    EXPECT_TRUE(rows[0].contains(key)) << key;
  EXPECT_EQ(rows[0]["bias"], "auto");
  EXPECT_EQ(rows[0]["resolution"], 2048);
  EXPECT_NE(text_report(v).find("unexplained"), std::string::npos);
}

// A coarse ball, whose triangles and smooth normals face the light in different regions.
TEST(Validation, PixelsWhereOnlyOneNormalFacesTheLightAreAClassOfTheirOwn) {
  const std::vector<std::string> coarse{"earth.latitudes=12", "earth.longitudes=24"};
  const ShadowScore fine = score({}), s = score(coarse);
  EXPECT_GT(s.sides_differ, 2.0 * fine.sides_differ);
  const auto scored = static_cast<double>(s.sides.lit + s.sides.shadowed), compared = static_cast<double>(s.lit + s.shadowed);
  const double differ = compared * s.sides_differ / (1.0 - s.sides_differ);
  EXPECT_GT(scored, 50.0);
  EXPECT_LT(scored, differ) << "where only the triangle faces the light, nothing is scored";
  EXPECT_EQ(s.sides.false_shadow, 0.0) << "the lookup is on the smooth surface";
  const Json sides = Json::parse(json_report(validated("shadow-plane", coarse))).at(0).at("sides");
  EXPECT_EQ(sides.at("lit_pixels"), s.sides.lit);
  EXPECT_EQ(sides.at("shadowed_pixels"), s.sides.shadowed);
  EXPECT_EQ(sides.at("error"), s.sides.error);
}

TEST(Validation, ReportsThatNoLightHasShadows) {
  const std::string text = text_report(validated("shadow-plane", {"lamp.shadow=false"}, 64, 36));
  EXPECT_TRUE(text.starts_with("the scene has no lights with shadows, so no shadows are compared\nvisible triangles: ")) << text;
  EXPECT_EQ(text_report({}), "the scene has no lights with shadows, so no shadows are compared\n");
}

}  // namespace
}  // namespace halfspace
