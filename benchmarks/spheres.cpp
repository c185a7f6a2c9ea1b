// SPDX-License-Identifier: Apache-2.0
//
// sphere_phong, sphere_gouraud, sphere_flat at 20,000, 200,000 and 2,000,000 triangles; near_clip: from just inside of the sphere.
#include "families.h"
#include "sphere_camera.h"

namespace halfspace {

namespace {

template <class S>
std::unique_ptr<Workload> prepare_sphere(SphereDetail detail, WorkloadSize size, WorkloadAssets& assets) {
  auto parts = std::make_shared<const SphereAssets>(detail, assets);
  const S shader{sphere_uniforms(size, *parts->texture)};
  return std::make_unique<SingleDraw<S>>(size, shader, parts->vertex_view(), parts->indices(), workload_state(), parts);
}

}  // namespace

std::unique_ptr<Workload> prepare_sphere_phong(SphereDetail detail, WorkloadSize size, WorkloadAssets& assets) {
  return prepare_sphere<SpherePhong>(detail, size, assets);
}
std::unique_ptr<Workload> prepare_sphere_gouraud(SphereDetail detail, WorkloadSize size, WorkloadAssets& assets) {
  return prepare_sphere<SphereGouraud>(detail, size, assets);
}
std::unique_ptr<Workload> prepare_sphere_flat(SphereDetail detail, WorkloadSize size, WorkloadAssets& assets) {
  return prepare_sphere<SphereFlat>(detail, size, assets);
}

// The eye lies nearer to the surface than the near plane, which so cuts the triangles around it; it looks along the surface.
std::unique_ptr<Workload> prepare_near_clip(WorkloadSize size, WorkloadAssets& assets) {
  auto parts = std::make_shared<const SphereAssets>(k200k, assets);
  const glm::dvec3 eye{0.0, 0.0, 0.99};
  SpherePhong shader{sphere_uniforms(size, *parts->texture)};
  shader.clip_from_world = glm::mat4(workload_projection(size, 0.05, 10.0) * look_at(eye, eye + glm::dvec3(1, 0, 0), {0, 1, 0}));
  shader.eye_ws = glm::vec3(eye);
  return std::make_unique<SingleDraw<SpherePhong>>(size, shader, parts->vertex_view(), parts->indices(), DrawState{}, parts);
}

}  // namespace halfspace
