// SPDX-License-Identifier: Apache-2.0
#include "halfspace/model/gltf/read_gltf.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "halfspace/model/gltf/gltf_accessors.h"
#include "halfspace/model/gltf/gltf_animations.h"
#include "halfspace/model/gltf/gltf_buffers.h"
#include "halfspace/model/gltf/gltf_document.h"
#include "halfspace/model/gltf/gltf_extensions.h"
#include "halfspace/model/gltf/gltf_materials.h"
#include "halfspace/model/gltf/gltf_meshes.h"
#include "halfspace/model/gltf/gltf_nodes.h"
#include "halfspace/model/gltf/gltf_textures.h"

namespace halfspace::HS_LANES {

namespace {

constexpr std::size_t kMaxWarnings = 500;

// Limits the number of warnings, because a damaged file can produce thousands.
void limit_warnings(std::vector<std::string>& warnings) {
  if (warnings.size() <= kMaxWarnings) return;
  const std::size_t left_out = warnings.size() - kMaxWarnings;
  warnings.resize(kMaxWarnings);
  warnings.push_back(fmt::format("{} more warnings are not shown", left_out));
}

void check_version(const GltfDocument& document) {
  const GltfValue& asset = document.object(document.root(), "asset");
  const std::string version = document.string(asset, "version"), minimum = document.string(asset, "minVersion");
  if (!version.starts_with("2.")) {
    document.fail(document.root(), "asset.version", (version.empty() ? "is missing" : gltf_quoted(version)) + "; expected glTF 2.0");
  }
  if (!minimum.empty() && minimum != "2.0") document.fail(asset, "minVersion", gltf_quoted(minimum) + " is not supported; expected 2.0");
}

void read_variants(const GltfDocument& document, Model& model) {
  const GltfValue* variants = document.extension(document.root(), "KHR_materials_variants");
  if (variants == nullptr) return;
  for (const GltfValue& json : document.objects(*variants, "variants")) model.variants.push_back(document.string(json, "name"));
}

}  // namespace

Model read_gltf(const std::filesystem::path& file, std::span<const std::byte> bytes, const ReadModelOptions& options) {
  Model model;
  model.format = "glTF";
  const GltfChunks chunks = gltf_chunks(file, bytes);
  const auto offset = static_cast<std::size_t>(chunks.json.data() - reinterpret_cast<const char*>(bytes.data()));
  GltfDocument document(file, chunks.json, offset, options, model.warnings);
  check_version(document);
  read_gltf_extensions(document, model);
  References references(file, options.allow_outside, model.warnings);
  GltfBuffers buffers(document, references, chunks.binary);
  GltfAccessors accessors(document, buffers);
  GltfTextures textures(document, buffers, references, model);
  model.materials = gltf_materials(document, textures);
  read_variants(document, model);
  const std::vector<GltfMesh> meshes = gltf_meshes(accessors, model);
  read_gltf_skins(accessors, model);
  read_gltf_cameras_and_lights(document, model);
  read_gltf_nodes(accessors, meshes, model);
  read_gltf_animations(accessors, model);
  model.files = references.found();
  limit_warnings(model.warnings);
  return model;
}

}  // namespace halfspace::HS_LANES
