// SPDX-License-Identifier: Apache-2.0
//
// Decodes Draco streams with halfspace-draco-tool.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "halfspace/core/tool_process.h"
#include "halfspace/model/draco_tool/protocol.h"

namespace halfspace::HS_LANES {

/// A decoded mesh, or the reason why decoding failed.
struct DracoMesh {
  struct Attribute {
    DracoAttributeHeader type;
    std::vector<std::byte> values;  ///< tightly packed
  };
  std::string problem;  ///< "problem; what was expected"; empty on success
  std::size_t points = 0;
  std::vector<std::byte> indices;  ///< three per triangle, uint32_t
  std::vector<Attribute> attributes;
};

/// Returns the path of halfspace-draco-tool, or an empty path if it is not installed.
std::filesystem::path find_draco_tool();

/// The decoder of one file. The program is started when it is first used, and restarted if it has crashed.
class DracoProcess {
 public:
  /// Decodes the attributes with these unique ids, at most kMaxDracoAttributes. max_bytes: memory limit of the result.
  DracoMesh decode(std::span<const std::byte> stream, std::span<const uint32_t> ids, uint64_t max_bytes);

 private:
  bool receive(std::size_t attributes, uint64_t max_bytes, DracoMesh& mesh);

  ToolProcess tool_;
};

}  // namespace halfspace::HS_LANES
