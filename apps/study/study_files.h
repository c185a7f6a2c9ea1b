// SPDX-License-Identifier: Apache-2.0
//
// Writes the results of a study: data, pictures, the chart, and an HTML page that shows all studies in a folder.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "study/study.h"

namespace halfspace {

/// Information about a run, stored with the data.
struct RunFacts {
  std::string command;  ///< command line
  std::string version;  ///< version and build of the program
  int threads = 1;
  bool quick = false;
};

/// Writes NAME.csv, NAME.json, and the pictures NAME-truth.png, NAME-VARIANT.png and NAME-VARIANT-difference.png to a folder, which must
/// exist. Throws OutputError.
void write_study(const Study& study, const RunFacts& facts, const std::filesystem::path& folder);

/// Runs draw_charts.py, which draws NAME.svg and NAME-dark.svg from NAME.json for each name. The script is expected in
/// ../share/halfspace relative to the folder of the running program. Returns an empty string, or a message that names the missing component
/// and the package that contains it. Throws OutputError if the script fails.
std::string draw_charts(const std::vector<std::string>& names, const std::filesystem::path& folder);

/// Writes index.html, which shows every study that has a NAME.json in the folder, with its chart if NAME.svg exists. Throws InputError if
/// one of them is invalid.
void write_index(const std::filesystem::path& folder);

/// Converts the name of a variant to a part of a file name: lowercase letters, digits and '-'.
std::string file_word(std::string_view name);

}  // namespace halfspace
