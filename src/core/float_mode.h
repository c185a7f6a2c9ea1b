// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <xmmintrin.h>

namespace halfspace {

/// While it lives, this thread computes in IEEE's default mode: round to nearest, denormals kept, exceptions masked.
/// Hosts and libraries (Embree among them) change the mode; results must not depend on that. The old mode comes back
/// at the end.
class FloatMode {
 public:
  FloatMode() : saved_(_mm_getcsr()) { _mm_setcsr(kDefault); }
  ~FloatMode() { _mm_setcsr(saved_); }
  FloatMode(const FloatMode&) = delete;
  FloatMode& operator=(const FloatMode&) = delete;

 private:
  static constexpr unsigned kDefault = 0x1f80;  // all exceptions masked, nearest even, no flush to zero
  unsigned saved_;
};

}  // namespace halfspace
