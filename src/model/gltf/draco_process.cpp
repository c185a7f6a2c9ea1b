// SPDX-License-Identifier: Apache-2.0
#include "halfspace/model/gltf/draco_process.h"

#include <algorithm>
#include <cstring>

#include "halfspace/core/check.h"
#include "halfspace/core/tool_folder.h"

namespace halfspace::HS_LANES {

namespace {

constexpr const char* kOtherVersion = "cannot be decoded: halfspace-draco-tool has a different version from this program";

std::size_t component_bytes(uint32_t component) { return component <= 5121 ? 1 : component <= 5123 ? 2 : 4; }

bool is_valid(const DracoAttributeHeader& type) {
  return type.component >= 5120 && type.component <= 5126 && type.component != 5124 && type.width >= 1 && type.width <= 4;
}

bool receive_list(ToolProcess& tool, std::size_t bytes, std::vector<std::byte>& list) {
  list.resize(bytes);
  return tool.receive(list.data(), bytes);
}

}  // namespace

std::filesystem::path find_draco_tool() { return find_tool(kDracoToolName); }

DracoMesh DracoProcess::decode(std::span<const std::byte> stream, std::span<const uint32_t> ids, uint64_t max_bytes) {
  HS_CHECK_OP(ids.size(), <=, kMaxDracoAttributes, "Draco: too many attributes; expected at most 64");
  DracoMesh mesh;
  if (!tool_.running()) {
    const std::filesystem::path program = find_draco_tool();
    const int error = tool_.start(program);
    if (error != 0) {
      mesh.problem = "cannot be decoded: " + program.string() + " does not start (" + std::strerror(error) + ")";
      return mesh;
    }
  }
  const DracoRequest request{kDracoToolMagic, static_cast<uint32_t>(ids.size()), stream.size(), max_bytes};
  const bool sent =
      tool_.send(&request, sizeof request) && tool_.send(ids.data(), ids.size_bytes()) && tool_.send(stream.data(), stream.size());
  // A tool that runs out of memory may answer before it has received the whole request.
  if (!receive(ids.size(), max_bytes, mesh) || (!sent && mesh.problem.empty())) {
    const int signal = tool_.wait();
    mesh.problem = std::string("cannot be decoded (the decoder ") +
                   (signal == 0 ? "ended early" : std::string("died: ") + ::strsignal(signal)) + "); expected a compressed triangle mesh";
  }
  if (!mesh.problem.empty()) tool_.stop();
  return mesh;
}

// Receives an answer. Returns false if the tool has ended. The answer is validated, because a malicious stream may have taken control of
// the tool.
bool DracoProcess::receive(std::size_t attributes, uint64_t max_bytes, DracoMesh& mesh) {
  DracoHeader header;
  if (!tool_.receive(&header, sizeof header)) return false;
  if (header.magic != kDracoToolMagic) {
    mesh.problem = kOtherVersion;
    return true;
  }
  if (header.message_bytes > 0) {
    mesh.problem.resize(std::min<std::size_t>(header.message_bytes, 1000));
    const bool complete = tool_.receive(mesh.problem.data(), mesh.problem.size());
    std::ranges::replace_if(
        mesh.problem, [](char c) { return static_cast<unsigned char>(c) < ' '; }, ' ');
    return complete;
  }
  std::vector<DracoAttributeHeader> types(attributes);
  if (!tool_.receive(types.data(), types.size() * sizeof(DracoAttributeHeader))) return false;
  constexpr std::size_t kTriangle = 3 * sizeof(uint32_t);
  uint64_t bytes_per_point = 0;
  for (const DracoAttributeHeader& type : types) bytes_per_point += component_bytes(type.component) * type.width;
  const bool fits = header.triangles <= max_bytes / kTriangle && std::ranges::all_of(types, is_valid) &&
                    header.points * bytes_per_point <= max_bytes - header.triangles * kTriangle;
  if (!fits) {
    mesh.problem = kOtherVersion;
    return true;
  }
  mesh.points = header.points;
  bool complete = receive_list(tool_, header.triangles * kTriangle, mesh.indices);
  for (const DracoAttributeHeader& type : types) {
    mesh.attributes.push_back({type, {}});
    complete = complete && receive_list(tool_, mesh.points * component_bytes(type.component) * type.width, mesh.attributes.back().values);
  }
  return complete;
}

}  // namespace halfspace::HS_LANES
