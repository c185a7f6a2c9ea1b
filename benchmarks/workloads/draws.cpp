// SPDX-License-Identifier: Apache-2.0
//
// draws_10k: ten thousand draw calls of two triangles, each with its own vertices and color. Measures the cost of a draw call.
#include "workloads/families.h"
#include "workloads/workload_canvas.h"
#include "workloads/workload_constant.h"
#include "workloads/workload_geometry.h"

namespace halfspace {

namespace {

class Draws final : public Workload {
 public:
  explicit Draws(WorkloadSize size) : canvas_(size), quads_(grid_of_quads()) {}

  void frame(const Workers& workers) override {
    Pass pass = canvas_.pass();
    for (const ColoredQuad& q : quads_) pass.draw(ConstantShader{q.color}, corners(q), indices_, workload_state());
    pass.run(workers);
  }
  WorkloadPicture picture() const override { return canvas_.picture(); }
  WorkloadTruth truth() const override {
    WorkloadTruth target = canvas_.truth();
    for (const ColoredQuad& q : quads_) draw_naive(target, ConstantShader{q.color}, corners(q), indices_, workload_state());
    return target;
  }

 private:
  static VertexView corners(const ColoredQuad& q) { return make_vertex_view(stream(std::span<const glm::vec3>(q.corners))); }

  Canvas canvas_;
  std::vector<ColoredQuad> quads_;
  Indices indices_{std::span<const uint32_t>(kStripTriangles), 4};
};

}  // namespace

std::unique_ptr<Workload> prepare_draws_10k(WorkloadSize size, WorkloadAssets&) { return std::make_unique<Draws>(size); }

}  // namespace halfspace
