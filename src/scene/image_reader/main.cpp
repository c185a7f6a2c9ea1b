// SPDX-License-Identifier: Apache-2.0
//
// halfspace-read-image: decodes what is not PNG, through OpenImageIO, for halfspace (see protocol.h). It is a program
// of its own for two reasons. Files are not trusted, and decoders of many formats have many faults: OpenImageIO 2.4
// dies on a public JPEG with a damaged colour profile. Here such a file ends this process and no other. And merely
// linking OpenImageIO costs a program 0.2 s of start-up, which most runs of halfspace need not pay.
#include "scene/image_reader/protocol.h"

#include <OpenImageIO/imageio.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <new>
#include <string>
#include <vector>

namespace halfspace {

namespace {

// A picture may claim this many pixels for each byte of its file (constant JPEG: about 100; bilevel TIFF: 8000).
constexpr uint64_t kMostPixelsPerByte = 8192;
constexpr int kMostChannels = 64;
constexpr rlim_t kCpuSeconds = 60;
constexpr rlim_t kAddressSpace = rlim_t{6} << 30;  // 2^28 pixels of 8 bytes, as many decoded, and the libraries

struct Request {
  std::string path, format;
  uint64_t file_bytes = 0, most_pixels = 0;
};

struct Failure {
  std::string text;
};

struct Picture {
  int width = 0, height = 0;
  std::vector<uint8_t> rgba;
};

// OpenImageIO's messages may have several lines.
std::string one_line(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](unsigned char c) { return c < 0x20; }, ' ');
  if (text.size() > 200) text.resize(200);
  while (!text.empty() && (text.back() == ' ' || text.back() == '.')) text.pop_back();
  return text.empty() ? "the decoder gives no reason" : text;
}

Failure damaged(const Request& request, const std::string& why) {
  return {"cannot be read as " + request.format + " (" + one_line(why) + "); expected a whole image file"};
}

void check_spec(const OIIO::ImageSpec& spec, const Request& request) {
  const std::string size = std::to_string(spec.width) + "x" + std::to_string(spec.height) + " pixels";
  if (spec.width < 1 || spec.height < 1 || spec.depth > 1) throw Failure{"has " + size + "; expected a flat picture of at least 1x1"};
  const uint64_t pixels = static_cast<uint64_t>(spec.width) * static_cast<uint64_t>(spec.height);
  if (pixels > request.most_pixels) throw Failure{"claims " + size + "; expected at most 2^28 pixels and 32768 on an edge"};
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

// Three colours, or one repeated; a missing alpha is opaque.
std::vector<uint8_t> to_rgba(const std::vector<uint8_t>& pixels, const OIIO::ImageSpec& spec) {
  const int colors = spec.nchannels - (spec.alpha_channel >= 0 ? 1 : 0);
  const int from[4] = {0, colors >= 3 ? 1 : 0, colors >= 3 ? 2 : 0, spec.alpha_channel};
  const std::size_t channels = static_cast<std::size_t>(spec.nchannels);
  const std::size_t count = pixels.size() / channels;
  std::vector<uint8_t> rgba(4 * count);
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t c = 0; c < 4; ++c)
      rgba[4 * i + c] = from[c] < 0 ? uint8_t{255} : pixels[i * channels + static_cast<std::size_t>(from[c])];
  }
  return rgba;
}

Picture read_picture(const Request& request) {
  // create, not open: open would try every other reader on a file that the right one refuses.
  const std::unique_ptr<OIIO::ImageInput> input = OIIO::ImageInput::create(request.format);
  if (input == nullptr) throw Failure{"is " + request.format + ", which this OpenImageIO cannot read; expected PNG or JPEG"};
  OIIO::ImageSpec spec;
  OIIO::ImageSpec hints;
  hints.attribute("oiio:UnassociatedAlpha", 1);  // straight alpha stays straight
  if (!input->open(request.path, spec, hints)) throw damaged(request, input->geterror());
  check_spec(spec, request);
  const std::size_t count = static_cast<std::size_t>(spec.width) * static_cast<std::size_t>(spec.height);
  std::vector<uint8_t> pixels(count * static_cast<std::size_t>(spec.nchannels));
  if (!input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::UINT8, pixels.data())) throw damaged(request, input->geterror());
  return {spec.width, spec.height, to_rgba(pixels, spec)};
}

// A decoder that loops ends after a minute, one that wants all memory is refused it; none leaves a core file; the program that asked takes
// this one with it.
void limit_this_process() {
  const rlimit cpu = {kCpuSeconds, kCpuSeconds};
  ::setrlimit(RLIMIT_CPU, &cpu);
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)  // these reserve terabytes of addresses
  const rlimit memory = {kAddressSpace, kAddressSpace};
  ::setrlimit(RLIMIT_AS, &memory);
#endif
  const rlimit core = {0, 0};
  ::setrlimit(RLIMIT_CORE, &core);
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  OIIO::attribute("threads", 1);
  OIIO::attribute("exr_threads", -1);
  OIIO::attribute("limits:channels", kMostChannels);
  OIIO::attribute("limits:imagesize_MB", 4096);
}

void answer(const Picture& picture, const std::string& message) {
  const ImageReaderHeader header{kImageReaderMagic, picture.width, picture.height, static_cast<uint32_t>(message.size())};
  std::fwrite(&header, sizeof header, 1, stdout);
  std::fwrite(message.data(), 1, message.size(), stdout);
  std::fwrite(picture.rgba.data(), 1, picture.rgba.size(), stdout);
  std::fflush(stdout);
}

void read_and_answer(const Request& request) {
  try {
    answer(read_picture(request), "");
  } catch (const Failure& failure) {
    answer({}, failure.text);
  } catch (const std::bad_alloc&) {
    answer({}, "needs more memory than there is; expected a smaller picture");
  } catch (const std::exception& e) {
    answer({}, damaged(request, e.what()).text);
  }
}

}  // namespace

}  // namespace halfspace

int main(int argc, char** argv) {
  if (argc != 5) {
    std::fputs("halfspace-read-image serves halfspace; usage: halfspace-read-image PATH FORMAT FILE_BYTES MOST_PIXELS\n", stderr);
    return 2;
  }
  halfspace::limit_this_process();
  halfspace::read_and_answer({argv[1], argv[2], std::strtoull(argv[3], nullptr, 10), std::strtoull(argv[4], nullptr, 10)});
  std::_Exit(0);  // OpenImageIO's statics have nothing left to do
}
