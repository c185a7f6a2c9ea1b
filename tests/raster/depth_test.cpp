// SPDX-License-Identifier: Apache-2.0
//
// Tests depth: accuracy of reversed Z down to the smallest values, ordering, tests and writes, ranges, clamping, offset, formats, and
// invariance (equal positions give equal depth bits in any shader).
#include <algorithm>
#include <cmath>
#include <limits>

#include "raster/raster_test.h"

namespace halfspace::raster_test {
namespace {

using Exact = long double;

DrawState reversed_z() {
  DrawState s;
  s.depth.clip = ClipDepth::zero_to_one;
  s.depth.compare = CompareOp::greater;
  return s;
}

DrawState always() {
  DrawState s;
  s.depth.clip = ClipDepth::zero_to_one;
  s.depth.compare = CompareOp::always;
  return s;
}

// Draws a triangle list into a new depth image.
Image<float> draw_depth(int width, int height, const std::vector<glm::vec4>& positions, const DrawState& state, float clear) {
  Image<float> depth(width, height);
  DepthTarget target = d32f_target(depth);
  target.clear_value = clear;
  Pass pass(width, height, {}, target);
  pass.draw(ConstantShader{}, make_vertex_view(stream(positions)), state);
  pass.run(one_worker());
  return depth;
}

// ---- accuracy --------------------------------------------------------------------------------------------------

// Compares the depth of single triangles with the plane through the float depths of their vertices at the snapped positions. The error is
// relative to the depth itself, which spans many powers of two in one triangle with reversed Z.
Exact worst_relative_error(Random& r, double size, double z_low, double z_high, int triangles, int64_t& samples) {
  constexpr int kSize = 64;
  Exact worst = 0;
  for (int i = 0; i < triangles; ++i) {
    std::vector<glm::vec4> p;
    const double turn = r.real(0.0, 6.28);
    std::array<std::array<double, 2>, 3> at;
    for (std::size_t k = 0; k < 3; ++k) {
      const double angle = turn + 2.0944 * static_cast<double>(k) + r.real(-0.6, 0.6), reach = size * r.real(0.2, 1.0);
      at[k] = {reach * std::cos(angle), reach * std::sin(angle)};
    }
    double a = r.real(0.0, 1.0), b = r.real(0.0, 1.0);
    if (a + b > 1) a = 1 - a, b = 1 - b;
    const int small = r.integer(0, 2);
    for (std::size_t k = 0; k < 3; ++k) {
      std::array<double, 2> q;
      for (std::size_t n = 0; n < 2; ++n) {
        q[n] = std::clamp(32 + at[k][n] - (at[0][n] + a * (at[1][n] - at[0][n]) + b * (at[2][n] - at[0][n])), -16000.0, 16000.0);
      }
      const double z = static_cast<int>(k) == small ? z_low : r.magnitude(z_low, z_high);
      p.push_back({static_cast<float>(q[0] / 32 - 1), static_cast<float>(q[1] / 32 - 1), static_cast<float>(z), 1.0f});
    }
    const ShadedVertices v = shade(ConstantShader{}, make_vertex_view(stream(p)), {0, 0, kSize, kSize}, reversed_z());
    const auto x = [&](std::size_t k) { return static_cast<Exact>(v.screen[k].x); };
    const auto y = [&](std::size_t k) { return static_cast<Exact>(v.screen[k].y); };
    const Exact area = (x(1) - x(0)) * (y(2) - y(0)) - (y(1) - y(0)) * (x(2) - x(0));
    if (area == 0) continue;
    const Image<float> depth = draw_depth(kSize, kSize, p, reversed_z(), 0.0f);
    for (int py = 0; py < kSize; ++py) {
      for (int px = 0; px < kSize; ++px) {
        const float got = pixel(depth, px, py);
        if (got == 0.0f) continue;
        const Exact sx = px * 256 + 128, sy = py * 256 + 128;
        Exact want = 0;
        for (std::size_t k = 0; k < 3; ++k) {
          const std::size_t s = (k + 1) % 3, t = (k + 2) % 3;
          want += ((x(t) - x(s)) * (sy - y(s)) - (y(t) - y(s)) * (sx - x(s))) / area * static_cast<Exact>(v.screen[k].z);
        }
        worst = std::max(worst, std::fabs(static_cast<Exact>(got) - want) / want);
        ++samples;
      }
    }
  }
  return worst;
}

TEST(Depth, ReversedZKeepsItsRelativeAccuracy) {
  // Depth is a sum of three non-negative terms with about three roundings each; 1e-6 is 16 times 2^-24. (The coefficients are depth divided
  // by area, which is up to 2^47, so they become denormal if depths of huge triangles are below 1e-24.)
  Random r(1);
  for (const double size : {4.0, 20.0, 60.0, 64.0, 200.0, 2000.0, 15000.0}) {
    for (const double low : {1e-2, 1e-6, 1e-12, 1e-20}) {
      int64_t samples = 0;
      const Exact worst = worst_relative_error(r, size, low, std::min(1.0, low * 1e6), effort(size < 64 ? 200 : 100), samples);
      std::printf(
          "%7.0f px, z from %.0e: largest relative error %.3g over "
          "%lld samples\n",
          size, low, static_cast<double>(worst), static_cast<long long>(samples));
      ::testing::Test::RecordProperty("size_" + std::to_string(static_cast<int>(size)),
                                      std::to_string(static_cast<double>(worst) * 1e9) + "e-9");
      EXPECT_GT(samples, 0);
      EXPECT_LE(worst, 1e-6L) << size << " px, z from " << low;
    }
  }
}

// Draws pairs of parallel quads at a small relative distance with a perspective projection, including vertex transform, divide and
// interpolation. Returns the fraction of pixels whose depth values are in the wrong order or equal.
double wrong_orders(Random& r, bool reversed, double far_over_near, double gap, int pairs) {
  constexpr int kSize = 16;
  int64_t wrong = 0, all = 0;
  const double near = 0.1, far = near * far_over_near;
  for (int i = 0; i < pairs; ++i) {
    const double distance = r.magnitude(near * 1.1, far / 1.1 / (1 + gap));
    std::array<Image<float>, 2> depth;
    for (const int which : {0, 1}) {
      const auto z_eye = static_cast<float>(-distance * (which == 1 ? 1 + gap : 1.0));
      // Uses float matrices and positions, like a real scene.
      const auto n = static_cast<float>(near), f = static_cast<float>(far);
      const float a = reversed ? n / (f - n) : -f / (f - n), b = reversed ? n * f / (f - n) : -n * f / (f - n);
      std::vector<glm::vec4> p;
      for (const auto& [x, y] : {std::array{-1.f, -1.f}, {3.f, -1.f}, {-1.f, 3.f}})
        p.push_back({-x * z_eye, -y * z_eye, a * z_eye + b, -z_eye});
      DrawState state = reversed ? reversed_z() : always();
      depth[static_cast<std::size_t>(which)] = draw_depth(kSize, kSize, p, state, reversed ? 0.0f : 1.0f);
    }
    for (std::size_t k = 0; k < depth[0].texels().size(); ++k) {
      const float nearer = depth[0].texels()[k], farther = depth[1].texels()[k];
      wrong += reversed ? nearer <= farther : nearer >= farther;
      ++all;
    }
  }
  return static_cast<double>(wrong) / static_cast<double>(all);
}

// Vertices created by the clipper are snapped but keep the depth of their exact position, like original vertices. Each is moved by at most
// half a grid step, 1/512 px, in x and in y. Depth is affine in the window, so the error at an inside sample is at most the error at the
// vertices, (|dz/dx| + |dz/dy|) / 512, plus float rounding.
TEST(Depth, ClippedTrianglesStayWithinHalfAGridStepOfTheirPlane) {
  constexpr int kSize = 64;
  Random r(11);
  int64_t samples = 0, clipped = 0;
  Exact worst = 0;
  for (int i = 0; i < effort(2000); ++i) {
    std::vector<glm::vec4> p;
    for (int k = 0; k < 3; ++k) {
      const double w = r.magnitude(0.5, 8.0);
      const double z = w * r.real(-0.5, 1.5);
      p.push_back({static_cast<float>(w * r.real(-1.2, 1.2)), static_cast<float>(w * r.real(-1.2, 1.2)), static_cast<float>(z),
                   static_cast<float>(w)});
    }
    std::array<Exact, 3> x, y, z;
    for (std::size_t k = 0; k < 3; ++k) {
      x[k] = (static_cast<Exact>(p[k].x) / static_cast<Exact>(p[k].w) + 1) * kSize / 2;
      y[k] = (static_cast<Exact>(p[k].y) / static_cast<Exact>(p[k].w) + 1) * kSize / 2;
      z[k] = static_cast<Exact>(p[k].z) / static_cast<Exact>(p[k].w);
    }
    const Exact area = (x[1] - x[0]) * (y[2] - y[0]) - (y[1] - y[0]) * (x[2] - x[0]);
    if (std::fabs(area) < 1e-3L) continue;
    const Exact dz_dx = ((z[1] - z[0]) * (y[2] - y[0]) - (z[2] - z[0]) * (y[1] - y[0])) / area;
    const Exact dz_dy = ((z[2] - z[0]) * (x[1] - x[0]) - (z[1] - z[0]) * (x[2] - x[0])) / area;
    const Image<float> depth = draw_depth(kSize, kSize, p, always(), 2.0f);  // the clear value is clamped to 1
    clipped += std::any_of(z.begin(), z.end(), [](Exact v) { return v < 0 || v > 1; }) ? 1 : 0;
    for (int py = 0; py < kSize; ++py) {
      for (int px = 0; px < kSize; ++px) {
        const float got = pixel(depth, px, py);
        if (got == 1.0f) continue;
        const Exact want = z[0] + dz_dx * (px + 0.5L - x[0]) + dz_dy * (py + 0.5L - y[0]);
        const Exact bound = (std::fabs(dz_dx) + std::fabs(dz_dy)) / 512 + 4e-7L;
        const Exact error = std::fabs(static_cast<Exact>(got) - std::clamp<Exact>(want, 0, 1));
        EXPECT_LE(error, bound) << i << " at " << px << ", " << py;
        worst = std::max(worst, error / bound);
        ++samples;
      }
    }
  }
  EXPECT_GT(clipped, effort(2000) / 2);
  EXPECT_GT(samples, effort(2000) * 20);
  EXPECT_GT(worst, 0.3L);  // the bound is not too loose
}

TEST(Depth, ReversedZResolvesGapsThatStandardZCannot) {
  Random r(2);
  for (const double ratio : {1e2, 1e4, 1e6}) {
    for (const double gap : {1e-3, 1e-4, 1e-5}) {
      const double standard = wrong_orders(r, false, ratio, gap, effort(300)), reversed = wrong_orders(r, true, ratio, gap, effort(300));
      std::printf(
          "far/near %.0e, gap %.0e: wrong orders standard %.2f%%, "
          "reversed %.2f%%\n",
          ratio, gap, 100 * standard, 100 * reversed);
      // 1e-5 is 84 times the spacing of floats, 2^-23. The errors of transform, divide and interpolation are smaller than that in total.
      EXPECT_EQ(reversed, 0.0) << ratio << ' ' << gap;
      const bool telling = ratio == 1e6 && gap == 1e-4;  // measured: 39% for standard Z, so the test can detect errors
      EXPECT_GT(standard, telling ? 0.2 : -1.0);
    }
  }
}

// ---- tests and writes ------------------------------------------------------------------------------------------

bool is_everywhere(const Image<float>& depth, float z) {
  return std::all_of(depth.texels().begin(), depth.texels().end(), [z](float got) { return got == z; });
}

TEST(Depth, CompareOpsMatchTheirDefinitions) {
  const std::array<CompareOp, 8> ops{CompareOp::never,   CompareOp::less,      CompareOp::equal,         CompareOp::less_equal,
                                     CompareOp::greater, CompareOp::not_equal, CompareOp::greater_equal, CompareOp::always};
  //                                 new < stored, new == stored, new > stored
  const std::array<std::array<bool, 3>, 8> passes{{{false, false, false},
                                                   {true, false, false},
                                                   {false, true, false},
                                                   {true, true, false},
                                                   {false, false, true},
                                                   {true, false, true},
                                                   {false, true, true},
                                                   {true, true, true}}};
  for (const DepthFormat format : {DepthFormat::d16, DepthFormat::d24, DepthFormat::d32f}) {
    for (std::size_t op = 0; op < 8; ++op) {
      for (const bool blended : {false, true}) {
        for (std::size_t relation = 0; relation < 3; ++relation) {
          Image<glm::vec4> image(16, 16);
          Pass pass(16, 16, rgba32f_target(image), {.format = format, .clear_value = 0.5f});
          DrawState state = always();
          state.depth.compare = ops[op];
          if (blended) state.blend = kAdd;
          const auto positions = full_screen(0.25f + 0.25f * static_cast<float>(relation));
          pass.draw(ConstantShader{}, make_vertex_view(stream(positions)), state);
          const PassStatistics s = pass.run(one_worker());
          EXPECT_EQ(pixel(image, 7, 9).x, passes[op][relation] ? 1.0f : 0.0f) << "op " << op << " relation " << relation;
          EXPECT_EQ(s.samples_passed, passes[op][relation] ? 256u : 0u);
        }
      }
    }
  }
}

// Compares random layers with a plain loop that tests each pixel by the definition. The depth bounds of blocks must never reject a passing
// sample.
TEST(Depth, RandomLayersMatchThePlainLoop) {
  Random r(3);
  for (int round = 0; round < effort(200); ++round) {
    constexpr int kSize = 96;
    const auto op = static_cast<CompareOp>(r.integer(0, 7));
    const auto next_op = static_cast<CompareOp>(r.integer(0, 7));
    const float clear = r.real(0.0f, 1.0f);
    Image<glm::vec4> image(kSize, kSize), want(kSize, kSize);
    Image<float> depth(kSize, kSize), want_depth(kSize, kSize);
    std::fill_n(want_depth.data(), kSize * kSize, clear);
    DepthTarget depth_target = d32f_target(depth);
    depth_target.clear_value = clear;
    std::vector<std::vector<glm::vec4>> keep;  // keeps vertex data alive until the pass has run
    std::vector<DrawState> states;
    for (int layer = 0; layer < 40; ++layer) {
      const int x0 = r.integer(-10, kSize), y0 = r.integer(-10, kSize), w = r.integer(1, kSize), h = r.integer(1, kSize);
      const float z = static_cast<float>(r.integer(0, 16)) / 16.0f;
      DrawState state = always();
      state.depth.compare = layer % 2 ? op : next_op;
      state.depth.write = r.integer(0, 3) != 0;
      state.depth.test = r.integer(0, 7) != 0;
      if (r.integer(0, 3) == 0)
        state.blend =
            BlendState{BlendEquation::add, BlendFactor::one, BlendFactor::zero, BlendEquation::add, BlendFactor::one, BlendFactor::zero};
      const auto at = [&](int x, int y) {
        return glm::vec4(static_cast<float>(2 * x) / kSize - 1, static_cast<float>(2 * y) / kSize - 1, z, 1);
      };
      keep.push_back({at(x0, y0), at(x0 + w, y0), at(x0, y0 + h), at(x0 + w, y0), at(x0 + w, y0 + h), at(x0, y0 + h)});
      states.push_back(state);
      for (int y = std::max(0, y0); y < std::min(kSize, y0 + h); ++y) {
        for (int x = std::max(0, x0); x < std::min(kSize, x0 + w); ++x) {
          float& stored = want_depth.at(x, kSize - 1 - y);
          bool pass = true;
          if (state.depth.test) {
            switch (state.depth.compare) {
              case CompareOp::never: pass = false; break;
              case CompareOp::less: pass = z < stored; break;
              case CompareOp::equal: pass = z == stored; break;
              case CompareOp::less_equal: pass = z <= stored; break;
              case CompareOp::greater: pass = z > stored; break;
              case CompareOp::not_equal: pass = z != stored; break;
              case CompareOp::greater_equal: pass = z >= stored; break;
              case CompareOp::always: break;
            }
          }
          if (!pass) continue;
          want.at(x, kSize - 1 - y) = glm::vec4(static_cast<float>(layer + 1));
          if (state.depth.test && state.depth.write) stored = z;
        }
      }
    }
    Pass pass(kSize, kSize, rgba32f_target(image), depth_target, {.tuning = {.tile_size = 8 << (round % 4)}});
    for (std::size_t i = 0; i < keep.size(); ++i) {
      pass.draw(ConstantShader{glm::vec4(static_cast<float>(i + 1))}, make_vertex_view(stream(keep[i])), states[i]);
    }
    pass.run(one_worker());
    ASSERT_EQ(image, want) << round;
    ASSERT_EQ(depth, want_depth) << round;
  }
}

TEST(Depth, DisabledWritesLeaveDepthUnchanged) {
  const auto positions = full_screen(0.25f);
  for (const bool blended : {false, true}) {
    DrawState state = always();
    if (blended) state.blend = kAdd;
    state.depth.write = false;
    EXPECT_TRUE(is_everywhere(draw_depth(8, 8, positions, state, 0.75f), 0.75f));
    state.depth.write = true;
    EXPECT_TRUE(is_everywhere(draw_depth(8, 8, positions, state, 0.75f), 0.25f));
    state.depth.test = false;  // as in OpenGL, disabling the test also disables writes
    EXPECT_TRUE(is_everywhere(draw_depth(8, 8, positions, state, 0.75f), 0.75f));
  }
}

// ---- range and clamp -------------------------------------------------------------------------------------------

TEST(Depth, RangeMapsNearAndFar) {
  struct Case {
    ClipDepth clip;
    float z, range_near, range_far, want;
  };
  for (const Case& c : {Case{ClipDepth::negative_one_to_one, -1, 0, 1, 0},
                        {ClipDepth::negative_one_to_one, 1, 0, 1, 1},
                        {ClipDepth::negative_one_to_one, 0, 0, 1, 0.5f},
                        {ClipDepth::zero_to_one, 0, 0, 1, 0},
                        {ClipDepth::zero_to_one, 1, 0, 1, 1},
                        {ClipDepth::negative_one_to_one, -1, 0.25f, 0.75f, 0.25f},
                        {ClipDepth::negative_one_to_one, 1, 0.25f, 0.75f, 0.75f},
                        {ClipDepth::zero_to_one, 0.5f, 0.25f, 0.75f, 0.5f},
                        {ClipDepth::zero_to_one, 0, 0.25f, 0.75f, 0.25f},
                        // reversed: near maps to 1
                        {ClipDepth::negative_one_to_one, -1, 1, 0, 1},
                        {ClipDepth::negative_one_to_one, 0.5f, 1, 0, 0.25f},
                        {ClipDepth::zero_to_one, 0.25f, 1, 0, 0.75f},
                        {ClipDepth::zero_to_one, 1, 1, 0, 0},
                        {ClipDepth::zero_to_one, 0.3f, 0.5f, 0.5f, 0.5f}}) {
    DrawState state = always();
    state.depth.clip = c.clip;
    state.depth.range_near = c.range_near;
    state.depth.range_far = c.range_far;
    const auto positions = full_screen(c.z);
    EXPECT_TRUE(is_everywhere(draw_depth(8, 8, positions, state, 0.9f), c.want)) << c.z << ' ' << c.range_near << ' ' << c.range_far;
  }
}

TEST(Depth, ClampLimitsDepthToTheRange) {
  // A ramp from z = −1 to z = 2 across 32 px is either clipped at near and far or clamped to the range.
  constexpr int kSize = 32;
  const std::vector<glm::vec4> positions{{-1, -1, -1, 1}, {1, -1, 2, 1}, {-1, 1, -1, 1}, {1, -1, 2, 1}, {1, 1, 2, 1}, {-1, 1, -1, 1}};
  for (const bool reversed_range : {false, true}) {
    DrawState state = always();
    state.depth.range_near = reversed_range ? 0.75f : 0.25f;
    state.depth.range_far = reversed_range ? 0.25f : 0.75f;
    state.depth.clamp = true;
    const Image<float> clamped = draw_depth(kSize, kSize, positions, state, 0.0f);
    state.depth.clamp = false;
    const Image<float> cut = draw_depth(kSize, kSize, positions, state, 0.0f);
    for (int x = 0; x < kSize; ++x) {
      const float z = -1 + 3 * (static_cast<float>(x) + 0.5f) / kSize;
      const bool inside = z >= 0 && z <= 1;
      const float stored = std::clamp(z, 0.0f, 1.0f);
      const float want = reversed_range ? 0.75f - 0.5f * stored : 0.25f + 0.5f * stored;
      EXPECT_NEAR(pixel(clamped, x, 13), want, 1e-6f);
      // Snapping moves the vertices of the clipped triangles by half a sub-pixel, times a slope of 0.5 · 3/32 per pixel.
      EXPECT_NEAR(pixel(cut, x, 13), inside ? want : 0.0f, 0.5f * 3 / 32 / 512 + 1e-6f);
      if (inside) continue;
      EXPECT_EQ(pixel(clamped, x, 13), want);  // exactly the limit of the range
    }
  }
}

// ---- offset ----------------------------------------------------------------------------------------------------

float offset_depth(DepthFormat format, const std::vector<glm::vec4>& positions, const DepthOffset& offset, int x, int y) {
  DrawState state = always();
  state.offset = offset;
  constexpr int kSize = 64;
  if (format == DepthFormat::d16) {
    Image<uint16_t> depth(kSize, kSize);
    Pass pass(kSize, kSize, {}, d16_target(depth));
    pass.draw(ConstantShader{}, make_vertex_view(stream(positions)), state);
    pass.run(one_worker());
    return pixel(depth, x, y);
  }
  if (format == DepthFormat::d24) {
    Image<uint32_t> depth(kSize, kSize);
    Pass pass(kSize, kSize, {}, d24_target(depth));
    pass.draw(ConstantShader{}, make_vertex_view(stream(positions)), state);
    pass.run(one_worker());
    return static_cast<float>(pixel(depth, x, y));
  }
  return pixel(draw_depth(kSize, kSize, positions, state, 1.0f), x, y);
}

TEST(DepthOffset, ConstantIsInUnitsOfTheSmallestStep) {
  // At z = 0.25 = 2^-2, the ulp of a float is 2^(−2−23) = 2^-25. A positive offset increases z.
  const auto p = full_screen(0.25f);
  for (const float n : {1.0f, 4.0f, 100.0f, -3.0f}) {
    EXPECT_EQ(offset_depth(DepthFormat::d32f, p, {.constant = n}, 10, 10), 0.25f + n * 0x1p-25f);
    EXPECT_EQ(offset_depth(DepthFormat::d16, p, {.constant = n}, 10, 10), std::nearbyint(65535 * 0.25) + static_cast<double>(n));
    // 0.25·(2^24 − 1) = 4194303.75 rounds to 4194304.
    EXPECT_EQ(offset_depth(DepthFormat::d24, p, {.constant = n}, 10, 10), 4194304 + static_cast<double>(n));
  }
}

TEST(DepthOffset, FloatStepFollowsTheLargestDepthOfTheTriangle) {
  // The largest |z| is 0.75, with exponent −1, so the unit is 2^-24 for the whole triangle. Floats resolve this unit at the vertex with z =
  // 0.25.
  const std::vector<glm::vec4> p{{-1, -1, 0.25f, 1}, {3, -1, 0.75f, 1}, {-1, 3, 0.25f, 1}};
  const float without = offset_depth(DepthFormat::d32f, p, {}, 3, 3);
  EXPECT_EQ(offset_depth(DepthFormat::d32f, p, {.constant = 2.0f}, 3, 3), without + 2 * 0x1p-24f);
}

TEST(DepthOffset, SlopeIsTheSteeperOfBothDirections) {
  // z increases by 1/256 per pixel in x and decreases by 1/512 in y, so m = 1/256.
  const auto plane = [](float x, float y) { return 0.5f + (x - 32) / 256 - (y - 32) / 512; };
  const auto vertex = [&](float x, float y) { return glm::vec4(x / 32 - 1, y / 32 - 1, plane(x, y), 1); };
  const std::vector<glm::vec4> p{vertex(0, 0), vertex(64, 0), vertex(0, 64)};
  const std::vector<glm::vec4> q{vertex(0, 0), vertex(0, 64), vertex(64, 0)};  // opposite winding; the result must not change
  for (const auto& t : {p, q}) {
    const float z = plane(10.5f, 10.5f);
    // The sum of plane and offset has a few rounding errors of 2^-25.
    EXPECT_NEAR(offset_depth(DepthFormat::d32f, t, {.slope = 2.0f}, 10, 10), z + 2.0f / 256, 2e-7f);
    EXPECT_NEAR(offset_depth(DepthFormat::d32f, t, {.slope = -3.0f}, 10, 10), z - 3.0f / 256, 2e-7f);
    EXPECT_NEAR(offset_depth(DepthFormat::d32f, t, {.slope = 2.0f, .clamp = 0.001f}, 10, 10), z + 0.001f, 2e-7f);
    EXPECT_NEAR(offset_depth(DepthFormat::d32f, t, {.slope = -2.0f, .clamp = -0.001f}, 10, 10), z - 0.001f, 2e-7f);
    EXPECT_NEAR(offset_depth(DepthFormat::d32f, t, {.slope = -2.0f, .clamp = 0.001f}, 10, 10), z - 2.0f / 256,
                2e-7f);  // only an upper bound
    EXPECT_NEAR(offset_depth(DepthFormat::d16, t, {.slope = 1.0f, .constant = 5.0f}, 10, 10),
                (static_cast<double>(z) + 1.0 / 256) * 65535 + 5, 0.51);
    EXPECT_NEAR(offset_depth(DepthFormat::d24, t, {.slope = 1.0f, .constant = 5.0f}, 10, 10),
                (static_cast<double>(z) + 1.0 / 256) * 16777215 + 5, 4);
  }
}

TEST(DepthOffset, ResultStaysInTheRange) {
  const auto p = full_screen(0.999f);
  EXPECT_EQ(offset_depth(DepthFormat::d32f, p, {.constant = 1e9f}, 10, 10), 1.0f);
  EXPECT_EQ(offset_depth(DepthFormat::d32f, full_screen(0.001f), {.constant = -1e9f}, 10, 10), 0.0f);
}

TEST(DepthOffset, SignFollowsTheDepthConvention) {
  // For two coplanar quads, the decal wins with a negative offset under LESS and with a positive offset under reversed Z.
  for (const bool reversed : {false, true}) {
    for (const float sign : {-1.0f, 1.0f}) {
      Image<glm::vec4> image(8, 8);
      Pass pass(8, 8, rgba32f_target(image), {.format = DepthFormat::d32f, .clear_value = reversed ? 0.0f : 1.0f});
      DrawState state = always();
      state.depth.compare = reversed ? CompareOp::greater : CompareOp::less;
      const auto p = full_screen(0.3f);
      pass.draw(ConstantShader{glm::vec4(1)}, make_vertex_view(stream(p)), state);
      state.offset.constant = sign;
      pass.draw(ConstantShader{glm::vec4(2)}, make_vertex_view(stream(p)), state);
      pass.run(one_worker());
      EXPECT_EQ(pixel(image, 3, 3).x, (sign > 0) == reversed ? 2.0f : 1.0f);
    }
  }
}

// ---- formats ---------------------------------------------------------------------------------------------------

// UNORM values are the integers nearest to z·(2^n − 1), ties to even (OpenGL 4.6, section 2.3.5.2, does not define ties), computed from the
// float depth. Every value is tested in a pass with a primitive of that depth.
TEST(DepthFormats, UnormValuesAreCorrectlyRounded) {
  Random r(4);
  constexpr int kSide = 64;
  for (int batch = 0; batch < effort(40); ++batch) {
    // One small square per value: each pixel (x, y) has its own depth.
    std::vector<float> z(kSide * kSide);
    std::vector<glm::vec4> positions;
    for (int i = 0; i < kSide * kSide; ++i) {
      float& value = z[static_cast<std::size_t>(i)];
      const int kind = r.integer(0, 3);
      const bool wide = batch % 2 == 0;
      const double codes = wide ? 16777215.0 : 65535.0;
      value =
          kind == 0 ? r.real(0.0f, 1.0f) : static_cast<float>((r.integer(0, static_cast<int>(codes) - 1) + 0.5) / codes);  // close to a tie
      if (kind == 2) value = static_cast<float>((r.integer(0, 1 << r.integer(1, 16)) + 0.5) / codes);
      if (kind == 3) value = static_cast<float>(r.real(0.0, codes) / codes);
      value = std::min(value, 1.0f);
      const int x = i % kSide, y = i / kSide;
      const auto at = [&](int dx, int dy) {
        return glm::vec4(static_cast<float>(x + dx) / 32 - 1, static_cast<float>(y + dy) / 32 - 1, value, 1);
      };
      positions.insert(positions.end(), {at(0, 0), at(1, 0), at(0, 1), at(1, 0), at(1, 1), at(0, 1)});
    }
    Image<uint32_t> d24(kSide, kSide);
    Image<uint16_t> d16(kSide, kSide);
    Image<float> d32f(kSide, kSide);
    for (const DepthTarget& target : {d24_target(d24), d16_target(d16), d32f_target(d32f)}) {
      Pass pass(kSide, kSide, {}, target);
      pass.draw(ConstantShader{}, make_vertex_view(stream(positions)), always());
      pass.run(one_worker());
    }
    for (int i = 0; i < kSide * kSide; ++i) {
      const float value = z[static_cast<std::size_t>(i)];
      const int x = i % kSide, y = i / kSide;
      ASSERT_EQ(pixel(d32f, x, y), value);
      // The product of two 24-bit numbers is exact in double.
      ASSERT_EQ(pixel(d24, x, y), static_cast<uint32_t>(std::nearbyint(static_cast<double>(value) * 16777215.0))) << value;
      ASSERT_EQ(pixel(d16, x, y), static_cast<uint16_t>(std::nearbyint(static_cast<double>(value) * 65535.0))) << value;
    }
  }
}

TEST(DepthFormats, LoadReturnsStoredDepth) {
  Random r(5);
  Image<uint16_t> d16(70, 50);
  Image<uint32_t> d24(70, 50);
  Image<float> d32f(70, 50);
  for (std::size_t i = 0; i < 70 * 50; ++i) {
    d16.data()[i] = static_cast<uint16_t>(r.bits());
    d24.data()[i] = static_cast<uint32_t>(r.bits()) & 0xffffff;
    d32f.data()[i] = r.real(0.0f, 1.0f);
  }
  const auto d16_before = d16;
  const auto d24_before = d24;
  const auto d32f_before = d32f;
  const std::vector<glm::vec4> nothing_passes = full_screen(0.5f);
  DrawState state = always();
  state.depth.compare = CompareOp::never;
  for (DepthTarget target : {d16_target(d16), d24_target(d24), d32f_target(d32f)}) {
    target.load = LoadOp::load;
    Pass pass(70, 50, {}, target);
    pass.draw(ConstantShader{}, make_vertex_view(stream(nothing_passes)), state);
    pass.run(one_worker());
  }
  EXPECT_EQ(d16, d16_before);
  EXPECT_EQ(d24, d24_before);
  EXPECT_EQ(d32f, d32f_before);
}

// ---- invariance ------------------------------------------------------------------------------------------------

// Uses the same expression for the position, but different attributes, varyings and fragment outputs.
struct Full {
  glm::mat4 clip_from_model{1.0f};
  template <class R>
  using Attributes = ColoredAttributes<R>;
  template <class R>
  struct Varyings {
    vec4<R> color;
    vec2<R> extra;
    NoPerspective<R> more;
  };
  template <class R>
  vec4<R> vertex(const Attributes<R>& in, Varyings<R>& out) const {
    out.color = in.color;
    out.extra = vec2<R>(in.position.x * in.position.y, in.color.x);
    out.more.value = in.position.z;
    return clip_from_model * in.position;
  }
  template <class R>
  Fragment<R> fragment(const Varyings<R>& in, const Pixel<R>& px) const {
    return {in.color + vec4<R>(in.extra.x, in.extra.y, in.more.value, px.z())};
  }
};

TEST(DepthInvariance, PrePassThenEqualLosesNoPixels) {
  Random r(6);
  int64_t covered = 0, lost = 0;
  uint64_t clipped = 0;
  for (int i = 0; i < effort(150); ++i) {
    constexpr int kWidth = 150, kHeight = 90;
    const auto format = static_cast<DepthFormat>(1 + i % 3);
    std::vector<glm::vec4> positions, colors;
    std::vector<uint32_t> indices;
    for (int k = 0; k < 120; ++k) {
      positions.push_back({r.real(-3.0f, 3.0f), r.real(-3.0f, 3.0f), r.real(-6.0f, 1.0f), 1.0f});
      colors.push_back({r.real(0.0f, 1.0f), r.real(0.0f, 1.0f), r.real(0.0f, 1.0f), 1.0f});
    }
    for (int k = 0; k < 300; ++k) indices.push_back(static_cast<uint32_t>(r.integer(0, 119)));
    const Indices list(indices, positions.size());
    // Reversed Z with an infinite far plane and near = 0.3, so that many triangles cross the near plane and w = 0.
    glm::mat4 m(0.0f);
    m[0][0] = r.real(0.5f, 3.0f);
    m[1][1] = r.real(0.5f, 3.0f);
    m[2][3] = -1.0f;
    m[3][2] = 0.3f;
    DrawState state = reversed_z();
    if (i % 4 == 0) state.offset = {.slope = 1.5f, .constant = 3.0f};
    if (i % 5 == 0) state.depth.clamp = true;

    Image<float> d32f(kWidth, kHeight);
    Image<uint32_t> d24(kWidth, kHeight);
    Image<uint16_t> d16(kWidth, kHeight);
    DepthTarget depth = format == DepthFormat::d32f ? d32f_target(d32f) : format == DepthFormat::d24 ? d24_target(d24) : d16_target(d16);
    depth.clear_value = 0.0f;
    Pass first(kWidth, kHeight, {}, depth, {.tuning = {.tile_size = 8 << (i % 4)}});
    first.draw_depth(MatrixShader{m}, make_vertex_view(stream(positions)), list, state);
    clipped += first.run(one_worker()).clipped;

    // The pre-pass covered every pixel that is nearer than infinity.
    Image<glm::vec4> color(kWidth, kHeight);
    ColorTarget color_target = rgba32f_target(color);
    color_target.clear_value = glm::vec4(-1000.0f);
    depth.load = LoadOp::load;
    state.depth.compare = CompareOp::equal;
    Pass second(kWidth, kHeight, color_target, depth, {.tuning = {.tile_size = 64, .defer = i % 2 == 0}});
    second.draw(Full{m}, make_vertex_view(stream(positions), stream(colors)), list, state);
    second.run(one_worker());
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) {
        const bool before = format == DepthFormat::d32f  ? pixel(d32f, x, y) > 0
                            : format == DepthFormat::d24 ? pixel(d24, x, y) > 0
                                                         : pixel(d16, x, y) > 0;
        if (!before) continue;
        ++covered;
        lost += pixel(color, x, y) == glm::vec4(-1000.0f);
      }
    }
  }
  std::printf("%lld covered pixels, %lld lost, %llu triangles clipped\n", static_cast<long long>(covered), static_cast<long long>(lost),
              static_cast<unsigned long long>(clipped));
  EXPECT_EQ(lost, 0);
  EXPECT_GT(covered, effort(150) * 3000);
  EXPECT_GT(clipped, static_cast<uint64_t>(effort(150) * 10));
}

