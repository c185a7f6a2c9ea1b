// SPDX-License-Identifier: Apache-2.0
#include "halfspace/render/frame/frame.h"

#include <algorithm>
#include <tuple>
#include <utility>

#include "halfspace/core/float_mode.h"
#include "halfspace/core/half.h"
#include "halfspace/core/resource_limits.h"
#include "halfspace/render/frame/add_draw.h"
#include "halfspace/render/frame/display.h"
#include "halfspace/render/frame/scene_pass.h"
#include "halfspace/render/frame/unlit_layer.h"

namespace halfspace::HS_LANES {

namespace {

constexpr DepthTarget kDepth{.format = DepthFormat::d32f, .clear_value = 0.0f};

// Returns how light is displayed. Without `hdr` it is only encoded.
PostDescription display_of(const PreparedScene& scene) {
  if (scene.post.hdr) return scene.post;
  PostDescription plain;
  plain.format = LightFormat::rgba32f;
  plain.tone = ToneCurve::none;
  return plain;
}

template <class Pixel>
double automatic_exposure(const PostDescription& post, const Image<Pixel>& light, const Workers& workers) {
  return post.exposure * post.key_value / log_average_luminance(light, workers);
}

// A scene, and the part of the view that is rendered.
class FrameRenderer {
 public:
  // run_pass: runs the passes that draw the scene.
  FrameRenderer(const PreparedScene& scene, const std::optional<ImageRect>& crop, int width, int height, const Workers& workers,
                PassRunner run_pass)
      : scene_(scene),
        post_(display_of(scene)),
        crop_(crop),
        width_(width),
        height_(height),
        workers_(workers),
        run_(std::move(run_pass)) {}

  PassStatistics render(Image<glm::u8vec4>& picture) const {
    if (!scene_.post.hdr && !scene_.transparent) return run(pass_of(srgb8a8_target(picture), Draws::in_crop));
    const Image<glm::vec4> unlit = unlit_part();
    return displayed([&](Pass& pass, double exposure) { show(pass, post_, exposure, picture, premultiplied(), unlit); });
  }

  PassStatistics render(Image<glm::u16vec4>& picture) const {
    Image<glm::vec4> encoded(width_, height_);
    const Image<glm::vec4> unlit = unlit_part();
    const PassStatistics statistics =
        displayed([&](Pass& pass, double exposure) { show_fine(pass, post_, exposure, encoded, premultiplied(), unlit); });
    round(encoded, picture);
    return statistics;
  }

  PassStatistics render(Image<glm::vec4>& light) const {
    if (!scene_.transparent) return run(pass_of(rgba32f_target(light), Draws::in_crop));
    Pass pass = pass_of({.format = ColorFormat::rgba32f, .store = StoreOp::dont_care}, Draws::in_crop);
    show_light(pass, light);
    return run_(pass);
  }

  // Converts light that has already been rendered. There must be no crop.
  void display(const Image<glm::vec4>& light, Image<glm::u8vec4>& picture) const {
    const Image<glm::vec4> unlit = unlit_part();
    display_light(light, [&](Pass& pass, double exposure) { show(pass, post_, exposure, picture, premultiplied(), unlit); });
  }

  void display(const Image<glm::vec4>& light, Image<glm::u16vec4>& picture) const {
    Image<glm::vec4> encoded(width_, height_);
    const Image<glm::vec4> unlit = unlit_part();
    display_light(light, [&](Pass& pass, double exposure) { show_fine(pass, post_, exposure, encoded, premultiplied(), unlit); });
    round(encoded, picture);
  }

  PassStatistics render_values(const std::array<ColorTarget, kFrameValues>& targets) const {
    std::array<bool, kFrameValues> wanted{};
    for (std::size_t i = 0; i < kFrameValues; ++i) wanted[i] = targets[i].format != ColorFormat::none;
    Pass pass(width_, height_, targets, kDepth);
    const FrameCamera camera = frame_camera();
    for (const PreparedDraw& draw : scene_.draws) add_value_draw(pass, draw, camera, wanted, state_of(draw, Draws::in_crop));
    return run_(pass);
  }

