// SPDX-License-Identifier: Apache-2.0
//
// The protocol between halfspace-draco-tool and the program that started it.
//
//   halfspace-draco-tool serve
//
// reads requests from standard input, which is a socket, until it is closed. A request is a DracoRequest, the unique ids of the requested
// attributes (uint32_t each) and the compressed stream. The answer on standard output starts with a DracoHeader. If its message_bytes is
// not 0, an error message of this length follows, one line of the form "problem; what was expected". Otherwise, a DracoAttributeHeader for
// each requested attribute follows, then three indices (uint32_t) per triangle, then the values of the attributes for all points, one
// attribute after the other.
#pragma once

#include <cstdint>

#include "halfspace/core/namespace.h"

namespace halfspace::HS_LANES {

inline constexpr const char* kDracoToolName = "halfspace-draco-tool";
inline constexpr uint32_t kDracoToolMagic = 0x31544448;  // "HDT1": the digit is the protocol version
inline constexpr uint32_t kMaxDracoAttributes = 64;

struct DracoRequest {
  uint32_t magic = kDracoToolMagic;
  uint32_t attributes = 0;  ///< at most kMaxDracoAttributes
  uint64_t stream_bytes = 0;
  uint64_t max_bytes = 0;  ///< limit for the decoded indices and attributes
};

struct DracoHeader {
  uint32_t magic = kDracoToolMagic;
  uint32_t message_bytes = 0;
  uint32_t exceeds_limit = 0;  ///< 1 if max_bytes was exceeded
  uint32_t points = 0;
  uint64_t triangles = 0;
};

struct DracoAttributeHeader {
  uint32_t component = 0;  ///< glTF component type: 5120 to 5126
  uint32_t width = 0;      ///< components per point, 1 to 4
};

}  // namespace halfspace::HS_LANES
