// SPDX-License-Identifier: Apache-2.0
//
// The files, textures, meshes and maps of scenes, and the conversion of a scene description to draws.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>

#include "halfspace/core/parallel.h"
#include "halfspace/render/assets/asset_cache.h"
#include "halfspace/render/assets/detail_cache.h"
#include "halfspace/render/assets/minimum_sizes.h"
#include "halfspace/render/assets/warnings.h"
#include "halfspace/render/error_budget/approximation_choice.h"
#include "halfspace/render/prepared_scene.h"
#include "halfspace/scene/description.h"

namespace halfspace::HS_LANES {

struct ModelAsset;

/// Creates the textures, meshes and maps that scene descriptions require. Assets are cached until a frame is prepared that does not
/// use them. Frames share the shadow maps of a light as long as its view, the settings and all objects that cast shadows stay the same.
class SceneAssets {
 public:
  /// warn: called with one line for each problem that does not prevent rendering, such as a missing texture of a model.
  explicit SceneAssets(const Workers& workers, std::function<void(const std::string&)> warn = {})
      : workers_(workers), warnings_(std::move(warn)) {}

  /// Shares the assets of `other`. Both can then be used by different threads. Frames that were announced to `other` are ignored.
  SceneAssets(const SceneAssets& other, const Workers& workers, std::function<void(const std::string&)> warn)
      : workers_(workers), warnings_(std::move(warn)), cache_(other.cache_), details_(other.details_) {}

  /// Keeps the simplified meshes of model files in `cache` as well. By default, they are made again by each process.
  void keep_details(std::shared_ptr<DetailCache> cache) { details_ = std::move(cache); }

  /// Provides the contents of a model file that has already been read, so that `prepare` does not read it again.
  void add_model(const std::filesystem::path& file, std::shared_ptr<const ModelAsset> model);

  /// Announces a frame that will be rendered. From then on, generated maps without an explicit width are at least as fine as that frame
  /// needs. If all frames of a range are announced before the first is rendered, maps do not change in between. width and height are the
  /// image size in pixels.
  void expect(const SceneDescription& scene, int width, int height);
  const MinimumSizes& minimum_sizes() const { return minimum_; }  ///< determined by the announced frames

  /// Returns the same scene with the cheapest models that keep the image within the allowed error (docs/results/accuracy.md). The choice
  /// depends only on the scene and on models of error and cost, so it is the same on every machine. Throws the same exceptions as prepare.
  SceneWithinError choose_within_error(const SceneDescription& scene, int width, int height, const AllowedError& allowed);

  /// Prepares a frame of width x height pixels. Throws InputError with a message that begins with the key if a file cannot be used.
  PreparedScene prepare(const SceneDescription& scene, int width, int height);

  /// The same for a frame without color (render/frame/frame.h). Lights, shadows, reflections and the background are not prepared.
  /// Environments stay in the cache for later frames.
  PreparedScene prepare_values(SceneDescription scene, int width, int height);

  /// Removes the shadow maps of the last frame from the cache: for measurements, and before another scene.
  void forget_shadow_maps();

 private:
  const Workers& workers_;
  Warnings warnings_;
  AssetCache cache_;
  std::shared_ptr<DetailCache> details_;
  MinimumSizes minimum_;
};

}  // namespace halfspace::HS_LANES
