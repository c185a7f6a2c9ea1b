// SPDX-License-Identifier: Apache-2.0
//
// sphere_phong, sphere_gouraud, sphere_flat: a sphere with 20,000, 200,000 or 2,000,000 triangles. near_clip: the sphere seen from inside,
// close to its surface.
#include "workloads/families.h"
#include "workloads/sphere_camera.h"
#include "workloads/workload_geometry.h"

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

std::unique_ptr<Workload> prepare_near_clip(WorkloadSize size, WorkloadAssets& assets) {
  auto parts = std::make_shared<const SphereAssets>(k200k, assets);
  const SpherePhong shader{near_clip_uniforms(size, *parts->texture)};
  return std::make_unique<SingleDraw<SpherePhong>>(size, shader, parts->vertex_view(), parts->indices(), DrawState{}, parts);
}

}  // namespace halfspace
