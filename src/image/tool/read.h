// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "halfspace/image/tool/service.h"

namespace halfspace::HS_LANES {

/// Largest number of channels that a file may have.
inline constexpr int kMaxChannels = 64;

/// Decodes the file and writes the answer (see protocol.h) to standard output. Returns false if the process ran out of memory and should
/// not handle further requests.
bool read_and_answer(const ReadRequest& request);

}  // namespace halfspace::HS_LANES
