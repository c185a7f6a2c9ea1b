// SPDX-License-Identifier: Apache-2.0
//
// The mesh of the layer workloads: by default ten quads, one behind another, each covering the whole image.
#pragma once

#include <memory>
#include <vector>

#include "workloads/workload_canvas.h"
#include "workloads/workload_layers.h"

namespace halfspace {

inline constexpr int kLayers = 10;
inline constexpr std::size_t kLayerVertices = 6;

using LayerMesh = std::vector<LayerShader::Attributes<float>>;

/// Returns `layers` quads of two triangles each, with the nearest quad first or last. The quads are evenly spaced between 2 and 7 units
/// from the eye. layers: 1 … 64.
LayerMesh layer_mesh(WorkloadSize size, bool front_to_back, int layers = kLayers);

/// Returns a shader with the camera at the origin, looking along −z.
LayerShader layer_shader(WorkloadSize size);

}  // namespace halfspace
