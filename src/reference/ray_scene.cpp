// SPDX-License-Identifier: Apache-2.0
#include "halfspace/reference/ray_scene.h"

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <algorithm>
#include <string>
#include <vector>

#include "halfspace/core/check.h"
#include "halfspace/core/float_mode.h"

namespace halfspace::HS_LANES {

namespace {

RTCRay make_ray(const glm::vec3& origin, const glm::vec3& direction, float near, float far) {
  RTCRay ray{};
  ray.org_x = origin.x;
  ray.org_y = origin.y;
  ray.org_z = origin.z;
  ray.dir_x = direction.x;
  ray.dir_y = direction.y;
  ray.dir_z = direction.z;
  ray.tnear = near;
  ray.tfar = far;
  ray.mask = ~0u;
  return ray;
}

void intersect(RTCScene scene, RTCRayHit& query) {
#if RTC_VERSION_MAJOR >= 4
  rtcIntersect1(scene, &query);
#else
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcIntersect1(scene, &context, &query);
#endif
}

bool is_occluded(RTCScene scene, RTCRay& ray) {
#if RTC_VERSION_MAJOR >= 4
  rtcOccluded1(scene, &ray);
#else
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcOccluded1(scene, &context, &ray);
#endif
  return ray.tfar < 0.0f;  // Embree sets tfar to −inf if the ray is occluded
}

}  // namespace

struct RayScene::Impl {
  struct DeviceDeleter {
    void operator()(RTCDevice d) const { rtcReleaseDevice(d); }
  };
  struct SceneDeleter {
    void operator()(RTCScene s) const { rtcReleaseScene(s); }
  };
  struct Placed {
    std::vector<glm::dvec3> positions_rws;
    std::shared_ptr<const Indices> indices;
  };
  std::unique_ptr<std::remove_pointer_t<RTCDevice>, DeviceDeleter> device;
  std::unique_ptr<std::remove_pointer_t<RTCScene>, SceneDeleter> scene;
  std::vector<Placed> placed;  // indexed by mesh

  void add_spheres(const Particles& spheres, const glm::dvec3& eye_ws, unsigned id);
};

void RayScene::Impl::add_spheres(const Particles& spheres, const glm::dvec3& eye_ws, unsigned id) {
  const RTCGeometry geometry = rtcNewGeometry(device.get(), RTC_GEOMETRY_TYPE_SPHERE_POINT);
  auto* rows = static_cast<float*>(
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT4, 4 * sizeof(float), spheres.radii.size()));
  for (std::size_t i = 0; i < spheres.radii.size(); ++i) {
    const glm::vec3 center_rws(spheres.centers_ws[i] - eye_ws);
    for (const float f : {center_rws.x, center_rws.y, center_rws.z, spheres.radii[i]}) *rows++ = f;
  }
  rtcCommitGeometry(geometry);
  rtcAttachGeometryByID(scene.get(), geometry, id);
  rtcReleaseGeometry(geometry);
}

RayScene::RayScene(std::span<const PlacedMesh> meshes, const glm::dvec3& eye_ws, bool casters_only, std::span<const PlacedSpheres> spheres)
    : impl_(std::make_unique<Impl>()) {
  impl_->device.reset(rtcNewDevice("threads=1"));  // a single thread builds the tree, so that it is the same every time
  if (impl_->device == nullptr) throw InputError("Embree cannot start on this machine");
  impl_->scene.reset(rtcNewScene(impl_->device.get()));
  rtcSetSceneFlags(impl_->scene.get(), RTC_SCENE_FLAG_ROBUST);
  rtcSetSceneBuildQuality(impl_->scene.get(), RTC_BUILD_QUALITY_HIGH);
  impl_->placed.resize(meshes.size());
  for (std::size_t m = 0; m < meshes.size(); ++m) {
    const PlacedMesh& mesh = meshes[m];
    if (casters_only && !mesh.casts_shadow) continue;
    Impl::Placed& placed = impl_->placed[m];
    placed.indices = mesh.indices;
    for (const glm::vec3& p : mesh.positions)
      placed.positions_rws.push_back(glm::dvec3(mesh.world_from_object * glm::dvec4(glm::dvec3(p), 1.0)) - eye_ws);
    const RTCGeometry geometry = rtcNewGeometry(impl_->device.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
    const std::size_t triangles = mesh.indices->size() / 3;
    auto* vertices = static_cast<float*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), placed.positions_rws.size()));
    for (const glm::dvec3& p : placed.positions_rws)
      for (int k = 0; k < 3; ++k) *vertices++ = static_cast<float>(p[k]);
    auto* indices = static_cast<uint32_t*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(uint32_t), triangles));
    for (std::size_t i = 0; i < 3 * triangles; ++i) *indices++ = (*mesh.indices)[i];
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(impl_->scene.get(), geometry, static_cast<unsigned>(m));
    rtcReleaseGeometry(geometry);
  }
  for (std::size_t k = 0; k < spheres.size(); ++k) {
    if (spheres[k].casts_shadow || !casters_only)
      impl_->add_spheres(*spheres[k].particles, eye_ws, static_cast<unsigned>(meshes.size() + k));
  }
  rtcCommitScene(impl_->scene.get());
}

RayScene::~RayScene() = default;
RayScene::RayScene(RayScene&&) noexcept = default;
RayScene& RayScene::operator=(RayScene&&) noexcept = default;

std::optional<RayHit> RayScene::nearest(const glm::vec3& origin_rws, const glm::vec3& direction_ws, float near, float far) const {
  RTCRayHit query{};
  query.ray = make_ray(origin_rws, direction_ws, near, far);
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  intersect(impl_->scene.get(), query);
  if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
  if (query.hit.geomID >= impl_->placed.size()) {
    const glm::dvec3 along = static_cast<double>(query.ray.tfar) * glm::dvec3(direction_ws);
    const glm::dvec3 normal(query.hit.Ng_x, query.hit.Ng_y, query.hit.Ng_z);
    return RayHit{static_cast<int>(impl_->placed.size()) - 1 - static_cast<int>(query.hit.geomID),
                  query.hit.primID,
                  query.ray.tfar,
                  {},
                  glm::dvec3(origin_rws) + along,
                  normal / std::max(glm::length(normal), 1e-300)};
  }
  const Impl::Placed& placed = impl_->placed[query.hit.geomID];
  std::array<glm::dvec3, 3> corner;
  for (std::size_t k = 0; k < 3; ++k) corner[k] = placed.positions_rws[(*placed.indices)[3 * std::size_t{query.hit.primID} + k]];
  const double u = static_cast<double>(query.hit.u), v = static_cast<double>(query.hit.v);
  const glm::dvec3 normal = glm::cross(corner[1] - corner[0], corner[2] - corner[0]);
  return RayHit{static_cast<int>(query.hit.geomID),
                query.hit.primID,
                query.ray.tfar,
                {1.0 - u - v, u, v},
                corner[0] * (1.0 - u - v) + corner[1] * u + corner[2] * v,
                normal / std::max(glm::length(normal), 1e-300)};
}

bool RayScene::occluded(const glm::vec3& origin_rws, const glm::vec3& direction_ws, float near, float far) const {
  RTCRay ray = make_ray(origin_rws, direction_ws, near, far);
  return is_occluded(impl_->scene.get(), ray);
}

}  // namespace halfspace::HS_LANES
