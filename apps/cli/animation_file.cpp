// SPDX-License-Identifier: Apache-2.0
#include "cli/animation_file.h"

#include <fmt/format.h>

#include "cli/gif_file.h"
#include "cli/webp_file.h"
#include "command_line/errors.h"

namespace halfspace {

namespace {

[[noreturn, maybe_unused]] void fail_without(const char* library, const std::filesystem::path& file) {
  throw UsageError(fmt::format("-o is '{}', but this build has no {}; expected a file name ending in .png, .jpg, .tif, .exr or .hdr",
                               file.string(), library));
}

}  // namespace

std::unique_ptr<PictureSink> make_animation_file(Animation format, const RenderOptions& options, const std::filesystem::path& file) {
  if (format == Animation::webp) {
#if HALFSPACE_HAS_WEBP
    return make_webp_file(FrameClock(options.pictures_per_second(), 1000), options.loop, file);
#else
    fail_without("libwebp", file);
#endif
  }
#if HALFSPACE_HAS_GIF
  return make_gif_file(FrameClock(options.pictures_per_second(), 100), options.loop, file);
#else
  fail_without("giflib", file);
#endif
}

}  // namespace halfspace
