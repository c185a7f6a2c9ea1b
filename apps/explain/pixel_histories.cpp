// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <array>
#include <utility>

#include "explain/fragment_values.h"
#include "explain/pixel_history.h"
#include "halfspace/core/srgb.h"
#include "halfspace/render/frame/frame.h"
#include "halfspace/render/frame/scene_pass.h"
#include "halfspace/render/frame/unlit_layer.h"
#include "halfspace/scene/scene_paths.h"
#include "halfspace/shading/values/tone.h"

namespace halfspace {

namespace {

constexpr std::array<const char*, 19> kFactorNames{"0",
                                                   "1",
                                                   "color",
                                                   "(1 - color)",
                                                   "stored color",
                                                   "(1 - stored color)",
                                                   "alpha",
                                                   "(1 - alpha)",
                                                   "stored alpha",
                                                   "(1 - stored alpha)",
                                                   "constant",
                                                   "(1 - constant)",
                                                   "constant alpha",
                                                   "(1 - constant alpha)",
                                                   "min(alpha, 1 - stored alpha)",
                                                   "second color",
                                                   "(1 - second color)",
                                                   "second alpha",
                                                   "(1 - second alpha)"};

std::string blend_formula(const BlendState& blend) {
  const char* source = kFactorNames[static_cast<std::size_t>(blend.source_color)];
  const char* destination = kFactorNames[static_cast<std::size_t>(blend.destination_color)];
  switch (blend.color_equation) {
    case BlendEquation::add: return fmt::format("{} * color + {} * stored", source, destination);
    case BlendEquation::subtract: return fmt::format("{} * color - {} * stored", source, destination);
    case BlendEquation::reverse_subtract: return fmt::format("{} * stored - {} * color", destination, source);
    case BlendEquation::min: return "min(color, stored)";
    case BlendEquation::max: return "max(color, stored)";
  }
  return {};
}

std::string blend_text(const DrawState& state) {
  if (state.order_independent) return "layers from the farthest to the nearest: alpha * color + (1 - alpha) * stored";
  const std::optional<BlendState>& blend = blend_of(state, 0);
  return blend ? blend_formula(*blend) : std::string();
}

// Computes the details of fragments while the data of their round exists.
class DetailFinder {
 public:
  DetailFinder(const SceneDescription& scene, const PreparedScene& prepared, const FrameTrace& trace)
      : scene_(scene), prepared_(prepared), trace_(trace) {
    for (const PreparedLight& light : prepared.lights) light_names_.push_back(light.name);
  }

  FragmentDetail find(const TriangleInspector& triangles, const TracedFragment& f, const glm::ivec2& pixel) const {
    const PreparedDraw& draw = prepared_.draws[f.draw];
    InspectedTriangle triangle;
    triangles.find(f.id, triangle);
    const SamplePosition center{kSubPixels / 2, kSubPixels / 2};
    const SamplePosition at = triangle.draw->shades_samples ? sample_position(trace_.samples, f.sample) : center;
    FragmentValues v = fragment_values(draw.shader, {triangle, {pixel.x, trace_.height - 1 - pixel.y}, at, f.depth}, light_names_);
    return {.fragment = f,
            .object = object_name(scene_, draw.source.object),
            .is_front = triangle.source.triangle->is(kFrontFacing),
            .topology = triangle.draw->state.topology,
            .copy = draw.source.instance,
            .shader = std::move(v.shader),
            .barycentrics = v.barycentrics,
            .inv_w = v.inv_w,
            .varyings = std::move(v.varyings),
            .terms = std::move(v.terms),
            .factors = std::move(v.factors),
            .color = f.is_shaded ? f.color : v.color,
            .blend = blend_text(draw.state)};
  }

 private:
  const SceneDescription& scene_;
  const PreparedScene& prepared_;
  const FrameTrace& trace_;
  std::vector<std::string> light_names_;
};

DisplayDetail display_detail(const PreparedScene& scene, const FrameTrace& trace, const Image<glm::u8vec4>& picture,
                             const glm::ivec2& pixel) {
  DisplayDetail d;
  d.light = trace.light.at(pixel.x, pixel.y);
  const ToneMapping tone = frame_tone(scene, trace.exposure);
  d.exposure = tone.exposure;
  const float alpha = scene.transparent && d.light.w > 0.0f ? d.light.w : 1.0f;
  d.tone_mapped = tone_map(SceneLight<float>{vec3<float>(glm::vec3(d.light) / alpha)}, tone).rgb;
  d.code = picture.at(pixel.x, pixel.y);
  if (separates_unlit(scene)) {  // unlit surfaces are displayed without exposure and tone curve
    for (glm::length_t k = 0; k < 3; ++k) d.tone_mapped[k] = kSrgbToLinear[d.code[k]];
  }
  return d;
}

}  // namespace

std::vector<PixelHistory> pixel_histories(const SceneDescription& scene, const PreparedScene& prepared, const FrameTrace& trace,
                                          std::span<const glm::ivec2> pixels, const Workers& workers) {
  const DetailFinder finder(scene, prepared, trace);
  Image<glm::u8vec4> picture(trace.width, trace.height);
  display_frame(prepared, trace.light, {.picture = &picture}, workers);
  std::vector<PixelHistory> out(pixels.size());
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    const glm::ivec2& p = pixels[i];
    PixelHistory& h = out[i];
    const std::size_t index = static_cast<std::size_t>(p.y) * static_cast<std::size_t>(trace.width) + static_cast<std::size_t>(p.x);
    const auto samples = static_cast<std::size_t>(trace.samples);
    h.pixel = p;
    h.window = {static_cast<float>(p.x) + 0.5f, static_cast<float>(trace.height - p.y) - 0.5f};
    h.clear_color = prepared.clear_color;
    h.fragments.resize(trace.at(p).size());
    h.others = trace.others[index];
    h.samples.assign(trace.values.begin() + static_cast<std::ptrdiff_t>(index * samples),
                     trace.values.begin() + static_cast<std::ptrdiff_t>((index + 1) * samples));
    h.display = display_detail(prepared, trace, picture, p);
  }
  visit_set_up_scene(prepared, workers, [&](const PassContext& context, int round) {
    const TriangleInspector triangles(context);
    workers.for_each(static_cast<int>(pixels.size()), [&](int i) {
      PixelHistory& h = out[static_cast<std::size_t>(i)];
      const std::span<const TracedFragment> fragments = trace.at(h.pixel);
      for (std::size_t k = 0; k < fragments.size(); ++k) {
        if (fragments[k].round == round) h.fragments[k] = finder.find(triangles, fragments[k], h.pixel);
      }
    });
  });
  return out;
}

}  // namespace halfspace
