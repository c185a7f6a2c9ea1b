// SPDX-License-Identifier: Apache-2.0
#include "mesa/twin_pass.h"

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

// Returns at most `most` of the pixels, evenly distributed.
std::vector<std::pair<int, int>> some_of(const std::vector<std::pair<int, int>>& pixels, int max_count) {
  std::vector<std::pair<int, int>> some;
  if (max_count == 0 || pixels.empty()) return some;
  const std::size_t step = (pixels.size() - 1) / static_cast<std::size_t>(max_count) + 1;
  for (std::size_t i = 0; i < pixels.size(); i += step) some.push_back(pixels[i]);
  return some;
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

Figures TwinPass::figures(int max_checked) const {
  Figures f;
  std::vector<std::pair<int, int>> differing, depths;
  for (int row = 0; row < target_.height; ++row) {
    for (int x = 0; x < target_.width; ++x) {
      const glm::u8vec4 a = ours_.color.at(x, row), b = mesa_.color.at(x, row);
      if (a.w == 0 && b.w == 0) continue;
      ++f.covered;
      const int d = distance(a, b);
      f.worst = std::max(f.worst, d);
      f.coverage_differs += (a.w == 0) != (b.w == 0);
      const bool depth_differs = std::fabs(ours_.depth.at(x, row) - mesa_.depth.at(x, row)) > kDepthTolerance;
      f.depth_differs += depth_differs;
      if (d > 1)
        differing.emplace_back(x, row);
      else if (depth_differs)
        depths.emplace_back(x, row);
    }
  }
  f.color_differs = static_cast<int64_t>(differing.size());
  for (const auto& [x, row] : some_of(differing, max_checked)) judge(x, row, 1, f);
  compare_depths_with_double(depths, max_checked, f);
  return f;
}

Figures TwinPass::fragment_figures(int max_checked) const {
  Figures f;
  std::vector<std::pair<int, int>> differing;
  for (int row = 0; row < target_.height; ++row) {
    for (int x = 0; x < target_.width; ++x) {
      const int a = ours_.color.at(x, row).x, b = mesa_.color.at(x, row).x;
      EXPECT_LT(std::max(a, b), 255) << "more layers than an 8-bit count can hold";
      f.covered += std::max(a, b);
      f.coverage_differs += std::abs(a - b);
      f.worst = std::max(f.worst, std::abs(a - b));
      if (a != b) differing.emplace_back(x, row);
    }
  }
  for (const auto& [x, row] : some_of(differing, max_checked)) judge(x, row, 0, f);
  return f;
}

TruthPixel TwinPass::truth(int x, int row, Positions positions, const glm::dvec2& offset) const {
  TruthPixel pixel{truth_codes(glm::dvec4(target_.clear_color), target_.format), static_cast<double>(target_.clear_depth)};
  const glm::dvec2 center(x + 0.5, target_.height - 1 - row + 0.5);
  for (const auto& draw : truths_) draw->draw(center + offset, positions, pixel);
  return pixel;
}

void TwinPass::judge(int x, int row, int tolerance, Figures& f) const {
  const glm::u8vec4 snapped = truth(x, row, Positions::snapped).codes, exact = truth(x, row, Positions::exact).codes;
  const glm::u8vec4 a = ours_.color.at(x, row), b = mesa_.color.at(x, row);
  const bool right = distance(a, snapped) <= tolerance;
  ++f.judged;
  f.halfspace_right += right;
  f.mesa_right += distance(b, snapped) <= tolerance;
  f.halfspace_right_exact += distance(a, exact) <= tolerance;
  f.mesa_right_exact += distance(b, exact) <= tolerance;
  f.halfspace_right_beside += !right && is_right_beside(x, row, tolerance);
  if (std::getenv("HALFSPACE_MESA_PIXELS") == nullptr) return;
  const auto text = [](const glm::u8vec4& c) {
    return std::to_string(c.x) + ',' + std::to_string(c.y) + ',' + std::to_string(c.z) + ',' + std::to_string(c.w);
  };
  std::printf("    x %d row %d: Halfspace %s  Mesa %s  reference %s  for unsnapped vertices %s\n", x, row, text(a).c_str(), text(b).c_str(),
              text(snapped).c_str(), text(exact).c_str());
}

// Clipping creates vertices that are also snapped, which moves an edge by up to 1/256 px; the reference does not model them.
bool TwinPass::is_right_beside(int x, int row, int tolerance) const {
  for (int i = -1; i <= 1; ++i) {
    for (int j = -1; j <= 1; ++j) {
      const TruthPixel shifted = truth(x, row, Positions::exact, glm::dvec2(i, j) / 256.0);
      if (distance(ours_.color.at(x, row), shifted.codes) <= tolerance) return true;
    }
  }
  return false;
}

void TwinPass::compare_depths_with_double(const std::vector<std::pair<int, int>>& pixels, int max_count, Figures& f) const {
  for (const auto& [x, row] : some_of(pixels, max_count)) {
    const double snapped = truth(x, row, Positions::snapped).depth;
    f.halfspace_depth_error = std::max(f.halfspace_depth_error, std::fabs(static_cast<double>(ours_.depth.at(x, row)) - snapped));
    f.mesa_depth_error = std::max(f.mesa_depth_error, std::fabs(static_cast<double>(mesa_.depth.at(x, row)) - snapped));
  }
}

void report(const Figures& f) {
  const auto n = [](int64_t v) { return static_cast<long long>(v); };
  std::printf("  covered %lld  coverage differs %lld (%.4f%%)  color differs %lld (%.4f%%)  worst %d/255  depth differs %lld\n",
              n(f.covered), n(f.coverage_differs), 100.0 * f.coverage_share(), n(f.color_differs), 100.0 * f.color_share(), f.worst,
              n(f.depth_differs));
  if (f.halfspace_depth_error + f.mesa_depth_error > 0.0)
    std::printf("  largest depth error where depths differ: Halfspace %.2g, Mesa %.2g\n", f.halfspace_depth_error, f.mesa_depth_error);
  if (f.halfspace_right_beside != 0)
    std::printf("  Halfspace correct for a point within 1/256 px of the pixel center: %lld more\n", n(f.halfspace_right_beside));
  if (f.judged != 0)
    std::printf(
        "  of %lld checked in double: correct for vertices on the 1/256 px grid: Halfspace %lld, Mesa %lld; for unsnapped ones: %lld and "
        "%lld\n",
        n(f.judged), n(f.halfspace_right), n(f.mesa_right), n(f.halfspace_right_exact), n(f.mesa_right_exact));
  testing::Test::RecordProperty("covered", std::to_string(f.covered));
  testing::Test::RecordProperty("coverage_differs", std::to_string(f.coverage_differs));
  testing::Test::RecordProperty("color_differs", std::to_string(f.color_differs));
  testing::Test::RecordProperty("worst_code_difference", std::to_string(f.worst));
  testing::Test::RecordProperty("depth_differs", std::to_string(f.depth_differs));
}

void expect_agreement(const Figures& f) {
  EXPECT_GT(f.covered, 0);
  EXPECT_LE(f.coverage_share(), kCoverageBound);
  EXPECT_LE(f.color_share(), kColorBound);
}

void expect_halfspace_right(const Figures& f, const char* what_mesa_does) {
  std::printf("  Mesa %s\n", what_mesa_does);
  testing::Test::RecordProperty("mesa", what_mesa_does);
  EXPECT_GT(f.covered, 0);
  EXPECT_LE(f.coverage_share() * f.halfspace_wrong(), kCoverageBound);
  EXPECT_LE(f.color_share() * f.halfspace_wrong(), kColorBound);
}

}  // namespace halfspace::test
