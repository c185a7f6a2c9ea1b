// SPDX-License-Identifier: Apache-2.0
#include "halfspace/render/export/export_files.h"

#include "halfspace/core/check.h"
#include "halfspace/image/atomic_output.h"
#include "halfspace/render/export/embed_images.h"
#include "halfspace/render/export/pack_maps.h"
#include "halfspace/render/model_file/input_files.h"
#include "halfspace/render/scene_assets.h"

namespace halfspace::HS_LANES {

namespace {

bool is_gltf(ModelFormat format) { return format == ModelFormat::glb || format == ModelFormat::gltf; }

}  // namespace

ExportSource export_source(const std::string& file, bool allow_outside) {
  Model model = read_model(file, {.allow_outside = allow_outside});
  for (std::string& warning : model.warnings) warning.insert(0, file + ": ");
  std::vector<std::filesystem::path> inputs = files_of(model);
  inputs.emplace_back(file);
  return {std::move(model), file, std::move(inputs)};
}

ExportSource export_source(const SceneDescription& scene, const std::string& name, SceneAssets& assets, ModelFormat format,
                           const MemoryModels& models) {
  Model model = scene_model(scene, assets, is_gltf(format), models);
  std::vector<std::filesystem::path> inputs = input_files(scene, name, {});
  for (const std::filesystem::path& input : files_of(model)) inputs.push_back(input);
  return {std::move(model), name, std::move(inputs)};
}

std::vector<ModelFile> exported_files(ExportSource source, const std::filesystem::path& out, ModelFormat format,
                                      const std::function<void(const std::string&)>& warn) {
  if (source.model.meshes.empty())
    throw InputError(source.name + ": has no meshes to export; expected at least one (particles are not exported)");
  embed_images(source.model, source.name);
  if (is_gltf(format)) pack_maps(source.model, source.name);
  WrittenModel written = written_model(source.model, out, format);
  for (const ModelFile& file : written.files) reject_overwriting(out.parent_path() / file.name, source.inputs);
  for (const std::string& warning : source.model.warnings) warn(warning);
  for (const std::string& warning : written.warnings) warn(warning);
  return std::move(written.files);
}

void write_files(const std::filesystem::path& out, const std::vector<ModelFile>& files) {
  for (std::size_t i = files.size(); i-- > 0;) write_file(out.parent_path() / files[i].name, files[i].bytes);
}

}  // namespace halfspace::HS_LANES
