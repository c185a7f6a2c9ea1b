// SPDX-License-Identifier: Apache-2.0
#include "halfspace/image/tool/read.h"

#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cstring>
#include <memory>
#include <new>
#include <vector>

#include "halfspace/image/image_limits.h"
#include "halfspace/image/tool/failure.h"
#include "halfspace/image/tool/protocol.h"

namespace halfspace::inline HS_LANES_NAMESPACE {

namespace {

// A decoded image with the requested channels: all channels of the file, or only the first.
struct Picture {
  int width = 0, height = 0, channels = 0, alpha_channel = -1;
  Sample sample = Sample::uint8;
  std::vector<std::byte> pixels;
};

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

void check_spec(const OIIO::ImageSpec& spec, const ReadRequest& request) {
  if (spec.depth > 1) throw Failure{"has several layers of pixels; expected a flat image"};
  if (spec.nchannels < 1 || spec.nchannels > kMaxChannels) {
    throw Failure{"has " + std::to_string(spec.nchannels) + " channels; expected 1 to " + std::to_string(kMaxChannels)};
  }
  const auto channels = static_cast<uint64_t>(request.gray ? 1 : spec.nchannels);
  check_claimed_size(request, spec.width, spec.height, channels * sample_bytes(sample_of(spec.format)));
  const uint64_t tile = static_cast<uint64_t>(std::max(spec.tile_width, 0)) * static_cast<uint64_t>(std::max(spec.tile_height, 0));
  if (spec.deep || tile > kMaxImagePixels) throw Failure{"has deep pixels or oversized tiles; expected a flat image"};
}

OIIO::TypeDesc type_of(Sample sample) {
  if (sample == Sample::uint8) return OIIO::TypeDesc::UINT8;
  return sample == Sample::uint16 ? OIIO::TypeDesc::UINT16 : OIIO::TypeDesc::FLOAT;
}

Picture read_picture(const ReadRequest& request) {
  // Uses create() instead of open(), which would try all other readers if the matching one rejects the file.
  const std::unique_ptr<OIIO::ImageInput> input = OIIO::ImageInput::create(request.format);
  if (input == nullptr) throw Failure{"is " + request.format + ", which this OpenImageIO cannot read; expected PNG or JPEG"};
  OIIO::ImageSpec spec;
  OIIO::ImageSpec hints;
  hints.attribute("oiio:UnassociatedAlpha", 1);  // keep straight alpha as it is
  if (!input->open(name_of(request), spec, hints)) throw damaged(request, input->geterror());
  check_spec(spec, request);
  Picture p{spec.width, spec.height, request.gray ? 1 : spec.nchannels, request.gray ? -1 : spec.alpha_channel, sample_of(spec.format), {}};
  p.pixels.resize(static_cast<std::size_t>(p.width) * static_cast<std::size_t>(p.height) * static_cast<std::size_t>(p.channels) *
                  sample_bytes(p.sample));
  if (!input->read_image(0, 0, 0, p.channels, type_of(p.sample), p.pixels.data())) throw damaged(request, input->geterror());
  return p;
}

// Returns the bytes of one fully opaque sample.
std::vector<std::byte> opaque(Sample sample) {
  std::vector<std::byte> bytes(sample_bytes(sample), std::byte{255});
  const float one = 1.0f;
  if (sample == Sample::float32) std::memcpy(bytes.data(), &one, sizeof one);
  return bytes;
}

// Writes RGBA row by row, which avoids a second copy of the image. If there are fewer than three color channels, the first one is
// written as gray. If there is no alpha channel, alpha is opaque.
void put_rgba(const Picture& p) {
  const int colors = p.channels - (p.alpha_channel >= 0 ? 1 : 0);
  const int from[4] = {0, colors >= 3 ? 1 : 0, colors >= 3 ? 2 : 0, p.alpha_channel};
  const std::size_t size = sample_bytes(p.sample);
  const std::size_t stride = size * static_cast<std::size_t>(p.channels);
  const std::vector<std::byte> one = opaque(p.sample);
  std::vector<std::byte> row(static_cast<std::size_t>(p.width) * 4 * size);
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

}  // namespace

bool read_and_answer(const ReadRequest& request) {
  try {
    const Picture p = read_picture(request);
    put_answer(PictureHeader{kImageToolMagic, p.width, p.height, request.gray ? 1u : 4u, p.sample, 0}, "");
    if (request.gray) {
      std::fwrite(p.pixels.data(), 1, p.pixels.size(), stdout);
    } else {
      put_rgba(p);
    }
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

}  // namespace halfspace::inline HS_LANES_NAMESPACE
