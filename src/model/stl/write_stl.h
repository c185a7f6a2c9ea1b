// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "halfspace/model/model.h"
#include "halfspace/model/written_model.h"

namespace halfspace::HS_LANES {

/// Writes a model as a binary STL file; see written_model() for what the format can store. stem: the name of the main file without its
/// extension.
WrittenModel write_stl(const Model& model, const std::string& stem);

}  // namespace halfspace::HS_LANES
