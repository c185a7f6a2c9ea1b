// SPDX-License-Identifier: Apache-2.0
//
// The part of a decoder program that does not depend on a format: receives requests and limits the resources that they may use.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "halfspace/core/namespace.h"

namespace halfspace::HS_LANES {

struct ReadRequest {
  /// An open file. The service closes it after the request.
  int file = -1;
  uint64_t file_bytes = 0;
  /// See ToolRequest.
  std::string format;
  /// Read only the first channel instead of RGBA.
  bool gray = false;
  /// See ToolRequest.
  uint64_t max_pixels = 0, max_bytes = 0;
};

/// Functions that handle a request and write the answer (see protocol.h) to standard output. They return whether the tool can handle
/// further requests.
struct ToolHandlers {
  bool (*read)(const ReadRequest& request) = nullptr;
  /// nullptr if the tool does not write images.
  bool (*write)(const std::string& format) = nullptr;
};

/// Handles requests until standard input is closed. Ends the process if the program that started it ends, or if a request uses too much
/// CPU time. Returns the exit code of the program.
int serve_requests(const ToolHandlers& handlers);

/// Reads from standard input, unbuffered. Throws Failure if it ends early.
void receive(void* memory, std::size_t bytes);

/// Throws Failure if a header claims more pixels than Halfspace supports, than the request permits, or than a file of this size can
/// contain. bytes_per_pixel: size of a decoded pixel, with all channels.
void check_claimed_size(const ReadRequest& request, int64_t width, int64_t height, uint64_t bytes_per_pixel);

}  // namespace halfspace::HS_LANES
