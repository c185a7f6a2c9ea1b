// SPDX-License-Identifier: Apache-2.0
//
// Simplified meshes in the user's cache folder. Several processes may use the folder at the same time.
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

#include "halfspace/render/assets/detail_cache.h"

namespace halfspace {

/// Returns $XDG_CACHE_HOME/halfspace/detail or ~/.cache/halfspace/detail; empty if neither variable has an absolute path.
std::filesystem::path detail_folder();

/// One file per mesh and step. Its name is a hash of the mesh, the step and the version of the simplification. A file that is damaged is
/// ignored, and replaced if possible. Problems with the folder are ignored, because everything in it can be made again.
class DetailFiles : public DetailCache {
 public:
  /// folder: created when it is needed. max_bytes: if all files together are larger, those that were not used for the longest time are
  /// removed. warn: called with one line for the first damaged file.
  DetailFiles(std::filesystem::path folder, uint64_t max_bytes, std::function<void(const std::string&)> warn)
      : folder_(std::move(folder)), max_bytes_(max_bytes), warn_(std::move(warn)) {}

  std::optional<SimplifiedMesh> find(const TriangleList& mesh, int step) override;
  void store(const TriangleList& mesh, int step, const SimplifiedMesh& simple) override;

 private:
  void remove_oldest() const;

  std::filesystem::path folder_;
  uint64_t max_bytes_;
  std::function<void(const std::string&)> warn_;
  std::atomic<bool> warned_ = false;
};

}  // namespace halfspace
