// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <xmmintrin.h>

namespace halfspace {

/// Sets the default IEEE mode for the current thread (round to nearest, denormals kept, exceptions masked) and restores the
/// previous mode on destruction. Host programs and libraries such as Embree change the mode, and results must not depend on
/// that.
class FloatMode {
 public:
  FloatMode() : saved_(_mm_getcsr()) { _mm_setcsr(kDefault); }
  ~FloatMode() { _mm_setcsr(saved_); }
  FloatMode(const FloatMode&) = delete;
  FloatMode& operator=(const FloatMode&) = delete;

 private:
  static constexpr unsigned kDefault = 0x1f80;  // all exceptions masked, round to nearest even, no flush to zero
  unsigned saved_;
};

}  // namespace halfspace
