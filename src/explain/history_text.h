// SPDX-License-Identifier: Apache-2.0
//
// The history of a pixel for readers and for programs.
#pragma once

#include <string>

#include "halfspace/explain/pixel_history.h"

namespace halfspace {

/// Returns how a tile stores colors, for example "half floats".
const char* storage_text(ColorFormat format);

/// Returns the history as text for readers. title: first line, for example the name of the scene.
std::string history_text(const std::string& title, const PixelHistory& history, const FrameTrace& trace);

/// Returns the history as a JSON object. Numbers have as many digits as needed to read back the same float.
std::string history_json(const PixelHistory& history, const FrameTrace& trace);

}  // namespace halfspace
