// SPDX-License-Identifier: Apache-2.0
//
// What `render` writes: files of one picture each, a stream of pictures on standard output, or one animated file.
#pragma once

#include <optional>
#include <string>

#include "halfspace/image/image_io.h"

namespace halfspace {

/// Pictures without a file format of their own, one after the other: YUV4MPEG2 video, or the bytes of the pixels.
enum class RawStream { y4m, rgb24, rgba, rgbaf32 };

/// Files that contain all frames.
enum class Animation { webp, gif };

struct OutputFormat {
  ImageFile picture = ImageFile::png;  ///< applies if neither of the other two is set
  std::optional<RawStream> stream{};
  std::optional<Animation> animation{};
  bool to_standard_output = false;

  bool is_picture() const { return !stream && !animation; }
  /// Returns whether the pixels are linear values.
  bool is_linear() const { return is_picture() ? halfspace::is_linear(picture) : stream == RawStream::rgbaf32; }
  bool stores_alpha() const;
};

/// Returns the format for -o and --format. Throws UsageError if there is no such format.
OutputFormat parse_output_format(const std::string& out, const std::string& format, bool has_frames);

}  // namespace halfspace
