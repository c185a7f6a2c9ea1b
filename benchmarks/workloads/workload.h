// SPDX-License-Identifier: Apache-2.0
//
// A workload draws the same image repeatedly. All compared renderers use the same formulas (docs/results/performance.md).
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "halfspace/core/image.h"
#include "halfspace/core/parallel.h"
#include "halfspace/raster/naive.h"

namespace halfspace {

struct WorkloadSize {
  int width, height;
};

/// The result of a frame, top row first. Owned by the workload.
struct WorkloadPicture {
  const Image<glm::u8vec4>* color;  ///< linear values, without sRGB encoding
  const Image<float>* depth;        ///< window depth; null if the workload has no depth buffer
};

/// The same image in double precision: the color before clamping and quantization, and the window depth, which is 1 for the background.
using WorkloadTruth = NaiveTarget<double>;

/// How much of a shadow map a picture reads, in texels and in tiles of 64 x 64 texels.
struct ShadowMapUse {
  int tiles = 0, texels = 0;  ///< of the map
  int filled_tiles = 0;       ///< tiles that contain a part of a caster
  int read_tiles = 0, read_filled_tiles = 0, read_texels = 0;
};

/// How much of the geometry of the objects that a picture draws is processed.
struct GeometryUse {
  uint64_t triangles = 0, vertices = 0;  ///< of the objects; a vertex counts once per object
  uint64_t skipped_triangles = 0;        ///< in clusters that are outside of the view, face away, or are hidden
  uint64_t shaded_vertices = 0;
  uint64_t binned_triangles = 0;  ///< that may cover a sample, hidden or not; a clipped triangle may count several times
};

/// A workload that has been prepared for one image size. All inputs already exist; a frame allocates only what its passes need.
class Workload {
 public:
  virtual ~Workload() = default;
  /// Draws the image. Every frame does the same work.
  virtual void frame(const Workers& workers) = 0;
  /// Returns the image drawn by the last frame.
  virtual WorkloadPicture picture() const = 0;
  /// False for matrix rows and scenes without a double-precision reference image; truth() must then not be called.
  virtual bool has_truth() const { return true; }
  /// Computes the reference image with the naive pipeline, or analytically where possible. Slow.
  virtual WorkloadTruth truth() const = 0;
  /// For the matrix and the scenes drawn by another renderer: Halfspace's picture, for comparison. Null for all other workloads.
  virtual std::unique_ptr<Workload> twin() const { return nullptr; }
  /// For the scenes drawn by Halfspace: what the last picture reads of its shadow map. Draws the picture again.
  virtual std::optional<ShadowMapUse> shadow_map_use(const Workers&) const { return std::nullopt; }
  /// For the scenes drawn by Halfspace: what was processed for the last picture.
  virtual std::optional<GeometryUse> geometry_use() const { return std::nullopt; }
};

class WorkloadAssets;

/// An entry of the workload table.
struct WorkloadKind {
  std::string name;
  std::string what;  ///< one-line description
  std::function<std::unique_ptr<Workload>(WorkloadSize size, WorkloadAssets& assets)> prepare;
};

/// Returns all workloads in display order.
std::span<const WorkloadKind> workloads();

}  // namespace halfspace