// Covers the left half, x < 4. Has no fragment function, because it is only drawn with draw_depth().
struct LeftHalf : PositionShader {
  template <class R>
  Visibility<R> visibility(const Varyings<R>&, const Pixel<R>& px) const {
    return {px.x < R(4), px.z()};
  }
};

TEST(Depth, AShaderWithoutAFragmentFunctionDecidesCoverageOfDepthDraws) {
  Image<float> depth(8, 8);
  DepthTarget target = d32f_target(depth);
  target.clear_value = 1.0f;
  const std::vector<glm::vec4> positions = full_screen();
  Pass pass(8, 8, {}, target);
  pass.draw_depth(LeftHalf{}, make_vertex_view(stream(positions)), always());
  pass.run(one_worker());
  for (int y = 0; y < 8; ++y) {
    for (int x = 0; x < 8; ++x) EXPECT_EQ(depth.at(x, y) != 1.0f, x < 4) << x << ' ' << y;
  }
}

// The depth bounds of a block must include all triangles whose shader has a visibility function. If they missed the second triangle, the
// third would replace the whole tile.
TEST(Depth, AllTrianglesWithAVisibilityFunctionWidenTheBoundsOfTheirBlock) {
  Image<float> depth(64, 64);
  const auto corner_at = [](float z) { return std::vector<glm::vec4>{{-1, -1, z, 1}, {-0.5f, -1, z, 1}, {-1, -0.5f, z, 1}}; };  // 16 px
  std::vector<glm::vec4> corners = corner_at(0.5f);
  for (const glm::vec4& corner : corner_at(-0.5f)) corners.push_back(corner);
  const std::vector<glm::vec4> behind_corner = full_screen(0.0f);
  Pass pass(64, 64, {}, d32f_target(depth));
  pass.draw_depth(LeftHalf{}, make_vertex_view(stream(corners)));
  pass.draw_depth(PositionShader{}, make_vertex_view(stream(behind_corner)));
  pass.run(one_worker());
  for (int y = 0; y < 8; ++y) {
    for (int x = 0; x < 8; ++x) EXPECT_EQ(pixel(depth, x, y), x < 4 ? 0.25f : 0.5f) << x << ' ' << y;
  }
}

