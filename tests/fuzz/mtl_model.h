// SPDX-License-Identifier: Apache-2.0
//
// A material library as a model, so that it can be tested like a model file.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string_view>

#include "halfspace/model/model.h"
#include "halfspace/model/obj/mtl_materials.h"
#include "halfspace/model/obj/read_mtl.h"

namespace halfspace {

/// Returns a model that consists of a triangle and all materials of the library. `file` is its path; textures are looked for in its folder.
inline Model read_mtl_model(const std::filesystem::path& file, std::span<const std::byte> bytes, const ReadModelOptions& options) {
  Model model;
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  MtlConverter converter(model, file, options, 1.0);
  for (const MtlMaterial& material : parse_mtl(file.filename().string(), text, model.warnings)) {
    model.materials.push_back(converter.convert(material));
  }
  ModelMesh& mesh = model.meshes.emplace_back();
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.indices = {0, 1, 2};
  model.nodes.emplace_back().meshes = {0};
  model.scenes.push_back({"", {0}});
  return model;
}

}  // namespace halfspace
