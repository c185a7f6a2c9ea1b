// SPDX-License-Identifier: Apache-2.0
//
// Writes models and scenes to files, as `halfspace export` does.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "halfspace/model/write_model.h"
#include "halfspace/render/export/scene_model.h"
#include "halfspace/render/scene_assets.h"

namespace halfspace::HS_LANES {

/// A model to export, the name of its file or scene in messages, and the files that it was made from, which are not overwritten.
struct ExportSource {
  Model model;
  std::string name;
  std::vector<std::filesystem::path> inputs;
};

/// Reads a model file. Throws InputError.
ExportSource export_source(const std::string& file, bool allow_outside);

/// Converts a scene to a model. name: the file or name of the scene. models: as for scene_model(). Throws InputError.
ExportSource export_source(const SceneDescription& scene, const std::string& name, SceneAssets& assets, ModelFormat format,
                           const MemoryModels& models = {});

/// Returns the files of a model in a format, with textures in the form that the format needs. out: the main file. warn: called with one
/// line for each kind of data that is omitted. Throws InputError if there is nothing to export, and OutputError if a file is one of the
/// inputs.
std::vector<ModelFile> exported_files(ExportSource source, const std::filesystem::path& out, ModelFormat format,
                                      const std::function<void(const std::string&)>& warn);

/// Writes the files to the folder of `out`. The main file is written last, so that it never refers to missing files. Throws OutputError.
void write_files(const std::filesystem::path& out, const std::vector<ModelFile>& files);

}  // namespace halfspace::HS_LANES
