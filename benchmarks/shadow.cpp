// SPDX-License-Identifier: Apache-2.0
//
// shadow_200k: a depth map drawn from the light, and a picture that asks it nine times a pixel.
#include <array>

#include "families.h"
#include "shading/depth_only.h"
#include "workload_shadow.h"

namespace halfspace {

namespace {

constexpr int kMapSize = ShadowedShader::kMapSize;

// The depth pass as the naive pipeline takes it, which knows of no shader without colour.
struct DepthTwin : DepthOnly {
  template <class R>
  Fragment<R> fragment(const Varyings<R>&, const Pixel<R>&) const {
    return {vec4<R>(R(0))};
  }
};

struct PlaneVertex {
  glm::vec3 position, normal;
};
constexpr std::array<PlaneVertex, 4> kPlane{
    {{{-4, -1, 4}, {0, 1, 0}}, {{4, -1, 4}, {0, 1, 0}}, {{4, -1, -4}, {0, 1, 0}}, {{-4, -1, -4}, {0, 1, 0}}}};
constexpr std::array<uint32_t, 6> kPlaneTriangles{0, 1, 2, 0, 2, 3};

class Shadowed final : public Workload {
 public:
  Shadowed(WorkloadSize size, WorkloadAssets& assets)
      : canvas_(size),
        map_(kMapSize, kMapSize),
        sphere_(assets.sphere(k200k.rows, k200k.columns)),
        sphere_indices_(sphere_->indices, sphere_->vertices.size()) {
    const glm::dvec3 to_light = unit_or_zero({0.5, 1.0, 0.3}), eye{0.0, 1.5, 4.5};
    const glm::dmat4 light = orthographic_gl(3.2, 1.0, 0.5, 8.0) * look_at(3.0 * to_light, {0, 0, 0}, {0, 1, 0});
    depth_shader_.clip_from_object = glm::mat4(light);
    sphere_shader_ = {.clip_from_world = glm::mat4(workload_projection(size, 0.5, 20.0) * look_at(eye, {0.0, -0.3, 0.0}, {0, 1, 0})),
                      .light_from_world = glm::mat4(light),
                      .map = map_.data(),
                      .eye_ws = glm::vec3(eye),
                      .to_light_ws = glm::vec3(to_light),
                      .base = {0.8f, 0.3f, 0.2f}};
  }

  void frame(const Workers& workers) override {
    Pass light(kMapSize, kMapSize, ColorTarget{}, d32f_target(map_));
    light.draw_depth(depth_shader_, positions(), sphere_indices_, workload_state());
    light.run(workers);
    Pass pass = canvas_.pass();
    pass.draw(sphere_shader_, sphere_vertices(), sphere_indices_, workload_state());
    pass.draw(plane_shader(map_.data()), plane_vertices(), plane_indices_, workload_state());
    pass.run(workers);
  }
  WorkloadPicture picture() const override { return canvas_.picture(); }

  // The map too is drawn in double, then rounded to floats as it is stored.
  WorkloadTruth truth() const override {
    Image<float> map(kMapSize, kMapSize);
    {
      WorkloadTruth light(kMapSize, kMapSize, vec4<double>(0.0), 1.0);
      draw_naive(light, DepthTwin{depth_shader_}, positions(), sphere_indices_, workload_state());
      for (std::size_t i = 0; i < map.texels().size(); ++i) map.data()[i] = static_cast<float>(light.depth.data()[i]);
    }
    WorkloadTruth target = canvas_.truth();
    ShadowedShader sphere = sphere_shader_;
    sphere.map = map.data();
    draw_naive(target, sphere, sphere_vertices(), sphere_indices_, workload_state());
    draw_naive(target, plane_shader(map.data()), plane_vertices(), plane_indices_, workload_state());
    return target;
  }

 private:
  VertexView positions() const { return vertices(stream(sphere_->vertices, &SphereVertex::position)); }
  VertexView sphere_vertices() const {
    return vertices(stream(sphere_->vertices, &SphereVertex::position), stream(sphere_->vertices, &SphereVertex::normal));
  }
  static VertexView plane_vertices() { return vertices(stream(std::span<const PlaneVertex>(kPlane))); }
  ShadowedShader plane_shader(const float* map) const {
    ShadowedShader shader = sphere_shader_;
    shader.base = glm::vec3(0.6f);
    shader.map = map;
    return shader;
  }

  Canvas canvas_;
  Image<float> map_;
  std::shared_ptr<const SphereMesh> sphere_;
  Indices sphere_indices_;
  Indices plane_indices_{std::span<const uint32_t>(kPlaneTriangles), kPlane.size()};
  DepthOnly depth_shader_;
  ShadowedShader sphere_shader_;
};

}  // namespace

std::unique_ptr<Workload> prepare_shadow_200k(WorkloadSize size, WorkloadAssets& assets) {
  return std::make_unique<Shadowed>(size, assets);
}

}  // namespace halfspace
