// SPDX-License-Identifier: Apache-2.0
//
// Buffer views that are compressed with EXT_meshopt_compression.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "halfspace/model/gltf/gltf_document.h"

namespace halfspace::HS_LANES {

enum class MeshoptMode : uint8_t { attributes, triangles, indices };
enum class MeshoptFilter : uint8_t { none, octahedral, quaternion, exponential };

/// Contents of a compressed buffer view. `stride` and `count` have been checked against `mode` and `filter`.
struct MeshoptStream {
  MeshoptMode mode = MeshoptMode::attributes;
  MeshoptFilter filter = MeshoptFilter::none;
  std::size_t stride = 0;  ///< bytes per element
  std::size_t count = 0;   ///< elements
};

/// Reads and checks the extension object of a buffer view.
MeshoptStream meshopt_stream(const GltfDocument& document, const GltfValue& json);

/// Decompresses `source` to stream.count · stream.stride bytes. Returns false if the data is damaged.
bool decode_meshopt(const MeshoptStream& stream, std::span<const std::byte> source, std::span<std::byte> result);

}  // namespace halfspace::HS_LANES
