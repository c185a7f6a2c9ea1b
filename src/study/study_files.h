// SPDX-License-Identifier: Apache-2.0
//
// What a study found, as files: data, pictures, chart, and the page that shows all studies of a folder.
#pragma once

#include <filesystem>
#include <string>

#include "halfspace/study/study.h"

namespace halfspace {

/// How a run was made, for the data.
struct RunFacts {
  std::string command;  ///< as it was called
  std::string version;  ///< of the program, with its build
  int threads = 1;
  bool quick = false;
};

/// Writes NAME.csv, NAME.json, the pictures NAME-truth.png, NAME-VARIANT.png and NAME-VARIANT-difference.png, and the chart's
/// instructions for gnuplot, NAME.gnuplot, into the folder, which exists. Throws OutputError.
void write_study(const Study& study, const RunFacts& facts, const std::filesystem::path& folder);

/// Draws NAME.svg, NAME-dark.svg and NAME.png by NAME.gnuplot. False where there is no gnuplot; throws OutputError where it fails.
bool draw_chart(const std::string& name, const std::filesystem::path& folder);

/// Writes index.html, which shows every study that has a NAME.json in the folder. Throws InputError where one is damaged.
void write_index(const std::filesystem::path& folder);

/// A variant's name as part of a file's: small letters, digits and '-'.
std::string file_word(std::string_view name);

}  // namespace halfspace