 private:
  enum class Draws : bool { everywhere, in_crop };

  static glm::u16vec4 codes16_of(const glm::vec4& encoded) {
    glm::u16vec4 codes;
    for (int k = 0; k < 4; ++k) codes[k] = static_cast<uint16_t>(std::clamp(encoded[k], 0.0f, 1.0f) * 65535.0f + 0.5f);
    return codes;
  }

  PassStatistics run(Pass pass) const { return run_(pass); }

  static void round(const Image<glm::vec4>& encoded, Image<glm::u16vec4>& picture) {
    std::ranges::transform(encoded.texels(), picture.data(), codes16_of);
  }

  Premultiplied premultiplied() const { return scene_.transparent ? Premultiplied::yes : Premultiplied::no; }

  // Returns the state of a draw. Cropping is a scissor test, so that all pixels keep their window coordinates.
  DrawState state_of(const PreparedDraw& draw, Draws where) const {
    DrawState state = draw.state;
    if (crop_ && where == Draws::in_crop) state.scissor = Rect{crop_->x, height_ - crop_->y - crop_->height, crop_->width, crop_->height};
    return state;
  }

  Pass pass_of(ColorTarget color, Draws where) const {
    color.clear_value = scene_.clear_color;
    Pass pass(width_, height_, color, kDepth, {.samples = scene_.samples});
    for (const PreparedDraw& draw : scene_.draws) add_draw(pass, draw, state_of(draw, where));
    return pass;
  }

  // Renders the unlit surfaces alone, for show(). Returns an empty image if they are displayed like all others.
  Image<glm::vec4> unlit_part() const {
    if (!separates_unlit(scene_)) return {};
    const MemoryClaim claim(static_cast<uint64_t>(width_) * static_cast<uint64_t>(height_) * sizeof(glm::vec4), "post.tone_unlit");
    Image<glm::vec4> unlit(width_, height_);
    ColorTarget color = rgba32f_target(unlit);
    color.clear_value = glm::vec4(0.0f);
    Pass pass(width_, height_, color, kDepth, {.samples = scene_.samples});
    for (const PreparedDraw& draw : unlit_layer(scene_)) add_draw(pass, draw, state_of(draw, Draws::in_crop));
    pass.run(workers_);
    return unlit;
  }

  // Renders light and displays it. display(pass, exposure) must add the post step.
  template <class F>
  PassStatistics displayed(F display) const {
    const bool half = post_.format == LightFormat::rgba16f;
    if (post_.auto_exposure) return half ? metered<U16Vec4>(rgba16f_target, display) : metered<glm::vec4>(rgba32f_target, display);
    Pass pass = pass_of({.format = half ? ColorFormat::rgba16f : ColorFormat::rgba32f, .store = StoreOp::dont_care}, Draws::in_crop);
    display(pass, post_.exposure);
    return run_(pass);
  }

  // Renders the whole view to an image of linear light and converts it to pixel values in a second pass.
  template <class Pixel, class F>
  PassStatistics metered(ColorTarget (*target)(Image<Pixel>&), F display) const {
    const MemoryClaim claim(static_cast<uint64_t>(width_) * static_cast<uint64_t>(height_) * sizeof(Pixel), "post.auto_exposure");
    Image<Pixel> light(width_, height_);
    const PassStatistics statistics = run(pass_of(target(light), Draws::everywhere));
    display_stored(light, target, display);
    return statistics;
  }

  // Rounds light to the format in which the scene stores it, and displays it.
  template <class F>
  void display_light(const Image<glm::vec4>& light, F display) const {
    if (post_.format == LightFormat::rgba32f) {
      Image<glm::vec4> copy = light;
      return display_stored(copy, rgba32f_target, display);
    }
    Image<U16Vec4> halves(width_, height_);
    std::ranges::transform(light.texels(), halves.data(), [](const glm::vec4& c) {
      return U16Vec4(float_to_finite_half(c.x), float_to_finite_half(c.y), float_to_finite_half(c.z), float_to_finite_half(c.w));
    });
    display_stored(halves, rgba16f_target, display);
  }

