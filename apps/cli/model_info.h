// SPDX-License-Identifier: Apache-2.0
//
// `halfspace info MODEL`: describes the contents of a model file and problems found in it.
#pragma once

#include <string>

#include "cli/commands.h"

namespace halfspace {

/// Reads the model and describes it, as text or as JSON. Throws UsageError and InputError.
std::string model_info(const InfoArguments& args);

}  // namespace halfspace
