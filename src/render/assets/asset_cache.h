// SPDX-License-Identifier: Apache-2.0
//
// Keeps textures, meshes and maps of scenes from one frame to the next.
#pragma once

#include <algorithm>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <typeindex>

#include "halfspace/core/check.h"

namespace halfspace::HS_LANES {

/// Maps strings to assets. The string, called the recipe, lists everything that the asset is made from. A recipe always belongs to the same
/// type of asset. Not thread-safe.
class AssetCache {
 public:
  bool contains(const std::string& recipe) const { return entries_.contains(recipe); }

  /// Returns the asset, or null if it does not exist yet.
  template <class T>
  std::shared_ptr<const T> find(const std::string& recipe) {
    const auto found = entries_.find(recipe);
    if (found == entries_.end()) return nullptr;
    HS_CHECK(found->second.type == typeid(T), "asset cache: two types of assets have the same recipe; expected one type");
    found->second.wanted = true;
    return std::static_pointer_cast<const T>(found->second.asset);
  }

  /// Adds an asset, or replaces the one with this recipe.
  template <class T>
  void add(const std::string& recipe, std::shared_ptr<const T> asset) {
    entries_.insert_or_assign(recipe, Entry{std::move(asset), typeid(T), true});
  }

  /// Removes an asset and returns it, or null if it does not exist.
  template <class T>
  std::shared_ptr<const T> take(const std::string& recipe) {
    std::shared_ptr<const T> found = find<T>(recipe);
    entries_.erase(recipe);
    return found;
  }

  /// Removes all assets of a type. Returns their number.
  template <class T>
  std::size_t remove_all() {
    return std::erase_if(entries_, [](const auto& entry) { return entry.second.type == typeid(T); });
  }

  /// Removes the assets that were neither found nor added since the last call, except for those of the kept types.
  void remove_unwanted(std::span<const std::type_index> kept = {}) {
    const auto is_kept = [&](const Entry& e) { return e.wanted || std::ranges::find(kept, e.type) != kept.end(); };
    std::erase_if(entries_, [&](const auto& entry) { return !is_kept(entry.second); });
    for (auto& [recipe, entry] : entries_) entry.wanted = false;
  }

 private:
  struct Entry {
    std::shared_ptr<const void> asset;
    std::type_index type;
    bool wanted;
  };
  std::map<std::string, Entry> entries_;
};

}  // namespace halfspace::HS_LANES
