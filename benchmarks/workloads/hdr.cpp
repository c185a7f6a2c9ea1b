// SPDX-License-Identifier: Apache-2.0
//
// hdr_200k, tonemap: HDR rendering to half floats, and tone mapping. The tone curve is a post step of the pass, which runs while a tile is
// in cache. hdr_200k also stores the half floats, because the workload is defined to leave the HDR image in memory.
#include "workloads/families.h"
#include "workloads/workload_tone.h"

namespace halfspace {

namespace {

// Renders an image in half floats and tone-maps it to 8 bits.
class Hdr : public Workload {
 public:
  Hdr(WorkloadSize size, WorkloadAssets& assets)
      : light_(size.width, size.height),
        depth_(size.width, size.height),
        color_(size.width, size.height),
        assets_(k200k, assets),
        indices_(assets_.indices()),
        shader_{{sphere_uniforms(size, *assets_.texture)}} {}

  void frame(const Workers& workers) override {
    ColorTarget target = rgba16f_target(light_);
    target.clear_value = kClear;
    Pass pass(light_.width(), light_.height(), target, d32f_target(depth_));
    pass.draw(shader_, assets_.vertex_view(), indices_, workload_state());
    pass.post(WorkloadTone{}, rgba8_target(color_));
    pass.run(workers);
  }
  WorkloadPicture picture() const override { return {&color_, &depth_}; }
  WorkloadTruth truth() const override {
    WorkloadTruth target(light_.width(), light_.height(), vec4<double>(glm::dvec4(kClear)), 1.0);
    draw_naive(target, shader_, assets_.vertex_view(), indices_, workload_state());
    const std::size_t pixels = target.color.texels().size();
    for (std::size_t i = 0; i < pixels; ++i) target.color.data()[i] = WorkloadTone{}(target.color.data()[i]);
    return target;
  }

 protected:
  static constexpr glm::vec4 kClear{0.4f, 0.6f, 1.5f, 1.0f};
  Image<U16Vec4> light_;
  Image<float> depth_;
  Image<glm::u8vec4> color_;

 private:
  SphereAssets assets_;
  Indices indices_;
  SphereHdr shader_;
};

// Only runs the post step, on an image rendered during preparation.
class ToneMap final : public Hdr {
 public:
  ToneMap(WorkloadSize size, WorkloadAssets& assets) : Hdr(size, assets) { Hdr::frame(Workers(1)); }

  void frame(const Workers& workers) override {
    ColorTarget light = rgba16f_target(light_);
    light.load = LoadOp::load;
    light.store = StoreOp::dont_care;
    Pass pass(light_.width(), light_.height(), light, {});
    pass.post(WorkloadTone{}, rgba8_target(color_));
    pass.run(workers);
  }
  WorkloadPicture picture() const override { return {&color_, nullptr}; }
};

}  // namespace

std::unique_ptr<Workload> prepare_hdr_200k(WorkloadSize size, WorkloadAssets& assets) { return std::make_unique<Hdr>(size, assets); }
std::unique_ptr<Workload> prepare_tonemap(WorkloadSize size, WorkloadAssets& assets) { return std::make_unique<ToneMap>(size, assets); }

}  // namespace halfspace
