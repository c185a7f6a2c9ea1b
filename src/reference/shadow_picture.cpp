// SPDX-License-Identifier: Apache-2.0
//
// Draws the rasterized images that are validated against rays.
#include <chrono>
#include <vector>

#include "halfspace/geometry/camera.h"
#include "halfspace/geometry/mesh.h"
#include "halfspace/raster/pass.h"
#include "halfspace/reference/pixel_truth.h"
#include "halfspace/reference/shadow_mask.h"

namespace halfspace::HS_LANES {

namespace {

// A mesh without shared vertices: each triangle has three vertices of its own, which store its index.
struct UnsharedMesh {
  std::vector<glm::vec3> positions, normals;
  std::vector<float> triangles;
};

UnsharedMesh unshared(const PlacedMesh& placed) {
  UnsharedMesh out;
  const Indices& indices = *placed.indices;
  for (std::size_t i = 0; i < indices.size(); ++i) {
    out.positions.push_back(placed.positions[indices[i]]);
    out.normals.push_back(placed.normals[indices[i]]);
    out.triangles.push_back(static_cast<float>(i / 3));
  }
  return out;
}

ShadowMask mask_of(const PlacedMesh& placed, const View& view) {
  ShadowMask s;
  glm::dmat4 world = placed.world_from_object;
  s.clip_from_object = glm::mat4(view.clip_from_world * world);
  world[3] -= glm::dvec4(view.eye_ws, 0.0);
  s.world_from_object = glm::mat4(world);
  s.normal_from_object = normal_matrix(world);
  s.to_eye_ws = glm::vec3(view.to_eye_ws);
  return s;
}

}  // namespace

ShadowPicture draw_shadow_picture(const LightChoice& choice, const View& view, int width, int height, bool with_shadow,
                                  const Workers& workers, const Image<glm::vec3>* shading_normals) {
  const PreparedScene& scene = *choice.scene;
  const PreparedLight& light = scene.lights[choice.index];
  ShadowPicture out{Image<glm::vec4>(width, height), Image<float>(width, height), 0.0};
  DepthTarget depth = d32f_target(out.depth);
  depth.clear_value = 0.0f;
  Pass pass(width, height, rgba32f_target(out.mask), depth);
  std::vector<UnsharedMesh> meshes;
  meshes.reserve(scene.meshes.size());  // the pass keeps pointers to the elements
  for (std::size_t m = 0; m < scene.meshes.size(); ++m) {
    const PlacedMesh& placed = scene.meshes[m];
    const UnsharedMesh& mesh = meshes.emplace_back(unshared(placed));
    ShadowMask shader = mask_of(placed, view);
    shader.light = light.light;
    if (!with_shadow || !placed.receives_shadow) shader.light.shadow = nullptr;
    shader.mesh = static_cast<float>(m);
    if (shading_normals != nullptr) shader.shading_normals = &shading_normals->texels().data()->x;
    shader.width = width;
    shader.height = height;
    const DrawState state = opaque_state(placed.two_sided ? CullMode::none : CullMode::back, placed.mirrored());
    pass.draw(shader, make_vertex_view(stream(mesh.positions), stream(mesh.normals), stream(mesh.triangles)), state);
  }
  const auto start = std::chrono::steady_clock::now();
  pass.run(workers);
  out.draw_ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
  return out;
}

}  // namespace halfspace::HS_LANES
