// SPDX-License-Identifier: Apache-2.0
#include "halfspace/render/model_file/input_files.h"

#include <fmt/format.h>

#include "halfspace/core/check.h"
#include "halfspace/render/assets/model_asset.h"
#include "halfspace/render/scene_assets.h"
#include "halfspace/scene/scene_paths.h"

namespace halfspace::HS_LANES {

ReadModels read_models(const OpenedScene& opened) {
  ReadModels models;
  if (opened.model != nullptr) models.try_emplace({opened.model_file, opened.model->allow_outside}, opened.model);
  return read_models(opened.scene, std::move(models));
}

ReadModels read_models(const SceneFile& scene, ReadModels models) {
  for (const auto& [name, object] : scene.description().objects) {
    const std::pair key(object.file.path, object.allow_outside);
    if (object.shape != Shape::file || !object.visible || models.contains(key)) continue;
    try {
      models.emplace(key, std::make_shared<const ModelAsset>(read_model(object.file.path, {.allow_outside = object.allow_outside}),
                                                             object.allow_outside));
    } catch (const InputError& e) {
      throw InputError(fmt::format("{}: objects.{}.file: {}", scene.source(), name, e.what()));
    }
  }
  return models;
}

void add_models(SceneAssets& assets, const ReadModels& models) {
  for (const auto& [key, model] : models) assets.add_model(key.first, model);
}

std::vector<std::filesystem::path> input_files(SceneDescription scene, const std::string& name, const ReadModels& models) {
  std::vector<std::filesystem::path> files{name};
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
  for (const auto& [key, model] : models) {
    for (const std::filesystem::path& read : files_of(model->model)) add(read);
  }
  return files;
}

void reject_overwriting(const std::filesystem::path& out, const std::vector<std::filesystem::path>& inputs) {
  for (const std::filesystem::path& input : inputs) {
    std::error_code error;
    if (std::filesystem::equivalent(out, input, error))
      throw OutputError(out.string() + ": is read by this command; expected another output file");
  }
}

}  // namespace halfspace::HS_LANES
