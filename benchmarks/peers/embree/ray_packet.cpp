// SPDX-License-Identifier: Apache-2.0
#include "peers/embree/ray_packet.h"

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <array>
#include <limits>
#include <tuple>
#include <type_traits>

#include "halfspace/core/check.h"

namespace halfspace {

struct RayMesh::Impl {
  std::shared_ptr<const SphereMesh> mesh;  // shared with Embree, so it must stay alive
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;

  ~Impl() {
    rtcReleaseScene(scene);
    rtcReleaseDevice(device);
  }
};

namespace {

using Packet = std::conditional_t<kRays == 16, RTCRayHit16, std::conditional_t<kRays == 8, RTCRayHit8, RTCRayHit4>>;

constexpr auto kIntersect = std::get<kRays / 8>(std::tuple{&rtcIntersect4, &rtcIntersect8, &rtcIntersect16});

// Embree 3 and 4 use different names for the coherent-rays flag and a different argument order.
#if RTC_VERSION_MAJOR >= 4
using How = RTCIntersectArguments;
How close_together() {
  How how;
  rtcInitIntersectArguments(&how);
  how.flags = RTC_RAY_QUERY_FLAG_COHERENT;
  return how;
}
void intersect(const int* valid, RTCScene scene, How& how, Packet& packet) { kIntersect(valid, scene, &packet, &how); }
#else
using How = RTCIntersectContext;
How close_together() {
  How how;
  rtcInitIntersectContext(&how);
  how.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  return how;
}
void intersect(const int* valid, RTCScene scene, How& how, Packet& packet) { kIntersect(valid, scene, &how, &packet); }
#endif

}  // namespace

RayMesh::RayMesh(std::shared_ptr<const SphereMesh> mesh) : impl_(std::make_unique<Impl>()) {
  impl_->mesh = std::move(mesh);
  impl_->device = rtcNewDevice(nullptr);
  if (impl_->device == nullptr) throw InputError("Embree cannot start on this machine");
  impl_->scene = rtcNewScene(impl_->device);
  const SphereMesh& from = *impl_->mesh;
  RTCGeometry geometry = rtcNewGeometry(impl_->device, RTC_GEOMETRY_TYPE_TRIANGLE);
  rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, from.vertices.data(), 0, sizeof(SphereVertex),
                             from.vertices.size());
  rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, from.indices.data(), 0, 3 * sizeof(uint32_t),
                             from.indices.size() / 3);
  rtcSetGeometryBuildQuality(geometry, RTC_BUILD_QUALITY_HIGH);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(impl_->scene, geometry);
  rtcReleaseGeometry(geometry);
  rtcSetSceneBuildQuality(impl_->scene, RTC_BUILD_QUALITY_HIGH);
  rtcCommitScene(impl_->scene);
}

RayMesh::~RayMesh() = default;

RayInt RayMesh::first_triangles(const glm::vec3& origin, const vec3<RayReal>& direction) const {
  Packet packet;
  RTCHitN* const hit = reinterpret_cast<RTCHitN*>(&packet.hit);
  RTCRayN* const ray = reinterpret_cast<RTCRayN*>(&packet.ray);
  alignas(64) std::array<int, kRays> valid;  // Embree loads this array as one vector
  for (unsigned i = 0; i < kRays; ++i) {
    const int k = static_cast<int>(i);
    valid[i] = -1;
    RTCRayN_org_x(ray, kRays, i) = origin.x;
    RTCRayN_org_y(ray, kRays, i) = origin.y;
    RTCRayN_org_z(ray, kRays, i) = origin.z;
    RTCRayN_dir_x(ray, kRays, i) = lane(direction.x, k);
    RTCRayN_dir_y(ray, kRays, i) = lane(direction.y, k);
    RTCRayN_dir_z(ray, kRays, i) = lane(direction.z, k);
    RTCRayN_tnear(ray, kRays, i) = 0.0f;
    RTCRayN_tfar(ray, kRays, i) = std::numeric_limits<float>::infinity();
    RTCRayN_time(ray, kRays, i) = 0.0f;
    RTCRayN_mask(ray, kRays, i) = ~0u;
    RTCRayN_id(ray, kRays, i) = 0;
    RTCRayN_flags(ray, kRays, i) = 0;
    RTCHitN_geomID(hit, kRays, i) = RTC_INVALID_GEOMETRY_ID;
    RTCHitN_instID(hit, kRays, i, 0) = RTC_INVALID_GEOMETRY_ID;
  }
  How how = close_together();
  intersect(valid.data(), impl_->scene, how, packet);
  RayInt triangles(-1);
  for (unsigned i = 0; i < kRays; ++i) {
    if (RTCHitN_geomID(hit, kRays, i) != RTC_INVALID_GEOMETRY_ID)
      set_lane(triangles, static_cast<int>(i), static_cast<int32_t>(RTCHitN_primID(hit, kRays, i)));
  }
  return triangles;
}

}  // namespace halfspace
