// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <bit>

#include "halfspace/core/lane_math.h"

namespace halfspace::HS_LANES {

/// Computes x^y for an exponent 0 < y <= 1 that is known in advance, such as the gamma of a display. Cheaper than unit_pow,
/// which has to compute a logarithm.
///
/// With x = m·2^e and 1 <= m < 2, x^y = m^y·2^(e·y). The first factor is a polynomial in m. The second is the product of two
/// table entries, one for the lower and one for the upper four bits of the biased exponent. The constructor calls no library
/// functions, so the tables are identical on every machine.
class FixedPower {
 public:
  explicit constexpr FixedPower(float y) : y_(y) {
    const auto exponent = static_cast<double>(y);
    for (int i = 0; i < 16; ++i) {
      low_[static_cast<std::size_t>(i)] = bits(exp(kLn2 * exponent * i));
      high_[static_cast<std::size_t>(i)] = bits(exp(kLn2 * exponent * (16 * i - 127)));
    }
    fit(exponent);
  }

  /// Returns x^y for 0 <= x < infinity, with a relative error of at most 3e-7. Subnormal x counts as 0. x < 0 and NaN give NaN.
  template <Number R>
  HS_INLINE R operator()(R x) const {
    if constexpr (std::is_same_v<R, double>) {
      return pow(x, static_cast<double>(y_));
    } else {
      const IntOf<R> i = as_int(x);
      const R t = as_real((i & 0x7fffff) | 0x3f800000) - R(kMiddle);
      const R scale = as_real(look_up(low_, (i >> 23) & 15)) * as_real(look_up(high_, (i >> 27) & 15));
      const R r = detail::polynomial(t, mantissa_) * scale;
      return select(x >= R(0x1p-126f), r, select(x >= R(0), R(0), R(detail::kNaN)));
    }
  }

 private:
  static constexpr int kTerms = 8;
  static constexpr double kLn2 = 0.693147180559945309417, kLnMiddle = 0.405465108108164381978;
  static constexpr float kMiddle = 1.5f;

  static constexpr int32_t bits(double value) { return std::bit_cast<int32_t>(static_cast<float>(value)); }

  // e^z for |z| <= 88, computed as the Taylor series at z/2^7, squared seven times.
  static constexpr double exp(double z) {
    const double part = z / 128;
    double sum = 1;
    for (int k = 16; k > 0; --k) sum = 1 + part / k * sum;
    for (int k = 0; k < 7; ++k) sum *= sum;
    return sum;
  }

  // (1 + u)^y for |u| <= 1/3, by the binomial series.
  static constexpr double binomial(double u, double y) {
    double sum = 1;
    for (int k = 40; k > 0; --k) sum = 1 + (y - k + 1) / k * u * sum;
    return sum;
  }

  // Interpolates (kMiddle + t)^y at the Chebyshev points of |t| <= 1/2, using Newton's divided differences.
  constexpr void fit(double y) {
    constexpr std::array<double, kTerms> points{-0.490392640, -0.415734806, -0.277785117, -0.097545161,
                                                0.097545161,  0.277785117,  0.415734806,  0.490392640};
    std::array<double, kTerms> differences{};
    for (std::size_t i = 0; i < kTerms; ++i) differences[i] = exp(kLnMiddle * y) * binomial(points[i] / static_cast<double>(kMiddle), y);
    for (std::size_t order = 1; order < kTerms; ++order) {
      for (std::size_t i = kTerms - 1; i >= order; --i) {
        differences[i] = (differences[i] - differences[i - 1]) / (points[i] - points[i - order]);
      }
    }
    std::array<double, kTerms> powers{};
    for (std::size_t i = kTerms; i-- > 0;) {  // powers · (t − point) + difference
      for (std::size_t k = kTerms - 1; k > 0; --k) powers[k] = powers[k - 1] - points[i] * powers[k];
      powers[0] = differences[i] - points[i] * powers[0];
    }
    for (std::size_t k = 0; k < kTerms; ++k) mantissa_[k] = static_cast<float>(powers[k]);
  }

  float y_;
  float mantissa_[kTerms] = {};
  std::array<int32_t, 16> low_{}, high_{};  // bits of 2^(i·y) and 2^((16·i − 127)·y)
};

}  // namespace halfspace::HS_LANES
