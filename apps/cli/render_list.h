// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cli/render_run.h"

namespace halfspace {

/// Renders the scenes that `next` selects and adds them to the results. The next scene is read while one is rendered. A scene that fails
/// costs one line on standard error and its own pictures; the others are still rendered.
void render_list(const RenderOptions& options, const NextIndex& next, RenderRun& run, RunResults& results, Progress& progress);

}  // namespace halfspace
