// SPDX-License-Identifier: Apache-2.0
//
// Compares the operators of unsigned lanes, and the divisions and variable shifts of signed ones, with the operators of uint32_t and
// int32_t.
#include "halfspace/core/lane_uint.h"

#include "core/glsl_lanes.h"

namespace halfspace {
namespace {

const std::vector<uint32_t>& uint_values() {
  static const std::vector<uint32_t> values = [] {
    std::vector<uint32_t> v = {0, 1, 2, 3, 7, 31, 32, 33, 255, 65535, 65536, 0x7fffffff, 0x80000000, 0x80000001, 0xfffffffe, 0xffffffff};
    std::mt19937 random(5);
    for (int i = 0; i < 40; ++i) v.push_back(static_cast<uint32_t>(random()) >> (random() % 32));
    return v;
  }();
  return values;
}

/// Calls check(lanes a, lanes b, k, a of lane k, b of lane k) for all pairs of values.
template <class R, class F>
void for_all_pairs_in(F check) {
  constexpr int W = kWidthOf<R>;
  for (const uint32_t first : uint_values()) {
    for (std::size_t j = 0; j < uint_values().size(); j += W) {
      UintOf<R> a(0), b(0);
      for (int k = 0; k < W; ++k) {
        set_lane(a, k, first + static_cast<uint32_t>(k) * (first & 2));
        set_lane(b, k, uint_values()[(j + static_cast<std::size_t>(k)) % uint_values().size()]);
      }
      for (int k = 0; k < W; ++k) check(a, b, k, lane(a, k), lane(b, k));
    }
  }
}
template <class F>
void for_all_pairs(F check) {
  for_all_pairs_in<RealN<4>>(check);
  for_all_pairs_in<RealN<8>>(check);
  for_all_pairs_in<RealN<16>>(check);
  for_all_pairs_in<RealPair<float>>(check);
  for_all_pairs_in<RealPair<RealN<16>>>(check);
}

TEST(LaneUint, OperatorsMatchUint32) {
  for_all_pairs([](auto a, auto b, int k, uint32_t x, uint32_t y) {
    using U = decltype(a);
    ASSERT_EQ(lane(a + b, k), x + y);
    ASSERT_EQ(lane(a - b, k), x - y);
    ASSERT_EQ(lane(a * b, k), x * y);
    ASSERT_EQ(lane(-a, k), 0 - x);
    ASSERT_EQ(lane(a / b, k), y == 0 ? 0xffffffffu : x / y) << x << '/' << y;
    ASSERT_EQ(lane(a % b, k), y == 0 ? x : x % y) << x << '%' << y;
    ASSERT_EQ(lane(a & b, k), x & y);
    ASSERT_EQ(lane(a | b, k), x | y);
    ASSERT_EQ(lane(a ^ b, k), x ^ y);
    ASSERT_EQ(lane(~a, k), ~x);
    ASSERT_EQ(lane(a << 7, k), x << 7);
    ASSERT_EQ(lane(a >> 7, k), x >> 7);
    ASSERT_EQ(lane(a << b, k), x << (y & 31));
    ASSERT_EQ(lane(a >> b, k), x >> (y & 31));
    ASSERT_EQ(lane(a >> SignedOf<U>(b), k), x >> (y & 31));
    ASSERT_EQ(lane(a < b, k), x < y);
    ASSERT_EQ(lane(a <= b, k), x <= y);
    ASSERT_EQ(lane(a > b, k), x > y);
    ASSERT_EQ(lane(a >= b, k), x >= y);
    ASSERT_EQ(lane(a == b, k), x == y);
    ASSERT_EQ(lane(a != b, k), x != y);
    ASSERT_EQ(lane(min(a, b), k), min(x, y));
    ASSERT_EQ(lane(max(a, b), k), max(x, y));
    ASSERT_EQ(lane(select(a < b, a, b), k), select(x < y, x, y));
    U c = a;
    c *= b, c += 3u, c -= a, c |= 5u, c ^= b, c &= 0xffff00ffu, c <<= 3, c >>= b, c /= 3u, c %= 1000u;
    uint32_t z = x;
    z *= y, z += 3u, z -= x, z |= 5u, z ^= y, z &= 0xffff00ffu, z <<= 3, z >>= y & 31, z /= 3u, z %= 1000u;
    ASSERT_EQ(lane(c, k), z);
  });
}

TEST(LaneUint, SignedDivisionAndShiftsMatchInt32) {
  for_all_pairs([](auto a, auto b, int k, uint32_t x, uint32_t y) {
    using I = SignedOf<decltype(a)>;
    const I i(a), j(b);
    const int64_t p = static_cast<int32_t>(x), q = static_cast<int32_t>(y);  // 64 bits, where INT32_MIN / −1 does not overflow
    ASSERT_EQ(lane(i / j, k), q == 0 ? -1 : static_cast<int32_t>(p / q)) << p << '/' << q;
    ASSERT_EQ(lane(i % j, k), q == 0 ? p : p % q) << p << '%' << q;
    ASSERT_EQ(int_divide(lane(i, k), lane(j, k)), lane(i / j, k));
    ASSERT_EQ(int_modulo(lane(i, k), lane(j, k)), lane(i % j, k));
    ASSERT_EQ(lane(i << j, k), static_cast<int32_t>(x << (y & 31)));
    ASSERT_EQ(lane(i >> j, k), static_cast<int32_t>(x) >> (y & 31));
    ASSERT_EQ(lane(i >> b, k), static_cast<int32_t>(x) >> (y & 31));
    ASSERT_EQ(lane(decltype(a)(i), k), x);
  });
}

/// Shifts by a count that the compiler does not know.
template <class R>
void expect_counts_modulo_32() {
  using I = IntOf<R>;
  volatile int counts[] = {0, 1, 31, 32, 33, 63, -1};
  for (const volatile int& count : counts) {
    const int n = count;
    const I left = I(-123456789) << n, right = I(-123456789) >> n;
    const UintOf<R> left_uint = UintOf<R>(0x87654321u) << n, right_uint = UintOf<R>(0x87654321u) >> n;
    for (int k = 0; k < kWidthOf<R>; ++k) {
      EXPECT_EQ(lane(left, k), static_cast<int32_t>(static_cast<uint32_t>(-123456789) << (n & 31))) << n;
      EXPECT_EQ(lane(right, k), -123456789 >> (n & 31)) << n;
      EXPECT_EQ(lane(left_uint, k), 0x87654321u << (n & 31)) << n;
      EXPECT_EQ(lane(right_uint, k), 0x87654321u >> (n & 31)) << n;
    }
  }
}
TEST(LaneUint, OfShiftCountsTheLowFiveBitsCount) {
  expect_counts_modulo_32<RealN<4>>();
  expect_counts_modulo_32<RealN<8>>();
  expect_counts_modulo_32<RealN<16>>();
  expect_counts_modulo_32<RealPair<RealN<4>>>();
  expect_counts_modulo_32<RealPair<RealN<16>>>();
  expect_counts_modulo_32<RealPair<float>>();
}

TEST(LaneUint, ScalarDivisionAcceptsEveryDivisor) {
  EXPECT_EQ(int_divide(7u, 0u), 0xffffffffu);
  EXPECT_EQ(int_modulo(7u, 0u), 7u);
  EXPECT_EQ(int_divide(7u, 2u), 3u);
  EXPECT_EQ(int_modulo(7u, 4u), 3u);
  EXPECT_EQ(int_divide(-7, 2), -3);
  EXPECT_EQ(int_modulo(-7, 2), -1);
}

TEST(LaneUint, ConversionsRoundToNearestAndTruncate) {
  for (const uint32_t x : uint_values()) {
    EXPECT_EQ(to_real<float>(x), static_cast<float>(x));
    EXPECT_EQ(lane(to_real<RealN<8>>(UintOf<RealN<8>>(x)), 5), static_cast<float>(x));
  }
  std::mt19937 random(6);
  for (int i = 0; i < 100000; ++i) {
    const auto x = static_cast<uint32_t>(random());
    ASSERT_EQ(lane(to_real<RealN<16>>(UintOf<RealN<16>>(x)), 11), static_cast<float>(x));
  }
  const auto check = [](float x, uint32_t want) {
    EXPECT_EQ(truncate_to_uint(x), want) << x;
    EXPECT_EQ(lane(truncate_to_uint(RealN<4>(x)), 2), want) << x;
    EXPECT_EQ(lane(truncate_to_uint(RealPair<RealN<16>>(x)), 20), want) << x;
  };
  for (const float x : {kNaN, -kInf, -1.0f, -0.5f, -0.0f, 0.0f, 0.99f}) check(x, 0);
  check(1.99f, 1);
  check(2147483520.0f, 2147483520u);
  check(2147483648.0f, 2147483648u);
  check(4294967040.0f, 4294967040u);
  check(4294967296.0f, 0xffffffffu);
  check(kInf, 0xffffffffu);
}

TEST(DiscreteVec, OperatorsMatchScalarsLaneByLane) {
  expect_glsl_lanes_match_scalars([](const auto& a, auto& out) {
    const auto i = a.i3(0), j = a.i3(3);
    const auto u = a.u3(0), w = a.u3(3);
    out.add(i + j), out.add(i - j), out.add(i * j), out.add(i / j), out.add(i % j), out.add(-i), out.add(~i);
    out.add(i & j), out.add(i | j), out.add(i ^ j), out.add(i << j), out.add(i >> j), out.add(i == j), out.add(i != j);
    out.add(u + w), out.add(u - w), out.add(u * w), out.add(u / w), out.add(u % w), out.add(-u), out.add(~u);
    out.add(u & w), out.add(u | w), out.add(u ^ w), out.add(u << w), out.add(u >> i), out.add(u == w), out.add(u != w);
    out.add(i + 3), out.add(7 - i), out.add(a.i[6] * j), out.add(u / 5u), out.add(u % a.u(7)), out.add(u >> 3), out.add(i << a.i[5]);
    auto c = i;
    c += j, c -= 2, c *= j, c /= j, c %= 77, c &= 0xffff, c |= 1, c ^= i, c <<= 2, c >>= j;
    out.add(c);
    using R = std::decay_t<decltype(a.x[0])>;
    out.add(ivec3<R>(a.v3(0))), out.add(uvec3<R>(a.v3(3))), out.add(uvec3<R>(i)), out.add(ivec3<R>(u));
    out.add(ivec3<R>(bvec3<R>(i))), out.add(bvec3<R>(u)), out.add(to_real<R>(i)), out.add(to_real<R>(u));
    out.add(select(a.x[0] < a.x[1], i, j)), out.add(not(bvec3<R>(i)));
  });
}

TEST(DiscreteVec, ScalarsAreDefinedForEveryOperand) {
  constexpr int32_t kMin = std::numeric_limits<int32_t>::min();
  using I2 = ivec2<float>;
  EXPECT_TRUE(I2(kMin, 5) / I2(-1, 0) == I2(kMin, -1));
  EXPECT_TRUE(I2(kMin, 5) % I2(-1, 0) == I2(0, 5));
  EXPECT_TRUE(I2(kMin, 1) - I2(1, 2) == I2(0x7fffffff, -1));
  EXPECT_TRUE((I2(1, 2) << 33) == I2(2, 4));
  EXPECT_TRUE(I2(1, 2) != I2(1, 3));
  const ivec4<float> four(I2(1, 2), 3, 4);
  EXPECT_EQ(four[0] + 10 * four[1] + 100 * four[2] + 1000 * four[3], 4321);
  EXPECT_EQ(lane(ivec4<RealN<4>>(ivec3<RealN<4>>(ivec2<RealN<4>>(1, 2), 3), 4).w, 1), 4);
}

}  // namespace
}  // namespace halfspace
