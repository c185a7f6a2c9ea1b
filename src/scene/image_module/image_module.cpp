// SPDX-License-Identifier: Apache-2.0
//
// The image module: decodes what is not PNG through OpenImageIO. A shared library of its own, because merely linking
// OpenImageIO costs a program 0.2 s of start-up. Files are not trusted: the format is fixed by the caller (so that
// OpenImageIO does not try its other readers), and sizes are checked before anything is allocated for the pixels.
#include "scene/image_module/image_module.h"

#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <new>
#include <string>
#include <vector>

namespace {

// A picture may claim this many pixels for each byte of its file (constant JPEG: about 100; bilevel TIFF: 8000).
constexpr uint64_t kMostPixelsPerByte = 8192;
constexpr int kMostChannels = 64;

struct Failure {
  std::string text;
};

// OpenImageIO's messages may have several lines and name the path: one line is kept.
std::string one_line(std::string text) {
  std::replace_if(text.begin(), text.end(), [](unsigned char c) { return c < 0x20; }, ' ');
  if (text.size() > 200) text.resize(200);
  while (!text.empty() && (text.back() == ' ' || text.back() == '.')) text.pop_back();
  return text.empty() ? "the decoder gives no reason" : text;
}

Failure damaged(const HalfspaceImageRequest& request, const std::string& why) {
  return {std::string("cannot be read as ") + request.format + " (" + one_line(why) + "); expected a whole image file"};
}

void check_spec(const OIIO::ImageSpec& spec, const HalfspaceImageRequest& request) {
  const std::string size = std::to_string(spec.width) + "x" + std::to_string(spec.height) + " pixels";
  if (spec.width < 1 || spec.height < 1 || spec.depth > 1) throw Failure{"has " + size + "; expected a flat picture of at least 1x1"};
  const uint64_t pixels = static_cast<uint64_t>(spec.width) * static_cast<uint64_t>(spec.height);
  if (pixels > request.most_pixels) throw Failure{"claims " + size + "; expected at most 2^28 pixels"};
  if (pixels > (1u << 20) && pixels / kMostPixelsPerByte > request.file_bytes) {
    throw Failure{"claims " + size + " but has only " + std::to_string(request.file_bytes) + " bytes; expected a whole image file"};
  }
  if (spec.nchannels < 1 || spec.nchannels > kMostChannels) {
    throw Failure{"has " + std::to_string(spec.nchannels) + " channels; expected 1 to " + std::to_string(kMostChannels)};
  }
  const uint64_t tile = static_cast<uint64_t>(std::max(spec.tile_width, 0)) * static_cast<uint64_t>(std::max(spec.tile_height, 0));
  if (spec.deep || tile > request.most_pixels) throw Failure{"has deep pixels or oversized tiles; expected a flat picture"};
  if (spec.format.is_floating_point()) {
    throw Failure{"holds floating-point (linear) numbers; expected a picture of 8 or 16 bits a channel, such as PNG or JPEG"};
  }
}

// Which channel of the file becomes red, green, blue, alpha; −1 is opaque.
struct ChannelMap {
  int from[4];
};

ChannelMap map_channels(const OIIO::ImageSpec& spec) {
  const int colors = spec.nchannels - (spec.alpha_channel >= 0 ? 1 : 0);
  ChannelMap map = {{0, 0, 0, spec.alpha_channel}};
  if (colors >= 3) map = {{0, 1, 2, spec.alpha_channel}};
  return map;
}

void read_image(const HalfspaceImageRequest& request) {
  const std::unique_ptr<OIIO::ImageInput> input = OIIO::ImageInput::create(request.format);
  if (input == nullptr) {
    OIIO::geterror();
    throw Failure{std::string("is ") + request.format + ", which this OpenImageIO cannot read; expected PNG or JPEG"};
  }
  OIIO::ImageSpec spec;
  OIIO::ImageSpec hints;
  hints.attribute("oiio:UnassociatedAlpha", 1);  // straight alpha stays straight
  if (!input->open(request.path, spec, hints)) throw damaged(request, input->geterror());
  check_spec(spec, request);
  const std::size_t width = static_cast<std::size_t>(spec.width);
  const std::size_t height = static_cast<std::size_t>(spec.height);
  uint8_t* out = request.allocate(request.user, spec.width, spec.height);
  if (out == nullptr) throw std::bad_alloc();

  const std::size_t channels = static_cast<std::size_t>(spec.nchannels);
  std::vector<uint8_t> pixels(width * height * channels);
  if (!input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::UINT8, pixels.data())) throw damaged(request, input->geterror());
  const ChannelMap map = map_channels(spec);
  for (std::size_t i = 0; i < width * height; ++i) {
    for (std::size_t c = 0; c < 4; ++c) out[4 * i + c] = map.from[c] < 0 ? uint8_t{255} : pixels[i * channels + static_cast<std::size_t>(map.from[c])];
  }
  input->close();
}

}  // namespace

extern "C" __attribute__((visibility("default"))) int halfspace_read_image_1(const HalfspaceImageRequest* request) {
  std::string error;
  try {
    // The program has its own threads; a decoder's team would only add start-up time.
    OIIO::attribute("threads", 1);
    OIIO::attribute("exr_threads", -1);
    OIIO::attribute("try_all_readers", 0);
    OIIO::attribute("limits:channels", kMostChannels);
    OIIO::attribute("limits:imagesize_MB", 4096);
    OIIO::geterror();  // of attributes that this version does not have
    read_image(*request);
    return 1;
  } catch (const Failure& failure) {
    error = failure.text;
  } catch (const std::bad_alloc&) {
    error = "needs more memory than there is; expected a smaller picture";
  } catch (const std::exception& e) {
    error = damaged(*request, e.what()).text;
  }
  std::snprintf(request->error, request->error_size, "%s", error.c_str());
  return 0;
}
