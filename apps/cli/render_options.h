// SPDX-License-Identifier: Apache-2.0
//
// The options of `render` after parsing and validation. They apply to all scenes of a run.
#pragma once

#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "cli/commands.h"
#include "cli/output_format.h"
#include "command_line/frames.h"
#include "command_line/output_pattern.h"
#include "halfspace/render/error_budget/approximation_choice.h"
#include "halfspace/render/prepare/wireframe.h"

namespace halfspace {

struct RenderOptions {
  const RenderArguments& arguments;
  std::vector<std::string> scenes;  ///< names and files, at least one
  std::string out;                  ///< as given; empty: named after each scene
  OutputFormat format;
  PictureSize size;
  double time, fps;
  int loop;  ///< how often an animation is played; 0: forever
  std::optional<FrameRange> frames;
  Shard shard;  ///< of the scenes if there are several, else of `frames`
  int threads;
  std::optional<AllowedError> allowed;
  std::optional<HiddenLines> wireframe;
  OutputChoice output;
  std::set<std::filesystem::path> outputs{};  ///< of a list without frames, absolute

  /// Returns whether pictures contain a fingerprint, so that --resume can keep them.
  bool has_fingerprints() const { return (frames || is_list()) && format.is_picture() && !format.to_standard_output; }
  /// Returns whether a scene that fails must not end the run.
  bool is_list() const { return scenes.size() > 1 || !arguments.list.empty(); }
  /// Returns the pictures per second of a stream or an animation.
  double pictures_per_second() const { return frames ? fps / frames->step : fps; }
  /// Returns the number of pictures of each scene.
  int pictures_per_scene() const { return frames ? frames->count() : 1; }
};

/// Returns the size of the written pictures, which is that of the crop if there is one.
PictureSize picture_size(const RenderOptions& options);

/// Parses the arguments and reads the list of scenes. Throws UsageError and InputError. The options refer to the arguments.
RenderOptions parse_options(const RenderArguments& args);

/// Returns the output file of a scene. Its name may have a place for the number of a frame.
std::filesystem::path output_of(const RenderOptions& options, const std::string& scene);

/// Returns the files of the frames of a scene, or nothing if all of its pictures have the same file. Throws UsageError if the name of the
/// output does not fit.
std::optional<OutputPattern> pattern_of(const RenderOptions& options, const std::string& scene);

}  // namespace halfspace
