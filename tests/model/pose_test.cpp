// SPDX-License-Identifier: Apache-2.0
#include "halfspace/model/pose/pose.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "halfspace/model/pose/animation.h"
#include "halfspace/model/pose/deform.h"

namespace halfspace {
namespace {

ModelMesh pose_triangle() {
  ModelMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.normals.assign(3, {0, 0, 1});
  mesh.tangents.assign(3, {1, 0, 0, 1});
  mesh.indices = {0, 1, 2};
  return mesh;
}

// A model with one triangle at node 0.
Model pose_model() {
  Model model;
  model.meshes = {pose_triangle()};
  model.nodes.resize(1);
  model.nodes[0].meshes = {0};
  model.scenes = {{"", {0}}};
  return model;
}

glm::dvec3 point(const PosedMesh& posed, const glm::dvec3& p) { return glm::dvec3(posed.world_from_mesh * glm::dvec4(p, 1.0)); }

const glm::dquat kQuarterTurnAroundZ(std::sqrt(0.5), 0.0, 0.0, std::sqrt(0.5));

AnimationChannel channel(AnimatedProperty property, KeyInterpolation interpolation, std::vector<float> times, std::vector<float> values) {
  AnimationChannel c{0, property, interpolation, std::move(times), std::move(values), 3};
  if (property == AnimatedProperty::rotation) c.width = 4;
  return c;
}

// ---- animation -------------------------------------------------------------------------------------------------

TEST(Animation, StepsHoldTheirValue) {
  const auto c = channel(AnimatedProperty::translation, KeyInterpolation::step, {1, 2}, {1, 2, 3, 4, 5, 6});
  EXPECT_EQ(value_at(c, 0.0), (std::vector<double>{1, 2, 3}));
  EXPECT_EQ(value_at(c, 1.999), (std::vector<double>{1, 2, 3}));
  EXPECT_EQ(value_at(c, 2.0), (std::vector<double>{4, 5, 6}));
}

TEST(Animation, LinearKeysAreClampedAtTheEnds) {
  const auto c = channel(AnimatedProperty::scale, KeyInterpolation::linear, {1, 3}, {1, 2, 3, 5, 6, 7});
  EXPECT_EQ(value_at(c, 1.5), (std::vector<double>{2, 3, 4}));
  EXPECT_EQ(value_at(c, -9.0), (std::vector<double>{1, 2, 3}));
  EXPECT_EQ(value_at(c, 9.0), (std::vector<double>{5, 6, 7}));
  EXPECT_EQ(value_at(c, 3.0), (std::vector<double>{5, 6, 7}));
}

// With the values 0 and 1, the tangents 3 and 6 and two seconds between the keyframes, the value in the middle is 1/2 + 2·(3 − 6)/8.
TEST(Animation, CubicKeysUseTheirTangents) {
  AnimationChannel c = channel(AnimatedProperty::translation, KeyInterpolation::cubic, {0, 2}, {});
  for (const float x : {9.0f, 0.0f, 3.0f, 6.0f, 1.0f, 9.0f}) c.values.insert(c.values.end(), 3, x);
  EXPECT_DOUBLE_EQ(value_at(c, 1.0)[2], 0.5 + 2.0 * (3.0 - 6.0) / 8.0);
  EXPECT_EQ(value_at(c, 0.0)[0], 0.0);
  EXPECT_EQ(value_at(c, 2.0)[1], 1.0);
}

TEST(Animation, RotatesAtConstantSpeedAlongTheShorterWay) {
  for (const double angle : {1e-6, 0.1, 1.0, std::numbers::pi / 2.0}) {  // between quaternions
    for (const double sign : {1.0, -1.0}) {
      const glm::dquat a(1, 0, 0, 0), b(sign * std::cos(angle), 0.0, sign * std::sin(angle), 0.0);
      for (const double t : {0.0, 0.1, 0.5, 0.77, 1.0}) {
        const glm::dquat q = shortest_rotation(a, b, t);
        EXPECT_NEAR(q.w, std::cos(t * angle), 2e-15);
        EXPECT_NEAR(std::abs(q.y), std::sin(t * angle), 2e-15);
      }
    }
  }
  const auto c = channel(AnimatedProperty::rotation, KeyInterpolation::linear, {0, 1}, {0, 0, 0, 2, 0, 0, 3, 3});
  EXPECT_NEAR(value_at(c, 0.5)[2], std::sin(std::numbers::pi / 8.0), 1e-15);
}

// ---- poses -----------------------------------------------------------------------------------------------------

TEST(Pose, CombinesTheTransformsOfTheHierarchy) {
  Model model = pose_model();
  model.nodes[0].transform = {{10, 0, 0}, kQuarterTurnAroundZ, {2, 2, 2}};
  model.nodes[0].meshes.clear();
  model.nodes[0].children = {1};
  model.nodes.resize(2);
  model.nodes[1].meshes = {0};
  glm::dmat4 m(1.0);
  m[3] = {0, 0, 5, 1};
  model.nodes[1].matrix = m;
  model.meshes[0].origin = {1, 0, 0};
  const PosedModel posed = pose(model, {});
  ASSERT_EQ(posed.meshes.size(), 1u);
  EXPECT_EQ(posed.meshes[0].deformed, nullptr);
  // x → 2y, y → −2x, z → 2z, after the origin and the translation of the child
  const glm::dvec3 p = point(posed.meshes[0], {0, 1, 0});
  EXPECT_NEAR(p.x, 8.0, 1e-14);
  EXPECT_NEAR(p.y, 2.0, 1e-14);
  EXPECT_NEAR(p.z, 10.0, 1e-14);
  EXPECT_NEAR(posed.low.x, 8.0, 1e-14);
  EXPECT_NEAR(posed.high.y, 4.0, 1e-14);
}

TEST(Pose, DrawsOnlyTheScene) {
  Model model = pose_model();
  model.nodes.resize(2);
  model.nodes[1].meshes = {0, 0};
  model.scenes = {{"", {0}}, {"", {1}}};
  model.scene = 1;
  EXPECT_EQ(pose(model, {}).meshes.size(), 2u);
  EXPECT_EQ(pose(model, {.scene = 0}).meshes.size(), 1u);
}

TEST(Pose, ConvertsZUpToYUp) {
  Model model = pose_model();
  model.up = UpAxis::z;
  model.meshes[0].positions[2] = {1, 2, 3};
  const PosedModel posed = pose(model, {});
  EXPECT_EQ(point(posed.meshes[0], {1, 2, 3}), glm::dvec3(1, 3, -2));
  EXPECT_EQ(posed.high, glm::dvec3(1, 3, 0));
}

TEST(Pose, KeepsNegativeScale) {
  Model model = pose_model();
  model.nodes[0].transform.scale = {-1, 1, 1};
  EXPECT_EQ(pose(model, {}).low, glm::dvec3(-1, 0, 0));
}

TEST(Pose, ComputesBoundsOnlyOnRequest) {
  const PosedModel posed = pose(pose_model(), {.bounds = false});
  EXPECT_GT(posed.low.x, posed.high.x);
  EXPECT_FALSE(posed.meshes.empty());
}

TEST(Pose, PlacesInstances) {
  Model model = pose_model();
  model.nodes[0].transform.translation = {0, 0, 7};
  model.nodes[0].instances.resize(2);
  model.nodes[0].instances[1].translation = {4, 0, 0};
  model.nodes[0].instances[1].scale = {3, 3, 3};
  const PosedModel posed = pose(model, {});
  ASSERT_EQ(posed.meshes.size(), 2u);
  EXPECT_EQ(point(posed.meshes[1], {1, 0, 0}), glm::dvec3(7, 0, 7));
  EXPECT_EQ(posed.high, glm::dvec3(7, 3, 7));
}

TEST(Pose, AppliesAnimationsAndVariants) {
  Model model = pose_model();
  model.variants = {"a", "b"};
  model.meshes[0].material = 4;
  model.meshes[0].variant_materials = {5, 6};
  model.animations = {{"", {channel(AnimatedProperty::translation, KeyInterpolation::linear, {0, 1}, {0, 0, 0, 4, 0, 0})}}};
  const PosedModel posed = pose(model, {.animation = 0, .time = 0.5, .variant = 1});
  EXPECT_EQ(posed.meshes[0].world_from_mesh[3], glm::dvec4(2, 0, 0, 1));
  EXPECT_EQ(posed.meshes[0].material, 6);
  EXPECT_EQ(pose(model, {}).meshes[0].material, 4);
  EXPECT_EQ(pose(model, {}).meshes[0].world_from_mesh[3], glm::dvec4(0, 0, 0, 1));
}

TEST(Pose, AppliesMorphTargets) {
  Model model = pose_model();
  MorphTarget up, turned;
  up.positions = {{0, 0, 1}, {0, 0, 2}, {0, 0, 3}};
  turned.normals.assign(3, {0, 1, -1});
  turned.tangents.assign(3, {-1, 0, 1});
  model.meshes[0].targets = {up, turned};
  EXPECT_EQ(pose(model, {}).meshes[0].deformed, nullptr);
  model.nodes[0].morph_weights = {0.5f, 0.5f};
  const PosedModel posed = pose(model, {});
  const ModelMesh& mesh = *posed.meshes[0].deformed;
  EXPECT_EQ(mesh.positions, (std::vector<glm::vec3>{{0, 0, 0.5f}, {1, 0, 1}, {0, 1, 1.5f}}));
  EXPECT_NEAR(mesh.normals[0].y, std::sqrt(0.5), 1e-7);
  EXPECT_NEAR(mesh.tangents[0].z, std::sqrt(0.5), 1e-7);
  EXPECT_EQ(mesh.tangents[0].w, 1.0f);
  EXPECT_EQ(posed.high.z, 1.5);
}

// Two joints: one moves, the other rotates by 90° around z. The transform of the mesh's node has no effect.
TEST(Pose, AppliesSkins) {
  Model model = pose_model();
  model.nodes.resize(3);
  model.nodes[0].transform.translation = {100, 100, 100};
  model.nodes[0].skin = 0;
  model.nodes[1].transform.translation = {10, 0, 0};
  model.nodes[2].transform.rotation = kQuarterTurnAroundZ;
  glm::dmat4 bind(1.0);
  bind[3] = {0, 0, 2, 1};
  model.skins = {{{1, 2}, {bind, glm::dmat4(1.0)}}};
  model.scenes[0].roots = {0, 1, 2};
  model.meshes[0].joints = {{0, 0, 0, 0}, {1, 0, 0, 0}, {0, 1, 0, 0}};
  model.meshes[0].weights = {{1, 0, 0, 0}, {1, 0, 0, 0}, {0.5f, 0.5f, 0, 0}};
  const PosedModel posed = pose(model, {});
  ASSERT_EQ(posed.meshes.size(), 1u);
  const ModelMesh& mesh = *posed.meshes[0].deformed;
  const auto near = [&](std::size_t i, const glm::dvec3& expected) {
    const glm::dvec3 d = point(posed.meshes[0], glm::dvec3(mesh.positions[i])) - expected;
    return std::sqrt(glm::dot(d, d)) < 1e-6;
  };
  EXPECT_TRUE(near(0, {10, 0, 2}));
  EXPECT_TRUE(near(1, {0, 1, 0}));
  EXPECT_TRUE(near(2, glm::dvec3(10, 1, 2) * 0.5 + glm::dvec3(-1, 0, 0) * 0.5));
  EXPECT_NEAR(mesh.tangents[1].y, 1.0f, 1e-7f);
  EXPECT_NEAR(posed.high.x, 10.0, 1e-6);
}

// Scaling x by 2 changes the direction of the normal (1, 1, 0) to (1/2, 1, 0). If the transform mirrors, the normal stays on the same side
// of the surface.
TEST(Pose, TransformsNormalsOfSkinsByTheInverseTranspose) {
  ModelMesh mesh = pose_triangle();
  mesh.normals.assign(3, glm::vec3(glm::dvec3(1, 1, 0) * std::sqrt(0.5)));
  mesh.joints.assign(3, {0, 0, 0, 0});
  mesh.weights.assign(3, {1, 0, 0, 0});
  glm::dmat4 m(1.0);
  m[0].x = -2.0;
  apply_skin(mesh, std::vector<glm::dmat4>{m});
  EXPECT_NEAR(mesh.normals[0].x, -0.5 / std::sqrt(1.25), 1e-7);
  EXPECT_NEAR(mesh.normals[0].y, 1.0 / std::sqrt(1.25), 1e-7);
  EXPECT_EQ(mesh.tangents[0], glm::vec4(-1, 0, 0, -1));
}

TEST(Pose, SharesMeshesThatDeformInTheSameWay) {
  Model model = pose_model();
  model.nodes.resize(3);
  model.scenes[0].roots = {0, 1, 2};
  model.meshes[0].targets = {MorphTarget{{{0, 0, 1}, {0, 0, 1}, {0, 0, 1}}, {}, {}}};
  for (std::size_t i = 0; i < 3; ++i) {
    model.nodes[i].meshes = {0};
    model.nodes[i].morph_weights = {i < 2 ? 1.0f : 2.0f};
  }
  const PosedModel posed = pose(model, {});
  EXPECT_EQ(posed.meshes[0].deformed, posed.meshes[1].deformed);
  EXPECT_NE(posed.meshes[0].deformed, posed.meshes[2].deformed);
}

TEST(Pose, PlacesCamerasWithoutScaleAndLights) {
  Model model = pose_model();
  model.cameras.resize(1);
  model.lights.resize(1);
  model.nodes[0].camera = model.nodes[0].light = 0;
  model.nodes[0].transform = {{1, 2, 3}, kQuarterTurnAroundZ, {5, -6, 7}};
  const PosedModel posed = pose(model, {});
  const glm::dmat4& camera = posed.cameras.at(0).world_from_camera;
  EXPECT_EQ(camera[3], glm::dvec4(1, 2, 3, 1));
  EXPECT_NEAR(camera[1].x, 1.0, 1e-14);  // y up in the camera, mirrored by the scale
  EXPECT_EQ(camera[2], glm::dvec4(0, 0, 1, 0));
  EXPECT_NEAR(glm::determinant(camera), 1.0, 1e-14);
  EXPECT_EQ(posed.lights.at(0).world_from_light[3], glm::dvec4(1, 2, 3, 1));
}

// A node is drawn if it and all its ancestors are visible. Cameras are not affected (KHR_node_visibility).
TEST(Pose, OmitsHiddenNodesWithTheirDescendants) {
  Model model = pose_model();
  model.cameras.resize(1);
  model.lights.resize(1);
  model.nodes.resize(3);
  for (std::size_t i = 0; i < 3; ++i) model.nodes[i].meshes = {0};
  model.nodes[0].children = {1};
  model.nodes[2].camera = model.nodes[2].light = 0;
  model.scenes[0].roots = {0, 2};
  EXPECT_EQ(pose(model, {}).meshes.size(), 3u);
  model.nodes[0].visible = false;
  EXPECT_EQ(pose(model, {}).meshes.size(), 1u);
  model.nodes[2].visible = false;
  const PosedModel posed = pose(model, {});
  EXPECT_TRUE(posed.meshes.empty() && posed.lights.empty());
  EXPECT_EQ(posed.cameras.at(0).node, 2);
  AnimationChannel shown = channel(AnimatedProperty::visibility, KeyInterpolation::step, {0, 1}, {0, 1});
  shown.width = 1;
  model.animations = {{"", {shown}}};
  EXPECT_EQ(pose(model, {.animation = 0, .time = 0.9}).meshes.size(), 0u);
  EXPECT_EQ(pose(model, {.animation = 0, .time = 1.0}).meshes.size(), 2u);
}

TEST(Pose, OmitsNodesWhoseTransformOverflows) {
  Model model = pose_model();
  model.nodes[0].children = {1};
  model.nodes.resize(2);
  model.nodes[1].meshes = {0};
  model.nodes[0].transform.scale = model.nodes[1].transform.scale = {1e15, 1, 1};
  EXPECT_EQ(pose(model, {}).meshes.size(), 1u);
}

// A hierarchy of 100,000 levels is resolved without recursion.
TEST(Pose, HasNoDepthLimit) {
  Model model = pose_model();
  constexpr std::size_t kLevels = 100'000;
  model.nodes.resize(kLevels);
  for (std::size_t i = 0; i + 1 < kLevels; ++i) {
    model.nodes[i].transform.translation = {1, 0, 0};
    model.nodes[i].children = {static_cast<int>(i + 1)};
  }
  model.nodes[kLevels - 1].meshes = {0};
  EXPECT_EQ(pose(model, {}).high.x, static_cast<double>(kLevels));
}

}  // namespace
}  // namespace halfspace
