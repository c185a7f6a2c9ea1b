// SPDX-License-Identifier: Apache-2.0
//
// Buffers and buffer views of glTF files, and the chunks of binary files.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "halfspace/model/gltf/gltf_document.h"
#include "halfspace/model/text/references.h"

namespace halfspace::HS_LANES {

/// Returns whether a file is a binary glTF file, by its first four bytes.
bool is_glb(std::span<const std::byte> bytes);

/// The parts of a glTF file.
struct GltfChunks {
  std::string_view json;
  std::optional<std::span<const std::byte>> binary;  ///< buffer 0 of a binary file
};

/// Returns the parts of a text or binary glTF file. They point into `bytes`. Throws InputError if a chunk is invalid.
GltfChunks gltf_chunks(const std::filesystem::path& file, std::span<const std::byte> bytes);

/// Part of a buffer.
struct GltfView {
  std::span<const std::byte> bytes;
  std::size_t stride = 0;  ///< distance between elements in bytes; 0 if they are tightly packed
};

/// Loads buffers and decompresses buffer views when they are first used. All arguments of the constructor must outlive this object.
class GltfBuffers {
 public:
  GltfBuffers(GltfDocument& document, References& references, std::optional<std::span<const std::byte>> binary);

  /// Returns a buffer view. index must be valid. The data lives as long as this object.
  const GltfView& view(std::size_t index);

 private:
  std::span<const std::byte> buffer(std::size_t index);
  std::vector<std::byte> load(const GltfValue& json);
  GltfView compressed_view(const GltfValue& compression);
  std::span<const std::byte> range(const GltfValue& json);

  GltfDocument& document_;
  References& references_;
  std::optional<std::span<const std::byte>> binary_;
  std::vector<std::optional<std::span<const std::byte>>> buffers_;
  std::vector<std::optional<GltfView>> views_;
  std::vector<std::vector<std::byte>> storage_;  // moving a vector of vectors keeps the addresses of their elements
};

}  // namespace halfspace::HS_LANES
