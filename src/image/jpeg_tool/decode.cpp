// SPDX-License-Identifier: Apache-2.0
#include "halfspace/image/jpeg_tool/decode.h"

#include <algorithm>
#include <new>
#include <vector>

#include "halfspace/core/cache_line_allocator.h"
#include "halfspace/image/jpeg_errors.h"
#include "halfspace/image/tool/failure.h"
#include "halfspace/image/tool/mapped_file.h"
#include "halfspace/image/tool/protocol.h"

namespace halfspace::HS_LANES {

namespace {

// Adobe stores CMYK inverted, as 255 minus the amount of ink, and so do all programs that write such files. The reflected light is then the
// product of the color and the black channel.
uint8_t light_of(uint8_t color, uint8_t black) { return static_cast<uint8_t>((color * black + 127) / 255); }

using Pixels = std::vector<uint8_t, CacheLineAllocator<uint8_t>>;

class JpegDecoder {
 public:
  explicit JpegDecoder(const MappedFile& file) {
    codec_.err = errors_.manager();
    check(errors_.run([&] {
      jpeg_create_decompress(&codec_);
      jpeg_mem_src(&codec_, file.data(), file.size());
      jpeg_read_header(&codec_, TRUE);
    }));
  }
  ~JpegDecoder() { jpeg_destroy_decompress(&codec_); }
  JpegDecoder(const JpegDecoder&) = delete;
  JpegDecoder& operator=(const JpegDecoder&) = delete;

  unsigned width() const { return codec_.image_width; }
  unsigned height() const { return codec_.image_height; }

  // Decodes to 1 channel (the first) or to RGBA.
  Pixels decode(unsigned channels) {
    Pixels pixels(std::size_t{width()} * height() * channels);
    std::vector<uint8_t> row(std::size_t{width()} * static_cast<unsigned>(codec_.num_components));
    check(errors_.run([&] {
      const J_COLOR_SPACE space = codec_.jpeg_color_space;
      const bool inks = space == JCS_CMYK || space == JCS_YCCK;
      const bool direct = channels == 4 && (space == JCS_GRAYSCALE || space == JCS_RGB || space == JCS_YCbCr);
      if (inks) codec_.out_color_space = JCS_CMYK;
      if (direct) codec_.out_color_space = JCS_EXT_RGBA;  // with alpha 255
      jpeg_start_decompress(&codec_);
      while (codec_.output_scanline < codec_.output_height) {
        uint8_t* to = pixels.data() + std::size_t{codec_.output_scanline} * width() * channels;
        uint8_t* scanline = direct ? to : row.data();
        jpeg_read_scanlines(&codec_, &scanline, 1);
        if (!direct) put_row(row.data(), inks, channels, to);
      }
    }));
    return pixels;
  }

 private:
  void check(bool ok) const {
    if (!ok)
      throw Failure{std::string("cannot be read as jpeg (JPEG error: ") + one_line(errors_.text()) + "); expected a complete image file"};
  }

  // Converts a decoded row. Files with fewer than 3 components give gray.
  void put_row(const uint8_t* from, bool inks, unsigned channels, uint8_t* to) const {
    const int components = codec_.out_color_components;
    const int second = components >= 3 ? 1 : 0, third = components >= 3 ? 2 : 0;
    for (unsigned x = 0; x < width(); ++x, from += components, to += channels) {
      const uint8_t black = inks ? from[3] : uint8_t{255};
      to[0] = light_of(from[0], black);
      if (channels == 1) continue;
      to[1] = light_of(from[second], black);
      to[2] = light_of(from[third], black);
      to[3] = 255;
    }
  }

  JpegErrors errors_;
  jpeg_decompress_struct codec_ = {};
};

void decode(const ReadRequest& request) {
  const MappedFile file(request.file, request.file_bytes);
  JpegDecoder decoder(file);
  const unsigned channels = request.gray ? 1 : 4;
  check_claimed_size(request, decoder.width(), decoder.height(), channels);
  const Pixels pixels = decoder.decode(channels);
  const auto edge = [](unsigned pixels_per_side) { return static_cast<int32_t>(pixels_per_side); };
  put_answer(PictureHeader{kImageToolMagic, edge(decoder.width()), edge(decoder.height()), channels, Sample::uint8, 0}, "");
  std::fwrite(pixels.data(), 1, pixels.size(), stdout);
}

}  // namespace

bool decode_and_answer(const ReadRequest& request) {
  try {
    decode(request);
  } catch (const Failure& failure) {
    report_failure(failure);
  } catch (const std::bad_alloc&) {
    report_failure({"not enough memory; expected a smaller image"});
    return false;
  }
  return true;
}

}  // namespace halfspace::HS_LANES
