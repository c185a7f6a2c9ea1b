// SPDX-License-Identifier: Apache-2.0
//
// Advice for `render` if nothing is visible.
#pragma once

#include <string>

#include "cli/render_job.h"
#include "cli/statistics.h"

namespace halfspace {

/// Returns what to change if the pictures of a finished job are empty, or an empty string if they show something.
std::string advice_for_empty_pictures(const RenderJob& job, const RenderReport& report);

}  // namespace halfspace
