// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "command_line/frames.h"

namespace halfspace {

/// Returns the name of a scene or model without folders and extension, which takes the place of "{name}" in the name of an output file.
std::string short_name(const std::string& scene);

/// Returns the output file of a scene: the name with "{name}" replaced.
std::filesystem::path named_output(const std::string& name, const std::string& scene);

/// The files of a range of frames: a name with places for the number of the frame. "%04d" has at least four digits, with leading zeros.
/// "{frame}" has four, or as many as the last frame of the range. "{name}" is the short name of the scene. "%%" is a percent sign. A name
/// without a place for the number is followed by "_{frame}", before its extension.
class OutputPattern {
 public:
  /// Throws UsageError for other places of printf, such as "%4d".
  OutputPattern(const std::filesystem::path& name, const std::string& scene, const FrameRange& range);

  /// Returns true if a name has a place for a number.
  static bool has_place(const std::string& name);

  /// Returns the file of a frame of the range.
  std::filesystem::path path(int frame) const;

  /// Returns the frames of which at least one file may exist, in ascending order: moon_0007.png or, for example, moon_0007-depth.exr.
  std::vector<int> existing_frames() const;

 private:
  struct Part {
    std::string text;  // before the number
    int digits;        // minimum number of digits; 0: no number, for the last part
  };

  FrameRange range_;
  std::vector<Part> parts_;
};

}  // namespace halfspace
