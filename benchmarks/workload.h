// SPDX-License-Identifier: Apache-2.0
//
// A workload: one fixed picture that is drawn again and again. Every renderer that is compared draws it by the same formulas
// (docs/performance.md).
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>

#include "halfspace/core/image.h"
#include "halfspace/core/parallel.h"
#include "halfspace/raster/naive.h"

namespace halfspace {

struct WorkloadSize {
  int width, height;
};

/// What a frame leaves in memory; top row first. Owned by the workload.
struct WorkloadPicture {
  const Image<glm::u8vec4>* color;  ///< linear values, not encoded
  const Image<float>* depth;        ///< window depth; null where the workload has none
};

/// The same picture in double precision: colour before it is held to [0, 1] and coded, and window depth (1: nothing was drawn).
using WorkloadTruth = NaiveTarget<double>;

/// A workload that is ready to be drawn at one size. All that a frame reads is there; a frame allocates only what its passes do.
class Workload {
 public:
  virtual ~Workload() = default;
  /// Draws the picture. Every frame does the same work.
  virtual void frame(const Workers& workers) = 0;
  /// What the last frame drew.
  virtual WorkloadPicture picture() const = 0;
  /// By the naive pipeline, or by the closed form where there is one. Slow.
  virtual WorkloadTruth truth() const = 0;
};

class WorkloadAssets;

/// A workload by name.
struct WorkloadKind {
  std::string name;
  std::string what;  ///< one line
  std::function<std::unique_ptr<Workload>(WorkloadSize size, WorkloadAssets& assets)> prepare;
};

/// All workloads, in the order in which tables show them.
std::span<const WorkloadKind> workloads();

}  // namespace halfspace
