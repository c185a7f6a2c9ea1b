// SPDX-License-Identifier: Apache-2.0
#include "twin_pass.h"

#include <cstdio>
#include <cstdlib>

#include <gtest/gtest.h>

namespace halfspace::test {

namespace {

int distance(const glm::u8vec4& a, const glm::u8vec4& b) {
  int d = 0;
  for (int k = 0; k < 4; ++k) d = std::max(d, std::abs(int{a[k]} - int{b[k]}));
  return d;
}

}  // namespace

void TwinPass::run() {
  ours_ = {Image<glm::u8vec4>(target_.width, target_.height), Image<float>(target_.width, target_.height)};
  ColorTarget color = target_.format == ColorFormat::srgb8a8 ? srgb8a8_target(ours_.color) : rgba8_target(ours_.color);
  color.clear_value = target_.clear_color;
  DepthTarget depth = d32f_target(ours_.depth);
  depth.clear_value = target_.clear_depth;
  Pass pass(target_.width, target_.height, color, depth);
  for (const auto& draw : our_draws_) draw(pass);
  pass.run(Workers(1));
  mesa_ = draw_with_mesa(target_, mesa_draws_);
}

Figures TwinPass::figures(int most_judged) const {
  Figures f;
  std::vector<std::pair<int, int>> differing;
  for (int row = 0; row < target_.height; ++row) {
    for (int x = 0; x < target_.width; ++x) {
      const glm::u8vec4 a = ours_.color.at(x, row), b = mesa_.color.at(x, row);
      if (a.w == 0 && b.w == 0) continue;
      ++f.covered;
      const int d = distance(a, b);
      f.worst = std::max(f.worst, d);
      f.coverage_differs += (a.w == 0) != (b.w == 0);
      f.depth_differs += std::fabs(ours_.depth.at(x, row) - mesa_.depth.at(x, row)) > kDepthTolerance;
      if (d > 1) differing.emplace_back(x, row);
    }
  }
  f.color_differs = static_cast<int64_t>(differing.size());
  judge_some(differing, most_judged, 1, f);
  return f;
}

Figures TwinPass::fragment_figures(int most_judged) const {
  Figures f;
  std::vector<std::pair<int, int>> differing;
  for (int row = 0; row < target_.height; ++row) {
    for (int x = 0; x < target_.width; ++x) {
      const int a = ours_.color.at(x, row).x, b = mesa_.color.at(x, row).x;
      EXPECT_LT(std::max(a, b), 255) << "too many layers to count";
      f.covered += std::max(a, b);
      f.coverage_differs += std::abs(a - b);
      f.worst = std::max(f.worst, std::abs(a - b));
      if (a != b) differing.emplace_back(x, row);
    }
  }
  judge_some(differing, most_judged, 0, f);
  return f;
}

glm::u8vec4 TwinPass::truth(int x, int row, Positions positions) const {
  TruthPixel pixel{truth_codes(glm::dvec4(target_.clear_color), target_.format), static_cast<double>(target_.clear_depth)};
  for (const auto& draw : truths_) draw->draw(x, target_.height - 1 - row, positions, pixel);
  return pixel.codes;
}

void TwinPass::judge_some(const std::vector<std::pair<int, int>>& pixels, int most, int tolerance, Figures& f) const {
  if (most == 0 || pixels.empty()) return;
  const std::size_t step = (pixels.size() - 1) / static_cast<std::size_t>(most) + 1;
  for (std::size_t i = 0; i < pixels.size(); i += step) judge(pixels[i].first, pixels[i].second, tolerance, f);
}

void TwinPass::judge(int x, int row, int tolerance, Figures& f) const {
  const glm::u8vec4 snapped = truth(x, row, Positions::snapped), exact = truth(x, row, Positions::exact);
  const glm::u8vec4 a = ours_.color.at(x, row), b = mesa_.color.at(x, row);
  ++f.judged;
  f.halfspace_right += distance(a, snapped) <= tolerance;
  f.mesa_right += distance(b, snapped) <= tolerance;
  f.halfspace_right_exact += distance(a, exact) <= tolerance;
  f.mesa_right_exact += distance(b, exact) <= tolerance;
  if (std::getenv("HALFSPACE_MESA_PIXELS") == nullptr) return;
  const auto text = [](const glm::u8vec4& c) {
    return std::to_string(c.x) + ',' + std::to_string(c.y) + ',' + std::to_string(c.z) + ',' + std::to_string(c.w);
  };
  std::printf("    x %d row %d: Halfspace %s  Mesa %s  truth %s  of unsnapped vertices %s\n", x, row, text(a).c_str(), text(b).c_str(),
              text(snapped).c_str(), text(exact).c_str());
}

void report(const Figures& f) {
  const auto n = [](int64_t v) { return static_cast<long long>(v); };
  std::printf("  covered %lld  coverage differs %lld (%.4f%%)  colour differs %lld (%.4f%%)  worst %d/255  depth differs %lld\n", n(f.covered),
              n(f.coverage_differs), 100.0 * f.coverage_share(), n(f.color_differs), 100.0 * f.color_share(), f.worst, n(f.depth_differs));
  if (f.judged != 0)
    std::printf("  of %lld judged in double: Halfspace right %lld, Mesa %lld of vertices on the 1/256 px grid; %lld and %lld of unsnapped ones\n", n(f.judged),
                n(f.halfspace_right), n(f.mesa_right), n(f.halfspace_right_exact), n(f.mesa_right_exact));
  testing::Test::RecordProperty("covered", std::to_string(f.covered));
  testing::Test::RecordProperty("coverage_differs", std::to_string(f.coverage_differs));
  testing::Test::RecordProperty("color_differs", std::to_string(f.color_differs));
  testing::Test::RecordProperty("worst_code_difference", std::to_string(f.worst));
  testing::Test::RecordProperty("depth_differs", std::to_string(f.depth_differs));
}

void expect_agreement(const Figures& f) {
  EXPECT_GT(f.covered, 0);
  EXPECT_LE(f.coverage_share(), 1e-4);
  EXPECT_LE(f.color_share(), 1e-3);
}

}  // namespace halfspace::test
