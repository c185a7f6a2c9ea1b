// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace halfspace {

/// Times of the last frame in milliseconds. While nothing changes, they are those of the last frame that was rendered.
struct WindowTimes {
  double frame = 0.0;      ///< from the start of one frame to the start of the next
  double interface = 0.0;  ///< drawing the user interface
  double present = 0.0;    ///< copying the frame to the window
  bool idle = false;       ///< nothing changes, so the scene is not rendered
};

/// Returns the first line of the statistics: the frame rate, or that the window is idle. render_ms: time of rendering the last frame.
std::string frame_rate_text(const WindowTimes& times, double render_ms);

}  // namespace halfspace
