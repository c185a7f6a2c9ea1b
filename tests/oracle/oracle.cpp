// SPDX-License-Identifier: Apache-2.0
#include "oracle/oracle.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "oracle/arithmetic.h"
#include "oracle/blend.h"
#include "oracle/coverage.h"
#include "oracle/depth.h"
#include "oracle/depth_stencil.h"
#include "oracle/smooth_area.h"

namespace halfspace::oracle {

bool Renderer::condition_holds(const DrawState& state) const {
  if (!state.condition) return true;
  const auto query = counts_.queries.find(state.condition->query);
  const bool passed = query != counts_.queries.end() && query->second != 0;
  return passed != state.condition->inverted;
}

void Renderer::clear(const ClearValues& values) {
  DrawState state;
  state.condition = values.condition;
  if (!condition_holds(state)) return;
  for (Framebuffer& target : layers_) {
    const Rect all{0, 0, target.width(), target.height()}, r = values.rect ? intersect(*values.rect, all) : all;
    for (int y = r.y; y < r.y + r.height; ++y) {
      for (int x = r.x; x < r.x + r.width; ++x) {
        for (int number = 0; number < target.samples(); ++number) clear_sample(values, target, {x, y, number});
      }
    }
  }
}

void Renderer::clear_sample(const ClearValues& values, Framebuffer& target, const Sample& s) {
  ++counts_.samples_passed;
  const std::array<bool, 4> written{values.mask.r, values.mask.g, values.mask.b, values.mask.a};
  for (std::size_t i = 0; i < target.color_formats().size(); ++i) {
    if (!values.colors[i] || target.color_formats()[i] == ColorFormat::none) continue;
    glm::vec4 color = target.color(i, s);
    for (int k = 0; k < 4; ++k) {
      if (written[static_cast<std::size_t>(k)]) color[k] = (*values.colors[i])[k];
    }
    target.set_color(i, s, color);
  }
  if (values.depth) target.set_depth(s, target.depth_value(*values.depth));
  if (values.stencil) {
    const int mask = values.stencil_mask;
    target.set_stencil(s, static_cast<uint8_t>((target.stencil(s) & ~mask) | (*values.stencil & mask)));
  }
}

bool Renderer::select_layer(const ShadedVertex& provoking, DrawState& state) {
  const auto layer = static_cast<std::size_t>(layers_.size() == 1 ? 0 : provoking.layer);
  const auto viewport = static_cast<std::size_t>(provoking.viewport);  // a negative one becomes a large number
  if (layer >= layers_.size() || viewport >= (state.viewports != nullptr ? state.viewports->size() : 1)) return false;
  target_ = &layers_[layer];
  if (state.viewports == nullptr) return true;
  const IndexedViewport& v = (*state.viewports)[viewport];
  state.viewport = v.viewport;
  state.scissor = v.scissor;
  state.depth.range_near = v.range_near;
  state.depth.range_far = v.range_far;
  return true;
}

void Renderer::rasterize(const DrawState& state, const ShaderFacts& facts, const WindowTriangle& t, const FragmentFunction& shade) {
  const Surface surface = make_surface(t, facts.interpolations);
  const Box box = intersect(covered_box(t, target_->samples()), allowed_pixels(*target_, state));
  Surface in_cell;
  for (int64_t y = box.y0; y < box.y1; ++y) {
    for (int64_t x = box.x0; x < box.x1; ++x) {
      if (x == box.x0 || x % kCellSize == 0) in_cell = surface_in_cell(t, surface, facts.interpolations, x / kCellSize, y / kCellSize);
      draw_pixel(state, facts, t, in_cell, static_cast<int>(x), static_cast<int>(y), shade);
    }
  }
}

void Renderer::draw_pixel(const DrawState& state, const ShaderFacts& facts, const WindowTriangle& t, const Surface& surface, int x, int y,
                          const FragmentFunction& shade) {
  const auto shaded = [&](const Place& place) {
    FragmentResult result = shade(t, surface, place);
    if (!t.smooth.empty()) {
      const std::vector<ColorFormat>& formats = target_->color_formats();
      for (std::size_t i = 0; i < result.colors.size(); ++i) {
        if (i >= formats.size() || !is_integer(formats[i])) result.colors[i].w *= smooth_area(t.smooth, x, y);
      }
    }
    return result;
  };
  std::optional<FragmentResult> of_pixel;
  Point centroid = center_of(x, y);  // if only some samples are covered, replaced by the first of them
  std::vector<Point> covered;
  uint32_t mask = target_->samples() == 1 ? 1 : 0;
  for (int i = 0; i < target_->samples(); ++i) {
    const Point p = position_of({x, y, i}, target_->samples());
    if (!covers(t, p)) continue;
    covered.push_back(p);
    if (target_->samples() > 1 && allows_sample(state, i)) mask |= 1u << i;
  }
  const bool per_sample = shades_samples(state, facts);
  if (!covered.empty() && covered.size() < static_cast<std::size_t>(target_->samples())) centroid = covered[0];
  for (int i = 0; i < target_->samples(); ++i) {
    const Sample s{x, y, i};
    if (!covers(t, position_of(s, target_->samples()))) continue;
    if (target_->samples() > 1 && !allows_sample(state, i)) continue;
    if (per_sample) {
      const Point at = position_of(s, target_->samples());
      draw_sample(state, facts, t, s, shaded({at, at, i, target_->samples(), mask & 1u << i}));
    } else {
      if (!of_pixel) of_pixel = shaded({center_of(x, y), centroid, 0, target_->samples(), mask});
      draw_sample(state, facts, t, s, *of_pixel);
    }
  }
}

bool Renderer::shades_samples(const DrawState& state, const ShaderFacts& facts) const {
  const auto samples = static_cast<float>(target_->samples());
  return supersample_ || facts.runs_per_sample || (state.sample_shading && state.min_sample_shading * samples > 1.0f);
}

bool Renderer::allows_sample(const DrawState& state, int number) const {
  if ((state.sample_mask >> number) % 2 == 0) return false;
  if (!state.sample_coverage) return true;
  const bool is_covered = state.sample_coverage->value * static_cast<float>(target_->samples()) >= static_cast<float>(number) + 0.5f;
  return is_covered != state.sample_coverage->invert;
}

void Renderer::draw_sample(const DrawState& state, const ShaderFacts& facts, const WindowTriangle& t, const Sample& s,
                           const FragmentResult& result) {
  const auto samples = static_cast<float>(target_->samples());
  bool is_drawn = result.keep;
  if (facts.has_fragment && samples > 1.0f) {
    const bool has_alpha = target_->color_formats().empty() || !is_integer(target_->color_formats()[0]);
    if (state.alpha_to_coverage && has_alpha) is_drawn &= result.colors[0].w * samples >= static_cast<float>(s.number) + 0.5f;
    is_drawn &= (result.sample_mask >> s.number) % 2 != 0;
  }
  if (!is_drawn && !facts.tests_early) return;
  const double of_triangle = target_->depth_value(tested_depth(t, state.depth, position_of(s, target_->samples())));
  double z = of_triangle;
  if (facts.writes_depth) {
    const float low = std::min(state.depth.range_near, state.depth.range_far),
                high = std::max(state.depth.range_near, state.depth.range_far);
    z = target_->depth_value(clamped(result.depth, low, high));
    const bool has_one_depth = samples == 1.0f || shades_samples(state, facts);
    if (has_one_depth && facts.conservative_depth == ConservativeDepth::greater) z = std::fmax(z, of_triangle);
    if (has_one_depth && facts.conservative_depth == ConservativeDepth::less) z = std::fmin(z, of_triangle);
  }
  if (!tests_pass(state, t.front, s, z)) return;
  ++counts_.samples_passed;
  if (state.query) counts_.queries[*state.query] += 1;
  if (state.depth.test && state.depth.write) target_->set_depth(s, z);
  if (facts.has_fragment && is_drawn) write_colors(state, s, result.colors);
}

bool Renderer::depth_passes(const DrawState& state, const Sample& s, double z) const {
  return !state.depth.test || target_->depth_format() == DepthFormat::none || compares(state.depth.compare, z, target_->depth(s));
}

// Performs the stencil test and then the depth test. The stencil operation depends on the results of both.
bool Renderer::tests_pass(const DrawState& state, bool front, const Sample& s, double z) {
  if (state.depth_bounds && target_->depth_format() != DepthFormat::none) {
    const auto& [low, high] = *state.depth_bounds;
    const DepthFormat format = target_->depth_format();
    const bool is_float = format == DepthFormat::d32f || format == DepthFormat::d32fs8;
    const double one = is_float ? 1.0 : format == DepthFormat::d16 ? 65535.0 : 16777215.0;
    if (target_->depth(s) < static_cast<double>(low) * one || target_->depth(s) > static_cast<double>(high) * one) return false;
  }
  if (!state.stencil || !has_stencil(target_->depth_format())) return depth_passes(state, s, z);
  const StencilFace& f = front ? state.stencil->front : state.stencil->back;
  const uint8_t stored = target_->stencil(s);
  const bool stencil_passes = compares(f.compare, f.reference & f.read_mask, stored & f.read_mask);
  const bool passes = stencil_passes && depth_passes(state, s, z);
  target_->set_stencil(s, stencil_result(f, !stencil_passes ? f.fail : passes ? f.pass : f.depth_fail, stored));
  return passes;
}

void Renderer::write_colors(const DrawState& state, const Sample& s, const std::vector<glm::vec4>& colors) {
  const glm::vec4 none(0.0f);
  for (std::size_t i = 0; i < std::min(colors.size(), target_->color_formats().size()); ++i) {
    const ColorFormat format = target_->color_formats()[i];
    if (format == ColorFormat::none) continue;
    const bool own = state.attachments[i].has_value();
    const std::optional<BlendState>& blending = own ? state.attachments[i]->blend : state.blend;
    const ColorMask mask = own ? state.attachments[i]->mask : state.color_mask;
    const glm::vec4 before = target_->color(i, s);
    glm::vec4 color = colors[i];
    glm::vec4 second = colors.size() > 1 ? colors[1] : none;
    if (state.alpha_to_one && target_->samples() > 1 && !is_integer(format)) color.w = second.w = 1.0f;
    if (state.logic_op) {
      target_->combine_color(i, s, color, *state.logic_op, mask);
      continue;
    }
    if (blending) {
      const auto in_range = [&](glm::vec4 c) {
        const TexelKind kind = texel_info(format).kind;
        const bool is_fixed_point = kind == TexelKind::unorm || kind == TexelKind::srgb || kind == TexelKind::snorm;
        for (int k = 0; is_fixed_point && k < 4; ++k) c[k] = clamped(c[k], kind == TexelKind::snorm ? -1.0f : 0.0f, 1.0f);
        return c;
      };
      const float unit = format == ColorFormat::rgba8 ? 255.0f : 1.0f;
      color = blend(*blending, in_range(color), in_range(second), before, in_range(blending->constant), unit,
                    texel_info(format).kind == TexelKind::snorm);
      // The float nearest to code/255 is encoded as this code.
      for (int k = 0; unit != 1.0f && k < 4; ++k) color[k] = std::nearbyint(clamped(color[k], 0.0f, unit)) / unit;
    }
    const std::array<bool, 4> written{mask.r, mask.g, mask.b, mask.a};
    for (int k = 0; k < 4; ++k) {
      if (!written[static_cast<std::size_t>(k)]) color[k] = before[k];
    }
    target_->set_color(i, s, color);
  }
}

}  // namespace halfspace::oracle
