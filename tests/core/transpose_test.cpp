// SPDX-License-Identifier: Apache-2.0
#include "halfspace/core/transpose.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "halfspace/core/lane_pairs.h"

namespace halfspace {
namespace {

constexpr std::size_t kWords = 1000;

template <class I>
constexpr int kWidth = static_cast<int>(sizeof(I) / sizeof(int32_t));

// Returns random offsets. Records may overlap or coincide, and the last one ends at the end of the memory.
template <class I>
std::vector<std::size_t> places(std::mt19937& random) {
  std::vector<std::size_t> at(static_cast<std::size_t>(kWidth<I>));
  for (std::size_t& a : at) a = std::uniform_int_distribution<std::size_t>(0, kWords - 4)(random);
  at.back() = kWords - 4;
  if (at.size() > 2) at[1] = at[2];
  return at;
}

template <class I>
class Fours : public testing::Test {};
using Widths = testing::Types<int32_t, IntN<4>, IntN<8>, IntN<16>>;
TYPED_TEST_SUITE(Fours, Widths);

TYPED_TEST(Fours, AreReadFromAnywhere) {
  std::mt19937 random(1);
  std::vector<int32_t> memory(kWords);
  for (int32_t& m : memory) m = static_cast<int32_t>(random());
  for (int round = 0; round < 100; ++round) {
    const std::vector<std::size_t> at = places<TypeParam>(random);
    const auto words = load_aos4<TypeParam>([&](int k) { return &memory[at[static_cast<std::size_t>(k)]]; });
    for (std::size_t i = 0; i < 4; ++i) {
      for (int k = 0; k < kWidth<TypeParam>; ++k)
        ASSERT_EQ(lane(words[i], k), memory[at[static_cast<std::size_t>(k)] + i]) << i << ' ' << k;
    }
  }
}

TYPED_TEST(Fours, AreWrittenWhereTheyBelongAndNowhereElse) {
  std::mt19937 random(2);
  for (int round = 0; round < 100; ++round) {
    std::vector<std::size_t> at(kWords / 8);  // at least five words apart
    for (std::size_t i = 0; i < at.size(); ++i) at[i] = 8 * i + random() % 4;
    std::shuffle(at.begin(), at.end(), random);
    std::array<TypeParam, 4> words{};
    std::vector<int32_t> memory(kWords, -1), want = memory;
    for (std::size_t i = 0; i < 4; ++i) {
      for (int k = 0; k < kWidth<TypeParam>; ++k) {
        const auto value = static_cast<int32_t>(random() >> 1);
        set_lane(words[i], k, value);
        want[at[static_cast<std::size_t>(k)] + i] = value;
      }
    }
    store_aos4<TypeParam>(words, [&](int k) { return &memory[at[static_cast<std::size_t>(k)]]; });
    ASSERT_EQ(memory, want);
  }
}

TYPED_TEST(Fours, ThreesAreReadInOrder) {
  std::vector<int32_t> memory(1 + 3 * kWidth<TypeParam>);
  for (std::size_t i = 0; i < memory.size(); ++i) memory[i] = static_cast<int32_t>(100 + i);
  for (const int start : {0, 1}) {  // aligned where possible, and unaligned
    const auto words = load_aos3<TypeParam>(memory.data() + start);
    for (int i = 0; i < 3; ++i) {
      for (int k = 0; k < kWidth<TypeParam>; ++k)
        EXPECT_EQ(lane(words[static_cast<std::size_t>(i)], k), 100 + start + 3 * k + i) << i << ' ' << k;
    }
  }
}

// Compares gather_row of N adjacent words with individual reads, at random offsets and at the last offset from which four words can be
// read.
template <int N, class I, class Word>
void expect_rows(const std::vector<Word>& memory, const std::vector<std::size_t>& at) {
  I i(0);  // GCC 12 warns wrongly about I i{} for 4 lanes
  for (int k = 0; k < kWidth<I>; ++k) set_lane(i, k, static_cast<int32_t>(at[static_cast<std::size_t>(k)]));
  const auto row = gather_row<N>(memory.data(), i);
  static_assert(std::tuple_size_v<decltype(row)> == N);
  for (std::size_t n = 0; n < N; ++n) {
    for (int k = 0; k < kWidth<I>; ++k)
      ASSERT_EQ(lane(row[n], k), memory[at[static_cast<std::size_t>(k)] + n]) << N << ' ' << n << ' ' << k;
  }
}

template <class I>
class Rows : public testing::Test {};
using WidthsAndPairs =
    testing::Types<int32_t, IntN<4>, IntN<8>, IntN<16>, IntPair<float>, IntPair<RealN<4>>, IntPair<RealN<8>>, IntPair<RealN<16>>>;
TYPED_TEST_SUITE(Rows, WidthsAndPairs);

TYPED_TEST(Rows, AreGathered) {
  std::mt19937 random(3);
  std::vector<int32_t> words(kWords);
  std::vector<float> numbers(kWords);
  for (std::size_t i = 0; i < kWords; ++i) {
    words[i] = static_cast<int32_t>(random());
    numbers[i] = static_cast<float>(words[i]);
  }
  for (int round = 0; round < 100; ++round) {
    const std::vector<std::size_t> at = places<TypeParam>(random);
    expect_rows<1, TypeParam>(words, at);
    expect_rows<2, TypeParam>(words, at);
    expect_rows<3, TypeParam>(words, at);
    expect_rows<4, TypeParam>(words, at);
    expect_rows<3, TypeParam>(numbers, at);
  }
}

}  // namespace
}  // namespace halfspace
