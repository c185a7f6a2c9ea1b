// SPDX-License-Identifier: Apache-2.0
#include "view/frame_maker.h"
#include "halfspace/render/frame/frame.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "halfspace/render/model_file/opened_scene.h"
#include "halfspace/render/scene_assets.h"

namespace halfspace {

namespace {

class Stopwatch {
 public:
  // Returns the time since the last call or the construction.
  double lap_ms() {
    const auto now = std::chrono::steady_clock::now();
    const double ms = std::chrono::duration<double, std::milli>(now - start_).count();
    start_ = now;
    return ms;
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

// Fills an image with the enlarged pixels of a smaller image.
void enlarge(const Image<glm::u8vec4>& from, int factor, Image<glm::u8vec4>& to) {
  for (int y = 0; y < to.height(); ++y) {
    const std::span<const glm::u8vec4> source = from.row(y / factor);
    const std::span<glm::u8vec4> row = to.row(y);
    for (std::size_t x = 0; x < row.size(); ++x) row[x] = source[x / static_cast<std::size_t>(factor)];
  }
}

bool is_generated(const EnvironmentDescription& e) {
  return e.type == EnvironmentType::day_sky || e.type == EnvironmentType::night_sky || e.type == EnvironmentType::studio;
}

// Returns true if two generated skies have the same texels.
bool is_same_sky(const EnvironmentDescription& a, const EnvironmentDescription& b) {
  return a.type == b.type && a.size == b.size && a.sun == b.sun && a.clouds == b.clouds && a.milky_way == b.milky_way &&
         a.rotation == b.rotation;
}

}  // namespace

int CoarseControl::divisor(bool moving) const {
  if (!moving || full_ms_ <= kLongFrameMs) return 1;
  return std::min(static_cast<int>(std::ceil(std::sqrt(full_ms_ / kLongFrameMs))), kCoarsest);
}

void CoarseControl::add_frame(int divisor, double milliseconds) { full_ms_ = milliseconds * divisor * divisor; }

void FrameMaker::open(const OpenedScene& opened) {
  scene_.reset();
  environments_.clear();
  assets_ = std::make_unique<SceneAssets>(workers_, warn_);
  if (opened.model != nullptr) assets_->add_model(opened.model_file, opened.model);
}

// Limits the size of generated skies that have changed since the last frame. Generating a sky of 6 · 1024² texels takes longer than
// drawing most scenes.
void FrameMaker::shrink_skies(const SceneDescription& scene) {
  constexpr int kFaceSize = 256;
  for (std::size_t i = 0; i < scene.environments.size(); ++i) {
    EnvironmentDescription& sky = description_.environments[i].second;
    if (!is_generated(sky) || i >= environments_.size() || is_same_sky(sky, environments_[i].second)) continue;
    sky.size = sky.size == 0 ? kFaceSize : std::min(sky.size, kFaceSize);
    has_coarse_sky_ = true;
  }
}

void FrameMaker::render(const SceneDescription& scene, const FrameQuality& quality, Overlay overlay, Image<glm::u8vec4>& frame) {
  Stopwatch watch;
  const int divisor = quality.divisor;
  description_ = scene;
  divisor_ = divisor;
  has_coarse_sky_ = false;
  if (quality.coarse_skies) shrink_skies(scene);
  environments_ = scene.environments;
  if (divisor > 1) {
    description_.head.samples = 1;
    int& texels = description_.shadow.resolution;
    if (texels != 0) texels = std::max(texels / divisor, kMinShadowTexels);  // a value of 0 already depends on the size of the picture
    assets_->expect(scene, frame.width(), frame.height());                   // a coarse frame must not choose smaller maps
    small_ = Image<glm::u8vec4>((frame.width() + divisor - 1) / divisor, (frame.height() + divisor - 1) / divisor);
  }
  Image<glm::u8vec4>& picture = divisor > 1 ? small_ : frame;
  scene_ = assets_->prepare(description_, picture.width(), picture.height());
  times_.prepare_ms = watch.lap_ms();
  statistics_ = scene_->shadow_statistics;
  statistics_ += halfspace::render(*scene_, picture, workers_);
  times_.draw_ms = watch.lap_ms();
  add_overlay(overlay, scene, frame);
  times_.overlay_ms = watch.lap_ms();
}

// Enlarges a coarse picture and draws the overlay. In a coarse frame, the overlay needs the scene at full size, but without shadows.
void FrameMaker::add_overlay(Overlay overlay, const SceneDescription& scene, Image<glm::u8vec4>& frame) {
  overlay_text_.clear();
  const bool coarse = divisor_ > 1, coarse_overlay = coarse && overlay == Overlay::shadow_error;
  if (coarse_overlay) overlay_text_ = draw_overlay(overlay, {description_, *scene_, small_, *assets_, workers_});
  if (coarse) enlarge(small_, divisor_, frame);
  if (overlay == Overlay::none || coarse_overlay) return;
  if (!coarse) {
    overlay_text_ = draw_overlay(overlay, {description_, *scene_, frame, *assets_, workers_});
    return;
  }
  SceneDescription full = description_;
  full.head.samples = scene.head.samples;  // the size of tiles depends on it
  full.shadow.method = ShadowMethod::none;
  overlay_text_ = draw_overlay(overlay, {full, assets_->prepare(full, frame.width(), frame.height()), frame, *assets_, workers_});
}

std::string FrameMaker::reduction_text() const {
  std::string text;
  if (divisor_ > 1) text = fmt::format("1/{} of the width and height, one sample, smaller shadow maps", divisor_);
  if (has_coarse_sky_) text += text.empty() ? "smaller sky" : ", smaller sky";
  return text.empty() ? text : "reduced while moving: " + text;
}

PickedPixel FrameMaker::pick(const glm::ivec2& pixel, const std::string& title) const {
  HS_CHECK(scene_.has_value(), "viewer: no scene has been opened; expected open() first");
  PickedPixel picked = picked_pixel(title, *scene_, description_, pixel / divisor_, workers_);
  picked.pixel = pixel;
  return picked;
}

}  // namespace halfspace
