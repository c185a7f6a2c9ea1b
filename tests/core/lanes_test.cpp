// SPDX-License-Identifier: Apache-2.0
//
// Compares every operation of lanes.h at widths 4, 8 and 16, and of lane_pairs.h for pairs of these and of scalars, bit by bit with the
// same operation on scalars. The inputs are all pairs of special values (zeros, infinities, NaN, subnormals, ties, the limits of int32) and
// random bit patterns. A NaN result only has to be a NaN, because the sign and payload of a NaN produced by an operation are not specified.
#include "halfspace/core/lanes.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "halfspace/core/lane_bytes.h"
#include "halfspace/core/lane_pairs.h"
#include "halfspace/core/vec.h"
#include "support/constants.h"

namespace halfspace {
namespace {

constexpr float kMax = std::numeric_limits<float>::max();
constexpr int32_t kIntMin = std::numeric_limits<int32_t>::min(), kIntMax = std::numeric_limits<int32_t>::max();

const std::vector<float>& reals() {
  static const std::vector<float> values = [] {
    std::vector<float> v = {
        0.0f,        0.5f,       1.0f,       1.5f,          2.5f,          3.5f,          0x1p-149f, 0x1p-126f, 0x1.fffffcp-127f,
        0.49999997f, 8388607.5f, 8388609.0f, 2147483520.0f, 2147483648.0f, 4294967296.0f, kMax,      kInf,      kNaN};
    for (std::size_t i = 0, n = v.size(); i < n; ++i) v.push_back(-v[i]);
    std::mt19937 random(1);
    for (int i = 0; i < 60; ++i) v.push_back(as_real(static_cast<int32_t>(random())));
    return v;
  }();
  return values;
}
const std::vector<int32_t>& ints() {
  static const std::vector<int32_t> values = [] {
    std::vector<int32_t> v = {0, 1, -1, 2, 255, 65535, 65536, 16777217, kIntMax, kIntMin, kIntMin + 1, -65536};
    std::mt19937 random(2);
    for (int i = 0; i < 60; ++i) v.push_back(static_cast<int32_t>(random()));
    return v;
  }();
  return values;
}

bool same(float a, float b) { return (std::isnan(a) && std::isnan(b)) || as_int(a) == as_int(b); }
bool same(int32_t a, int32_t b) { return a == b; }
bool same(bool a, bool b) { return a == b; }

/// Fills the lanes of T with every step-th element of v, beginning at from and wrapping around.
template <class T, class V>
T pack(const std::vector<V>& v, std::size_t from, std::size_t step) {
  T r(0);
  for (std::size_t k = 0; k < sizeof(T) / sizeof(V); ++k) set_lane(r, static_cast<int>(k), v[(from + k * step) % v.size()]);
  return r;
}

/// Compares f(a, b, c) on lanes of type T with f applied to each lane separately, for all pairs (a, b) of the values and some c.
template <class T, class V, class F>
void expect_lanes_agree(const char* what, const std::vector<V>& v, F f) {
  constexpr std::size_t kWidth = sizeof(T) / sizeof(V);
  for (std::size_t i = 0; i < v.size(); ++i) {
    for (std::size_t j = 0; j < v.size(); j += kWidth) {
      const auto a = pack<T>(v, i, 1), b = pack<T>(v, j, 1), c = pack<T>(v, i + 3 * j, 5);
      const auto got = f(a, b, c);
      for (int k = 0; k < static_cast<int>(kWidth); ++k) {
        const auto want = f(lane(a, k), lane(b, k), lane(c, k));
        ASSERT_TRUE(same(lane(got, k), want)) << what << " with " << kWidth << " lanes: " << lane(a, k) << ", " << lane(b, k) << ", "
                                              << lane(c, k) << " returned " << lane(got, k) << ", expected " << want;
      }
    }
  }
}

/// Calls f.template operator()<R>() for every lane type R.
template <class F>
void for_all_lanes(F f) {
  f.template operator()<RealN<4>>();
  f.template operator()<RealN<8>>();
  f.template operator()<RealN<16>>();
  f.template operator()<RealPair<float>>();
  f.template operator()<RealPair<RealN<4>>>();
  f.template operator()<RealPair<RealN<8>>>();
  f.template operator()<RealPair<RealN<16>>>();
}
template <class F>
void check_real(const char* what, F f) {
  for_all_lanes([&]<class R>() { expect_lanes_agree<R>(what, reals(), f); });
}
template <class F>
void check_int(const char* what, F f) {
  for_all_lanes([&]<class R>() { expect_lanes_agree<IntOf<R>>(what, ints(), f); });
}

TEST(Lanes, ArithmeticMatchesFloat) {
  check_real("+", [](auto a, auto b, auto) { return a + b; });
  check_real("-", [](auto a, auto b, auto) { return a - b; });
  check_real("*", [](auto a, auto b, auto) { return a * b; });
  check_real("/", [](auto a, auto b, auto) { return a / b; });
  check_real("negation", [](auto, auto b, auto) { return -b; });
  check_real("+=", [](auto a, auto b, auto) { return a += b; });
  check_real("-=", [](auto a, auto b, auto) { return a -= b; });
  check_real("*=", [](auto a, auto b, auto) { return a *= b; });
  check_real("/=", [](auto a, auto b, auto) { return a /= b; });
  check_real("fma", [](auto a, auto b, auto c) { return fma(a, b, c); });
  check_real("sqrt", [](auto, auto b, auto) { return sqrt(b); });
  check_real("floor", [](auto, auto b, auto) { return floor(b); });
  check_real("round_even", [](auto, auto b, auto) { return round_even(b); });
  check_real("abs", [](auto, auto b, auto) { return abs(b); });
  check_real("min", [](auto a, auto b, auto) { return min(a, b); });
  check_real("max", [](auto a, auto b, auto) { return max(a, b); });
  check_real("clamp", [](auto a, auto b, auto c) { return clamp(a, b, c); });
  check_real("difference_of_products", [](auto a, auto b, auto c) { return difference_of_products(a, b, c, a); });
}

TEST(Lanes, IntegerArithmeticWraps) {
  // The scalar reference computes in unsigned, where wrapping is defined.
  const auto scalar = [](auto op) {
    return [op](auto a, auto b, auto) {
      if constexpr (std::is_same_v<decltype(a), int32_t>)
        return static_cast<int32_t>(op(static_cast<uint32_t>(a), static_cast<uint32_t>(b)));
      else
        return op(a, b);
    };
  };
  check_int("+", scalar([](auto a, auto b) { return a + b; }));
  check_int("-", scalar([](auto a, auto b) { return a - b; }));
  check_int("*", scalar([](auto a, auto b) { return a * b; }));
  check_int("negation", scalar([](auto, auto b) { return decltype(b)(0) - b; }));
  check_int("+=", scalar([](auto a, auto b) { return a += b; }));
  check_int("-=", scalar([](auto a, auto b) { return a -= b; }));
  check_int("&", [](auto a, auto b, auto) { return a & b; });
  check_int("|", [](auto a, auto b, auto) { return a | b; });
  check_int("^", [](auto a, auto b, auto) { return a ^ b; });
  check_int("~", [](auto, auto b, auto) { return ~b; });
  check_int("<< 7", [](auto, auto b, auto) { return b << 7; });
  check_int(">> 5", [](auto, auto b, auto) { return b >> 5; });
  check_int("min", [](auto a, auto b, auto) { return min(a, b); });
  check_int("max", [](auto a, auto b, auto) { return max(a, b); });
  EXPECT_EQ(lane(-IntN<8>(kIntMin), 3), kIntMin);
}

TEST(Lanes, ComparisonsAndSelectMatchScalars) {
  check_real("<", [](auto a, auto b, auto) { return a < b; });
  check_real("<=", [](auto a, auto b, auto) { return a <= b; });
  check_real(">", [](auto a, auto b, auto) { return a > b; });
  check_real(">=", [](auto a, auto b, auto) { return a >= b; });
  check_real("==", [](auto a, auto b, auto) { return a == b; });
  check_real("!=", [](auto a, auto b, auto) { return a != b; });
  check_real("select", [](auto a, auto b, auto c) { return select(a < b, b, c); });
  check_real("select scalar", [](auto a, auto b, auto c) { return select(a < b, 2.0f, c); });
  check_real("mask and, or", [](auto a, auto b, auto c) { return (a < b && b < c) || c < a; });
  check_int("<", [](auto a, auto b, auto) { return a < b; });
  check_int("<=", [](auto a, auto b, auto) { return a <= b; });
  check_int(">", [](auto a, auto b, auto) { return a > b; });
  check_int(">=", [](auto a, auto b, auto) { return a >= b; });
  check_int("==", [](auto a, auto b, auto) { return a == b; });
  check_int("!=", [](auto a, auto b, auto) { return a != b; });
  check_int("select", [](auto a, auto b, auto c) { return select(a < b, b, c); });
  check_int("select scalar", [](auto a, auto b, auto c) { return select(a < b, 7, c); });
  check_int("select mask", [](auto a, auto b, auto c) { return select(a < b, b < c, c < a); });
}

TEST(Lanes, ConversionsMatchScalarsForTiesNaNAndOverflow) {
  check_real("truncate_to_int", [](auto, auto b, auto) { return truncate_to_int(b); });
  check_real("round_to_int", [](auto, auto b, auto) { return round_to_int(b); });
  check_int("as_real", [](auto, auto b, auto) { return as_real(b); });
  check_real("as_int", [](auto, auto b, auto) { return as_int(b); });
  for_all_lanes([]<class R>() {
    expect_lanes_agree<IntOf<R>>("to_real", ints(), [](auto, auto b, auto) {
      return to_real<std::conditional_t<std::is_same_v<decltype(b), int32_t>, float, R>>(b);
    });
  });
  for (const float x : {kNaN, kInf, -kInf, 2147483648.0f, -2147483904.0f, 1e30f}) {
    EXPECT_EQ(truncate_to_int(x), kIntMin) << x;
    EXPECT_EQ(round_to_int(x), kIntMin) << x;
    EXPECT_EQ(round_to_int(static_cast<double>(x)), kIntMin) << x;
  }
  const float ties[] = {0.5f, 1.5f, 2.5f, -0.5f, -1.5f, -2.5f}, even[] = {0, 2, 2, 0, -2, -2};
  for (int i = 0; i < 6; ++i) {
    EXPECT_EQ(round_to_int(ties[i]), static_cast<int>(even[i]));
    EXPECT_EQ(round_even(ties[i]), even[i]);
  }
}

TEST(Lanes, MinAndMaxReturnTheSecondOperandForNaN) {
  for (const auto& [a, b] : {std::pair(kNaN, 1.0f), std::pair(1.0f, kNaN), std::pair(0.0f, -0.0f), std::pair(-0.0f, 0.0f)}) {
    EXPECT_TRUE(same(min(a, b), b));
    EXPECT_TRUE(same(max(a, b), b));
    EXPECT_TRUE(same(lane(min(RealN<16>(a), RealN<16>(b)), 9), b));
    EXPECT_TRUE(same(lane(max(RealN<16>(a), RealN<16>(b)), 9), b));
  }
  EXPECT_EQ(clamp(kNaN, 2.0f, 3.0f), 2.0f);
}

TEST(Lanes, BroadcastPreservesEveryBit) {
  for_all_lanes([]<class R>() {
    for (int k = 0; k < kWidthOf<R>; ++k) {
      for (const float x : reals()) EXPECT_TRUE(same(lane(R(x), k), x)) << x;
      for (const int32_t x : ints()) EXPECT_EQ(lane(IntOf<R>(x), k), x);
    }
    EXPECT_EQ(as_int(lane(R(-0.0f), kWidthOf<R> - 1)), kIntMin);  // including the sign of zero
  });
}

TEST(Lanes, GathersLoadsAndStoresAccessTheCorrectElements) {
  std::vector<float> table(1000);
  std::vector<int32_t> int_table(1000);
  for (std::size_t i = 0; i < 1000; ++i) {
    table[i] = static_cast<float>(i) * 0.25f;
    int_table[i] = static_cast<int32_t>(i * i);
  }
  std::array<int32_t, 16> small_table;
  for (std::size_t i = 0; i < 16; ++i) small_table[i] = static_cast<int32_t>(100 - i * i);
  for_all_lanes([&]<class R>() {
    using I = IntOf<R>;
    std::mt19937 random(kWidthOf<R>);
    for (int trial = 0; trial < 100; ++trial) {
      I index(0);
      for (int k = 0; k < kWidthOf<R>; ++k) set_lane(index, k, static_cast<int32_t>(random() % 500) - 250);
      const R r = gather(table.data() + 250, index);  // including negative indices
      const I n = gather(int_table.data() + 250, index);
      for (int k = 0; k < kWidthOf<R>; ++k) {
        EXPECT_EQ(lane(r, k), gather(table.data() + 250, lane(index, k)));
        EXPECT_EQ(lane(n, k), gather(int_table.data() + 250, lane(index, k)));
      }
    }
    for (int first = 0; first < 16; ++first) {
      I index(0);
      for (int k = 0; k < kWidthOf<R>; ++k) set_lane(index, k, (first + 5 * k) % 16);
      const I found = look_up(small_table, index);
      for (int k = 0; k < kWidthOf<R>; ++k) EXPECT_EQ(lane(found, k), look_up(small_table, lane(index, k)));
    }
    std::vector<float> memory = table;
    const R loaded = load<R>(memory.data() + 3);  // unaligned
    for (int k = 0; k < kWidthOf<R>; ++k) EXPECT_EQ(lane(loaded, k), memory[static_cast<std::size_t>(3 + k)]);
    store(memory.data() + 7, -loaded);
    for (int k = 0; k < kWidthOf<R>; ++k) EXPECT_EQ(memory[static_cast<std::size_t>(7 + k)], -lane(loaded, k));
  });
}

/// Returns the mask whose bits equal the bits of pattern.
template <class R>
MaskOf<R> mask_of(uint64_t pattern) {
  IntOf<R> number(0);
  for (int k = 0; k < kWidthOf<R>; ++k) set_lane(number, k, static_cast<int32_t>(pattern >> k & 1));
  return number == IntOf<R>(1);
}

template <class I>
void expect_bytes_are_converted() {
  constexpr int width = sizeof(I) / sizeof(int32_t);
  std::array<uint8_t, 17> bytes;  // one more than the maximum lane count, so that accesses can be unaligned
  for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<uint8_t>(255 - 13 * i);
  I values = load_u8<I>(&bytes[1]);
  std::array<uint8_t, 18> stored{};
  for (int i = 0; i < width; ++i) {
    EXPECT_EQ(lane(values, i), bytes[static_cast<std::size_t>(i) + 1]);
    set_lane(values, i, lane(values, i) + 0x1200);  // only the low byte is stored
  }
  store_u8(&stored[1], values);
  for (std::size_t i = 0; i < stored.size(); ++i) {
    const bool is_written = i >= 1 && i <= static_cast<std::size_t>(width);
    EXPECT_EQ(stored[i], is_written ? bytes[i] : 0) << i;
  }
}

TEST(Lanes, BytesAreConvertedToLanesAndBack) {
  expect_bytes_are_converted<int32_t>();
  expect_bytes_are_converted<IntN<4>>();
  expect_bytes_are_converted<IntN<8>>();
  expect_bytes_are_converted<IntN<16>>();
}

TEST(Lanes, MaskOperationsMatchBitOperations) {
  for_all_lanes([]<class R>() {
    using M = MaskOf<R>;
    constexpr uint64_t kPatterns = uint64_t{1} << kWidthOf<R>;
    constexpr uint64_t kStep = kPatterns > 65536 ? 999999 : kPatterns > 256 ? 7 : 1;
    EXPECT_EQ(kAllBits<M>, kPatterns - 1);
    EXPECT_TRUE(all(M(true)));
    EXPECT_TRUE(none(M(false)));
    for (uint64_t pattern = 0; pattern < kPatterns; pattern += kStep) {
      const M m = mask_of<R>(pattern);
      EXPECT_EQ(bits(m), pattern);
      EXPECT_EQ(any(m), pattern != 0);
      EXPECT_EQ(none(m), pattern == 0);
      EXPECT_EQ(all(m), pattern == kAllBits<M>);
      EXPECT_EQ(bits(!m), ~pattern & kAllBits<M>);
      EXPECT_EQ(bits(m ^ M(true)), bits(!m));
      M both = m, either = m;
      EXPECT_EQ(bits(both &= mask_of<R>(pattern >> 1)), pattern & pattern >> 1);
      EXPECT_EQ(bits(either |= mask_of<R>(pattern >> 1)), pattern | pattern >> 1);
      for (int k = 0; k < kWidthOf<R>; ++k) EXPECT_EQ(lane(m, k), (pattern >> k & 1) != 0);
    }
  });
}

TEST(Lanes, NegativeBitsAreTheSignBits) {
  const auto check = []<class I>(I values) {
    constexpr int width = static_cast<int>(sizeof(I) / sizeof(int32_t));
    for (std::size_t first = 0; first < ints().size(); ++first) {
      uint32_t expected = 0;
      for (int k = 0; k < width; ++k) {
        const int32_t value = ints()[(first + static_cast<std::size_t>(k)) % ints().size()];
        set_lane(values, k, value);
        expected |= (value < 0 ? 1u : 0u) << k;
      }
      EXPECT_EQ(negative_bits(values), expected);
    }
  };
  check(0);
  check(IntN<4>(0));
  check(IntN<8>(0));
  check(IntN<16>(0));
}

template <int W>
void expect_masks_of_lanes() {
  for (int k = 0; k < W; ++k) {
    const MaskN<W> m = iota<IntN<W>>() == IntN<W>(k);
    EXPECT_EQ(bits(m), 1u << k);
    for (int i = 0; i < W; ++i) EXPECT_EQ(lane(as_int(m), i), i == k ? -1 : 0);
  }
  for (int n = -1; n <= W + 1; ++n) EXPECT_EQ(bits(first_lanes<MaskN<W>>(n)), n <= 0 ? 0u : n >= W ? kAllBits<MaskN<W>> : (1u << n) - 1u);
}
TEST(Lanes, AreNumberedFromTheLowestBit) {
  expect_masks_of_lanes<4>();
  expect_masks_of_lanes<8>();
  expect_masks_of_lanes<16>();
}

TEST(Lanes, WidthOneIsScalar) {
  EXPECT_EQ(bits(true), 1u);
  EXPECT_TRUE(all(true) && any(true) && none(false));
  EXPECT_TRUE(first_lanes<bool>(1));
  EXPECT_FALSE(first_lanes<bool>(0));
  EXPECT_EQ(iota<int32_t>(), 0);
  static_assert(kWidthOf<float> == 1 && kWidthOf<double> == 1 && kWidthOf<RealN<8>> == 8 && kWidthOf<RealPair<RealN<8>>> == 16);
  static_assert(Number<float> && Number<double> && Number<RealN<4>> && Number<RealPair<float>> && !Number<int>);
}

TEST(Lanes, DifferenceOfProductsIsWithinErrorBound) {
  std::mt19937 random(5);
  std::uniform_real_distribution<float> unit(-1.0f, 1.0f);
  double worst = 0.0;
  for (int i = 0; i < 2000000; ++i) {
    float a = unit(random), b = unit(random), c = unit(random), d = unit(random);
    if (i % 2 == 0) {  // products that nearly cancel
      c = a * (1.0f + static_cast<float>(static_cast<int>(random() % 9) - 4) * 0x1p-23f);
      d = b * (1.0f + static_cast<float>(static_cast<int>(random() % 9) - 4) * 0x1p-23f);
    }
    const float got = difference_of_products(a, b, c, d);
    // Products of floats are exact in double, and their difference is rounded once, to a relative error of 2^-53.
    const double want = static_cast<double>(a) * static_cast<double>(b) - static_cast<double>(c) * static_cast<double>(d);
    if (want == 0.0) {
      ASSERT_EQ(got, 0.0f);
      continue;
    }
    const double ulp = std::ldexp(1.0, std::max(std::ilogb(want), -126) - 23);
    worst = std::max(worst, std::fabs(static_cast<double>(got) - want) / ulp);
  }
  EXPECT_LE(worst, 1.5);  // proven by Jeannerod, Louvet and Muller
  EXPECT_GE(worst, 1.0);  // the inputs come close to the bound; a plain a·b − c·d would have an error of millions of ulps
}

TEST(Vec, UniformsMixWithLanesAsWithFloat) {
  const glm::mat4 m(1.5f, 2.25f, -3.1f, 0.4f, 5.3f, 0.6f, 7.7f, -0.8f, 9.1f, 1.2f, 0.3f, 4.4f, 0.1f, 2.3f, 4.5f, 6.7f);
  const glm::vec4 v(0.3f, -1.7f, 2.9f, 1.1f);
  const glm::vec3 u(0.7f, 0.2f, -0.9f);
  for_all_lanes([&]<class R>() {
    const vec4<R> lanes(R(v.x), R(v.y), R(v.z), R(v.w));
    const vec3<R> three(R(v.x), R(v.y), R(v.z));
    const vec4<R> product = m * lanes;
    const vec3<R> turned = glm::mat3(m) * three;
    for (int c = 0; c < 4; ++c) EXPECT_EQ(as_int(lane(product[c], 1)), as_int((m * v)[c]));
    for (int c = 0; c < 3; ++c) EXPECT_EQ(as_int(lane(turned[c], 1)), as_int((glm::mat3(m) * glm::vec3(v))[c]));
    EXPECT_EQ(as_int(lane(dot(three, u), 1)), as_int(dot(vec3<float>(glm::vec3(v)), u)));
    EXPECT_EQ(as_int(lane(normalize(three).y, 1)), as_int(normalize(vec3<float>(glm::vec3(v))).y));
    const vec3<R> picked = select(MaskOf<R>(true), three, -three);
    EXPECT_EQ(lane(picked.z, 0), v.z);
  });
}

}  // namespace
}  // namespace halfspace
