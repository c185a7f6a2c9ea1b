// SPDX-License-Identifier: Apache-2.0
//
// The options --aov, --crop and --bits of `render`. They select additional values, a part of the picture, and the bit depth.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "cli/output_format.h"
#include "command_line/arguments.h"
#include "halfspace/image/image_io.h"
#include "halfspace/render/frame/frame.h"

namespace halfspace {

/// Values as given on the command line; empty: not given.
struct OutputArguments {
  std::string aov, crop, bits;
  bool separate = false;  ///< --aov-separate
};

/// The parsed options.
struct OutputChoice {
  std::vector<FrameValue> values;  ///< those of --aov, each once
  bool separate = false;
  bool fine = false;  ///< 16 bits per channel
  std::optional<ImageRect> crop;
};

/// Parses the options for pictures of the given size that are written to `out`. Throws UsageError.
OutputChoice parse_output(const OutputArguments& args, const PictureSize& size, const std::filesystem::path& out,
                          const OutputFormat& format);

/// Returns the memory of all images of one picture, in bytes per pixel of the whole view.
int bytes_per_pixel(const OutputChoice& choice, const OutputFormat& format);

/// Images of the values of --aov.
class ValueImages {
 public:
  ValueImages(const OutputChoice& choice, int width, int height);

  /// Sets the pointers for the values.
  void bind(FrameImages& images);

  /// Writes the files of the picture `path`, except for the picture itself; see value_files().
  void write(const std::filesystem::path& path, const ImageText& text) const;

  /// Returns the channels of all values. They refer to this object.
  std::vector<ExrChannel> channels() const;

 private:
  using AnyImage = std::variant<Image<float>, Image<uint32_t>, Image<glm::vec2>, Image<glm::vec3>>;

  const OutputChoice& choice_;
  int width_, height_;
  std::vector<AnyImage> images_;  // parallel to choice_.values
};

/// Returns true if the values are stored as channels of the picture. This is the case for OpenEXR files unless separate files are
/// requested.
bool share_file(const OutputChoice& choice, const std::filesystem::path& picture);

/// Returns the files of the values, next to the picture: NAME-aov.exr, or NAME-VALUE.exr for each value if separate files are requested.
/// Returns an empty list if there are no values or if they are stored in the picture's own file.
std::vector<std::filesystem::path> value_files(const OutputChoice& choice, const std::filesystem::path& picture);

/// Returns the names of the values, separated by commas.
std::string value_names(const OutputChoice& choice);

}  // namespace halfspace
