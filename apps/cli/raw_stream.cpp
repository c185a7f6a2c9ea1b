// SPDX-License-Identifier: Apache-2.0
#include "cli/raw_stream.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numeric>
#include <span>
#include <string_view>
#include <vector>

#include "halfspace/image/atomic_output.h"

namespace halfspace {

namespace {

class RawPictures : public PictureSink {
 public:
  explicit RawPictures(RawStream format) : format_(format) {}

  void add(const Image<glm::u8vec4>& picture) override {
    if (format_ == RawStream::rgba) return write_standard_output(std::as_bytes(picture.texels()));
    bytes_.clear();
    for (const glm::u8vec4& t : picture.texels()) bytes_.insert(bytes_.end(), {std::byte{t.x}, std::byte{t.y}, std::byte{t.z}});
    write_standard_output(bytes_);
  }
  void add(const Image<glm::vec4>& picture) override { write_standard_output(std::as_bytes(picture.texels())); }

 private:
  RawStream format_;
  std::vector<std::byte> bytes_;  // kept between pictures to avoid allocations
};

// Y'CbCr of 8-bit R'G'B'. Source: ITU-R BT.709-6, items 3.2 to 3.5, with the quantization for 8 bits.
struct VideoCode {
  std::array<uint8_t, 3> planes;
};
VideoCode video_code(const glm::u8vec4& t) {
  const double r = t.x / 255.0, g = t.y / 255.0, b = t.z / 255.0;
  const double y = 0.2126 * r + 0.7152 * g + 0.0722 * b;
  const auto code = [](double offset, double range, double value) { return static_cast<uint8_t>(std::lround(offset + range * value)); };
  return {{code(16, 219, y), code(128, 224, (b - y) / 1.8556), code(128, 224, (r - y) / 1.5748)}};
}

class Y4m : public PictureSink {
 public:
  explicit Y4m(double fps) : fps_(fps) {}

  void add(const Image<glm::u8vec4>& picture) override {
    bytes_.clear();
    if (!std::exchange(has_header_, true)) add_text(header(picture.width(), picture.height()));
    add_text("FRAME\n");
    const std::size_t pixels = picture.texels().size(), first = bytes_.size();
    bytes_.resize(first + 3 * pixels);
    for (std::size_t i = 0; i < pixels; ++i) {
      const VideoCode code = video_code(picture.texels()[i]);
      for (std::size_t plane = 0; plane < 3; ++plane) bytes_[first + plane * pixels + i] = std::byte{code.planes[plane]};
    }
    write_standard_output(bytes_);
  }

 private:
  std::string header(int width, int height) const {
    const auto thousandths = static_cast<int64_t>(std::llround(fps_ * 1000.0));
    const int64_t divisor = std::gcd(thousandths, int64_t{1000});
    return fmt::format("YUV4MPEG2 W{} H{} F{}:{} Ip A1:1 C444\n", width, height, thousandths / divisor, 1000 / divisor);
  }
  void add_text(std::string_view text) {
    const auto bytes = std::as_bytes(std::span(text));
    bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
  }

  double fps_;
  bool has_header_ = false;
  std::vector<std::byte> bytes_;  // kept between pictures to avoid allocations
};

}  // namespace

std::unique_ptr<PictureSink> make_raw_stream(RawStream format, double fps) {
  if (format == RawStream::y4m) return std::make_unique<Y4m>(fps);
  return std::make_unique<RawPictures>(format);
}

}  // namespace halfspace
