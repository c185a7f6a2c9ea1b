// SPDX-License-Identifier: Apache-2.0
//
// Renders a prepared scene and writes the files of one picture for `render`.
#pragma once

#include <filesystem>

#include "cli/naive_picture.h"
#include "cli/output_arguments.h"
#include "cli/statistics.h"

namespace halfspace {

/// The files to write for one picture.
struct PictureFiles {
  std::filesystem::path picture;
  ImageFile format;
  const OutputChoice& choice;
  PictureSize size;  ///< size of the files, which is the size of the crop if there is one
  ImageText text;
  NaiveReport* naive = nullptr;  ///< if set, draw the picture with the naive pipeline and add to this report
};

/// Renders the picture and its values and writes them, with the picture last. Adds times and counts to the report.
void render_files(const PreparedScene& scene, const PictureFiles& files, const Workers& workers, RenderReport& report);

/// Returns true if every existing file of the picture records how it was rendered. Throws UsageError if one of them was rendered with other
/// options than those of `files.text`. Only PNG and OpenEXR files have such a record.
bool record_same_options(const PictureFiles& files);

/// Returns true if all files from an earlier run exist, and the picture is complete and has the requested size.
bool are_complete(const PictureFiles& files);

}  // namespace halfspace
