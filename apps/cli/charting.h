// SPDX-License-Identifier: Apache-2.0
//
// What the commands that draw charts have in common.
#pragma once

#include <filesystem>
#include <string>

#include "halfspace/core/parallel.h"
#include "halfspace/study/study.h"

namespace halfspace {

/// Writes the study's data and chart into the folder, which exists; command: as it was called. False where the chart is missing, for want
/// of gnuplot. Throws OutputError.
bool write_charted(const Study& study, const std::string& command, bool quick, const Workers& workers, const std::filesystem::path& folder);

/// The line for that.
inline constexpr const char* kNoGnuplot =
    "no charts were drawn: gnuplot is missing (Debian and Ubuntu: gnuplot-nox); the data are written\n";

}  // namespace halfspace
