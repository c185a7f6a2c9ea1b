// SPDX-License-Identifier: Apache-2.0
//
// Compares random states drawn by the tile path with the oracle. A failure prints the command that draws only the shrunk state:
//
//   HALFSPACE_STATE=1234:8f03 build/release/bin/test-conformance --gtest_filter=ConformanceRandomState.ReplaysTheGivenState
#include <gtest/gtest.h>

#include <cstdlib>

#include "conformance/random_state.h"

namespace halfspace::conformance {

namespace {

std::string what_is_wrong(const Picture& p) {
  const std::string wrong = difference_from_oracle(p);
  return wrong.empty() ? wrong : wrong + describe(p);
}

}  // namespace

class RandomStates : public testing::TestWithParam<uint64_t> {};

TEST_P(RandomStates, MatchTheOracle) {
  uint64_t seen = 0;
  for (uint64_t i = 0; i < kStatesPerSet; ++i) {
    const RandomState state{GetParam() * kStatesPerSet + i, 0};
    const Picture picture = random_picture(state);
    if (difference_from_oracle(picture).empty()) {
      seen += !draw(picture).is_constant();
      continue;
    }
    const RandomState shrunk = shrink(state, [](const Picture& p) { return !difference_from_oracle(p).empty(); });
    FAIL() << "seed " << state.seed << ", shrunk: HALFSPACE_STATE=" << shrunk.text()
           << " build/release/bin/test-conformance --gtest_filter=ConformanceRandomState.ReplaysTheGivenState\n"
           << what_is_wrong(random_picture(shrunk));
  }
  RecordProperty("not_constant", std::to_string(seen));
  EXPECT_GE(seen * 10, kStatesPerSet * 8) << "too many states give a constant picture";
}

INSTANTIATE_TEST_SUITE_P(Conformance, RandomStates, testing::Range(uint64_t{0}, kRandomSets),
                         [](const auto& set) { return "seeds_from_" + std::to_string(set.param * kStatesPerSet); });

TEST(ConformanceRandomState, ReplaysTheGivenState) {
  const char* text = std::getenv("HALFSPACE_STATE");
  if (text == nullptr) GTEST_SKIP() << "HALFSPACE_STATE is not set";
  RandomState state;
  ASSERT_TRUE(RandomState::parse(text, state)) << "HALFSPACE_STATE=" << text << " is not a valid state; expected SEED or SEED:BITS";
  const Picture picture = random_picture(state);
  std::printf("%s", describe(picture).c_str());
  EXPECT_EQ(what_is_wrong(picture), "");
}

// Uses an artificial failure: blending with the equation `subtract`. The shrunk state must still contain it and nothing unnecessary, and
// its text must reproduce it.
TEST(ConformanceRandomState, ShrinksToAMinimalFailure) {
  const auto subtracts = [](const Picture& p) {
    for (const Drawing& d : p.draws) {
      if (d.state.blend && d.state.blend->color_equation == BlendEquation::subtract) return true;
    }
    return false;
  };
  int failures = 0;
  for (uint64_t seed = 0; seed < 100; ++seed) {
    if (!subtracts(random_picture({seed, 0}))) continue;
    ++failures;
    const RandomState shrunk = shrink({seed, 0}, subtracts);
    RandomState again;
    ASSERT_TRUE(RandomState::parse(shrunk.text(), again));
    const Picture p = random_picture(again);
    EXPECT_TRUE(subtracts(p));
    EXPECT_EQ(p.draws.size(), 1u);
    EXPECT_EQ(p.samples, 1);
    const DrawState& s = p.draws[0].state;
    EXPECT_FALSE(s.stencil || s.scissor || s.viewport || s.query);
    EXPECT_LE(p.draws[0].indices.size(), 8u);  // of up to 20
  }
  EXPECT_GT(failures, 5);
}

}  // namespace halfspace::conformance
