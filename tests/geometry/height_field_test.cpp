// SPDX-License-Identifier: Apache-2.0
#include "halfspace/geometry/height_field.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

#include "geometry/rough_map.h"
#include "support/constants.h"
#include "support/expected_hash.h"
#include "support/hash.h"
#include "support/workers.h"

namespace halfspace {
namespace {

// Returns a smooth function on the sphere with values from 0 to 1: a polynomial in the position.
double smooth_height(double u, double v) {
  const double s = std::sin(kPi * v);
  const double x = s * std::cos(2 * kPi * u), y = std::cos(kPi * v), z = -s * std::sin(2 * kPi * u);
  return 0.5 + 0.2 * x * y + 0.15 * z * z * x + 0.1 * y * z - 0.1 * x;
}

template <class F>
Image<float> map_of(int width, int height, F value) {
  Image<float> map(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) map.at(x, y) = static_cast<float>(value((x + 0.5) / width, (y + 0.5) / height));
  }
  return map;
}

Image<float> quantized(Image<float> map) {
  for (int y = 0; y < map.height(); ++y) {
    for (float& t : map.row(y)) t = std::round(t * 255.0f) / 255.0f;
  }
  return map;
}

bool same_bits(const HeightSample& a, const HeightSample& b) { return std::memcmp(&a, &b, sizeof a) == 0; }

// The difference quotient with step h has an error of f'''·h²/6, and f''' is at most 4·W³ for texels in [0, 1] and W texels per unit. With
// h = 1e-7 / W that is 1e-14·W; the rounding error is 1e-16 / h = 1e-9·W.
TEST(HeightField, GradientIsTheDerivativeOfTheValue) {
  for (const double smoothing : {0.0, 1.5}) {
    const HeightField f(rough_map(32, 16, 12345), smoothing, two_workers());
    for (const double u : {0.0, 0.013, 0.25, 0.4999, 0.7, 0.98, 0.999}) {
      for (const double v : {0.001, 0.02, 0.21, 0.5, 0.77, 0.96, 0.999}) {
        const double hu = 1e-7 / 32, hv = 1e-7 / 16;
        const HeightSample s = f.at(u, v);
        EXPECT_NEAR((f.at(u + hu, v).value - f.at(u - hu, v).value) / (2 * hu), s.du, 1e-7 * 32);
        EXPECT_NEAR((f.at(u, v + hv).value - f.at(u, v - hv).value) / (2 * hv), s.dv, 1e-7 * 16);
      }
    }
  }
}

TEST(HeightField, RowSamplesMatchSingleSamples) {
  for (const MapEdges edges : {MapEdges::sphere, MapEdges::torus, MapEdges::cylinder, MapEdges::sheet}) {
    const HeightField field(map_of(34, 17, smooth_height), 0.7, two_workers(), edges);
    std::vector<double> places{0.0, 1.0, 0.5, -0.25};
    for (int x = 0; x < 50; ++x) places.push_back((x + 0.5) / 50);
    std::vector<HeightTaps> taps;
    for (const double u : places) taps.push_back(field.taps(u));
    for (const double v : {-0.3, 0.0, 0.01, 0.5, 0.77, 1.0, 1.2}) {
      std::vector<HeightSample> samples(taps.size());
      field.at(taps, v, samples);
      for (std::size_t i = 0; i < places.size(); ++i) {
        const HeightSample one = field.at(places[i], v);
        EXPECT_EQ(samples[i].value, one.value);
        EXPECT_EQ(samples[i].du, one.du);
        EXPECT_EQ(samples[i].dv, one.dv);
      }
    }
  }
}

// For power-of-two sizes the texel centers are exact in double, and the results are bit-identical. For other sizes, at() samples about
// 1e-16 of the map size away from the center.
TEST(HeightField, TexelSamplesMatchSingleSamples) {
  for (const MapEdges edges : {MapEdges::sphere, MapEdges::torus, MapEdges::cylinder, MapEdges::sheet}) {
    for (const auto& [width, height] : {std::pair(32, 16), std::pair(2, 1), std::pair(30, 11)}) {
      const HeightField field(rough_map(width, height, 12345), 0.0, two_workers(), edges);
      const bool exact = std::has_single_bit(static_cast<unsigned>(width)) && std::has_single_bit(static_cast<unsigned>(height));
      std::vector<HeightSample> samples(static_cast<std::size_t>(width));
      for (int row = 0; row < height; ++row) {
        field.at_texels(row, samples);
        for (int x = 0; x < width; ++x) {
          const HeightSample got = samples[static_cast<std::size_t>(x)], want = field.at((x + 0.5) / width, (row + 0.5) / height);
          const double tolerance = exact ? 0.0 : 1e-12;  // slopes are up to 30 and second derivatives 30² per unit of u or v; times 1e-16
          EXPECT_NEAR(got.value, want.value, tolerance) << width << ' ' << x << ' ' << row;
          EXPECT_NEAR(got.du, want.du, tolerance) << width << ' ' << x << ' ' << row;
          EXPECT_NEAR(got.dv, want.dv, tolerance) << width << ' ' << x << ' ' << row;
        }
      }
    }
  }
}

// Value and gradient are continuous across texel borders, the seam and the poles.
TEST(HeightField, IsSmoothOverSeamAndPoles) {
  const HeightField f(rough_map(32, 16, 12345), 0.0, two_workers());
  const double tiny = 1e-12;
  for (const double a : {0.0, 0.1, 0.35, 0.8, 1.0}) {
    EXPECT_TRUE(same_bits(f.at(0, a), f.at(1, a)));
    EXPECT_NEAR(f.at(1 - tiny, a).value, f.at(0, a).value, 1e-9);
    EXPECT_NEAR(f.at(1 - tiny, a).du, f.at(0, a).du, 1e-8);
    for (const auto& [inside, beyond] : {std::pair(0.03, -0.03), std::pair(0.97, 1.03)}) {
      EXPECT_NEAR(f.at(a, beyond).value, f.at(a + 0.5, inside).value, 1e-14);
      EXPECT_NEAR(f.at(a, beyond).du, f.at(a + 0.5, inside).du, 1e-12);
      EXPECT_NEAR(f.at(a, beyond).dv, -f.at(a + 0.5, inside).dv, 1e-12);
    }
    const double texel_border = 7.5 / 32;
    EXPECT_NEAR(f.at(texel_border - tiny, a).du, f.at(texel_border + tiny, a).du, 1e-8);
  }
}

TEST(HeightField, ConstantsAreExact) {
  Image<float> map(12, 6);
  for (int y = 0; y < 6; ++y) {
    for (float& t : map.row(y)) t = 0.3f;
  }
  const HeightField plain(map, 0.0, two_workers()), smoothed(map, 2.3, two_workers());
  for (const HeightField& f : {plain, smoothed, smoothed.filtered(5, two_workers())}) {
    for (const double u : {0.0, 0.12, 0.9}) {
      for (const double v : {0.0, 0.3, 1.0}) {
        const HeightSample s = f.at(u, v);
        EXPECT_EQ(s.value, static_cast<double>(0.3f));
        EXPECT_EQ(s.du, 0.0);
        EXPECT_EQ(s.dv, 0.0);
      }
    }
  }
}

// The spline and symmetric filters reproduce a linear ramp, except near the poles, where the map mirrors it. The texels are multiples of
// 2^-7, so the unfiltered field has only the rounding error of double; smoothed texels are rounded to float.
TEST(HeightField, ReproducesRampsAlongV) {
  const Image<float> map = map_of(128, 64, [](double, double v) { return v; });
  const HeightField plain(map, 0.0, two_workers()), smoothed(map, 1.5, two_workers());
  for (double v = 0.2; v < 0.8; v += 0.0137) {
    EXPECT_NEAR(plain.at(0.3, v).value, v, 1e-14);
    EXPECT_NEAR(plain.at(0.3, v).dv, 1.0, 1e-13);
    EXPECT_NEAR(plain.at(0.3, v).du, 0.0, 1e-14);
    EXPECT_NEAR(smoothed.at(0.3, v).value, v, 1e-7);
    EXPECT_NEAR(smoothed.at(0.3, v).dv, 1.0, 1e-5);
    EXPECT_NEAR(plain.filtered(64, two_workers()).at(0.3, v).value, v, 1e-7);
  }
}

// At half the resolution, one-texel-wide stripes average out to their mean. At other ratios, the side lobes of the averaging filter let a
// ninth of the slope through.
TEST(HeightField, FilteringRemovesFineDetail) {
  const HeightField stripes(map_of(64, 32, [](double u, double) { return static_cast<int>(u * 64) % 2 == 0 ? 0.0 : 1.0; }), 0.0,
                            two_workers());
  const HeightField half = stripes.filtered(32, two_workers());
  EXPECT_EQ(half.width(), 32);
  EXPECT_EQ(half.height(), 16);
  const HeightField uneven = stripes.filtered(23, two_workers());
  EXPECT_EQ(uneven.width(), 22);
  EXPECT_EQ(uneven.height(), 11);
  double max_slope = 0, max_uneven_slope = 0, before = 0;
  for (double u = 0; u < 1; u += 0.003) {
    EXPECT_NEAR(half.at(u, 0.4).value, 0.5, 1e-7);
    max_slope = std::max(max_slope, std::fabs(half.at(u, 0.4).du));
    max_uneven_slope = std::max(max_uneven_slope, std::fabs(uneven.at(u, 0.4).du));
    before = std::max(before, std::fabs(stripes.at(u, 0.4).du));
  }
  EXPECT_GT(before, 20.0);
  EXPECT_LT(max_slope, 1e-5);
  EXPECT_LT(max_uneven_slope, 0.125 * before);
}

TEST(HeightField, FilteringKeepsCoarseDetail) {
  const HeightField fine(map_of(512, 256, smooth_height), 0.0, two_workers());
  EXPECT_EQ(fine.filtered(512, two_workers()).width(), 512);
  const HeightField coarse = fine.filtered(128, two_workers());
  for (double u = 0; u < 1; u += 0.07) {
    for (double v = 0.05; v < 1; v += 0.09) EXPECT_NEAR(coarse.at(u, v).value, smooth_height(u, v), 2e-3);
  }
}

// Near a pole the texels of a row are close together, and noise in them must not turn into slopes. In a smoothed field, the slope to the
// east (du / sin πv) is similar in the rows next to the pole and at the equator. In an unsmoothed field, it is many times larger near the
// pole.
TEST(HeightField, PolesAreNotNoisy) {
  const Image<float> map = rough_map(256, 128, 12345);
  const auto mean_square_slope = [](const HeightField& f, double v) {
    double sum = 0;
    for (int i = 0; i < 1000; ++i) sum += std::pow(f.at(i / 1000.0, v).du / std::sin(kPi * v), 2);
    return sum / 1000;
  };
  const HeightField rough(map, 0.0, two_workers()), even(map, 1.0, two_workers());
  for (const double v : {0.5 / 128, 2.0 / 128, 0.05, 0.96}) {
    EXPECT_LT(mean_square_slope(even, v), 2.0 * mean_square_slope(even, 0.5));
    EXPECT_GT(mean_square_slope(rough, v), 10.0 * mean_square_slope(rough, 0.5));
  }
}

// Returns the largest error of the gradient, in value per unit of u or v, relative to the smooth function.
double gradient_error(const HeightField& f) {
  double max_error = 0;
  for (double u = 0.001; u < 1; u += 0.0031) {
    for (double v = 0.15; v < 0.85; v += 0.0137) {
      const double h = 1e-5;
      const HeightSample s = f.at(u, v);
      max_error = std::max(max_error, std::fabs(s.du - (smooth_height(u + h, v) - smooth_height(u - h, v)) / (2 * h)));
      max_error = std::max(max_error, std::fabs(s.dv - (smooth_height(u, v + h) - smooth_height(u, v - h)) / (2 * h)));
    }
  }
  return max_error;
}

// Quantization to 8 bits creates terraces with slopes of up to 1/255 per texel, far more than the slopes of the map.
TEST(HeightField, SmoothingRemovesTerraces) {
  const Image<float> map = quantized(map_of(512, 256, smooth_height));
  const double rough = gradient_error(HeightField(map, 0.0, two_workers()));
  const double smoothed = gradient_error(HeightField(map, 3.0, two_workers()));
  RecordProperty("unsmoothed", std::to_string(rough));
  RecordProperty("smoothed", std::to_string(smoothed));
  EXPECT_GT(rough, 1.0);
  EXPECT_LT(smoothed, 0.1 * rough);
}

TEST(HeightField, AcceptsOddAndMinimumSizes) {
  for (const auto& [width, height] : {std::pair(2, 1), std::pair(3, 2), std::pair(37, 19)}) {
    const HeightField f(rough_map(width, height, 12345), 1.0, Workers(1));
    EXPECT_EQ(f.width(), width / 2 * 2);
    EXPECT_EQ(f.height(), height);
    for (const double a : {0.0, 0.3, 1.0}) {
      EXPECT_GE(f.at(a, a).value, 0.0);
      EXPECT_LE(f.at(a, a).value, 1.0);
    }
  }
  EXPECT_DEATH(HeightField(Image<float>(1, 1), 0.0, Workers(1)), "too narrow");
}

TEST(HeightField, IsBitIdenticalForAnyThreadCount) {
  const Image<float> map = rough_map(101, 50, 12345);
  const HeightField one = HeightField(map, 1.2, Workers(1)).filtered(60, Workers(1));
  const HeightField many = HeightField(map, 1.2, Workers(7)).filtered(60, Workers(7));
  for (double u = 0; u < 1; u += 0.017) {
    for (double v = 0; v < 1; v += 0.031) EXPECT_TRUE(same_bits(one.at(u, v), many.at(u, v)));
  }
}

TEST(HeightField, MatchesTheStoredHash) {
  const HeightField f = HeightField(rough_map(100, 50, 12345), 1.2, two_workers()).filtered(60, two_workers());
  Hash hash;
  for (double u = 0; u < 1; u += 0.0625) {
    for (double v = 0; v < 1; v += 0.0625) {
      const HeightSample s = f.at(u, v);
      for (const double x : {s.value, s.du, s.dv}) hash.add(std::bit_cast<uint64_t>(x));
    }
  }
  expect_hash("height-field", hash.value());
}

}  // namespace
}  // namespace halfspace
