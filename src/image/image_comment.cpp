// SPDX-License-Identifier: Apache-2.0
#include "halfspace/image/image_comment.h"

#include "halfspace/core/check.h"
#include "halfspace/image/exr_header.h"
#include "halfspace/image/image_source.h"
#include "halfspace/image/png.h"

namespace halfspace::HS_LANES {

std::string image_comment(const std::filesystem::path& path) {
  try {
    ImageSource source(path, "an image");
    return source.tool_format() ? exr_comment(path) : png_comment(source.bytes());
  } catch (const InputError&) {
    return {};
  }
}

}  // namespace halfspace::HS_LANES
