// SPDX-License-Identifier: Apache-2.0
//
// The protocol between a decoder program (halfspace-image-tool, halfspace-jpeg-tool) and the program that started it.
//
//   TOOL serve
//
// reads requests from standard input, which is a socket, until it is closed. The answer to each request goes to standard output.
//
// To read an image, send a ToolRequest together with a descriptor of the file (SCM_RIGHTS). The answer is a PictureHeader, followed by
// the pixels or, if width is 0, by a message of message_bytes bytes. height is then 1 if the image exceeds a limit of the request.
//
// To write an image, send a ToolRequest, a PictureHeader, message_bytes bytes of text and the pixels. The text is four strings, each with a
// zero at its end: all of ImageText as lines, and its three parts. The answer is a FileHeader, followed by the bytes of the file or, if
// file_bytes is 0, by a message of message_bytes bytes. The tool exits after such a message, since it may not have read all pixels.
//
// Pixels are stored in rows without padding, top row first, with interleaved channels in native byte order. A message is one line:
// the problem; what was expected.
#pragma once

#include <cstddef>
#include <cstdint>

#include "halfspace/core/namespace.h"

namespace halfspace::HS_LANES {

inline constexpr const char* kImageToolName = "halfspace-image-tool";
inline constexpr const char* kJpegToolName = "halfspace-jpeg-tool";
inline constexpr uint32_t kImageToolMagic = 0x34544948;  // "HIT4": the digit is the protocol version

/// What a tool is asked to do. read_gray returns only the first channel of a file. read_color returns RGBA: gray is replicated, and alpha
/// is opaque if the file has none.
enum class ToolTask : uint32_t { read_gray, read_color, write };

struct ToolRequest {
  uint32_t magic = kImageToolMagic;
  ToolTask task = ToolTask::read_color;
  /// The name of the format (ToolFormat::name), for example "jpeg", padded with zeros.
  char format[16] = {};
  /// Limits for reading: pixels of the image, and bytes of the decoded pixels with all channels of the file.
  uint64_t max_pixels = 0, max_bytes = 0;
};

/// The type of one channel of a pixel: an 8-bit or 16-bit unsigned normalized integer, a half or a float.
enum class Sample : uint32_t { uint8, uint16, float16, float32 };

inline constexpr std::size_t sample_bytes(Sample s) { return s == Sample::uint8 ? 1 : s == Sample::float32 ? 4 : 2; }

struct PictureHeader {
  uint32_t magic = kImageToolMagic;
  int32_t width = 0, height = 0;
  /// 1 (gray, or depth when writing), 3 or 4.
  uint32_t channels = 0;
  Sample sample = Sample::uint8;
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

}  // namespace halfspace::HS_LANES
