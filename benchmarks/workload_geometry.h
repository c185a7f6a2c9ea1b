// SPDX-License-Identifier: Apache-2.0
//
// Meshes and cameras of the workloads that are more than a sphere or layers: the same for every renderer that draws them.
#pragma once

#include <array>
#include <vector>

#include "workload.h"
#include "workload_canvas.h"
#include "workload_points.h"
#include "workload_sphere.h"

namespace halfspace {

/// A quad over the whole picture, in normalized device coordinates; as a strip.
inline constexpr std::array<glm::vec3, 4> kFullQuad{{{-1, -1, 0}, {1, -1, 0}, {-1, 1, 0}, {1, 1, 0}}};
inline constexpr glm::vec4 kFillColor{0.25f, 0.50f, 0.75f, 1.0f};

/// Right triangles of `area` px² on a grid over the picture, layer before layer, each nearer than the one before; three corners
/// each, in normalized device coordinates.
std::vector<glm::vec3> tiny_triangles(WorkloadSize size, int count, double area = 1.0);
inline constexpr glm::vec4 kTinyColor{0.9f, 0.6f, 0.1f, 1.0f};

/// 100,000 places evenly over the cube [−1, 1)³, by a linear congruential generator (Numerical Recipes' constants).
std::vector<glm::vec3> point_cloud();
/// The uniforms of points seen from (0, 0, 4).
PointShader point_shader(WorkloadSize size);

/// A quad of its own colour; corners as a strip in normalized device coordinates.
struct ColoredQuad {
  glm::vec4 color;
  std::array<glm::vec3, 4> corners;
};
/// 100 x 100 of them, each over four fifths of its cell of the picture.
std::vector<ColoredQuad> grid_of_quads();

/// Two triangles of four corners that go round, counter-clockwise; and of a strip.
inline constexpr std::array<uint32_t, 6> kRoundTriangles{0, 1, 2, 0, 2, 3}, kStripTriangles{0, 1, 2, 2, 1, 3};

/// A plane of 500 x 251 units to just below the horizon, in world space; its corners go round.
inline constexpr std::array<glm::vec3, 4> kFloor{{{-250, -1, 1}, {250, -1, 1}, {250, -1, -250}, {-250, -1, -250}}};
glm::mat4 floor_camera(WorkloadSize size);

struct PlaneVertex {
  glm::vec3 position, normal;
};
/// What the shadow falls on; its corners go round.
inline constexpr std::array<PlaneVertex, 4> kShadowPlane{
    {{{-4, -1, 4}, {0, 1, 0}}, {{4, -1, 4}, {0, 1, 0}}, {{4, -1, -4}, {0, 1, 0}}, {{-4, -1, -4}, {0, 1, 0}}}};
inline constexpr glm::vec3 kShadowSphereBase{0.8f, 0.3f, 0.2f}, kShadowPlaneBase{0.6f};
struct ShadowCameras {
  glm::mat4 clip_from_world, light_from_world;
  glm::vec3 eye_ws, to_light_ws;
};
ShadowCameras shadow_cameras(WorkloadSize size);

/// The camera from just inside of the unit sphere that looks along its surface. It lies nearer to it than the near plane, which so cuts
/// the triangles around it.
SphereUniforms near_clip_uniforms(WorkloadSize size, const Texture2D& texture);

}  // namespace halfspace
