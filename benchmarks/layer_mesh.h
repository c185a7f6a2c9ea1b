// SPDX-License-Identifier: Apache-2.0
//
// Ten quads behind each other that all fill the picture, for all workloads that draw them.
#pragma once

#include <memory>
#include <vector>

#include "workload_canvas.h"
#include "workload_layers.h"

namespace halfspace {

inline constexpr int kLayers = 10;
inline constexpr std::size_t kLayerVertices = 6;

using LayerMesh = std::vector<LayerShader::Attributes<float>>;

/// Two triangles a quad, the nearest quad first or last; 1 … 64 of them between 2 and less than 9 units from the eye.
LayerMesh layer_mesh(WorkloadSize size, bool front_to_back, int layers = kLayers);

/// The camera in the origin that looks along −z.
LayerShader layer_shader(WorkloadSize size);

}  // namespace halfspace
