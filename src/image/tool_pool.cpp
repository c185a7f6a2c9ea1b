// SPDX-License-Identifier: Apache-2.0
#include "halfspace/image/tool_pool.h"

#include <pthread.h>

#include <algorithm>
#include <cstdlib>
#include <memory>

#include "halfspace/core/parallel.h"

namespace halfspace::HS_LANES {

namespace {

constexpr int kMaxTools = 4;

struct Pools {
  ToolPool image, jpeg;
};

// Never destroyed: threads may still read images while the program exits. Tools that are in use then end when their channels are closed.
Pools& pools() {
  static Pools* const kPools = [] {
    Pools* made = new Pools;
    std::atexit([] {
      pools().image.stop_idle();
      pools().jpeg.stop_idle();
    });
    ::pthread_atfork([] { pools().image.lock(), pools().jpeg.lock(); }, [] { pools().image.unlock(), pools().jpeg.unlock(); },
                     [] { pools().image.abandon(), pools().jpeg.abandon(); });
    return made;
  }();
  return *kPools;
}

}  // namespace

ToolPool::ToolPool() : slots_(static_cast<std::size_t>(std::min(Workers::cores(), kMaxTools))) {}

std::size_t ToolPool::take() {
  std::unique_lock lock(mutex_);
  const auto is_free = [](const Slot& s) { return !s.lent; };
  given_back_.wait(lock, [&] { return std::ranges::any_of(slots_, is_free); });
  auto slot = std::ranges::find_if(slots_, [&](const Slot& s) { return is_free(s) && s.process.running(); });
  if (slot == slots_.end()) slot = std::ranges::find_if(slots_, is_free);
  slot->lent = true;
  return static_cast<std::size_t>(slot - slots_.begin());
}

void ToolPool::give_back(std::size_t slot, bool keep) {
  if (!keep) slots_[slot].process.stop();
  {
    const std::lock_guard lock(mutex_);
    slots_[slot].lent = false;
  }
  given_back_.notify_one();
}

void ToolPool::stop_idle() {
  const std::lock_guard lock(mutex_);
  for (Slot& s : slots_) {
    if (!s.lent) s.process.stop();
  }
}

void ToolPool::abandon() {
  // The locks may have been copied while other threads, which the child does not have, were waiting for them.
  std::construct_at(&mutex_);
  std::construct_at(&given_back_);
  for (Slot& s : slots_) {
    s.process.abandon();
    s.lent = false;
  }
}

ToolPool& image_tool_pool() { return pools().image; }
ToolPool& jpeg_tool_pool() { return pools().jpeg; }

}  // namespace halfspace::HS_LANES
