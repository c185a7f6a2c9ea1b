// SPDX-License-Identifier: Apache-2.0
// Light that is encoded twice must not compile, and the error must contain: Encoded.
#include "halfspace/shading/values/tone.h"

using namespace halfspace;

auto codes(const DisplayLight<float>& light) { return encode_srgb(encode_srgb(light)); }
