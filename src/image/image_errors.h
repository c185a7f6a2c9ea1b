// SPDX-License-Identifier: Apache-2.0
//
// Throws errors whose message starts with the path of the file.
#pragma once

#include <filesystem>
#include <string>

#include "halfspace/core/check.h"

namespace halfspace::HS_LANES {

[[noreturn]] inline void fail_reading(const std::filesystem::path& path, const std::string& what) {
  throw InputError(path.string() + ": " + what);
}

[[noreturn]] inline void fail_writing(const std::filesystem::path& path, const std::string& what) {
  throw OutputError(path.string() + ": " + what);
}

}  // namespace halfspace::HS_LANES
