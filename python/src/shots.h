// SPDX-License-Identifier: Apache-2.0
//
// Converts the times and cameras that Python passes to shots, and reports the progress of a batch.
#pragma once

#include <vector>

#include "bindings.h"
#include "scene_core.h"

namespace halfspace::python {

inline Shot shot_of(double time, const CameraDescription* camera) {
  Shot shot{.time = time};
  if (camera != nullptr) shot.camera = *camera;
  return shot;
}

/// times and cameras have the same length.
inline std::vector<Shot> shots_of(const std::vector<double>& times, const std::vector<CameraDescription*>& cameras) {
  std::vector<Shot> shots;
  for (std::size_t i = 0; i < times.size(); ++i) shots.push_back(shot_of(times[i], cameras[i]));
  return shots;
}

/// Calls progress(done, total) with the GIL held.
inline void report(const py::object& progress, std::size_t done, std::size_t total) {
  if (progress.is_none()) return;
  const py::gil_scoped_acquire acquire;
  progress(done, total);
}

}  // namespace halfspace::python