  // Converts light that is stored in an image to pixel values, in a pass that has no draws. Measures the light first if auto_exposure is
  // on.
  template <class Pixel, class F>
  void display_stored(Image<Pixel>& light, ColorTarget (*target)(Image<Pixel>&), F display) const {
    const double exposure = post_.auto_exposure ? automatic_exposure(post_, light, workers_) : post_.exposure;
    ColorTarget whole = target(light);
    whole.load = LoadOp::load;
    whole.store = StoreOp::dont_care;
    Pass pass(width_, height_, whole, {});
    display(pass, exposure);
    pass.run(workers_);
  }

  FrameCamera frame_camera() const {
    const View& v = scene_.view;
    FrameCamera camera;
    camera.right_ws = glm::vec3(v.right_ws);
    camera.up_ws = glm::vec3(v.up_ws);
    camera.forward_ws = glm::vec3(v.forward_ws);
    camera.eye_ws = glm::vec3(v.eye_ws);
    camera.eye_low_ws = glm::vec3(v.eye_ws - glm::dvec3(camera.eye_ws));
    camera.perspective = v.to_eye_ws == glm::dvec3(0.0);
    return camera;
  }

  const PreparedScene& scene_;
  PostDescription post_;
  const std::optional<ImageRect>& crop_;
  int width_, height_;  // of the view
  const Workers& workers_;
  PassRunner run_;
};

// The image that a pass writes to: the caller's image or, with a crop, an image of the whole view. finish() copies the crop to the
// caller's image.
template <class T>
class TargetImage {
 public:
  TargetImage(Image<T>* wanted, const std::optional<ImageRect>& crop, int width, int height) : wanted_(wanted), crop_(crop) {
    if (wanted == nullptr) return;
    HS_CHECK_OP(wanted->width(), ==, crop ? crop->width : width,
                "render: an image has the wrong width; expected that of the crop or the view");
    HS_CHECK_OP(wanted->height(), ==, crop ? crop->height : height,
                "render: an image has the wrong height; expected that of the crop or the view");
    if (crop) whole_ = Image<T>(width, height);
  }

  bool is_wanted() const { return wanted_ != nullptr; }
  Image<T>& image() { return crop_ ? whole_ : *wanted_; }

  // Call this when the image is complete.
  void finish() {
    if (wanted_ == nullptr || !crop_) return;
    for (int y = 0; y < crop_->height; ++y) {
      const std::span<const T> row = std::as_const(whole_).row(crop_->y + y);
      std::ranges::copy(row.subspan(static_cast<std::size_t>(crop_->x), static_cast<std::size_t>(crop_->width)), wanted_->row(y).begin());
    }
    whole_ = {};
  }

