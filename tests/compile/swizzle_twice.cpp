// SPDX-License-Identifier: Apache-2.0
// A swizzle that is written must not name a component twice, and the error must contain: must not name a component twice.
#include "halfspace/core/swizzle.h"

using namespace halfspace;

void write(vec3<float>& v) { swizzle_ref<"xx">(v) = vec2<float>(1, 2); }
