// SPDX-License-Identifier: Apache-2.0
//
// Composed scenes: an architectural interior, a garden and a workshop, each seen by five cameras, and the scenes of the views, which show
// only a part of what they contain. All are procedurally generated, and drawn in the way an application would: a shadow map, then opaque
// and alpha-tested surfaces, then blended ones from back to front.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "matrix/matrix_scene.h"
#include "workloads/workload.h"

namespace halfspace {

enum class SceneKind : uint8_t { hall, garden, workshop, street, detail, far, turn, leaves };

/// Listed in drawing order.
enum class SceneSurface : uint8_t {
  opaque,
  cutout,  ///< discards fragments whose texture has an alpha below 1/2
  unlit,   ///< casts no shadow
  blended  ///< casts no shadow
};

struct SceneMaterial {
  SceneSurface surface = SceneSurface::opaque;
  std::size_t texture = 0;
  glm::vec3 tint{1.0f};
  float gloss = 0.0f;  ///< factor of the highlight
  float alpha = 1.0f;  ///< alpha of a blended surface seen head-on; multiplied by the texture's alpha
  bool two_sided = false;
};

using SceneVertex = MatrixVertex;  // positions are in object space

/// A range of Scene::indices.
struct SceneMesh {
  uint32_t first, count;
  glm::dvec3 low, high;  ///< bounding box in object space

  glm::dvec3 center() const { return 0.5 * (low + high); }
};

/// A draw call.
struct SceneObject {
  std::size_t mesh, material;
  glm::dmat4 world_from_object;  ///< also transforms normals, which must then be normalized
};

struct SceneLighting {
  glm::vec3 to_sun;            ///< unit vector
  glm::vec3 sun, sky, ground;  ///< colors; sky and ground light surfaces that face up and down
  glm::vec3 lamp_ws, lamp;     ///< position and color of a lamp that casts no shadow
  glm::vec3 haze;              ///< color of far surfaces
  float haze_distance;         ///< distance at which half of the color is haze
  glm::dvec3 shadow_center;    ///< center and half the side of the cube that the shadow map covers
  double shadow_radius;
};

struct SceneCamera {
  glm::dvec3 eye, target;
};

struct Scene {
  std::vector<SceneVertex> vertices;
  std::vector<uint32_t> indices;
  std::vector<SceneMesh> meshes;
  std::vector<std::shared_ptr<const Texture2D>> textures;
  std::vector<SceneMaterial> materials;
  std::vector<SceneObject> objects;
  SceneLighting light;
  std::vector<SceneCamera> cameras;
  /// Objects whose bounding boxes are outside of the camera's frustum, or of the shadow map, are not drawn, and those with depth tests
  /// and without blending are drawn from front to back. Otherwise, everything is drawn, sorted by material.
  bool culls_objects = false;
  /// Most of what is far is behind what is near, so it pays to find out what is hidden. Requires culls_objects.
  bool near_hides_far = false;

  const SceneMaterial& material(const SceneObject& object) const { return materials[object.material]; }
  const SceneMesh& mesh(const SceneObject& object) const { return meshes[object.mesh]; }
  std::size_t triangles() const;  ///< number of triangles of all objects
};

Scene make_scene(SceneKind kind);
/// Returns the scene of `assets`, which make_scene() creates at the first call.
std::shared_ptr<const Scene> shared_scene(WorkloadAssets& assets, SceneKind kind);

/// Data of a frame with one camera, in addition to the scene.
struct SceneView {
  glm::mat4 clip_from_world, light_from_world;
  glm::vec3 eye_ws;
  std::vector<std::size_t> order;  ///< drawing order of the objects: by surface, see Scene::culls_objects; blended ones from back to front
  std::vector<std::size_t> casters;  ///< the objects that cast shadows, in the same order
};
SceneView scene_view(const Scene& scene, const SceneCamera& camera, WorkloadSize size);

/// Draw states of the shadow map, of surfaces without blending, and of blended surfaces.
DrawState scene_shadow_state();
DrawState scene_state(const SceneMaterial& material);

/// For the comparison with the shadow map, a point is moved along its normal by this distance, in meters.
inline constexpr float kSceneNormalOffset = 0.05f;
/// Bias of the shadow comparison, in window-space depth.
inline constexpr float kSceneBias = 0.0004f;

/// A row of the benchmark.
struct SceneRow {
  std::string name, what;
  SceneKind kind;
  std::size_t camera;        ///< the first camera
  std::size_t pictures = 1;  ///< drawn in a frame, each by the next camera
  bool keeps_map = false;    ///< the pictures of a frame share a shadow map
};
/// Returns the rows of the composed scenes, five cameras each.
std::span<const SceneRow> scene_rows();
/// Returns the rows of the views.
std::span<const SceneRow> view_rows();
/// Returns what each picture of a row needs.
std::vector<SceneView> scene_views(const Scene& scene, const SceneRow& row, WorkloadSize size);
/// Return a workload for each row, drawn by Halfspace.
std::span<const WorkloadKind> scene_workloads();
std::span<const WorkloadKind> view_workloads();

}  // namespace halfspace
