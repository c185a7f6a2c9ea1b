// SPDX-License-Identifier: Apache-2.0
//
// A model file as a workload: the view of `halfspace render FILE`, without shadows and without a floor.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "halfspace/render/prepared_scene.h"
#include "workloads/workload.h"

namespace halfspace {

/// The workloads of a model file, which differ in the number of samples per pixel.
struct ModelRow {
  std::string name, what;
  int samples;
};
std::span<const ModelRow> model_rows();

/// Reads a model file and prepares the draws of its default view: the default lights and environment, a half-float color buffer, and a tone
/// curve in the post step of the pass. Throws InputError.
PreparedScene prepared_model(const std::string& file, WorkloadSize size, int samples);

/// The rows of model_rows(), drawn by Halfspace. The file is read when a workload is prepared.
std::vector<WorkloadKind> model_workloads(const std::string& file);

}  // namespace halfspace
