// SPDX-License-Identifier: Apache-2.0
//
// Renders frames in full quality, or at a reduced resolution while something moves and frames are slow.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "halfspace/core/image.h"
#include "halfspace/render/model_file/opened_scene.h"
#include "halfspace/render/prepared_scene.h"
#include "halfspace/render/scene_assets.h"
#include "view/overlay.h"
#include "view/picked_pixel.h"

namespace halfspace {

/// Selects the resolution of frames.
class CoarseControl {
 public:
  static constexpr double kLongFrameMs = 50.0;
  static constexpr int kCoarsest = 4;

  /// Returns the divisor for the width and height of the next frame. moving: the camera moves or an animation runs.
  int divisor(bool moving) const;
  /// Records the time of a frame.
  void add_frame(int divisor, double milliseconds);

 private:
  double full_ms_ = 0.0;  // estimated time of a frame in full quality
};

/// How a frame is rendered.
struct FrameQuality {
  int divisor = 1;            ///< of the width, the height and the size of shadow maps
  bool coarse_skies = false;  ///< generated skies that differ from those of the last frame are small
  friend bool operator==(const FrameQuality&, const FrameQuality&) = default;
};

struct FrameTimes {
  double prepare_ms = 0.0;  ///< maps, meshes and shadow maps
  double draw_ms = 0.0;
  double overlay_ms = 0.0;
  double total() const { return prepare_ms + draw_ms + overlay_ms; }
};

class FrameMaker {
 public:
  /// warn: called with one line for each problem that does not prevent rendering.
  FrameMaker(const Workers& workers, std::function<void(const std::string&)> warn) : workers_(workers), warn_(std::move(warn)) {}

  /// Starts a new scene and releases the maps and meshes of the previous one.
  void open(const OpenedScene& opened);

  /// Renders a picture with the size of `frame`. With a divisor greater than 1, renders fewer pixels with one sample each and enlarges
  /// them; shadow maps are smaller by the same factor. Overlays have the size of `frame` for any divisor, except for the one that traces
  /// rays. Throws InputError.
  void render(const SceneDescription& scene, const FrameQuality& quality, Overlay overlay, Image<glm::u8vec4>& frame);

  /// Returns the history of a pixel of the last frame, which must exist. Its first line starts with `title`.
  PickedPixel pick(const glm::ivec2& pixel, const std::string& title) const;

  const FrameTimes& times() const { return times_; }
  /// Returns the sum over the passes of the last frame, including those of shadow maps.
  const PassStatistics& statistics() const { return statistics_; }
  const std::string& overlay_text() const { return overlay_text_; }
  /// Returns a line that says how the last frame was reduced, or an empty string if it has full quality.
  std::string reduction_text() const;

 private:
  void shrink_skies(const SceneDescription& scene);
  void add_overlay(Overlay overlay, const SceneDescription& scene, Image<glm::u8vec4>& frame);

  const Workers& workers_;
  std::function<void(const std::string&)> warn_;
  std::unique_ptr<SceneAssets> assets_;
  SceneDescription description_;                // scene of the last frame, reduced
  Named<EnvironmentDescription> environments_;  // of the last frame, not reduced
  bool has_coarse_sky_ = false;
  std::optional<PreparedScene> scene_;
  int divisor_ = 1;
  Image<glm::u8vec4> small_;  // coarse frame before it is enlarged
  FrameTimes times_;
  PassStatistics statistics_;
  std::string overlay_text_;
};

}  // namespace halfspace
