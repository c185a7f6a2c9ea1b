// SPDX-License-Identifier: Apache-2.0
#include "cli/input_files.h"

#include "halfspace/core/check.h"
#include "halfspace/render/model_asset.h"
#include "halfspace/scene/scene_paths.h"

namespace halfspace {

std::vector<std::filesystem::path> input_files(SceneDescription scene,
                                               const std::map<std::filesystem::path, std::shared_ptr<const ModelAsset>>& models) {
  std::vector<std::filesystem::path> files;
  const auto add = [&](const std::filesystem::path& file) {
    if (!file.empty()) files.push_back(file);
  };
  for (const NamedSection& section : sections_of(scene)) {
    for (const Field& field : fields_of(section.section)) {
      if (field.key->type == KeyType::file) add(static_cast<const FilePath*>(field.value)->path);
      if (field.key->type != KeyType::map) continue;
      if (const auto* file = std::get_if<FilePath>(static_cast<const MapValue*>(field.value))) add(file->path);
    }
  }
  for (const auto& [file, model] : models) {
    for (const std::filesystem::path& read : files_of(model->model)) add(read);
  }
  return files;
}

void reject_overwriting(const std::filesystem::path& out, const std::vector<std::filesystem::path>& inputs) {
  for (const std::filesystem::path& input : inputs) {
    std::error_code error;
    if (std::filesystem::equivalent(out, input, error))
      throw OutputError(out.string() + ": is read by this scene; expected another output file");
  }
}

}  // namespace halfspace
