// SPDX-License-Identifier: Apache-2.0
#include "view/ui_scale.h"

#include <X11/Xlib.h>

#include <algorithm>
#include <cstdlib>
#include <memory>

namespace halfspace {

double default_ui_scale() {
  constexpr double kUsualDpi = 96.0, kSmallest = 0.5, kLargest = 4.0;
  const std::unique_ptr<Display, int (*)(Display*)> display(XOpenDisplay(nullptr), XCloseDisplay);
  const char* text = display == nullptr ? nullptr : XGetDefault(display.get(), "Xft", "dpi");
  const double dpi = text == nullptr ? 0.0 : std::atof(text);
  return dpi > 0.0 ? std::clamp(dpi / kUsualDpi, kSmallest, kLargest) : 1.0;
}

}  // namespace halfspace
