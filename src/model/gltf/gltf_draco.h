// SPDX-License-Identifier: Apache-2.0
//
// Reads primitives that are compressed with KHR_draco_mesh_compression.
#pragma once

#include "halfspace/model/gltf/draco_process.h"
#include "halfspace/model/gltf/gltf_accessors.h"

namespace halfspace::HS_LANES {

/// Returns true if such primitives can be decoded, that is, if halfspace-draco-tool is installed.
bool can_decode_draco();

/// Decodes the primitives of one file. The accessors must outlive this object.
class GltfDraco {
 public:
  explicit GltfDraco(GltfAccessors& accessors) : accessors_(accessors), document_(accessors.document()) {}

  /// If the primitive is compressed, decodes it and returns true. Its accessors then return the decoded values until the next call, and the
  /// indices are a triangle list. If no decoder is installed, the accessors must refer to an uncompressed copy. Throws InputError if the
  /// stream is damaged or does not match the accessors.
  bool decode(const GltfValue& primitive);

 private:
  void check_fallback(const GltfValue& primitive) const;
  GltfAccessor checked_accessor(const GltfValue& object, const char* key, std::size_t count) const;

  GltfAccessors& accessors_;
  GltfDocument& document_;
  DracoProcess process_;
};

}  // namespace halfspace::HS_LANES
