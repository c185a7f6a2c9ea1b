// SPDX-License-Identifier: Apache-2.0
//
// Shared code of the commands that draw charts.
#pragma once

#include <filesystem>
#include <string>

#include "halfspace/core/parallel.h"
#include "halfspace/study/study.h"

namespace halfspace {

/// Writes the data and the chart of a study to a folder, which must exist. `command` is the command line, which is stored with the data.
/// Returns false if there is no chart because gnuplot is missing. Throws OutputError.
bool write_charted(const Study& study, const std::string& command, bool quick, const Workers& workers, const std::filesystem::path& folder);

/// The message to print if write_charted returns false.
inline constexpr const char* kNoGnuplot =
    "no charts were drawn: gnuplot is missing (Debian and Ubuntu: gnuplot-nox); the data files were written\n";

}  // namespace halfspace
