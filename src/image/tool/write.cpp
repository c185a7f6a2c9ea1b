// SPDX-License-Identifier: Apache-2.0
#include "halfspace/image/tool/write.h"

#include <OpenImageIO/imageio.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <memory>
#include <vector>

#include "halfspace/image/image_limits.h"
#include "halfspace/image/tool/failure.h"
#include "halfspace/image/tool/protocol.h"
#include "halfspace/image/tool/service.h"

namespace halfspace::HS_LANES {

namespace {

// Number of rows that are received, converted and encoded together. A multiple of 16, the number of rows of an EXR block.
constexpr int kBandRows = 64;

// The encoded file. Encoders need a seekable file, which a pipe is not, so this is an unnamed file in memory.
class MemoryFile {
 public:
  MemoryFile() : fd_(::memfd_create("halfspace", MFD_CLOEXEC)) {
    if (fd_ < 0) throw Failure{std::string("cannot create a file in memory (") + std::strerror(errno) + ")"};
  }
  ~MemoryFile() { ::close(fd_); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  std::string name() const { return "/proc/self/fd/" + std::to_string(fd_); }

  uint64_t size() const {
    struct stat s = {};
    return ::fstat(fd_, &s) == 0 ? static_cast<uint64_t>(s.st_size) : 0;
  }

  void copy_to_output() const {
    std::vector<char> buffer(1 << 20);
    off_t offset = 0;
    for (ssize_t n = 0; (n = ::pread(fd_, buffer.data(), buffer.size(), offset)) > 0; offset += n) {
      std::fwrite(buffer.data(), 1, static_cast<std::size_t>(n), stdout);
    }
  }

 private:
  int fd_;
};

PictureHeader receive_header() {
  PictureHeader h;
  receive(&h, sizeof h);
  if (h.magic != kImageToolMagic) throw Failure{std::string(kImageToolName) + " and the program that started it have different versions"};
  check_image_size(static_cast<uint64_t>(h.width), static_cast<uint64_t>(h.height), "picture");
  if ((h.channels != 1 && h.channels != 3 && h.channels != 4) || h.sample > Sample::float32) throw Failure{"the image header is damaged"};
  return h;
}

OIIO::TypeDesc type_of(Sample sample) {
  if (sample == Sample::uint8) return OIIO::TypeDesc::UINT8;
  if (sample == Sample::uint16) return OIIO::TypeDesc::UINT16;
  return sample == Sample::float16 ? OIIO::TypeDesc::HALF : OIIO::TypeDesc::FLOAT;
}

struct Text {
  std::string lines, software, comment, fingerprint;
};

Text receive_text(const PictureHeader& h) {
  constexpr uint32_t kMaxTextBytes = 1 << 20;
  if (h.message_bytes > kMaxTextBytes) throw Failure{"the text of the image is too long; expected at most 1 MiB"};
  std::string strings(h.message_bytes, '\0');
  receive(strings.data(), strings.size());
  Text text;
  std::size_t at = 0;
  for (std::string* part : {&text.lines, &text.software, &text.comment, &text.fingerprint}) {
    const std::size_t end = std::min(strings.find('\0', at), strings.size());
    *part = strings.substr(at, end - at);
    at = std::min(end + 1, strings.size());
  }
  return text;
}

void add_text(OIIO::ImageSpec& spec, const Text& text, const std::string& format) {
  const auto add = [&spec](const char* name, const std::string& value) {
    if (!value.empty()) spec.attribute(name, value);
  };
  if (format == "openexr") {
    add("software", text.software);
    add("comments", text.comment);
    add("fingerprint", text.fingerprint);
  } else {
    add("ImageDescription", text.lines);
  }
}

OIIO::ImageSpec spec_of(const PictureHeader& h, const std::string& format) {
  OIIO::ImageSpec spec(h.width, h.height, static_cast<int>(h.channels), type_of(h.sample));
  if (h.channels == 1) spec.channelnames = {"Z"};
  spec.attribute("oiio:ColorSpace", h.sample == Sample::uint8 ? "sRGB" : "Linear");
  spec.attribute("oiio:UnassociatedAlpha", format == "tiff" ? 1 : 0);  // store the pixels unchanged
  spec.attribute("DateTime", "");  // by default, OpenImageIO writes the current time, so equal images would give different files
  spec.attribute("compression", format == "jpeg" ? "jpeg:95" : "zip");
  spec.attribute("jpeg:subsampling", "4:4:4");  // keeps edges between colors sharp
  return spec;
}

void encode(const std::string& format, const MemoryFile& file) {
  const PictureHeader h = receive_header();
  const std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create(format);
  if (output == nullptr) throw Failure{"this OpenImageIO cannot write " + format};
  const auto check = [&](bool ok) {
    if (!ok) throw Failure{"the " + format + " encoder reported: " + one_line(output->geterror())};
  };
  OIIO::ImageSpec spec = spec_of(h, format);
  add_text(spec, receive_text(h), format);
  check(output->open(file.name(), spec));
  std::vector<std::byte> band(row_bytes(h) * static_cast<std::size_t>(std::min(h.height, kBandRows)));
  for (int top = 0; top < h.height; top += kBandRows) {
    const int end = std::min(top + kBandRows, h.height);
    receive(band.data(), row_bytes(h) * static_cast<std::size_t>(end - top));
    check(output->write_scanlines(top, end, 0, type_of(h.sample), band.data()));
  }
  check(output->close());
}

void reject(const std::string& message) { put_answer(FileHeader{kImageToolMagic, static_cast<uint32_t>(message.size()), 0}, message); }

}  // namespace

bool write_and_answer(const std::string& format) {
  try {
    const MemoryFile file;
    encode(format, file);
    put_answer(FileHeader{kImageToolMagic, 0, file.size()}, "");
    file.copy_to_output();
    return true;
  } catch (const Failure& failure) {
    reject(failure.text);
  } catch (const std::exception& e) {
    reject("the " + format + " encoder reported: " + one_line(e.what()));
  }
  return false;
}

}  // namespace halfspace::HS_LANES
