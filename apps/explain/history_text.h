// SPDX-License-Identifier: Apache-2.0
//
// The history of a pixel as text and as JSON.
#pragma once

#include <string>

#include "explain/pixel_history.h"

namespace halfspace {

/// Returns a description of a color format, for example "half floats".
const char* storage_text(ColorFormat format);

/// Returns the history as text. title: start of the first line, for example the name of the scene.
std::string history_text(const std::string& title, const PixelHistory& history, const FrameTrace& trace);

/// Returns the history as a JSON object. Numbers have enough digits to reproduce the same floats when parsed.
std::string history_json(const PixelHistory& history, const FrameTrace& trace);

}  // namespace halfspace
