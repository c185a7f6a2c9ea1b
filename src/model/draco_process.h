// SPDX-License-Identifier: Apache-2.0
//
// Decoding of Draco streams by halfspace-draco-tool.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "halfspace/core/tool_process.h"
#include "halfspace/model/draco_tool/protocol.h"

namespace halfspace {

/// A decoded mesh, or the reason why there is none.
struct DracoMesh {
  struct Attribute {
    DracoAttributeHeader type;
    std::vector<std::byte> values;  ///< tightly packed
  };
  std::string problem;  ///< "problem; what was expected"; empty: decoded
  std::size_t points = 0;
  std::vector<std::byte> indices;  ///< three per triangle, uint32_t
  std::vector<Attribute> attributes;
};

/// Returns the path of halfspace-draco-tool, or an empty path if it is not installed.
std::filesystem::path find_draco_tool();

/// The decoder of one file. It is started when it is first used, and again after it has died.
class DracoProcess {
 public:
  /// Decodes the attributes with these unique ids. max_bytes: memory for the result. At most kMaxDracoAttributes.
  DracoMesh decode(std::span<const std::byte> stream, std::span<const uint32_t> ids, uint64_t max_bytes);

 private:
  bool receive(std::size_t attributes, uint64_t max_bytes, DracoMesh& mesh);

  ToolProcess tool_;
};

}  // namespace halfspace
