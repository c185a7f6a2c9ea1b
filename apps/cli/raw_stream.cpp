// SPDX-License-Identifier: Apache-2.0
#include "cli/raw_stream.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
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
    bytes_.resize(3 * picture.texels().size());
    std::byte* to = bytes_.data();
    for (const glm::u8vec4& t : picture.texels()) {
      std::memcpy(to, &t, 3);
      to += 3;
    }
    write_standard_output(bytes_);
  }
  void add(const Image<glm::vec4>& picture) override { write_standard_output(std::as_bytes(picture.texels())); }

 private:
  RawStream format_;
  std::vector<std::byte> bytes_;  // kept between pictures to avoid allocations
};

// Converts 8-bit R'G'B' to Y'CbCr. Source: ITU-R BT.709-6, items 3.2 to 3.5, with the quantization for 8 bits. Each code is a sum of three
// terms, one per channel, which are read from tables: for 1920x1080 pixels, this saves about 10 ms per picture.
class VideoCodes {
 public:
  VideoCodes() {
    constexpr double kLuma[] = {0.2126, 0.7152, 0.0722};
    for (std::size_t c = 0; c < 3; ++c) {
      for (std::size_t v = 0; v < 256; ++v) {
        const double x = static_cast<double>(v) / 255.0, y = kLuma[c] * x;
        const double first = c == 0 ? 0.5 : 0.0;  // rounds the sum, once
        terms_[0][c][v] = first + (c == 0 ? 16.0 : 0.0) + 219.0 * y;
        terms_[1][c][v] = first + (c == 0 ? 128.0 : 0.0) + 224.0 * ((c == 2 ? x : 0.0) - y) / 1.8556;
        terms_[2][c][v] = first + (c == 0 ? 128.0 : 0.0) + 224.0 * ((c == 0 ? x : 0.0) - y) / 1.5748;
      }
    }
  }

  std::byte code(std::size_t plane, const glm::u8vec4& t) const {
    const auto& terms = terms_[plane];
    return static_cast<std::byte>(static_cast<int>(terms[0][t.x] + terms[1][t.y] + terms[2][t.z]));
  }

 private:
  std::array<std::array<std::array<double, 256>, 3>, 3> terms_;  // by plane, channel and value
};

class Y4m : public PictureSink {
 public:
  explicit Y4m(double fps) : fps_(fps) {}

  void add(const Image<glm::u8vec4>& picture) override {
    bytes_.clear();
    if (!std::exchange(has_header_, true)) add_text(header(picture.width(), picture.height()));
    add_text("FRAME\n");
    const std::size_t pixels = picture.texels().size(), first = bytes_.size();
    bytes_.resize(first + 3 * pixels);
    for (std::size_t plane = 0; plane < 3; ++plane) {
      std::ranges::transform(picture.texels(), bytes_.begin() + static_cast<std::ptrdiff_t>(first + plane * pixels),
                             [&](const glm::u8vec4& t) { return codes_.code(plane, t); });
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
  VideoCodes codes_;
  bool has_header_ = false;
  std::vector<std::byte> bytes_;  // kept between pictures to avoid allocations
};

}  // namespace

std::unique_ptr<PictureSink> make_raw_stream(RawStream format, double fps) {
  if (format == RawStream::y4m) return std::make_unique<Y4m>(fps);
  return std::make_unique<RawPictures>(format);
}

}  // namespace halfspace
