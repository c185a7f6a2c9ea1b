// SPDX-License-Identifier: Apache-2.0
//
// Writes the results of a study: data, pictures, the chart, and an HTML page that shows all studies in a folder.
#pragma once

#include <filesystem>
#include <string>

#include "halfspace/study/study.h"

namespace halfspace {

/// Information about a run, stored with the data.
struct RunFacts {
  std::string command;  ///< command line
  std::string version;  ///< version and build of the program
  int threads = 1;
  bool quick = false;
};

/// Writes NAME.csv, NAME.json, the pictures NAME-truth.png, NAME-VARIANT.png and NAME-VARIANT-difference.png, and the gnuplot script
/// NAME.gnuplot to a folder, which must exist. Throws OutputError.
void write_study(const Study& study, const RunFacts& facts, const std::filesystem::path& folder);

/// Runs gnuplot on NAME.gnuplot, which draws NAME.svg, NAME-dark.svg and NAME.png. Returns false if gnuplot is not installed; throws
/// OutputError if it fails.
bool draw_chart(const std::string& name, const std::filesystem::path& folder);

/// Writes index.html, which shows every study that has a NAME.json in the folder. Throws InputError if one of them is invalid.
void write_index(const std::filesystem::path& folder);

/// Converts the name of a variant to a part of a file name: lowercase letters, digits and '-'.
std::string file_word(std::string_view name);

}  // namespace halfspace
