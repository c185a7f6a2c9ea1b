// SPDX-License-Identifier: Apache-2.0
//
// Renders a prepared scene and writes the files of one picture for `render`.
#pragma once

#include <filesystem>

#include "cli/naive_picture.h"
#include "cli/output_arguments.h"
#include "cli/statistics.h"

namespace halfspace {

/// Receives the pictures of a run, if they do not go to a file each.
class PictureSink {
 public:
  PictureSink() = default;
  virtual ~PictureSink() = default;
  PictureSink(const PictureSink&) = delete;
  PictureSink& operator=(const PictureSink&) = delete;

  /// Receive the next picture: 8-bit sRGB values or linear light, with straight alpha. Only the function for OutputFormat::is_linear() is
  /// called.
  virtual void add(const Image<glm::u8vec4>&) {}
  virtual void add(const Image<glm::vec4>&) {}

  /// Called after the last picture.
  virtual void finish() {}
};

/// The files to write for one picture.
struct PictureFiles {
  std::filesystem::path picture;
  OutputFormat format;
  const OutputChoice& choice;
  PictureSize size;  ///< size of the files, which is the size of the crop if there is one
  ImageText text;
  PictureSink* sink = nullptr;   ///< if set, receives the picture instead of the file
  NaiveReport* naive = nullptr;  ///< if set, draw the picture with the naive pipeline and add to this report
};

/// Renders the picture and its values and writes them, with the picture last. Adds times and counts to the report.
void render_files(const PreparedScene& scene, const PictureFiles& files, const Workers& workers, RenderReport& report);

/// Returns all files of a picture, with the picture last.
std::vector<std::filesystem::path> all_files(const PictureFiles& files);

}  // namespace halfspace
