// SPDX-License-Identifier: Apache-2.0
//
// Assets that all scenes of the process share, for example the studio environment. Only assets that are made from numbers can be shared,
// because a file may change.
#pragma once

#include <cstddef>
#include <list>
#include <memory>
#include <mutex>
#include <string>

#include "halfspace/core/namespace.h"

namespace halfspace::HS_LANES {

/// Keeps the assets that were used last. Thread-safe. No lock is held while an asset is made: threads that need the same asset at the same
/// time may all make it, and then share one of the results.
class SharedAssets {
 public:
  static constexpr std::size_t kMaxBytes = std::size_t{32} << 20;

  /// Returns the assets of this process. They can be used in a child process after fork().
  static SharedAssets& of_process();

  /// Returns the asset with this recipe (asset_cache.h), which is made by make() if it does not exist. bytes(asset) is its size in memory.
  /// An asset larger than kMaxBytes is not kept.
  template <class T, class Make, class Bytes>
  std::shared_ptr<const T> get(const std::string& recipe, const Make& make, const Bytes& bytes) {
    if (const auto found = find(recipe)) return std::static_pointer_cast<const T>(found);
    const auto made = std::make_shared<const T>(make());
    return std::static_pointer_cast<const T>(add({recipe, made, bytes(*made)}));
  }

 private:
  struct Entry {
    std::string recipe;
    std::shared_ptr<const void> asset;
    std::size_t bytes;
  };

  // Returns null if there is no such asset.
  std::shared_ptr<const void> find(const std::string& recipe);
  // Returns the asset that another thread has added with the same recipe, or adds this one. Removes those that have not been used for the
  // longest time if there is too little space.
  std::shared_ptr<const void> add(Entry entry);
  std::list<Entry>::iterator place_of(const std::string& recipe);

  std::mutex mutex_;
  std::list<Entry> entries_;  // the one that was used last is first
  std::size_t bytes_ = 0;
};

}  // namespace halfspace::HS_LANES
