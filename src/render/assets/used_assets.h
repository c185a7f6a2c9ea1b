// SPDX-License-Identifier: Apache-2.0
//
// Provides the assets that a prepared scene uses, from the cache or newly created.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "halfspace/core/resource_limits.h"
#include "halfspace/render/assets/asset_cache.h"
#include "halfspace/render/assets/shared_assets.h"
#include "halfspace/scene/keys.h"

namespace halfspace::HS_LANES {

// Builds the cache key of an asset from the parameters that determine it.
template <class... T>
std::string recipe(const T&... parts) {
  std::string text;
  const auto add = [&](const auto& part) {
    if constexpr (std::is_arithmetic_v<std::decay_t<decltype(part)>>) {
      text += number_text(static_cast<double>(part)) + " ";
    } else {
      text += std::string(part) + " ";
    }
  };
  (add(parts), ...);
  return text;
}

// Calls `read` and prepends the scene key that refers to the file to its error messages.
template <class F>
auto read_for(const std::string& key, F read) {
  try {
    return read();
  } catch (const LimitError& e) {
    throw LimitError(key + ": " + e.what());
  } catch (const InputError& e) {
    throw InputError(key + ": " + e.what());
  }
}

// The assets that a prepared scene uses. They are kept alive with it.
class UsedAssets {
 public:
  explicit UsedAssets(AssetCache& cache) : cache_(cache) {}

  bool contains(const std::string& recipe) const { return cache_.contains(recipe); }
  // Returns the asset with this recipe, or null if it does not exist yet.
  template <class T>
  std::shared_ptr<const T> existing(const std::string& recipe) {
    std::shared_ptr<const T> found = cache_.find<T>(recipe);
    if (found != nullptr) used_.push_back(found);
    return found;
  }
  // Like the above, but creates an asset that does not exist yet by calling `make`.
  template <class T, class F>
  std::shared_ptr<const T> asset(const std::string& recipe, F make) {
    if (!cache_.contains(recipe)) cache_.add(recipe, std::make_shared<const T>(make()));
    return existing<T>(recipe);
  }
  // Like the above, for an asset that all scenes of the process share.
  template <class T, class F, class Bytes>
  std::shared_ptr<const T> shared_asset(const std::string& recipe, const F& make, const Bytes& bytes) {
    if (!cache_.contains(recipe)) cache_.add(recipe, SharedAssets::of_process().get<T>(recipe, make, bytes));
    return existing<T>(recipe);
  }
  // Removes an asset of an earlier scene from the cache and returns it, or null if it does not exist.
  template <class T>
  std::shared_ptr<const T> take_last(const std::string& recipe) {
    return cache_.take<T>(recipe);
  }
  // Adds an asset that does not exist yet.
  template <class T>
  void add(const std::string& recipe, std::shared_ptr<const T> asset) {
    used_.push_back(asset);
    cache_.add(recipe, std::move(asset));
  }
  // Adds an asset that is not in the cache.
  void keep(std::shared_ptr<const void> asset) { used_.push_back(std::move(asset)); }
  // Returns what has been used so far.
  const std::vector<std::shared_ptr<const void>>& used() const { return used_; }
  // Returns everything that was used, and forgets it.
  std::vector<std::shared_ptr<const void>> take() { return std::exchange(used_, {}); }

 private:
  AssetCache& cache_;
  std::vector<std::shared_ptr<const void>> used_;
};

}  // namespace halfspace::HS_LANES
