// SPDX-License-Identifier: Apache-2.0
// A swizzle must not name components that the vector does not have, and the error must contain: names one to four components.
#include "halfspace/core/swizzle.h"

using namespace halfspace;

vec2<float> read(const vec2<float>& v) { return swizzle<"xz">(v); }
