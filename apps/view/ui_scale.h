// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace halfspace {

/// Returns the scale of the user interface that the X server's resource Xft.dpi asks for: 1 for 96, and 1 if there is no such resource.
double default_ui_scale();

}  // namespace halfspace
