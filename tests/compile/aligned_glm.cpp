// SPDX-License-Identifier: Apache-2.0
// GLM vectors that are aligned to 16 bytes must not compile, and the error must contain: GLM_FORCE_DEFAULT_ALIGNED_GENTYPES.
// compile with: -DGLM_FORCE_DEFAULT_ALIGNED_GENTYPES
#include "halfspace/core/vec.h"
