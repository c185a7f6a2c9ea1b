// SPDX-License-Identifier: Apache-2.0
//
// The protocol between halfspace-image-tool and the program that started it.
//
//   halfspace-image-tool read PATH FORMAT CHANNELS FILE_BYTES MAX_PIXELS
//
// writes a PictureHeader to standard output, followed by the pixels or, if width is 0, by a message of message_bytes bytes.
// CHANNELS is "gray" (only the first channel of the file) or "rgba" (gray replicated, missing alpha opaque).
//
//   halfspace-image-tool write FORMAT
//
// reads a PictureHeader and its pixels from standard input. It writes a FileHeader to standard output, followed by the bytes of
// the file or, if file_bytes is 0, by a message of message_bytes bytes.
//
// FORMAT is OpenImageIO's name for the format, for example "jpeg". Pixels are stored in rows without padding, top row first, with
// interleaved channels in native byte order. A message is one line: the problem; what was expected.
#pragma once

#include <cstddef>
#include <cstdint>

namespace halfspace {

inline constexpr const char* kImageToolName = "halfspace-image-tool";
inline constexpr uint32_t kImageToolMagic = 0x31544948;  // "HIT1": the digit is the protocol version

/// The type of one channel of a pixel: an 8-bit or 16-bit code that spans its full range, a half or a float.
enum class Sample : uint32_t { code8, code16, half, number };

inline constexpr std::size_t sample_bytes(Sample s) { return s == Sample::code8 ? 1 : s == Sample::number ? 4 : 2; }

struct PictureHeader {
  uint32_t magic = kImageToolMagic;
  int32_t width = 0, height = 0;
  /// 1 (gray, or depth when writing), 3 or 4.
  uint32_t channels = 0;
  Sample sample = Sample::code8;
  uint32_t message_bytes = 0;
};

struct FileHeader {
  uint32_t magic = kImageToolMagic;
  uint32_t message_bytes = 0;
  uint64_t file_bytes = 0;
};

inline constexpr std::size_t row_bytes(const PictureHeader& h) {
  return static_cast<std::size_t>(h.width) * h.channels * sample_bytes(h.sample);
}

}  // namespace halfspace
