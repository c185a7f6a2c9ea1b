// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace halfspace {

/// Returns the scale of the user interface: the X resource Xft.dpi divided by 96, or 1 if it is not set.
double default_ui_scale();

}  // namespace halfspace