// Two planes that intersect at a grazing angle, so that blocks on the line of intersection contain depths that differ by a few ulps. The
// result must equal that of drawing each triangle in a separate pass.
TEST(Depth, TestsOfBlocksAgreeWithTestsOfPixels) {
  constexpr int kSize = 128;
  Random r(17);
  for (int i = 0; i < effort(400); ++i) {
    const double steepness = r.magnitude(1e-7, 1.0), twist = r.magnitude(1e-9, 1e-2);
    std::vector<glm::vec4> both;
    for (int k = 0; k < 2; ++k) {
      const double to_x = steepness + r.real(-twist, twist), to_y = steepness * 0.3 + r.real(-twist, twist);
      for (int corner = 0; corner < 3; ++corner) {
        const double x = r.real(-4.0, 4.0), y = r.real(-4.0, 4.0);
        both.push_back({static_cast<float>(x), static_cast<float>(y),
                        static_cast<float>(std::clamp(0.5 + (x * to_x + y * to_y) / 12, 0.0, 1.0)), 1.0f});
      }
    }
    DrawState state;
    state.depth.clip = ClipDepth::zero_to_one;
    const auto half = [&](std::ptrdiff_t k) { return std::vector<glm::vec4>(both.begin() + 3 * k, both.begin() + 3 * k + 3); };
    const Image<float> first = draw_depth(kSize, kSize, half(0), state, 1.0f), second = draw_depth(kSize, kSize, half(1), state, 1.0f);
    const Image<float> together = draw_depth(kSize, kSize, both, state, 1.0f);
    for (int y = 0; y < kSize; ++y) {
      for (int x = 0; x < kSize; ++x) ASSERT_EQ(together.at(x, y), std::min(first.at(x, y), second.at(x, y))) << i << ": " << x << ' ' << y;
    }
  }
}

// Both triangles span the same depths, but in every block the second is behind the first.
TEST(Depth, TiltedTrianglesAreRejectedInBlocks) {
  Image<float> depth(64, 64);
  const auto tilted = [](float z) { return std::vector<glm::vec4>{{-1, -1, z - 0.4f, 1}, {3, -1, z + 0.4f, 1}, {-1, 3, z - 0.4f, 1}}; };
  const std::vector<glm::vec4> near = tilted(0.0f), far = tilted(0.1f);
  Pass pass(64, 64, {}, d32f_target(depth));
  pass.draw_depth(PositionShader{}, make_vertex_view(stream(near)));
  pass.draw_depth(PositionShader{}, make_vertex_view(stream(far)));
  EXPECT_EQ(pass.run(one_worker()).samples_tested, 64u * 64u);
}

}  // namespace
}  // namespace halfspace::raster_test
