// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "halfspace/model/gltf_document.h"
#include "halfspace/model/model.h"

namespace halfspace {

/// Reads the names of the extensions that a file uses into model.extensions. Adds a warning for each that is not supported, and throws
/// InputError if the file requires one that is not supported and that changes more than appearance.
void read_gltf_extensions(GltfDocument& document, Model& model);

}  // namespace halfspace
