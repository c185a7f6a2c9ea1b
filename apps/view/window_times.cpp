// SPDX-License-Identifier: Apache-2.0
#include "view/window_times.h"

#include <fmt/format.h>

namespace halfspace {

std::string frame_rate_text(const WindowTimes& times, double render_ms) {
  if (times.idle) return fmt::format("{:6.1f} ms for the last frame; idle: nothing changes", render_ms + times.interface + times.present);
  return fmt::format("{:6.1f} ms per frame, {:.1f} frames per second", times.frame, 1000.0 / times.frame);
}

}  // namespace halfspace
