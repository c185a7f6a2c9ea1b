// SPDX-License-Identifier: Apache-2.0
//
// The files that a scene reads. No command may overwrite them.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <vector>

#include "halfspace/render/model_asset.h"
#include "halfspace/scene/description.h"

namespace halfspace {

/// Returns all files that the keys of a scene refer to, and the images of its models.
std::vector<std::filesystem::path> input_files(SceneDescription scene,
                                               const std::map<std::filesystem::path, std::shared_ptr<const ModelAsset>>& models);

/// Throws OutputError if the output is one of the files, even under a different name.
void reject_overwriting(const std::filesystem::path& out, const std::vector<std::filesystem::path>& inputs);

}  // namespace halfspace
