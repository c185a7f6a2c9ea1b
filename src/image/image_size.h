// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>

#include "halfspace/core/namespace.h"

namespace halfspace::HS_LANES {

struct ImageSize {
  int width = 0, height = 0;
};

/// Returns the size of an image that the readers of image_io.h support. PNG and JPEG are not decoded; the header suffices. Throws
/// InputError with a message that begins with the path or `name`.
ImageSize image_size(const std::filesystem::path& path);
ImageSize image_size(std::span<const std::byte> file, const std::string& name);

}  // namespace halfspace::HS_LANES
