// SPDX-License-Identifier: Apache-2.0
//
// What passes from halfspace-read-image to the program that started it.
//
//   halfspace-read-image PATH FORMAT FILE_BYTES MOST_PIXELS
//
// writes to standard output a header, then either width·height·4 bytes of RGBA (top row first) or, where width is 0,
// a message of one line: what is wrong; what would be right. FORMAT is OpenImageIO's name of it, for example "jpeg".
#pragma once

#include <cstdint>

namespace halfspace {

inline constexpr const char* kImageReaderName = "halfspace-read-image";
inline constexpr uint32_t kImageReaderMagic = 0x31495248;  // "HRI1": the number changes with the protocol

struct ImageReaderHeader {
  uint32_t magic = kImageReaderMagic;
  int32_t width = 0, height = 0;
  uint32_t message_bytes = 0;
};

}  // namespace halfspace
