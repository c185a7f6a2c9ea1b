// SPDX-License-Identifier: Apache-2.0
//
// Tone curves and their settings, used by both shaders and scene descriptions. The formulas are in shading/values/tone.h.
#pragma once

#include <cstdint>

#include "halfspace/core/namespace.h"

namespace halfspace::HS_LANES {

enum class ToneCurve : uint8_t { none, reinhard, reinhard_extended, exponential, aces };
enum class ToneOn : uint8_t { luminance, channel };

struct ToneMapping {
  float exposure = 1.0f;  ///< factor applied to light, 0 to 1e9
  ToneCurve curve = ToneCurve::none;
  ToneOn on = ToneOn::channel;
  float white = 4.0f;  ///< for reinhard_extended: the exposed light that maps to 1, 1e-3 to 1e6
};

}  // namespace halfspace::HS_LANES
