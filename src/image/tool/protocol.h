// SPDX-License-Identifier: Apache-2.0
//
// What passes between halfspace-image-tool and the program that started it.
//
//   halfspace-image-tool read PATH FORMAT CHANNELS FILE_BYTES MOST_PIXELS
//
// writes to standard output a PictureHeader, then its pixels or, where width is 0, message_bytes of a message.
// CHANNELS is "gray" (the first channel of the file alone) or "rgba" (grey repeated, absent alpha opaque).
//
//   halfspace-image-tool write FORMAT
//
// reads from standard input a PictureHeader and its pixels, and writes to standard output a FileHeader, then the bytes
// of the file or, where file_bytes is 0, message_bytes of a message.
//
// FORMAT is OpenImageIO's name of it, for example "jpeg". Pixels are rows without gaps, the top row first, channels side
// by side, in the machine's byte order. A message is one line: what is wrong; what would be right.
#pragma once

#include <cstddef>
#include <cstdint>

namespace halfspace {

inline constexpr const char* kImageToolName = "halfspace-image-tool";
inline constexpr uint32_t kImageToolMagic = 0x31544948;  // "HIT1": the number changes with the protocol

/// What one channel of one pixel is: a code of 8 or 16 bits that fills its range, or a number.
enum class Sample : uint32_t { code8, code16, half, number };

inline constexpr std::size_t sample_bytes(Sample s) { return s == Sample::code8 ? 1 : s == Sample::number ? 4 : 2; }

struct PictureHeader {
  uint32_t magic = kImageToolMagic;
  int32_t width = 0, height = 0;
  /// 1 (grey, or depth where written), 3 or 4.
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
