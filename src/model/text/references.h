// SPDX-License-Identifier: Apache-2.0
//
// Files that a model file refers to: buffers, images, material libraries.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "halfspace/core/namespace.h"

namespace halfspace::HS_LANES {

/// Finds files that a model refers to. A path that leaves the folder of the model (absolute, with too many "..", or through a symbolic
/// link) is not opened unless `allow_outside` is set. Instead, the folder of the model is searched for the file name without its folders.
class References {
 public:
  /// warnings: receives one line for each reference that was not found as written. Must outlive this object.
  References(const std::filesystem::path& model, bool allow_outside, std::vector<std::string>& warnings);

  /// Returns the absolute path of an existing file, or nothing (with a warning). `name` is a relative or absolute path with '/' or '\\',
  /// without quotation marks or percent encoding. If no file has exactly that name, a file whose name differs only in case is used,
  /// with a warning. `what` describes the reference in warnings: "the texture of material 'wood'".
  std::optional<std::filesystem::path> find(std::string_view name, std::string_view what);

  /// Returns the paths that find() has returned.
  const std::vector<std::filesystem::path>& found() const { return found_; }
  /// Returns how many references were rejected because they are outside the folder of the model.
  int outside() const { return outside_; }

 private:
  std::optional<std::filesystem::path> search(std::string_view name, std::string_view what);
  void warn_outside(const std::string& reference);

  std::filesystem::path folder_;
  bool allow_outside_;
  std::vector<std::string>& warnings_;
  std::vector<std::filesystem::path> found_;
  int outside_ = 0;                  // references that were rejected because they are outside of the folder
  std::size_t outside_warning_ = 0;  // index of the only warning about them
  std::string first_outside_;        // its subject
};

}  // namespace halfspace::HS_LANES
