// SPDX-License-Identifier: Apache-2.0
#include "halfspace/render/assets/shared_assets.h"

#include <pthread.h>

#include <algorithm>
#include <new>
#include <utility>

namespace halfspace::HS_LANES {

SharedAssets& SharedAssets::of_process() {
  static auto* const kAssets = new SharedAssets;  // never destroyed, because threads may still use it while the process exits
  // A child process must not inherit a mutex that another thread holds.
  static const int kError =
      ::pthread_atfork([] { kAssets->mutex_.lock(); }, [] { kAssets->mutex_.unlock(); }, [] { kAssets->mutex_.unlock(); });
  if (kError != 0) throw std::bad_alloc();
  return *kAssets;
}

std::list<SharedAssets::Entry>::iterator SharedAssets::place_of(const std::string& recipe) {
  return std::ranges::find(entries_, recipe, &Entry::recipe);
}

std::shared_ptr<const void> SharedAssets::find(const std::string& recipe) {
  const std::lock_guard lock(mutex_);
  const auto place = place_of(recipe);
  if (place == entries_.end()) return nullptr;
  entries_.splice(entries_.begin(), entries_, place);
  return place->asset;
}

std::shared_ptr<const void> SharedAssets::add(Entry entry) {
  const std::lock_guard lock(mutex_);
  if (const auto place = place_of(entry.recipe); place != entries_.end()) return place->asset;
  std::shared_ptr<const void> asset = entry.asset;
  bytes_ += entry.bytes;
  entries_.push_front(std::move(entry));
  if (entries_.front().bytes > kMaxBytes) {
    bytes_ -= entries_.front().bytes;
    entries_.pop_front();
  }
  while (bytes_ > kMaxBytes) {
    bytes_ -= entries_.back().bytes;
    entries_.pop_back();
  }
  return asset;
}

}  // namespace halfspace::HS_LANES
