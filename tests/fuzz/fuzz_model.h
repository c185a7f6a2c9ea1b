// SPDX-License-Identifier: Apache-2.0
//
// Shared by the fuzz targets for model files (libFuzzer). A target passes its input to one reader, which must return a model or throw an
// InputError with a one-line message.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <span>
#include <string_view>

#include "halfspace/core/check.h"
#include "halfspace/model/model.h"

namespace halfspace {

inline constexpr std::size_t kMaxFuzzBytes = std::size_t{64} << 10;

/// Checks that all indices of the mesh are in range and that its lists have one entry per vertex.
inline void check_mesh(const ModelMesh& mesh) {
  const std::size_t count = mesh.positions.size();
  for (const uint32_t index : mesh.indices) HS_CHECK_OP(index, <, count);
  const auto check_list = [&](std::size_t size) { HS_CHECK(size == 0 || size == count); };
  for (const auto& uvs : mesh.uvs) check_list(uvs.size());
  for (const std::size_t size : {mesh.normals.size(), mesh.tangents.size(), mesh.colors.size(), mesh.joints.size(), mesh.weights.size()}) {
    check_list(size);
  }
  if (mesh.topology == MeshTopology::triangles) HS_CHECK_OP(mesh.indices.size() % 3, ==, 0u);
}

/// Reads one input. Only an InputError is accepted; other exceptions end the process.
template <class Reader>
int fuzz_model(Reader&& reader, const char* name, const uint8_t* data, std::size_t size) {
  if (size > kMaxFuzzBytes) return -1;
  ReadModelOptions options;
  options.max_memory = std::size_t{256} << 20;
  // The folder does not exist, so references to other files are not found.
  const std::filesystem::path file = std::filesystem::path("/no-such-folder") / name;
  try {
    const Model model = reader(file, std::as_bytes(std::span(data, size)), options);
    for (const ModelMesh& mesh : model.meshes) check_mesh(mesh);
  } catch (const InputError& e) {
    HS_CHECK(std::string_view(e.what()).find('\n') == std::string_view::npos);
  }
  return 0;
}

}  // namespace halfspace
