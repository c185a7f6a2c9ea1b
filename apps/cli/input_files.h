// SPDX-License-Identifier: Apache-2.0
//
// The files that a scene reads, which no command overwrites.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <vector>

#include "halfspace/scene/description.h"

namespace halfspace {

struct ModelAsset;

/// Returns all files that the keys of a scene name, and the images of its models.
std::vector<std::filesystem::path> input_files(SceneDescription scene,
                                               const std::map<std::filesystem::path, std::shared_ptr<const ModelAsset>>& models);

/// Throws OutputError if the output is one of the files, by this or another name.
void reject_overwriting(const std::filesystem::path& out, const std::vector<std::filesystem::path>& inputs);

}  // namespace halfspace
