// SPDX-License-Identifier: Apache-2.0
#include "halfspace/image/jpeg_encode.h"

#include <algorithm>
#include <cstdlib>

#include "halfspace/image/image_errors.h"
#include "halfspace/image/image_text.h"
#include "halfspace/image/jpeg_errors.h"

namespace halfspace::HS_LANES {

namespace {

constexpr int kQuality = 95;

class JpegEncoder {
 public:
  JpegEncoder() { codec_.err = errors_.manager(); }
  ~JpegEncoder() {
    jpeg_destroy_compress(&codec_);
    std::free(file_);
  }
  JpegEncoder(const JpegEncoder&) = delete;
  JpegEncoder& operator=(const JpegEncoder&) = delete;

  // Returns false on failure, see why().
  bool encode(const Image<glm::u8vec4>& image, const std::string& comment) {
    std::vector<glm::u8vec3> row(static_cast<std::size_t>(image.width()));
    return errors_.run([&] {
      start(image.width(), image.height());
      if (!comment.empty())
        jpeg_write_marker(&codec_, JPEG_COM, reinterpret_cast<const JOCTET*>(comment.data()), static_cast<unsigned>(comment.size()));
      JSAMPLE* samples = &row.data()->x;
      for (int y = 0; y < image.height(); ++y) {
        std::ranges::transform(image.row(y), row.begin(), [](const glm::u8vec4& t) { return glm::u8vec3(t); });
        jpeg_write_scanlines(&codec_, &samples, 1);
      }
      jpeg_finish_compress(&codec_);
    });
  }

  std::vector<std::byte> file() const {
    const std::byte* first = reinterpret_cast<const std::byte*>(file_);
    return std::vector<std::byte>(first, first + bytes_);
  }

  const char* why() const { return errors_.text(); }

 private:
  void start(int width, int height) {
    jpeg_create_compress(&codec_);
    jpeg_mem_dest(&codec_, &file_, &bytes_);
    codec_.image_width = static_cast<JDIMENSION>(width);
    codec_.image_height = static_cast<JDIMENSION>(height);
    codec_.input_components = 3;
    codec_.in_color_space = JCS_RGB;
    jpeg_set_defaults(&codec_);
    jpeg_set_quality(&codec_, kQuality, TRUE);
    codec_.comp_info[0].h_samp_factor = codec_.comp_info[0].v_samp_factor = 1;  // 4:4:4 keeps edges between colors sharp
    jpeg_start_compress(&codec_, TRUE);
  }

  JpegErrors errors_;
  jpeg_compress_struct codec_ = {};
  unsigned char* file_ = nullptr;
  unsigned long bytes_ = 0;
};

}  // namespace

std::vector<std::byte> encode_jpeg(const std::filesystem::path& path, const Image<glm::u8vec4>& image, const ImageText& text) {
  HS_CHECK(!image.empty(), "write_image: the image is empty; expected at least one pixel");
  constexpr std::size_t kLongestComment = 65533;  // the length of a marker segment has 16 bits
  JpegEncoder encoder;
  if (!encoder.encode(image, text_lines(text).substr(0, kLongestComment)))
    fail_writing(path, std::string("cannot write (the jpeg encoder reported: ") + encoder.why() + ")");
  return encoder.file();
}

}  // namespace halfspace::HS_LANES
