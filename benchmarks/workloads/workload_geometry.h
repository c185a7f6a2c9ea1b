// SPDX-License-Identifier: Apache-2.0
//
// Meshes and cameras of the workloads other than the sphere and layer workloads, shared by all renderers.
#pragma once

#include <array>
#include <vector>

#include "workloads/workload.h"
#include "workloads/workload_canvas.h"
#include "workloads/workload_points.h"
#include "workloads/workload_sphere.h"

namespace halfspace {

/// A quad that covers the whole image, as a triangle strip in normalized device coordinates.
inline constexpr std::array<glm::vec3, 4> kFullQuad{{{-1, -1, 0}, {1, -1, 0}, {-1, 1, 0}, {1, 1, 0}}};
inline constexpr glm::vec4 kFillColor{0.25f, 0.50f, 0.75f, 1.0f};

/// Returns `count` right triangles of `area` px² as a triangle list in normalized device coordinates. They fill a grid over the image; when
/// the grid is full, another layer starts in front of it.
std::vector<glm::vec3> tiny_triangles(WorkloadSize size, int count, double area = 1.0);
inline constexpr glm::vec4 kTinyColor{0.9f, 0.6f, 0.1f, 1.0f};

/// Returns 100,000 points, uniformly distributed in the cube [−1, 1)³ by a linear congruential generator with the constants of Numerical
/// Recipes.
std::vector<glm::vec3> point_cloud();
/// Returns a shader for points seen from (0, 0, 4).
PointShader point_shader(WorkloadSize size);

/// A quad with its color. The corners form a triangle strip in normalized device coordinates.
struct ColoredQuad {
  glm::vec4 color;
  std::array<glm::vec3, 4> corners;
};
/// Returns 100 x 100 quads on a grid over the image, each 0.8 cells wide and high.
std::vector<ColoredQuad> grid_of_quads();

/// Indices that split a quad into two counter-clockwise triangles, for corners in counter-clockwise order or in strip order.
inline constexpr std::array<uint32_t, 6> kRoundTriangles{0, 1, 2, 0, 2, 3}, kStripTriangles{0, 1, 2, 2, 1, 3};

/// A plane of 500 x 251 units in world space that reaches almost to the horizon. The corners are in counter-clockwise order.
inline constexpr std::array<glm::vec3, 4> kFloor{{{-250, -1, 1}, {250, -1, 1}, {250, -1, -250}, {-250, -1, -250}}};
glm::mat4 floor_camera(WorkloadSize size);

struct PlaneVertex {
  glm::vec3 position, normal;
};
/// The plane that receives the shadow. The corners are in counter-clockwise order.
inline constexpr std::array<PlaneVertex, 4> kShadowPlane{
    {{{-4, -1, 4}, {0, 1, 0}}, {{4, -1, 4}, {0, 1, 0}}, {{4, -1, -4}, {0, 1, 0}}, {{-4, -1, -4}, {0, 1, 0}}}};
inline constexpr glm::vec3 kShadowSphereBase{0.8f, 0.3f, 0.2f}, kShadowPlaneBase{0.6f};
struct ShadowCameras {
  glm::mat4 clip_from_world, light_from_world;
  glm::vec3 eye_ws, to_light_ws;
};
ShadowCameras shadow_cameras(WorkloadSize size);

/// Returns uniforms for a camera just inside the unit sphere that looks along its surface. The surface is closer to the camera than the
/// near plane, so the triangles around the camera are clipped.
SphereUniforms near_clip_uniforms(WorkloadSize size, const Texture2D& texture);

}  // namespace halfspace
