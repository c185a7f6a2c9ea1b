// SPDX-License-Identifier: Apache-2.0
#include "cli/webp_file.h"

#include <webp/encode.h>
#include <webp/mux.h>

#include <new>
#include <string>
#include <utility>

#include "halfspace/core/check.h"
#include "halfspace/image/atomic_output.h"

namespace halfspace {

namespace {

constexpr float kQuality = 90.0f;

// Owns the pixels of a frame in libwebp's format.
class Picture {
 public:
  explicit Picture(const Image<glm::u8vec4>& image) {
    if (WebPPictureInit(&picture_) == 0) throw OutputError("libwebp has another version than at build time");
    picture_.use_argb = 1;
    picture_.width = image.width();
    picture_.height = image.height();
    if (WebPPictureImportRGBA(&picture_, &image.data()->x, 4 * image.width()) == 0) throw std::bad_alloc();
  }
  ~Picture() { WebPPictureFree(&picture_); }
  Picture(const Picture&) = delete;
  Picture& operator=(const Picture&) = delete;
  WebPPicture* get() { return &picture_; }

 private:
  WebPPicture picture_ = {};
};

class WebpFile : public PictureSink {
 public:
  WebpFile(const FrameClock& clock, int loop, std::filesystem::path file) : clock_(clock), loop_(loop), file_(std::move(file)) {}

  void add(const Image<glm::u8vec4>& image) override {
    if (encoder_ == nullptr) open(image.width(), image.height());
    WebPConfig config;
    if (WebPConfigInit(&config) == 0) throw OutputError("libwebp has another version than at build time");
    config.quality = kQuality;
    Picture picture(image);
    check(WebPAnimEncoderAdd(encoder_.get(), picture.get(), time_of(frames_), &config) != 0);
    ++frames_;
  }

  void finish() override {
    if (encoder_ == nullptr) return;  // no frames
    check(WebPAnimEncoderAdd(encoder_.get(), nullptr, time_of(frames_), nullptr) != 0);
    WebPData data;
    WebPDataInit(&data);
    const bool ok = WebPAnimEncoderAssemble(encoder_.get(), &data) != 0;
    const std::unique_ptr<WebPData, decltype(&WebPDataClear)> owner(&data, &WebPDataClear);
    check(ok);
    write_file(file_, std::as_bytes(std::span(data.bytes, data.size)));
  }

 private:
  void open(int width, int height) {
    constexpr int kMaxEdge = 16383;  // WEBP_MAX_DIMENSION
    if (width > kMaxEdge || height > kMaxEdge)
      throw OutputError(file_.string() + ": is larger than 16383 pixels; expected a smaller --size");
    WebPAnimEncoderOptions options;
    if (WebPAnimEncoderOptionsInit(&options) == 0) throw OutputError("libwebp has another version than at build time");
    options.anim_params.loop_count = loop_;
    options.allow_mixed = 1;
    encoder_.reset(WebPAnimEncoderNew(width, height, &options));
    if (encoder_ == nullptr) throw std::bad_alloc();
  }
  int time_of(int frame) const { return static_cast<int>(clock_.start_of(frame)); }
  void check(bool ok) const {
    if (!ok) throw OutputError(file_.string() + ": cannot write (libwebp reported: " + WebPAnimEncoderGetError(encoder_.get()) + ")");
  }

  FrameClock clock_;
  int loop_;
  std::filesystem::path file_;
  std::unique_ptr<WebPAnimEncoder, decltype(&WebPAnimEncoderDelete)> encoder_{nullptr, &WebPAnimEncoderDelete};
  int frames_ = 0;
};

}  // namespace

std::unique_ptr<PictureSink> make_webp_file(const FrameClock& clock, int loop, const std::filesystem::path& file) {
  return std::make_unique<WebpFile>(clock, loop, file);
}

}  // namespace halfspace
