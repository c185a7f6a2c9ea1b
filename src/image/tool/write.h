// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "halfspace/core/namespace.h"

namespace halfspace::HS_LANES {

/// Encodes the image received on standard input and writes the answer (see protocol.h) to standard output. Returns false if that failed.
bool write_and_answer(const std::string& format);

}  // namespace halfspace::HS_LANES
