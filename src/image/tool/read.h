// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

namespace halfspace {

struct ReadRequest {
  std::string path, format;
  /// Read only the first channel instead of RGBA.
  bool gray = false;
  uint64_t file_bytes = 0, max_pixels = 0;
};

/// Decodes the file and writes the answer (see protocol.h) to standard output.
void read_and_answer(const ReadRequest& request);

}  // namespace halfspace
