// SPDX-License-Identifier: Apache-2.0
//
// Coverage. Input: a triangle, line or point in the window, and a sample position. Output: whether it covers the sample.
// Lines follow the diamond-exit rule (OpenGL 4.6, section 14.5.1).
#pragma once

#include "oracle/window.h"

namespace halfspace::oracle {

/// Returns whether a point is inside. A point on an edge is treated as if it were slightly further to the right and, by a smaller amount,
/// further up. A smooth primitive covers the pixels that it overlaps.
bool covers(const WindowTriangle& t, const Point& at);

/// Returns whether a small triangle covers none of the pixel centers in a box of at most 4 x 4 pixels.
bool covers_none_of_few(const WindowTriangle& t, const Box& box);

}  // namespace halfspace::oracle
