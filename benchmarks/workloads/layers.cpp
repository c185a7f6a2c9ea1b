// SPDX-License-Identifier: Apache-2.0
//
// layers_b2f, layers_f2b, depth_prepass: ten quads, one behind another. Measures the cost of overdraw in the worst and the best order, and
// how much a depth prepass improves the worst order.
#include <array>

#include "halfspace/shading/surface/depth_only.h"
#include "workloads/families.h"
#include "workloads/layer_mesh.h"

namespace halfspace {

namespace {

// k is the layer's distance from the eye on a scale from 0 to 10.
void add_layer(double k, double aspect, LayerMesh& to) {
  const double z = -(2.0 + 0.5 * k), h = 1.05 * -z * kTanHalfAngle, w = h * aspect;
  const glm::vec3 base(glm::dvec3(0.1 * (k + 1), 0.5, 1.0 - 0.1 * k));
  const std::array<glm::dvec2, kLayerVertices> corners{{{-1, -1}, {1, -1}, {1, 1}, {-1, -1}, {1, 1}, {-1, 1}}};
  for (const glm::dvec2& c : corners) to.push_back({glm::vec3(glm::dvec3(c.x * w, c.y * h, z)), {0, 0, 1}, base});
}

std::unique_ptr<Workload> prepare_layers(WorkloadSize size, bool front_to_back) {
  auto mesh = std::make_shared<const LayerMesh>(layer_mesh(size, front_to_back));
  return std::make_unique<SingleDraw<LayerShader>>(size, layer_shader(size), make_vertex_view(stream(*mesh)),
                                                   Indices::sequential(mesh->size()), workload_state(), mesh);
}

class DepthPrepass final : public Workload {
 public:
  explicit DepthPrepass(WorkloadSize size)
      : canvas_(size), mesh_(layer_mesh(size, false)), indices_(Indices::sequential(mesh_.size())), shader_(layer_shader(size)) {}

  void frame(const Workers& workers) override {
    DrawState equal = workload_state();
    equal.depth.compare = CompareOp::equal;
    equal.depth.write = false;
    Pass pass = canvas_.pass();
    pass.draw_depth(DepthOnly{shader_.clip_from_eye}, make_vertex_view(stream(mesh_, &LayerMesh::value_type::position_es)), indices_,
                    workload_state());
    pass.draw(shader_, make_vertex_view(stream(mesh_)), indices_, equal);
    pass.run(workers);
  }
  WorkloadPicture picture() const override { return canvas_.picture(); }
  WorkloadTruth truth() const override {  // a depth prepass does not change the image
    WorkloadTruth target = canvas_.truth();
    draw_naive(target, shader_, make_vertex_view(stream(mesh_)), indices_, workload_state());
    return target;
  }

 private:
  Canvas canvas_;
  LayerMesh mesh_;
  Indices indices_;
  LayerShader shader_;
};

}  // namespace

LayerMesh layer_mesh(WorkloadSize size, bool front_to_back, int layers) {
  LayerMesh mesh;
  const double aspect = static_cast<double>(size.width) / size.height;
  for (int i = 0; i < layers; ++i) {
    const int k = front_to_back ? i : layers - 1 - i;
    add_layer(static_cast<double>(k * kLayers) / layers, aspect, mesh);
  }
  return mesh;
}

LayerShader layer_shader(WorkloadSize size) { return {.clip_from_eye = glm::mat4(workload_projection(size, 0.5, 10.0))}; }

std::unique_ptr<Workload> prepare_layers_b2f(WorkloadSize size, WorkloadAssets&) { return prepare_layers(size, false); }
std::unique_ptr<Workload> prepare_layers_f2b(WorkloadSize size, WorkloadAssets&) { return prepare_layers(size, true); }
std::unique_ptr<Workload> prepare_depth_prepass(WorkloadSize size, WorkloadAssets&) { return std::make_unique<DepthPrepass>(size); }

}  // namespace halfspace
