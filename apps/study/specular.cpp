// SPDX-License-Identifier: Apache-2.0
//
// Compares ways to compute the power function of a specular highlight: pow, exp2 with log2, squaring, a table and two approximations.
#include <fmt/format.h>

#include <array>
#include <cmath>

#include "halfspace/core/lane_math.h"
#include "study/study.h"

namespace halfspace {

namespace {

constexpr int kTable = 256;

// A table of c^n at 257 points with linear interpolation.
struct PowerTable {
  std::array<float, kTable + 2> values{};
  explicit PowerTable(double n) {
    for (std::size_t i = 0; i < values.size(); ++i)
      values[i] = static_cast<float>(std::pow(std::min(1.0, static_cast<double>(i) / kTable), n));
  }
  template <class R>
  HS_INLINE R at(R c) const {
    const R x = c * R(static_cast<float>(kTable));
    const IntOf<R> i = truncate_to_int(x);
    const R low = gather(values.data(), i), high = gather(values.data() + 1, i);
    return fma(x - to_real<R>(i), high - low, low);
  }
};

template <class R>
HS_INLINE R by_squaring(R c, int n) {  // n must be a power of two
  for (; n > 1; n /= 2) c = c * c;
  return c;
}

constexpr int kValues = 1 << 16, kRounds = 16;

template <class F>
Variant evaluated(const std::string& name, int exponent, const F& f, const StudyOptions& options) {
  std::vector<float> in(kValues), out(kValues);
  for (int i = 0; i < kValues; ++i) in[static_cast<std::size_t>(i)] = static_cast<float>((i + 0.5) / kValues);
  Variant v{.name = fmt::format("{} {}", name, exponent),
            .group = name,
            .parameters = {{"exponent", static_cast<double>(exponent)}, {"values", static_cast<double>(kValues) * kRounds}},
            .time = time_of(
                [&] {
                  for (int k = 0; k < kRounds; ++k)
                    for (std::size_t i = 0; i < kValues; i += kLanes) store(&out[i], f(load<Real>(&in[i])));
                },
                options)};
  long double sum = 0.0L;
  for (std::size_t i = 0; i < kValues; ++i) {
    const long double e =
        std::abs(static_cast<long double>(out[i]) - std::pow(static_cast<long double>(in[i]), static_cast<long double>(exponent)));
    v.error = std::max(v.error, static_cast<double>(e));
    sum += e;
  }
  v.measures = {{"mean", static_cast<double>(sum / kValues)}};
  return v;
}

}  // namespace

Study study_specular(const StudyOptions& options, const Workers&) {
  Study study{
      .name = "specular",
      .title = "Power function of a specular highlight",
      .setting = fmt::format("c^n over 65,536 cosines in (0, 1); labels are exponents; {} lanes", kLanes),
      .error_name = "largest error over all cosines",
      .time_name = "a million powers on one thread",
      .truth = {"long double", 0x1p-60, "a few roundings of 2^-64"},
  };
  for (const int n : options.quick ? std::vector{32} : std::vector{8, 32, 128}) {
    const auto y = static_cast<float>(n);
    const PowerTable table(n);
    study.variants.push_back(evaluated(
        "pow (used here)", n, [&](Real c) { return pow(c, Real(y)); }, options));
    study.variants.push_back(evaluated(
        "exp2(n log2 c)", n, [&](Real c) { return exp2(Real(y) * log2(c)); }, options));
    study.variants.push_back(evaluated(
        "squaring", n, [&](Real c) { return by_squaring(c, n); }, options));
    study.variants.push_back(evaluated(
        "table of 256", n, [&](Real c) { return table.at(c); }, options));
    // C. Schlick, "A fast alternative to Phong's specular model", Graphics Gems IV, 1994.
    study.variants.push_back(evaluated(
        "Schlick", n, [&](Real c) { return c / (Real(y) - Real(y) * c + c); }, options));
    // A spherical Gaussian. It has the same value and derivative as c^n at c = 1.
    study.variants.push_back(evaluated(
        "Gaussian", n, [&](Real c) { return exp(Real(y) * (c - Real(1.0f))); }, options));
  }
  return study;
}

}  // namespace halfspace
