// SPDX-License-Identifier: Apache-2.0
#include "halfspace/raster/pipeline/pass_memory.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

namespace halfspace {
namespace {

// Discards the lists that earlier passes of this process have returned.
void forget_draws() {
  while (take_draw_list().draws.capacity() != 0) {
  }
}

struct Holder {
  std::shared_ptr<const int> stored;
};

// Returns a draw whose shader, stored on the heap, owns an object.
Draw draw_of(std::shared_ptr<const int> stored) {
  static constexpr ShaderKernels kNone;
  static constexpr DrawState kState;
  return {kNone, {new Holder{std::move(stored)}, [](const void* kept) { delete static_cast<const Holder*>(kept); }}, nullptr, {}, kState,
          {}};
}

TEST(PassMemory, DrawListsAreRecycledEmptyWithTheirMemory) {
  forget_draws();
  DrawList list = take_draw_list();
  list.draws.reserve(100);
  list.draws.push_back(draw_of(std::make_shared<const int>(1)));
  const void* const in_arena = list.arena->allocate(100);
  const Draw* const place = list.draws.data();
  return_draw_list(std::move(list));
  const DrawList again = take_draw_list();
  EXPECT_TRUE(again.draws.empty());
  EXPECT_GE(again.draws.capacity(), 100u);
  EXPECT_EQ(again.draws.data(), place);
  EXPECT_EQ(again.arena->allocate(100), in_arena);
  EXPECT_EQ(take_draw_list().draws.capacity(), 0u);
}

TEST(PassMemory, ExcessivelyLargeListsAreNotKept) {
  forget_draws();
  DrawList list = take_draw_list();
  list.draws.reserve((std::size_t{513} << 20) / sizeof(Draw));
  return_draw_list(std::move(list));
  EXPECT_EQ(take_draw_list().draws.capacity(), 0u);
}

TEST(PassMemory, AnExcessivelyLargeArenaIsNotKept) {
  forget_draws();
  DrawList list = take_draw_list();
  list.draws.reserve(1);
  EXPECT_NE(list.arena->allocate(std::size_t{513} << 20), nullptr);
  return_draw_list(std::move(list));
  EXPECT_EQ(take_draw_list().draws.capacity(), 0u);
}

TEST(PassMemory, ReturningAListDestroysItsShaders) {
  const auto shader = std::make_shared<const int>(1);
  DrawList list = take_draw_list();
  list.draws.push_back(draw_of(shader));
  EXPECT_EQ(shader.use_count(), 2);
  return_draw_list(std::move(list));
  EXPECT_EQ(shader.use_count(), 1);
}

// Returns memory with one chunk that has reserved that many bytes, without touching them.
PassMemory memory_of(std::size_t bytes) {
  PassMemory memory;
  memory.chunks.emplace_back().triangles.reserve(bytes / sizeof(Triangle));
  return memory;
}

constexpr std::size_t kMegabyte = std::size_t{1} << 20;

void forget_pass_memory() {
  while (!take_pass_memory().chunks.empty()) {
  }
}

TEST(PassMemory, TheMemoryThatWasReturnedFirstIsFreedFirst) {
  forget_draws();
  forget_pass_memory();
  return_pass_memory(memory_of(10 * kMegabyte));
  return_pass_memory(memory_of(400 * kMegabyte));
  PassMemory last = memory_of(300 * kMegabyte);
  const Triangle* const place = last.chunks[0].triangles.data();
  return_pass_memory(std::move(last));
  const PassMemory kept = take_pass_memory();
  ASSERT_EQ(kept.chunks.size(), 1u);
  EXPECT_EQ(kept.chunks[0].triangles.data(), place);
  EXPECT_TRUE(take_pass_memory().chunks.empty());  // the oldest was freed before the large one
}

TEST(PassMemory, MemoryThatExceedsTheLimitByItselfFreesNothingElse) {
  forget_draws();
  forget_pass_memory();
  PassMemory small = memory_of(10 * kMegabyte);
  const Triangle* const place = small.chunks[0].triangles.data();
  return_pass_memory(std::move(small));
  return_pass_memory(memory_of(513 * kMegabyte));
  const PassMemory kept = take_pass_memory();
  ASSERT_EQ(kept.chunks.size(), 1u);
  EXPECT_EQ(kept.chunks[0].triangles.data(), place);
}

TEST(PassMemory, ADrawListIsKeptWhenThePoolIsFullOfPassMemory) {
  forget_draws();
  forget_pass_memory();
  return_pass_memory(memory_of(511 * kMegabyte));
  DrawList list = take_draw_list();
  list.draws.reserve(2 * kMegabyte / sizeof(Draw));
  const Draw* const place = list.draws.data();
  return_draw_list(std::move(list));
  EXPECT_EQ(take_draw_list().draws.data(), place);
  EXPECT_TRUE(take_pass_memory().chunks.empty());
}

TEST(DrawArena, AllocatesAlignedMemoryThatDoesNotOverlap) {
  DrawArena arena;
  std::byte* end = nullptr;
  for (const std::size_t bytes : {1u, 8u, 64u, 3u, 100u}) {
    const auto at = static_cast<std::byte*>(arena.allocate(bytes, 64));
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(at) % 64, 0u);
    EXPECT_GE(at, end);  // all are in the first block
    end = at + bytes;
  }
}

TEST(DrawArena, UsesTheSameBlocksAfterAReset) {
  DrawArena arena;
  const auto fill = [&] {
    std::vector<const void*> at;
    for (int i = 0; i < 100; ++i) at.push_back(arena.allocate(3000, 8));
    at.push_back(arena.allocate(200000, 8));  // larger than a block
    return at;
  };
  const std::vector<const void*> first = fill();
  const std::size_t bytes = arena.bytes();
  arena.reset();
  EXPECT_EQ(fill(), first);
  EXPECT_EQ(arena.bytes(), bytes);
}

}  // namespace
}  // namespace halfspace
