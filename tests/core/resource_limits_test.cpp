// SPDX-License-Identifier: Apache-2.0
#include "halfspace/core/resource_limits.h"

#include <gtest/gtest.h>

#include <vector>

#include "support/errors.h"

namespace halfspace {
namespace {

constexpr uint64_t kMebibyte = uint64_t{1} << 20;

class ResourceLimitsTest : public testing::Test {
 protected:
  ~ResourceLimitsTest() override { set_resource_limits({}); }

  // Allows `bytes` in addition to the memory in use.
  static void permit(uint64_t bytes) {
    ResourceLimits limits{.max_memory = uint64_t{1} << 50, .counts_resident = true};
    set_resource_limits(limits);
    limits.max_memory -= memory_left() - bytes;
    set_resource_limits(limits);
  }
};

TEST_F(ResourceLimitsTest, DefaultIsAtMostEightGibibytes) {
  EXPECT_GT(ResourceLimits{}.max_memory, 64 * kMebibyte);
  EXPECT_LE(ResourceLimits{}.max_memory, 8192 * kMebibyte);
  EXPECT_EQ(resource_limits().max_memory, ResourceLimits{}.max_memory);
}

TEST_F(ResourceLimitsTest, ClaimsAddUpAndAreReleased) {
  permit(64 * kMebibyte);
  {
    const MemoryClaim first(40 * kMebibyte, "a");
    EXPECT_TRUE(reports(message_of<LimitError>([] { const MemoryClaim second(40 * kMebibyte, "b.png"); }),
                        "b.png: ", {"40 MiB", "expected at most", "--max-memory"}));
  }
  EXPECT_NO_THROW(MemoryClaim(40 * kMebibyte, "b.png"));
}

TEST_F(ResourceLimitsTest, CountsMemoryThatIsInUse) {
  permit(256 * kMebibyte);
  const uint64_t before = memory_left();
  const std::vector<char> used(128 * kMebibyte, 1);
  const char* volatile kept = used.data();  // clang would leave out memory that nothing refers to
  EXPECT_LT(memory_left(), before - 100 * kMebibyte) << int{kept[5]};
}

TEST_F(ResourceLimitsTest, TheHostProgramMayUseMoreThanTheLimit) {
  set_resource_limits({.max_memory = 64 * kMebibyte});
  const std::vector<char> used(128 * kMebibyte, 1);
  const char* volatile kept = used.data();  // clang would leave out memory that nothing refers to
  EXPECT_EQ(memory_left(), 64 * kMebibyte) << int{kept[5]};
  EXPECT_NO_THROW(MemoryClaim(40 * kMebibyte, "a.png"));
  EXPECT_THROW(MemoryClaim(65 * kMebibyte, "a.png"), LimitError);
}

TEST_F(ResourceLimitsTest, PixelsAreCountedWithoutOverflow) {
  ResourceLimits limits;
  limits.max_pixels = 1000;
  set_resource_limits(limits);
  EXPECT_NO_THROW(check_pixel_limit(100, 10, "a.png"));
  EXPECT_TRUE(reports(message_of<LimitError>([] { check_pixel_limit(1001, 1, "a.png"); }), "a.png: 1001x1 pixels",
                      {"at most 1000", "--max-pixels"}));
  EXPECT_THROW(check_pixel_limit(uint64_t{1} << 33, uint64_t{1} << 33, "a.png"), LimitError);
}

}  // namespace
}  // namespace halfspace
