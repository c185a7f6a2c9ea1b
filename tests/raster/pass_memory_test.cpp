// SPDX-License-Identifier: Apache-2.0
#include "halfspace/raster/pipeline/pass_memory.h"

#include <gtest/gtest.h>

#include <memory>
#include <utility>
#include <vector>

namespace halfspace {
namespace {

// Discards the lists that earlier passes of this process have returned.
void forget_draws() {
  while (take_draw_list().capacity() != 0) {
  }
}

struct Holder {
  std::shared_ptr<const int> stored;
};

// Returns a draw whose shader, stored on the heap, owns an object.
Draw draw_of(std::shared_ptr<const int> stored) {
  static constexpr ShaderKernels kNone;
  return {kNone, {new Holder{std::move(stored)}, [](const void* kept) { delete static_cast<const Holder*>(kept); }}, nullptr, {}, {}};
}

TEST(PassMemory, DrawListsAreRecycledEmptyWithTheirCapacity) {
  forget_draws();
  std::vector<Draw> draws;
  draws.reserve(100);
  draws.push_back(draw_of(std::make_shared<const int>(1)));
  const Draw* const place = draws.data();
  return_draw_list(std::move(draws));
  const std::vector<Draw> again = take_draw_list();
  EXPECT_TRUE(again.empty());
  EXPECT_GE(again.capacity(), 100u);
  EXPECT_EQ(again.data(), place);
  EXPECT_EQ(take_draw_list().capacity(), 0u);
}

TEST(PassMemory, ExcessivelyLargeListsAreNotKept) {
  forget_draws();
  std::vector<Draw> draws;
  draws.reserve((std::size_t{257} << 20) / sizeof(Draw));
  return_draw_list(std::move(draws));
  EXPECT_EQ(take_draw_list().capacity(), 0u);
}

TEST(PassMemory, ReturningAListDestroysItsShaders) {
  const auto shader = std::make_shared<const int>(1);
  std::vector<Draw> draws;
  draws.push_back(draw_of(shader));
  EXPECT_EQ(shader.use_count(), 2);
  return_draw_list(std::move(draws));
  EXPECT_EQ(shader.use_count(), 1);
}

}  // namespace
}  // namespace halfspace
