// SPDX-License-Identifier: Apache-2.0
//
// `render -o - --format`: pictures without a file format, for programs such as ffmpeg.
#pragma once

#include <memory>

#include "cli/output_files.h"

namespace halfspace {

/// Returns a stream of pictures that are written to standard output as soon as they are complete:
///   y4m      YUV4MPEG2 at `fps` frames per second, 4:4:4, 8 bits, BT.709 with limited range (16 to 235 and 240). Alpha is dropped.
///   rgb24    3 bytes per pixel, sRGB. Alpha is dropped.
///   rgba     4 bytes per pixel, sRGB, straight alpha
///   rgbaf32  4 floats per pixel in native byte order: linear light, straight alpha
/// The first row is the top one, and nothing separates rows or pictures, except for the headers of y4m.
std::unique_ptr<PictureSink> make_raw_stream(RawStream format, double fps);

}  // namespace halfspace
