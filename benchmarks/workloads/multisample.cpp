// SPDX-License-Identifier: Apache-2.0
//
// msaa4_200k: the sphere with four samples per pixel, shaded once per pixel and triangle.
#include "halfspace/raster/pipeline/sample_pattern.h"
#include "workloads/families.h"
#include "workloads/sphere_camera.h"

namespace halfspace {

namespace {

constexpr int kSamples = 4;

// Draws one of the samples with the naive pipeline, whose only sample is at the pixel center. The image is shifted so that the sample
// coincides with it; the fragment function is evaluated at the original pixel center.
struct OneSample : SpherePhong {
  double to_x, to_y;  // from the sample to the pixel center, in 1/256 px
  double width, height;

  template <class R>
  vec4<R> vertex(const Attributes<R>& in, Varyings<R>& out) const {
    vec4<R> clip = SpherePhong::vertex(in, out);
    clip.x += clip.w * static_cast<R>(2.0 / 256.0 * to_x / width);
    clip.y += clip.w * static_cast<R>(2.0 / 256.0 * to_y / height);
    return clip;
  }
  template <class R>
  Fragment<R> fragment(const Varyings<R>&, const Pixel<R>& px) const {
    using V = Varyings<R>;
    Pixel<R> middle = px;
    middle.dx += static_cast<R>(to_x);
    middle.dy += static_cast<R>(to_y);
    middle.weights = weights_at(*px.triangle, middle.dx, middle.dy);
    const auto& lanes = *static_cast<const ComponentLanes<R, kComponents<V>>*>(px.component_lanes);
    return SpherePhong::fragment(interpolate_all<V>(middle.weights, lanes, std::make_index_sequence<kComponents<V>>()), middle);
  }
};

class Multisampled final : public Workload {
 public:
  Multisampled(WorkloadSize size, WorkloadAssets& assets)
      : size_(size),
        assets_(k200k, assets),
        indices_(assets_.indices()),
        shader_{sphere_uniforms(size, *assets_.texture)},
        color_(size.width, size.height) {}

  void frame(const Workers& workers) override {
    ColorTarget color = rgba8_target(color_);
    color.clear_value = kBackground;
    Pass pass(size_.width, size_.height, color, {.format = DepthFormat::d32f}, {.samples = kSamples});
    pass.draw(shader_, assets_.vertex_view(), indices_, workload_state());
    pass.run(workers);
  }
  WorkloadPicture picture() const override { return {&color_, nullptr}; }

  // Averages the colors of the samples, each clamped to [0, 1], and keeps the depth of the nearest sample.
  WorkloadTruth truth() const override {
    WorkloadTruth mean(size_.width, size_.height, vec4<double>(0.0), 1.0);
    for (int s = 0; s < kSamples; ++s) {
      WorkloadTruth one(size_.width, size_.height, vec4<double>(glm::dvec4(kBackground)), 1.0);
      const SamplePosition at = sample_position(kSamples, s);
      const OneSample shader{{shader_}, 128.0 - at.x, 128.0 - at.y, static_cast<double>(size_.width), static_cast<double>(size_.height)};
      draw_naive(one, shader, assets_.vertex_view(), indices_, workload_state());
      for (std::size_t i = 0; i < mean.color.texels().size(); ++i) {
        mean.color.data()[i] += glm::clamp(glm::dvec4(one.color.data()[i]), 0.0, 1.0) / static_cast<double>(kSamples);
        mean.depth.data()[i] = std::min(mean.depth.data()[i], one.depth.data()[i]);
      }
    }
    return mean;
  }

 private:
  WorkloadSize size_;
  SphereAssets assets_;
  Indices indices_;
  SpherePhong shader_;
  Image<glm::u8vec4> color_;
};

}  // namespace

std::unique_ptr<Workload> prepare_msaa4_200k(WorkloadSize size, WorkloadAssets& assets) {
  return std::make_unique<Multisampled>(size, assets);
}

}  // namespace halfspace
