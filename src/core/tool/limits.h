// SPDX-License-Identifier: Apache-2.0
//
// Limits that a decoder program sets for itself, because the files that it decodes are untrusted. Part of the decoder programs.
#pragma once

#include <cstdint>

#include "halfspace/core/namespace.h"

namespace halfspace::HS_LANES {

/// Ends this process when the reader of standard output is gone.
void exit_with_reader();

/// Limits the address space of this process in bytes, and disables core dumps.
void limit_memory(uint64_t bytes);

/// Ends this process after another `seconds` of CPU time, or after five times as many seconds of elapsed time.
void limit_time(unsigned seconds);

}  // namespace halfspace::HS_LANES
