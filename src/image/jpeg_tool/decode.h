// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "halfspace/image/tool/service.h"

namespace halfspace::HS_LANES {

/// Decodes a JPEG file and writes the answer (see tool/protocol.h) to standard output. Returns false if the process ran out of memory and
/// should not handle further requests.
bool decode_and_answer(const ReadRequest& request);

}  // namespace halfspace::HS_LANES
