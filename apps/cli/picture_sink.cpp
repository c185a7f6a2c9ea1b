// SPDX-License-Identifier: Apache-2.0
#include "cli/picture_sink.h"

#include "cli/animation_file.h"
#include "cli/raw_stream.h"

namespace halfspace {

std::unique_ptr<PictureSink> make_picture_sink(const RenderOptions& options, const std::filesystem::path& file) {
  if (options.format.stream) return make_raw_stream(*options.format.stream, options.pictures_per_second());
  if (options.format.animation) return make_animation_file(*options.format.animation, options, file);
  return nullptr;
}

}  // namespace halfspace
