// SPDX-License-Identifier: Apache-2.0
//
// Cases of the variables of samples, after the groups sample_variables.{sample_id, sample_pos, sample_mask_in, sample_mask} of VK-GL-CTS
// (GLES 3.2). The truth is the mean over all samples, for the pixels that a triangle covers whole.
#include <bit>

#include "conformance/geometry.h"
#include "conformance/groups.h"
#include "halfspace/raster/sample_location.h"

namespace halfspace::conformance {

namespace {

// A triangle with many inner pixels and edges in all directions. angle: which of four triangles.
Picture sampled(Kind kind, int samples, int mode, uint32_t mask, int angle) {
  Picture p;
  p.samples = samples;
  p.colors = {ColorFormat::rgba32f};
  Drawing d;
  d.kind = kind;
  d.mode = mode;
  d.value = static_cast<float>(mask);
  d.state.depth.test = false;
  constexpr glm::dvec2 kCorners[] = {{2.25, 3.5}, {29.75, 8.125}, {13.0, 30.5}};
  for (const glm::dvec2& c : kCorners) {
    const glm::dvec2 turned = angle == 0   ? c
                              : angle == 1 ? glm::dvec2(32.0 - c.y, c.x)
                              : angle == 2 ? 32.0 - c
                                           : glm::dvec2(c.y, 32.0 - c.x);
    d.vertices.push_back({clip_at(p, turned.x, turned.y)});
  }
  p.draws.push_back(std::move(d));
  return p;
}

glm::dvec4 mean_of(const Picture& p) {
  const Drawing& d = p.draws[0];
  const auto all = static_cast<uint32_t>((1 << p.samples) - 1);
  if (d.kind == Kind::sample_mask_in) return {all / 255.0, 0.0, 0.0, 1.0};
  if (d.kind == Kind::sample_mask && p.samples == 1) return glm::dvec4(1.0);  // the mask has no effect
  if (d.kind == Kind::sample_mask)
    return glm::dvec4(1.0) * (static_cast<double>(std::popcount(static_cast<uint32_t>(d.value) & all)) / p.samples);
  glm::dvec4 sum(0.0);
  for (int s = 0; s < p.samples; ++s)
    sum += d.mode == kSampleId ? glm::dvec4(s / 8.0, 0.0, 0.0, 1.0) : glm::dvec4(glm::dvec2(sample_location(p.samples, s)), 0.0, 1.0);
  return sum / static_cast<double>(p.samples);
}

// In the other pixels of the triangle, the sum lacks some samples.
std::string means(const Picture& p, const Seen& seen) {
  std::array<glm::dvec2, 3> corners;
  for (std::size_t k = 0; k < 3; ++k) corners[k] = window_of(p, p.draws[0].vertices[k].pos_clip);
  const std::vector<Region> triangle{polygon(corners)};
  const glm::dvec4 mean = mean_of(p);
  return for_each_pixel(seen, [&](int x, int y) -> std::string {
    const Share share = share_of(triangle, x, y, p.samples);
    if (share.low == 1.0) return expect_near(mean, seen.color(x, y), 1e-6);  // a sum of eight floats of up to 1
    if (share.high == 0.0) return expect_near(glm::dvec4(0.0), seen.color(x, y), 0.0);
    return {};
  });
}

}  // namespace

Cases sample_variables_cases() {
  Cases cases;
  for (const int samples : {1, 2, 4, 8}) {
    const std::string suffix = "_samples_" + std::to_string(samples);
    for (int angle = 0; angle < 4; ++angle) {
      const std::string name = suffix + "_triangle_" + std::to_string(angle);
      cases.push_back(
          {"sample_id" + name, [=] { return sampled(Kind::sample_inputs, samples, kSampleId, 0, angle); }, means, samples == 1});
      cases.push_back({"sample_pos" + name, [=] { return sampled(Kind::sample_inputs, samples, kSamplePosition, 0, angle); }, means});
      cases.push_back({"sample_mask_in" + name, [=] { return sampled(Kind::sample_mask_in, samples, 0, 0, angle); }, means});
    }
    for (const uint32_t mask : {0u, 1u, 2u, 5u, 0x0fu, 0xaau, 0xffu}) {
      const bool is_empty = samples > 1 && (mask & ((1u << samples) - 1)) == 0;
      cases.push_back({"sample_mask_" + std::to_string(mask) + suffix, [=] { return sampled(Kind::sample_mask, samples, 0, mask, 0); },
                       means, is_empty});
    }
  }
  return cases;
}

}  // namespace halfspace::conformance
