// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "halfspace/model/model.h"

namespace halfspace::inline HS_LANES_NAMESPACE {

/// Loads all images that are files into memory. Images that are neither PNG nor JPEG are converted to PNG with 8 bits per channel. An image
/// that cannot be read stays a file, and the model gets a warning.
void embed_images(Model& model);

}  // namespace halfspace::inline HS_LANES_NAMESPACE
