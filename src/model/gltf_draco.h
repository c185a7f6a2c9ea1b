// SPDX-License-Identifier: Apache-2.0
//
// Primitives that are compressed with KHR_draco_mesh_compression.
#pragma once

#include "halfspace/model/draco_process.h"
#include "halfspace/model/gltf_accessors.h"

namespace halfspace {

/// Returns whether such primitives can be decoded: halfspace-draco-tool is installed.
bool can_decode_draco();

/// Decodes the primitives of one file. The accessors must outlive this object.
class GltfDraco {
 public:
  explicit GltfDraco(GltfAccessors& accessors) : accessors_(accessors), document_(accessors.document()) {}

  /// If the primitive is compressed, decodes it and lets its accessors return the decoded values until the next call. Returns whether it
  /// did; the indices are then a list of triangles. Without a decoder, the accessors must have values of their own. Throws InputError if
  /// the stream is damaged or does not match the accessors.
  bool decode(const GltfValue& primitive);

 private:
  void check_fallback(const GltfValue& primitive) const;
  GltfAccessor checked_accessor(const GltfValue& object, const char* key, std::size_t count) const;

  GltfAccessors& accessors_;
  GltfDocument& document_;
  DracoProcess process_;
};

}  // namespace halfspace
