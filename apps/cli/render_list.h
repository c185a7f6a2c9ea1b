// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cli/render_run.h"

namespace halfspace {

/// The scenes that a process rendered.
struct ListCounts {
  int scenes = 0, failed = 0;
};

/// Renders the scenes that `next` selects. The next scene is read while one is rendered. A scene that fails costs one line on standard
/// error and its own pictures; the others are still rendered. Then writes the file of --report.
ListCounts render_list(const RenderOptions& options, const NextIndex& next, RenderRun& run);

}  // namespace halfspace
