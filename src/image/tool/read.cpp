// SPDX-License-Identifier: Apache-2.0
#include "halfspace/image/tool/read.h"

#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <memory>
#include <new>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "halfspace/image/image_limits.h"
#include "halfspace/image/tool/failure.h"
#include "halfspace/image/tool/mapped_file.h"
#include "halfspace/image/tool/picture.h"
#include "halfspace/image/tool/protocol.h"
#include "halfspace/image/tool/radiance_header.h"
#include "halfspace/image/tool/read_webp.h"
#include "halfspace/image/tool/texture_file.h"

namespace halfspace::HS_LANES {

namespace {

// The name under which OpenImageIO opens the file of a request.
std::string name_of(const ReadRequest& request) { return "/proc/self/fd/" + std::to_string(request.file); }

// OpenImageIO's messages mention the name of the file, in quotes. That name means nothing to users, whose message begins with the actual
// name.
std::string without_name(std::string text, const ReadRequest& request) {
  const std::string name = '"' + name_of(request) + '"';
  for (const std::string& mention : {" (" + name + ")", " of " + name, " " + name, name}) {
    for (std::size_t at = 0; (at = text.find(mention)) != std::string::npos;) text.erase(at, mention.size());
  }
  return text;
}

Failure damaged(const ReadRequest& request, const std::string& why) {
  return {"cannot be read as " + request.format + " (" + one_line(without_name(why, request)) + "); expected a complete image file"};
}

// Integers of up to 16 bits are kept. All other types become floats; signed and 32-bit integers are scaled to a maximum of 1.
Sample sample_of(const OIIO::TypeDesc& type) {
  if (type.basetype == OIIO::TypeDesc::UINT8) return Sample::uint8;
  return type.basetype == OIIO::TypeDesc::UINT16 ? Sample::uint16 : Sample::float32;
}

// How OpenImageIO describes the alpha of a file.
enum class Alpha : uint8_t { none, straight, premultiplied };

// Returns the index of the alpha channel, or -1. OpenImageIO 2.4 states a wrong index for GIF, but the name is right.
int alpha_channel_of(const OIIO::ImageSpec& spec) {
  if (spec.alpha_channel < spec.nchannels) return spec.alpha_channel;
  return spec.channelindex("A");
}

// OpenImageIO was asked not to change colors, and marks those that are straight. It premultiplies WebP all the same. OpenEXR
// is converted later, with its infinities (image_samples.h).
Alpha alpha_of(const OIIO::ImageSpec& spec, const std::string& format) {
  if (alpha_channel_of(spec) < 0) return Alpha::none;
  const int targa_type = spec.get_int_attribute("targa:alpha_type", 3);  // TGA 2.0: 1 and 2 are undefined, 3 straight, 4 premultiplied
  if (targa_type == 1 || targa_type == 2) return Alpha::none;
  const bool may_be_premultiplied = format == "tiff" || format == "webp" || targa_type == 4;
  return may_be_premultiplied && spec.get_int_attribute("oiio:UnassociatedAlpha") == 0 ? Alpha::premultiplied : Alpha::straight;
}

// Returns the number of channels to read. Only the first is needed for gray, unless it has to be divided by alpha.
int channels_to_read(const OIIO::ImageSpec& spec, const ReadRequest& request) {
  return request.gray && alpha_of(spec, request.format) != Alpha::premultiplied ? 1 : spec.nchannels;
}

Window data_window(const OIIO::ImageSpec& spec) { return {spec.x, spec.y, spec.width, spec.height}; }

// Returns the area of the picture. An OpenEXR file can store a part of it, or more ("Technical Introduction to OpenEXR", section Display
// Window and Data Window).
Window picture_window(const OIIO::ImageSpec& spec, const ReadRequest& request) {
  if (request.format != "openexr") return data_window(spec);
  return {spec.full_x, spec.full_y, spec.full_width, spec.full_height};
}

void check_spec(const OIIO::ImageSpec& spec, const ReadRequest& request) {
  if (spec.depth > 1) throw Failure{"has several layers of pixels; expected a flat image"};
  if (spec.nchannels < 1 || spec.nchannels > kMaxChannels) {
    throw Failure{"has " + std::to_string(spec.nchannels) + " channels; expected 1 to " + std::to_string(kMaxChannels)};
  }
  const auto channels = static_cast<uint64_t>(channels_to_read(spec, request));
  for (const Window& w : {data_window(spec), picture_window(spec, request)})
    check_claimed_size(request, w.width, w.height, channels * sample_bytes(sample_of(spec.format)));
  const uint64_t tile = static_cast<uint64_t>(std::max(spec.tile_width, 0)) * static_cast<uint64_t>(std::max(spec.tile_height, 0));
  if (spec.deep || tile > kMaxImagePixels) throw Failure{"has deep pixels or oversized tiles; expected a flat image"};
}

OIIO::TypeDesc type_of(Sample sample) {
  if (sample == Sample::uint8) return OIIO::TypeDesc::UINT8;
  return sample == Sample::uint16 ? OIIO::TypeDesc::UINT16 : OIIO::TypeDesc::FLOAT;
}

// Returns the orientation of the stored rows (see upright). EXIF data is ignored, as in JPEG files: texture coordinates refer to the stored
// pixels. OpenImageIO 2.4 exchanges two of the orientations of Radiance files, so their header is read here.
int orientation_of(const OIIO::ImageSpec& spec, const ReadRequest& request) {
  if (request.format == "tiff") return spec.get_int_attribute("Orientation", 1);
  if (request.format != "hdr") return 1;
  const MappedFile file(request.file, request.file_bytes);
  return radiance_orientation({reinterpret_cast<const char*>(file.data()), file.size()});
}

// Converts the stored pixels to an upright picture with straight alpha.
Picture arranged(Picture p, const OIIO::ImageSpec& spec, const ReadRequest& request) {
  if (alpha_of(spec, request.format) == Alpha::premultiplied) divide_by_alpha(p);
  // Programs that do not know alpha leave the fourth byte of a pixel 0. All other viewers show such files.
  if (request.format == "bmp" || request.format == "targa") drop_empty_alpha(p);
  const Window stored = data_window(spec), wanted = picture_window(spec, request);
  if (stored != wanted) p = in_window(p, stored, wanted);
  return upright(std::move(p), orientation_of(spec, request));
}

Picture read_picture(const ReadRequest& request) {
  if (request.format == "dds") return read_dds(request);
  if (request.format == "ktx2") return read_ktx2(request);
  if (request.format == "webp") {
    if (std::optional<Picture> p = read_webp(request)) return *std::move(p);
  }
  // Uses create() instead of open(), which would try all other readers if the matching one rejects the file.
  const std::unique_ptr<OIIO::ImageInput> input = OIIO::ImageInput::create(request.format);
  if (input == nullptr) throw Failure{"is " + request.format + ", which this OpenImageIO cannot read; expected PNG or JPEG"};
  OIIO::ImageSpec spec;
  OIIO::ImageSpec hints;
  hints.attribute("oiio:UnassociatedAlpha", 1);  // keep straight alpha as it is
  if (!input->open(name_of(request), spec, hints)) throw damaged(request, input->geterror());
  check_spec(spec, request);
  const int channels = channels_to_read(spec, request);
  const bool has_alpha = channels > 1 && alpha_of(spec, request.format) != Alpha::none;
  Picture p = empty_picture(
      spec.width, spec.height,
      {.channels = channels, .alpha_channel = has_alpha ? alpha_channel_of(spec) : -1, .sample = sample_of(spec.format), .pixels = {}});
  if (!input->read_image(0, 0, 0, p.channels, type_of(p.sample), p.pixels.data())) throw damaged(request, input->geterror());
  return arranged(std::move(p), spec, request);
}

// Returns the bytes of one fully opaque sample.
std::vector<std::byte> opaque(Sample sample) {
  std::vector<std::byte> bytes(sample_bytes(sample), std::byte{255});
  const float one = 1.0f;
  if (sample == Sample::float32) std::memcpy(bytes.data(), &one, sizeof one);
  return bytes;
}

// Writes channels row by row, which avoids a second copy of the image. `from`: the channel of p for each channel of the answer; -1: opaque.
void put_channels(const Picture& p, std::span<const int> from) {
  const std::size_t size = sample_bytes(p.sample), stride = p.pixel_bytes();
  const std::vector<std::byte> one = opaque(p.sample);
  std::vector<std::byte> row(static_cast<std::size_t>(p.width) * from.size() * size);
  for (std::size_t pixel = 0; pixel < p.pixels.size();) {
    for (std::byte* to = row.data(); to != row.data() + row.size(); pixel += stride) {
      for (const int channel : from) {
        const std::byte* sample = channel < 0 ? one.data() : p.pixels.data() + pixel + size * static_cast<std::size_t>(channel);
        to = std::copy_n(sample, size, to);
      }
    }
    std::fwrite(row.data(), 1, row.size(), stdout);
  }
}

// Writes the first channel, or RGBA. If there are fewer than three color channels, the first one is written as gray. If there is no alpha
// channel, alpha is opaque.
void put_pixels(const Picture& p, bool gray) {
  if (gray) return put_channels(p, std::array{0});
  const bool colors = p.channels - (p.alpha_channel >= 0 ? 1 : 0) >= 3;
  put_channels(p, std::array{0, colors ? 1 : 0, colors ? 2 : 0, p.alpha_channel});
}

}  // namespace

bool read_and_answer(const ReadRequest& request) {
  try {
    const Picture p = read_picture(request);
    put_answer(PictureHeader{kImageToolMagic, p.width, p.height, request.gray ? 1u : 4u, p.sample, 0}, "");
    put_pixels(p, request.gray);
  } catch (const Failure& failure) {
    report_failure(failure);
  } catch (const std::bad_alloc&) {
    report_failure({"not enough memory; expected a smaller image"});
    return false;
  } catch (const std::exception& e) {
    report_failure(damaged(request, e.what()));
  }
  return true;
}

}  // namespace halfspace::HS_LANES
