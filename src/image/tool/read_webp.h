// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "halfspace/image/tool/picture.h"
#include "halfspace/image/tool/service.h"

namespace halfspace::HS_LANES {

/// Decodes a WebP file to RGBA with libwebp, because OpenImageIO 2.4 multiplies its 8-bit colors by alpha, which loses them. Returns
/// nothing if the build lacks libwebp, or if it does not decode the file (it is damaged or an animation). Throws Failure if the picture
/// exceeds a limit.
std::optional<Picture> read_webp(const ReadRequest& request);

}  // namespace halfspace::HS_LANES
