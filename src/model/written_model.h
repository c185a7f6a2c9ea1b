// SPDX-License-Identifier: Apache-2.0
//
// A model as files, the result of the writers.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "halfspace/core/namespace.h"

namespace halfspace::HS_LANES {

/// One of the files of a model.
struct ModelFile {
  std::string name;  ///< without folders
  std::vector<std::byte> bytes;
};

/// A model as files, the main file first. Files refer to each other by name and belong in the same folder.
struct WrittenModel {
  std::vector<ModelFile> files;
  std::vector<std::string> warnings;  ///< one line for each kind of data that the format cannot store
};

/// Returns ".png" or ".jpg" for an image in a format that all glTF readers support, otherwise an empty string.
std::string image_extension(std::span<const std::byte> image);

/// Appends the bytes of a value, which are little-endian on all supported machines.
template <class T>
void append_value(std::vector<std::byte>& bytes, const T& value) {
  const auto* first = reinterpret_cast<const std::byte*>(&value);
  bytes.insert(bytes.end(), first, first + sizeof value);
}

void append_text(std::vector<std::byte>& bytes, std::string_view text);

}  // namespace halfspace::HS_LANES
