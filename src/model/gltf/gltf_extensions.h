// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "halfspace/model/gltf/gltf_document.h"
#include "halfspace/model/model.h"

namespace halfspace::HS_LANES {

/// Reads the names of the extensions that a file uses into model.extensions. Adds a warning for each unsupported extension. Throws
/// InputError if the file requires an unsupported extension that changes more than the appearance of materials.
void read_gltf_extensions(GltfDocument& document, Model& model);

}  // namespace halfspace::HS_LANES
