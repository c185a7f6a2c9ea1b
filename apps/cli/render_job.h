// SPDX-License-Identifier: Apache-2.0
//
// One scene of a run, opened and with its models read.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cli/output_files.h"
#include "cli/render_options.h"
#include "halfspace/render/model_file/input_files.h"
#include "halfspace/scene/scene_file.h"

namespace halfspace {

struct RenderJob {
  const RenderOptions& options;
  std::string name;  ///< as given
  SceneFile scene;
  ReadModels models;
  std::vector<std::filesystem::path> inputs;  ///< files that must not be overwritten
  std::string input_hash;                     ///< of their contents, if pictures have fingerprints
  std::filesystem::path out;                  ///< the only picture, or the file of all pictures
  std::optional<OutputPattern> pattern;       ///< files of the frames, unless all pictures share one
};

/// Opens a scene and, unless it is only printed, reads its models. Throws UsageError and InputError. The job refers to the options.
RenderJob open_job(const RenderOptions& options, const std::string& scene);

/// Returns the file of picture i.
std::filesystem::path picture_of(const RenderJob& job, int i);

/// Returns the time of picture i in seconds.
double time_of(const RenderJob& job, int i);

/// Returns the files of picture i. They refer to the options.
PictureFiles files_of(const RenderJob& job, int i);

/// Throws OutputError if one of the files of a picture is a file that the scene reads, or, in a list, a file of another program.
void protect_inputs(const RenderJob& job, const std::filesystem::path& picture);

/// The same for all pictures, so that a long animation does not fail at its last frame. Leaves out a list with frames.
void protect_inputs(const RenderJob& job);

}  // namespace halfspace
