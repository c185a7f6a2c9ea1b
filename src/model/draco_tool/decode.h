// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "halfspace/model/draco_tool/protocol.h"

namespace halfspace::HS_LANES {

/// The reason why a stream was rejected. The text is one line of the form "problem; what was expected".
struct DracoFailure {
  std::string text;
  bool exceeds_limit = false;
};

/// The indices and the requested attributes of a mesh.
struct DecodedDraco {
  DracoHeader header;
  std::vector<DracoAttributeHeader> attributes;
  std::vector<std::byte> data;  ///< indices and attribute values in the order of the protocol
};

/// Decodes a stream. Throws DracoFailure, or std::bad_alloc.
DecodedDraco decode_draco(std::span<const char> stream, std::span<const uint32_t> ids, uint64_t max_bytes);

}  // namespace halfspace::HS_LANES
