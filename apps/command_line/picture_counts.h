// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace halfspace {

/// How far a process has come with its pictures.
struct PictureCounts {
  int64_t done = 0;  ///< rendered, kept or left out
  int64_t kept = 0;  ///< of these, those that were not rendered; rates and estimates do not count them
};

}  // namespace halfspace
