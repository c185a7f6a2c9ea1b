// SPDX-License-Identifier: Apache-2.0
//
// `halfspace info MODEL`: describes the contents of a model file and problems found in it.
#pragma once

#include <filesystem>
#include <string>

namespace halfspace {

/// Reads the model and describes it, as text or as JSON. Throws InputError.
std::string model_info(const std::filesystem::path& file, bool json);

}  // namespace halfspace
