// SPDX-License-Identifier: Apache-2.0
//
// The arguments of `render` after parsing and validation: what to render, and to which files.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "cli/commands.h"
#include "cli/output_files.h"
#include "command_line/frames.h"
#include "command_line/output_pattern.h"
#include "halfspace/render/model_file/input_files.h"
#include "halfspace/render/prepare/wireframe.h"
#include "halfspace/render/scene_assets.h"
#include "halfspace/scene/scene_file.h"

namespace halfspace {

struct RenderJob {
  SceneFile scene;
  ReadModels models;
  std::vector<std::filesystem::path> inputs;  ///< files that must not be overwritten
  std::filesystem::path out;                  ///< as given
  ImageFile format;
  PictureSize size;
  double time, fps;
  std::optional<FrameRange> frames;
  std::optional<OutputPattern> pattern;  ///< of `frames`
  Shard shard;                           ///< of `frames`
  int threads;
  bool resume;
  std::optional<AllowedError> allowed;
  std::optional<HiddenLines> wireframe;
  OutputChoice output;
  const RenderArguments& arguments;
};

/// Parses the arguments and reads the scene and, unless it is only printed, its models. Throws UsageError and InputError. The job refers to
/// the arguments.
RenderJob parse_job(const RenderArguments& args);

/// Returns the picture of a frame, or the only picture if there are no frames.
std::filesystem::path picture_of(const RenderJob& job, int frame = 0);

/// Returns the time of a frame in seconds.
double time_of(const RenderJob& job, int frame);

/// Returns the files of one picture. They refer to the job. naive: see PictureFiles.
PictureFiles files_of(const RenderJob& job, double seconds, const std::filesystem::path& path, NaiveReport* naive = nullptr);

/// Throws OutputError if one of the files of a picture is a file that the scene reads.
void protect_inputs(const RenderJob& job, const std::filesystem::path& picture);

/// Like protect_inputs, for all frames, so that a long animation does not fail at its last frame. With --resume, throws UsageError if a
/// frame was rendered with other options, and warns if this is unknown.
void check_existing_frames(const RenderJob& job);

}  // namespace halfspace
