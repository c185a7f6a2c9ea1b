// SPDX-License-Identifier: Apache-2.0
#include "cli/gif_file.h"

#include <gif_lib.h>

#include <algorithm>
#include <array>
#include <new>
#include <string>
#include <utility>
#include <vector>

#include "halfspace/core/check.h"
#include "halfspace/image/atomic_output.h"

namespace halfspace {

namespace {

// The pixels of a frame as indices into its own colors.
struct IndexedPicture {
  std::unique_ptr<ColorMapObject, decltype(&GifFreeMapObject)> colors{nullptr, &GifFreeMapObject};
  std::vector<GifByteType> indices;
};

IndexedPicture quantize(const Image<glm::u8vec4>& image) {
  const std::size_t pixels = image.texels().size();
  std::array<std::vector<GifByteType>, 3> planes;
  for (int c = 0; c < 3; ++c) {
    planes[static_cast<std::size_t>(c)].resize(pixels);
    std::ranges::transform(image.texels(), planes[static_cast<std::size_t>(c)].begin(), [c](const glm::u8vec4& t) { return t[c]; });
  }
  IndexedPicture picture;
  picture.indices.resize(pixels);
  int count = 256;
  picture.colors.reset(GifMakeMapObject(count, nullptr));
  if (picture.colors == nullptr) throw std::bad_alloc();
  const auto edge = [](int n) { return static_cast<unsigned>(n); };
  if (GifQuantizeBuffer(edge(image.width()), edge(image.height()), &count, planes[0].data(), planes[1].data(), planes[2].data(),
                        picture.indices.data(), picture.colors->Colors) == GIF_ERROR)
    throw std::bad_alloc();
  return picture;
}

class GifFile : public PictureSink {
 public:
  GifFile(const FrameClock& clock, int loop, std::filesystem::path file) : clock_(clock), loop_(loop), file_(std::move(file)) {}
  ~GifFile() override { close(); }

  void add(const Image<glm::u8vec4>& image) override {
    if (gif_ == nullptr) open(image.width(), image.height());
    IndexedPicture picture = quantize(image);
    put_duration();
    check(EGifPutImageDesc(gif_, 0, 0, image.width(), image.height(), false, picture.colors.get()));
    for (int y = 0; y < image.height(); ++y)
      check(EGifPutLine(gif_, picture.indices.data() + static_cast<std::ptrdiff_t>(y) * image.width(), image.width()));
    ++frames_;
  }

  void finish() override {
    if (gif_ == nullptr) return;  // no frames
    check(close());
    write_file(file_, bytes_);
  }

 private:
  static int append(GifFileType* gif, const GifByteType* data, int count) {
    auto& bytes = *static_cast<std::vector<std::byte>*>(gif->UserData);
    const auto added = std::as_bytes(std::span(data, static_cast<std::size_t>(count)));
    bytes.insert(bytes.end(), added.begin(), added.end());
    return count;
  }

  void open(int width, int height) {
    constexpr int kColorBits = 8;
    gif_ = EGifOpen(&bytes_, &append, &error_);
    check(gif_ != nullptr ? GIF_OK : GIF_ERROR);
    EGifSetGifVersion(gif_, true);
    check(EGifPutScreenDesc(gif_, width, height, kColorBits, 0, nullptr));
    if (loop_ != 1) put_loop();
  }

  // The application extension of Netscape 2.0, which counts repetitions after the first time.
  void put_loop() {
    const int repetitions = std::max(loop_ - 1, 0);
    const GifByteType count[] = {1, static_cast<GifByteType>(repetitions & 0xff), static_cast<GifByteType>(repetitions >> 8)};
    check(EGifPutExtensionLeader(gif_, APPLICATION_EXT_FUNC_CODE));
    check(EGifPutExtensionBlock(gif_, 11, "NETSCAPE2.0"));
    check(EGifPutExtensionBlock(gif_, sizeof count, count));
    check(EGifPutExtensionTrailer(gif_));
  }

  // Viewers replace durations below two hundredths of a second by a tenth.
  void put_duration() {
    constexpr int64_t kShortest = 2, kLongest = 65535;
    GraphicsControlBlock control = {};
    control.DisposalMode = DISPOSE_DO_NOT;
    control.DelayTime = static_cast<int>(std::clamp(clock_.duration_of(frames_), kShortest, kLongest));
    control.TransparentColor = NO_TRANSPARENT_COLOR;
    GifByteType bytes[4];
    EGifGCBToExtension(&control, bytes);
    check(EGifPutExtension(gif_, GRAPHICS_EXT_FUNC_CODE, sizeof bytes, bytes));
  }

  int close() { return gif_ == nullptr ? GIF_OK : EGifCloseFile(std::exchange(gif_, nullptr), &error_); }

  void check(int result) const {
    if (result == GIF_OK) return;
    const char* reason = GifErrorString(gif_ != nullptr ? gif_->Error : error_);
    throw OutputError(file_.string() + ": cannot write (giflib reported: " + (reason != nullptr ? reason : "no reason") + ")");
  }

  FrameClock clock_;
  int loop_;
  std::filesystem::path file_;
  std::vector<std::byte> bytes_;
  GifFileType* gif_ = nullptr;
  int error_ = 0;
  int frames_ = 0;
};

}  // namespace

std::unique_ptr<PictureSink> make_gif_file(const FrameClock& clock, int loop, const std::filesystem::path& file) {
  return std::make_unique<GifFile>(clock, loop, file);
}

}  // namespace halfspace