 private:
  Image<T>* wanted_;
  const std::optional<ImageRect>& crop_;
  Image<T> whole_;
};

// Returns the size of the view: that of the scene, or that of the image if there is no crop.
glm::ivec2 view_size(const PreparedScene& scene, const FrameImages& images) {
  glm::ivec2 size(scene.view.width_px, scene.view.height_px);
  if (const std::optional<ImageRect>& c = images.crop) {
    HS_CHECK(c->x >= 0 && c->y >= 0 && c->width >= 1 && c->height >= 1 && c->x <= size.x - c->width && c->y <= size.y - c->height,
             "render: the crop is not inside the view; expected a rectangle of at least one pixel inside");
  }
  return size;
}

// Renders a color image if it is requested.
template <class T>
void render_color(const FrameRenderer& renderer, Image<T>* wanted, const FrameImages& images, const glm::ivec2& size,
                  PassStatistics& statistics) {
  if (wanted == nullptr) return;
  TargetImage<T> target(wanted, images.crop, size.x, size.y);
  statistics += renderer.render(target.image());
  target.finish();
}

// Renders all requested values in one pass.
PassStatistics render_values(const FrameRenderer& renderer, const FrameImages& images, const glm::ivec2& size) {
  const auto target_of = [&]<class T>(Image<T>* wanted) { return TargetImage<T>(wanted, images.crop, size.x, size.y); };
  auto all = std::tuple(target_of(images.depth), target_of(images.distance), target_of(images.normal), target_of(images.camera_normal),
                        target_of(images.albedo), target_of(images.position), target_of(images.uv), target_of(images.object),
                        target_of(images.instance), target_of(images.triangle), target_of(images.barycentrics));
  static_assert(std::tuple_size_v<decltype(all)> == kFrameValues);
  std::array<ColorTarget, kFrameValues> targets;
  const auto bind = [&]<class T>(TargetImage<T>& target, ColorTarget& out) {
    if (!target.is_wanted()) return;
    if constexpr (std::same_as<T, float>) out = r32f_target(target.image(), images.background_depth);
    if constexpr (std::same_as<T, uint32_t>) out = r32ui_target(target.image(), kNoId);
    if constexpr (std::same_as<T, glm::vec2>) out = rg32f_target(target.image());
    if constexpr (std::same_as<T, glm::vec3>) out = rgb32f_target(target.image());
  };
  std::apply(
      [&](auto&... target) {
        std::size_t i = 0;
        (bind(target, targets[i++]), ...);
      },
      all);
  const PassStatistics statistics = renderer.render_values(targets);
  std::apply([](auto&... target) { (target.finish(), ...); }, all);
  return statistics;
}

}  // namespace

bool wants_values(const FrameImages& i) {
  return i.depth != nullptr || i.distance != nullptr || i.normal != nullptr || i.camera_normal != nullptr || i.albedo != nullptr ||
         i.position != nullptr || i.uv != nullptr || i.object != nullptr || i.instance != nullptr || i.triangle != nullptr ||
         i.barycentrics != nullptr;
}

PassStatistics render_frame(const PreparedScene& scene, const FrameImages& images, const Workers& workers) {
  const FloatMode float_mode;
  const glm::ivec2 size = view_size(scene, images);
  const FrameRenderer renderer(scene, images.crop, size.x, size.y, workers, [&workers](Pass& pass) { return pass.run(workers); });
  PassStatistics statistics;
  render_color(renderer, images.picture, images, size, statistics);
  render_color(renderer, images.fine_picture, images, size, statistics);
  render_color(renderer, images.light, images, size, statistics);
  if (wants_values(images)) statistics += render_values(renderer, images, size);
  return statistics;
}

double frame_exposure(const PreparedScene& scene, const Image<glm::vec4>& light, const Workers& workers) {
  const FloatMode float_mode;
  const PostDescription post = display_of(scene);
  return post.auto_exposure ? automatic_exposure(post, light, workers) : post.exposure;
}

ToneMapping frame_tone(const PreparedScene& scene, double exposure) { return tone_of(display_of(scene), exposure); }

PassStatistics render_with(const PreparedScene& scene, Image<glm::u8vec4>& picture, const Workers& workers, const PassRunner& run_pass) {
  const FloatMode float_mode;
  const std::optional<ImageRect> whole;
  return FrameRenderer(scene, whole, scene.view.width_px, scene.view.height_px, workers, run_pass).render(picture);
}

void display_frame(const PreparedScene& scene, const Image<glm::vec4>& light, const FrameImages& images, const Workers& workers) {
  const FloatMode float_mode;
  HS_CHECK(!images.crop && !wants_values(images),
           "display_frame: a crop or values other than the color were requested; expected only pictures");
  const glm::ivec2 size = view_size(scene, images);
  HS_CHECK(light.width() == size.x && light.height() == size.y,
           "display_frame: the light has another size than the view; expected the same size");
  const FrameRenderer renderer(scene, images.crop, size.x, size.y, workers, [&workers](Pass& pass) { return pass.run(workers); });
  if (images.picture != nullptr) renderer.display(light, *images.picture);
  if (images.fine_picture != nullptr) renderer.display(light, *images.fine_picture);
  if (images.light != nullptr) *images.light = light;
}

PassStatistics render(const PreparedScene& scene, Image<glm::u8vec4>& picture, const Workers& workers) {
  return render_frame(scene, {.picture = &picture}, workers);
}

PassStatistics render(const PreparedScene& scene, Image<glm::vec4>& light, const Workers& workers) {
  return render_frame(scene, {.light = &light}, workers);
}

}  // namespace halfspace::HS_LANES
