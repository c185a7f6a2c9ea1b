// SPDX-License-Identifier: Apache-2.0
//
// Describes the contents of a model file and problems found in it.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "halfspace/model/model.h"

namespace halfspace::HS_LANES {

/// Reads a model and describes it as a JSON object. up: replaces the direction that points up in the file. Throws InputError.
nlohmann::ordered_json model_info(const std::filesystem::path& file, bool allow_outside, std::optional<UpAxis> up);

/// Returns the text of a description, with one line for each of its values and then one for each warning.
std::string model_info_text(const nlohmann::ordered_json& info);

}  // namespace halfspace::HS_LANES
