// SPDX-License-Identifier: Apache-2.0
//
// shadow_200k: renders a depth map from the light, then an image that reads nine depth-map texels per pixel.
#include "halfspace/shading/surface/depth_only.h"
#include "workloads/families.h"
#include "workloads/workload_geometry.h"
#include "workloads/workload_shadow.h"

namespace halfspace {

namespace {

// The depth shader for the naive pipeline, which requires a fragment function.
struct DepthTwin : DepthOnly {
  template <class R>
  Fragment<R> fragment(const Varyings<R>&, const Pixel<R>&) const {
    return {vec4<R>(R(0))};
  }
};

class Shadowed final : public Workload {
 public:
  Shadowed(WorkloadSize size, WorkloadAssets& assets)
      : canvas_(size),
        map_(kShadowMapSize, kShadowMapSize),
        sphere_(assets.sphere(k200k.rows, k200k.columns)),
        sphere_indices_(sphere_->indices, sphere_->vertices.size()) {
    const ShadowCameras cameras = shadow_cameras(size);
    depth_shader_.clip_from_object = cameras.light_from_world;
    sphere_shader_ = {.clip_from_world = cameras.clip_from_world,
                      .light_from_world = cameras.light_from_world,
                      .map = {map_.data(), nullptr},
                      .eye_ws = cameras.eye_ws,
                      .to_light_ws = cameras.to_light_ws,
                      .base = kShadowSphereBase};
  }

  void frame(const Workers& workers) override {
    Pass light(kShadowMapSize, kShadowMapSize, ColorTarget{}, d32f_target(map_));
    light.draw_depth(depth_shader_, positions(), sphere_indices_, workload_state());
    light.run(workers);
    Pass pass = canvas_.pass();
    pass.draw(sphere_shader_, sphere_vertices(), sphere_indices_, workload_state());
    pass.draw(plane_shader(sphere_shader_.map), plane_vertices(), plane_indices_, workload_state());
    pass.run(workers);
  }
  WorkloadPicture picture() const override { return canvas_.picture(); }

  // The depth map is also rendered in double and then rounded to float, as it would be when stored.
  WorkloadTruth truth() const override {
    Image<float> map(kShadowMapSize, kShadowMapSize);
    {
      WorkloadTruth light(kShadowMapSize, kShadowMapSize, vec4<double>(0.0), 1.0);
      draw_naive(light, DepthTwin{depth_shader_}, positions(), sphere_indices_, workload_state());
      for (std::size_t i = 0; i < map.texels().size(); ++i) map.data()[i] = static_cast<float>(light.depth.data()[i]);
    }
    WorkloadTruth target = canvas_.truth();
    ShadowedShader sphere = sphere_shader_;
    sphere.map = {map.data(), nullptr};
    draw_naive(target, sphere, sphere_vertices(), sphere_indices_, workload_state());
    draw_naive(target, plane_shader(sphere.map), plane_vertices(), plane_indices_, workload_state());
    return target;
  }

 private:
  VertexView positions() const { return make_vertex_view(stream(sphere_->vertices, &SphereVertex::position)); }
  VertexView sphere_vertices() const {
    return make_vertex_view(stream(sphere_->vertices, &SphereVertex::position), stream(sphere_->vertices, &SphereVertex::normal));
  }
  static VertexView plane_vertices() { return make_vertex_view(stream(std::span<const PlaneVertex>(kShadowPlane))); }
  ShadowedShader plane_shader(const WorkloadShadowMap& map) const {
    ShadowedShader shader = sphere_shader_;
    shader.base = kShadowPlaneBase;
    shader.map = map;
    return shader;
  }

  Canvas canvas_;
  Image<float> map_;
  std::shared_ptr<const SphereMesh> sphere_;
  Indices sphere_indices_;
  Indices plane_indices_{std::span<const uint32_t>(kRoundTriangles), kShadowPlane.size()};
  DepthOnly depth_shader_;
  ShadowedShader sphere_shader_;
};

}  // namespace

std::unique_ptr<Workload> prepare_shadow_200k(WorkloadSize size, WorkloadAssets& assets) {
  return std::make_unique<Shadowed>(size, assets);
}

}  // namespace halfspace
