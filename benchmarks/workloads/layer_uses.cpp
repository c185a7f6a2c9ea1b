// SPDX-License-Identifier: Apache-2.0
//
// blend_10, alpha_test: ten quads that are transparent or have holes.
#include "workloads/families.h"
#include "workloads/layer_mesh.h"
#include "workloads/workload_assets.h"

namespace halfspace {

namespace {

// All ten quads contribute to the image, because they are blended back to front.
class Blend final : public Workload {
 public:
  explicit Blend(WorkloadSize size)
      : canvas_(size), mesh_(layer_mesh(size, false)), indices_(Indices::sequential(mesh_.size())), shader_{layer_shader(size)} {}

  void frame(const Workers& workers) override {
    Pass pass = canvas_.pass();
    pass.draw(shader_, make_vertex_view(stream(mesh_)), indices_, state());
    pass.run(workers);
  }
  WorkloadPicture picture() const override { return canvas_.picture(); }

  // The naive pipeline does not blend, so draw one layer at a time and blend it with c = a·source + (1 − a)·c, where the source is clamped
  // to [0, 1].
  WorkloadTruth truth() const override {
    WorkloadTruth target = canvas_.truth();
    for (std::size_t first = 0; first < mesh_.size(); first += kLayerVertices) {
      const std::span<const LayerMesh::value_type> quad(&mesh_[first], kLayerVertices);
      WorkloadTruth layer = canvas_.truth();
      draw_naive(layer, shader_, make_vertex_view(stream(quad)), Indices::sequential(quad.size()), workload_state());
      for (std::size_t i = 0; i < target.color.texels().size(); ++i) {
        if (layer.depth.data()[i] == 1.0) continue;
        vec4<double>& to = target.color.data()[i];
        to = vec4<double>(0.5 * (glm::min(glm::dvec3(glm::dvec4(layer.color.data()[i])), 1.0) + vec3<double>(to)), 1.0);
      }
    }
    return target;
  }

 private:
  static DrawState state() {
    DrawState state = workload_state();
    state.blend = BlendState{};
    state.depth.write = false;
    return state;
  }

  Canvas canvas_;
  LayerMesh mesh_;
  Indices indices_;
  BlendedLayerShader shader_;
};

struct PerforatedParts {
  LayerMesh mesh;
  std::shared_ptr<const Texture2D> texture;
};

}  // namespace

std::unique_ptr<Workload> prepare_blend_10(WorkloadSize size, WorkloadAssets&) { return std::make_unique<Blend>(size); }

std::unique_ptr<Workload> prepare_alpha_test(WorkloadSize size, WorkloadAssets& assets) {
  auto parts = std::make_shared<const PerforatedParts>(PerforatedParts{layer_mesh(size, true), assets.checker()});
  const PerforatedLayerShader shader{layer_shader(size), parts->texture.get()};
  return std::make_unique<SingleDraw<PerforatedLayerShader>>(size, shader, make_vertex_view(stream(parts->mesh)),
                                                             Indices::sequential(parts->mesh.size()), workload_state(), parts);
}

}  // namespace halfspace
