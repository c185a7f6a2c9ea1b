// SPDX-License-Identifier: Apache-2.0
#include "halfspace/image/exr_encode.h"

#include <OpenEXR/Iex.h>
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStringAttribute.h>

#include <algorithm>
#include <cstring>
#include <string>
#include <utility>

#include "halfspace/core/check.h"
#include "halfspace/image/image_errors.h"

namespace halfspace::HS_LANES {

namespace {

// Number of rows that are fetched and encoded together. A multiple of 16, the number of rows of a compressed block.
constexpr int kBandRows = 64;

// A file in memory. OpenEXR seeks back to write the table of blocks.
class MemoryStream : public Imf::OStream {
 public:
  explicit MemoryStream(const char* name) : OStream(name) {}

  void write(const char* from, int count) override {
    const std::size_t n = static_cast<std::size_t>(count);
    bytes_.resize(std::max(bytes_.size(), position_ + n));
    std::memcpy(bytes_.data() + position_, from, n);
    position_ += n;
  }
  uint64_t tellp() override { return position_; }
  void seekp(uint64_t position) override { position_ = position; }

  std::vector<std::byte> take() { return std::move(bytes_); }

 private:
  std::vector<std::byte> bytes_;
  std::size_t position_ = 0;
};

Imf::PixelType type_of(ExrSample sample) {
  if (sample == ExrSample::float16) return Imf::HALF;
  return sample == ExrSample::float32 ? Imf::FLOAT : Imf::UINT;
}

Imf::Header header_of(int width, int height, std::span<const ExrChannel> channels, const ImageText& text) {
  Imf::Header header(width, height);
  header.compression() = Imf::ZIP_COMPRESSION;
  for (const ExrChannel& c : channels) header.channels().insert(c.name, Imf::Channel(type_of(c.sample)));
  if (!text.software.empty()) header.insert("software", Imf::StringAttribute(text.software));
  if (!text.comment.empty()) header.insert("comments", Imf::StringAttribute(text.comment));
  if (!text.fingerprint.empty()) header.insert("fingerprint", Imf::StringAttribute(text.fingerprint));
  return header;
}

// The samples of one channel in a band of rows.
class Band {
 public:
  Band(const ExrChannel& channel, int width, int rows)
      : channel_(channel),
        row_bytes_(static_cast<std::size_t>(width) * sample_bytes(channel.sample)),
        samples_(row_bytes_ * static_cast<std::size_t>(rows)) {}

  void fill(int top, int end) {
    for (int y = top; y < end; ++y)
      channel_.fill_row(y, std::span(samples_).subspan(static_cast<std::size_t>(y - top) * row_bytes_, row_bytes_));
  }

  // Adds the samples to the frame buffer, as rows that begin with row `top`.
  void insert_into(Imf::FrameBuffer& buffer, int width, int top) {
    char* first = reinterpret_cast<char*>(samples_.data());
    const int rows = static_cast<int>(samples_.size() / row_bytes_);
    const Imath::Box2i area(Imath::V2i(0, top), Imath::V2i(width - 1, top + rows - 1));
    buffer.insert(channel_.name, Imf::Slice::Make(type_of(channel_.sample), first, area, sample_bytes(channel_.sample), row_bytes_));
  }

 private:
  const ExrChannel& channel_;
  std::size_t row_bytes_;
  std::vector<std::byte> samples_;
};

void write_bands(Imf::OutputFile& file, int width, int height, std::span<const ExrChannel> channels) {
  std::vector<Band> bands;
  for (const ExrChannel& c : channels) bands.emplace_back(c, width, std::min(height, kBandRows));
  for (int top = 0; top < height; top += kBandRows) {
    const int end = std::min(top + kBandRows, height);
    Imf::FrameBuffer buffer;
    for (Band& band : bands) {
      band.fill(top, end);
      band.insert_into(buffer, width, top);
    }
    file.setFrameBuffer(buffer);
    file.writePixels(end - top);
  }
}

}  // namespace

std::vector<std::byte> encode_exr(const std::filesystem::path& path, int width, int height, std::span<const ExrChannel> channels,
                                  const ImageText& text) {
  HS_CHECK(width > 0 && height > 0 && !channels.empty(), "write_exr: there are no pixels or no channels; expected at least one of each");
  MemoryStream stream(path.c_str());
  try {
    Imf::OutputFile file(stream, header_of(width, height, channels, text), 0);  // 0: no threads
    write_bands(file, width, height, channels);
  } catch (const Iex::BaseExc& e) {
    fail_writing(path, std::string("cannot write (the openexr encoder reported: ") + e.what() + ")");
  }
  return stream.take();
}

}  // namespace halfspace::HS_LANES
