// SPDX-License-Identifier: Apache-2.0
//
// clear, fill: measure how fast pixels are written from tiles to the image.
#include <algorithm>

#include "workloads/families.h"
#include "workloads/workload_canvas.h"
#include "workloads/workload_constant.h"
#include "workloads/workload_geometry.h"

namespace halfspace {

namespace {

class Clear final : public Workload {
 public:
  explicit Clear(WorkloadSize size) : canvas_(size) {}
  void frame(const Workers& workers) override { canvas_.pass().run(workers); }
  WorkloadPicture picture() const override { return canvas_.picture(); }
  WorkloadTruth truth() const override { return canvas_.truth(); }

 private:
  Canvas canvas_;
};

// One quad over the whole image, without a depth buffer. The image is neither cleared nor loaded.
class Fill final : public Workload {
 public:
  explicit Fill(WorkloadSize size) : color_(size.width, size.height) {}
  void frame(const Workers& workers) override {
    ColorTarget target = rgba8_target(color_);
    target.load = LoadOp::dont_care;
    Pass pass(color_.width(), color_.height(), target, {});
    pass.draw(shader_, make_vertex_view(stream(std::span<const glm::vec3>(kFullQuad))), indices_, kState);
    pass.run(workers);
  }
  WorkloadPicture picture() const override { return {&color_, nullptr}; }
  WorkloadTruth truth() const override {
    return {color_.width(), color_.height(), vec4<double>(glm::dvec4(shader_.color)), 1.0};  // analytic result
  }

 private:
  static constexpr DrawState kState{.depth = {.test = false, .write = false}};
  Image<glm::u8vec4> color_;
  ConstantShader shader_{kFillColor};
  Indices indices_{std::span<const uint32_t>(kStripTriangles), kFullQuad.size()};
};

}  // namespace

std::unique_ptr<Workload> prepare_clear(WorkloadSize size, WorkloadAssets&) { return std::make_unique<Clear>(size); }
std::unique_ptr<Workload> prepare_fill(WorkloadSize size, WorkloadAssets&) { return std::make_unique<Fill>(size); }

}  // namespace halfspace
