// SPDX-License-Identifier: Apache-2.0
//
// The files that a scene is made from. No command may overwrite the files that it reads.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "halfspace/render/model_file/opened_scene.h"
#include "halfspace/render/scene_assets.h"

namespace halfspace::HS_LANES {

/// Models of objects with the shape `file`. Key: the file, and whether files outside of its folder were allowed.
using ReadModels = std::map<std::pair<std::filesystem::path, bool>, std::shared_ptr<const ModelAsset>>;

/// Reads the models of all visible objects of a scene, except the one that was read when the scene was opened. Throws InputError.
ReadModels read_models(const OpenedScene& opened);
/// Reads the models that `models` does not contain, and returns all.
ReadModels read_models(const SceneFile& scene, ReadModels models);

/// Provides the models to `assets`, so that they are not read again.
void add_models(SceneAssets& assets, const ReadModels& models);

/// Returns all files that the keys of a scene refer to, the buffers and images of its models, and the file `name` that was opened.
std::vector<std::filesystem::path> input_files(SceneDescription scene, const std::string& name, const ReadModels& models);

/// Throws OutputError if the output is one of the files, even under a different name.
void reject_overwriting(const std::filesystem::path& out, const std::vector<std::filesystem::path>& inputs);

}  // namespace halfspace::HS_LANES
