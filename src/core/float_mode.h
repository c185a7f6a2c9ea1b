// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <xmmintrin.h>

#include "halfspace/core/namespace.h"

namespace halfspace::HS_LANES {

/// Sets the default IEEE mode for the current thread (round to nearest, denormals kept, exceptions masked) and restores the
/// previous mode on destruction. Host programs and libraries such as Embree change the mode, and results must not depend on
/// that. Tasks and the functions that a host program calls create a FloatMode. The control word of the x87 is set as well: the C
/// library takes the rounding mode for reading and writing decimal numbers from it.
class FloatMode {
 public:
  FloatMode() : saved_(_mm_getcsr()) {
    __asm__ volatile("fnstcw %0" : "=m"(saved_x87_));
    _mm_setcsr(kDefault);
    if (saved_x87_ != kDefaultX87) set_x87(kDefaultX87);
  }
  ~FloatMode() {
    _mm_setcsr(saved_);
    if (saved_x87_ != kDefaultX87) set_x87(saved_x87_);
  }
  FloatMode(const FloatMode&) = delete;
  FloatMode& operator=(const FloatMode&) = delete;

 private:
  static void set_x87(unsigned short word) { __asm__ volatile("fldcw %0" : : "m"(word)); }

  static constexpr unsigned kDefault = 0x1f80;          // all exceptions masked, round to nearest even, no flush to zero
  static constexpr unsigned short kDefaultX87 = 0x37f;  // all exceptions masked, round to nearest even, 64-bit significand
  unsigned saved_;
  unsigned short saved_x87_ = 0;
};

}  // namespace halfspace::HS_LANES
