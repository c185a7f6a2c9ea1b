// SPDX-License-Identifier: Apache-2.0
// Scene light that is encoded without a tone curve must not compile, and the error must contain: SceneLight.
#include "halfspace/shading/values/tone.h"

using namespace halfspace;

auto codes(const SceneLight<float>& light) { return encode_srgb(light); }
