// SPDX-License-Identifier: Apache-2.0
//
// Shared code of the commands that draw charts.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "halfspace/core/parallel.h"
#include "study/study.h"

namespace halfspace {

/// Writes the data of a study to a folder, which must exist. `command` is the command line, which is stored with the data. Throws
/// OutputError.
void write_data(const Study& study, const std::string& command, bool quick, const Workers& workers, const std::filesystem::path& folder);

/// Draws the charts of the named studies from the data in the folder. Returns an empty string on success, or a line to print that names the
/// missing component. Throws OutputError if drawing fails.
std::string draw_or_explain(const std::vector<std::string>& names, const std::filesystem::path& folder);

}  // namespace halfspace
